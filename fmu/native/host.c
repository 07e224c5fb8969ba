/* See host.h. */

#include "host.h"

#include <string.h>

static int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Path of a file URI; a plain path is taken as it is. */
int ck_folder_of(const char *uri, char *folder, size_t size) {
    size_t n = 0;
    int is_uri = strncmp(uri, "file:", 5) == 0;
    if (is_uri) {
        uri += 5;
        if (strncmp(uri, "//localhost/", 12) == 0) uri += 11;
        else if (strncmp(uri, "///", 3) == 0) uri += 2;
#ifdef _WIN32
        if (uri[0] == '/' && uri[1] && uri[2] == ':') uri++;
#endif
    }
    while (*uri && n + 1 < size) {
        if (is_uri && uri[0] == '%' && digit(uri[1]) >= 0 && digit(uri[2]) >= 0) {
            folder[n++] = (char)(16 * digit(uri[1]) + digit(uri[2]));
            uri += 3;
        } else {
            folder[n++] = *uri++;
        }
    }
    if (*uri) return 0;
    while (n > 1 && (folder[n - 1] == '/' || folder[n - 1] == '\\')) n--;
    folder[n] = 0;
    return n > 0;
}

int ck_category(const char *name) {
    if (!name) return 0;
    if (strcmp(name, "logAll") == 0) return CK_LOG_ALL;
    if (strcmp(name, "logStatusError") == 0) return CK_LOG_ERROR;
    if (strcmp(name, "logStatusWarning") == 0) return CK_LOG_WARNING;
    if (strcmp(name, "logEvents") == 0) return CK_LOG_EVENTS;
    return strcmp(name, "logCoupling") == 0 ? CK_LOG_COUPLING : 0;
}

/* Categories that are wanted once some, or all if none is named, are switched on or off. */
int ck_wanted(int wanted, int on, size_t n, const char *const categories[]) {
    size_t i;
    if (n == 0) return on ? CK_LOG_ALL : 0;
    if (on) wanted = 0; /* those named, and no other */
    for (i = 0; i < n; i++)
        wanted = on ? wanted | ck_category(categories[i]) : wanted & ~ck_category(categories[i]);
    return wanted;
}

/* Hosts hand messages to printf. */
void ck_double_percents(const char *message, char *safe, size_t size) {
    size_t n = 0;
    for (; *message && n + 3 < size; message++) {
        if (*message == '%') safe[n++] = '%';
        safe[n++] = *message;
    }
    safe[n] = 0;
}
