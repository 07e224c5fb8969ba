/* What both versions of FMI share: the folder of resources, and which messages are wanted. */

#ifndef CK_HOST_H
#define CK_HOST_H

#include <stddef.h>

enum { CK_LOG_ERROR = 1, CK_LOG_WARNING = 2, CK_LOG_EVENTS = 4, CK_LOG_COUPLING = 8, CK_LOG_ALL = 15 };

int ck_folder_of(const char *uri, char *folder, size_t size); /* 0 if it is no file */
int ck_wanted(int wanted, int on, size_t n, const char *const categories[]);
int ck_category(const char *name);                            /* 0 if there is none */
void ck_double_percents(const char *message, char *safe, size_t size);

#endif
