/* What a host hands over and gets: folders, categories of messages, handles; see host.h. */

#include "host.h"

#include <stdint.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#endif
#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#endif

static int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Whether a text begins with another in small letters. */
static int begins(const char *text, const char *with) {
    for (; *with; text++, with++)
        if ((*text >= 'A' && *text <= 'Z' ? *text - 'A' + 'a' : *text) != *with) return 0;
    return 1;
}

#ifdef _WIN32
/* Without the slashes before a drive: hosts make file:///C:/x, file:///C%3A/x or file://C:/x of it. */
static void start_at_drive(char *folder) {
    size_t from = 0, n = 0;
    while (folder[from] == '/') from++;
    if (from == 0 || !folder[from] || folder[from + 1] != ':') return;
    do folder[n] = folder[from + n];
    while (folder[n++]);
}

/* What is no UTF-8 is in the code page of this computer; hosts hand over what they have. */
static int make_utf8(char *folder, size_t size) {
    wchar_t wide[1024];
    if (MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, folder, -1, wide, 1024)) return 1;
    return MultiByteToWideChar(CP_ACP, 0, folder, -1, wide, 1024) &&
           WideCharToMultiByte(CP_UTF8, 0, wide, -1, folder, (int)size, NULL, NULL);
}
#endif

/* Path of a file URI; a plain path is taken as it is. */
int ck_folder_of(const char *uri, char *folder, size_t size) {
    size_t n = 0;
    int is_uri = begins(uri, "file:");
    if (is_uri) {
        uri += 5;
        if (begins(uri, "//localhost/")) uri += 11;
        else if (strncmp(uri, "///", 3) == 0) uri += 2;
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
#ifdef _WIN32
    if (is_uri) start_at_drive(folder);
    if (!make_utf8(folder, size)) return 0;
#endif
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

/* Handles: slots with a generation each, both in one number in the shape of a pointer ---------- */

#if defined(_MSC_VER) && !defined(__clang__)
#define LOCK(flag) while (_InterlockedExchange(&(flag), 1))
#define UNLOCK(flag) _InterlockedExchange(&(flag), 0)
#define LOAD(value) (value)
#define STORE(value, to) ((value) = (to))
#else
#define LOCK(flag) while (__atomic_exchange_n(&(flag), 1, __ATOMIC_ACQUIRE))
#define UNLOCK(flag) __atomic_store_n(&(flag), 0, __ATOMIC_RELEASE)
#define LOAD(value) __atomic_load_n(&(value), __ATOMIC_ACQUIRE)
#define STORE(value, to) __atomic_store_n(&(value), (to), __ATOMIC_RELEASE)
#endif

/* Instances, and states, that a library has at a time. A handle is the number of its slot beside that
   of its use, so that one that was freed is never taken for a later one; 1 MB for each kind. */
#ifndef SLOTS
#define SLOTS 65536u
#endif

typedef struct {
    void *content;
    uintptr_t generation;
} slot;

static slot slots[2][SLOTS];
static uint32_t first_free[2]; /* no slot below it is free */
static long busy;

static slot *slot_of(int kind, const void *handle) {
    uintptr_t number = (uintptr_t)handle;
    slot *found = &slots[kind][(number >> 1) % SLOTS];
    /* odd, so that it is never the address of anything */
    if (!(number & 1u) || LOAD(found->generation) != number / (2u * SLOTS)) return NULL;
    return LOAD(found->content) ? found : NULL;
}

int ck_is_place(const void *place) { return place && !((uintptr_t)place & 1u); }

void *ck_handle_new(int kind, void *content) {
    uint32_t i;
    void *handle = NULL;
    LOCK(busy);
    for (i = first_free[kind]; i < SLOTS && slots[kind][i].content; i++) continue;
    first_free[kind] = i;
    if (i < SLOTS) {
        uintptr_t most = UINTPTR_MAX / (4u * SLOTS), next = slots[kind][i].generation + 1;
        /* each library begins elsewhere, so that none takes a handle of another for its own */
        if (next == 1) next += (uintptr_t)slots / 4096u % (most / 2u);
        if (next > most) next = 1;
        STORE(slots[kind][i].generation, next);
        STORE(slots[kind][i].content, content);
        first_free[kind] = i + 1;
        handle = (void *)((next * SLOTS + i) * 2u + 1u);
    }
    UNLOCK(busy);
    return handle;
}

void *ck_handle_content(int kind, const void *handle) {
    slot *found = slot_of(kind, handle);
    return found ? LOAD(found->content) : NULL;
}

void *ck_handle_free(int kind, const void *handle) {
    void *content = NULL;
    slot *found;
    LOCK(busy);
    found = slot_of(kind, handle);
    if (found) {
        uint32_t i = (uint32_t)(found - slots[kind]);
        content = found->content;
        STORE(found->content, NULL);
        if (i < first_free[kind]) first_free[kind] = i;
    }
    UNLOCK(busy);
    return content;
}
