/* Common to both versions of FMI, and to the guard of a Python FMU: the folder of resources, wanted
   messages, and handles in place of pointers. */

#ifndef CK_HOST_H
#define CK_HOST_H

#include <stddef.h>

enum { CK_LOG_ERROR = 1, CK_LOG_WARNING = 2, CK_LOG_EVENTS = 4, CK_LOG_COUPLING = 8, CK_LOG_ALL = 15 };

int ck_folder_of(const char *uri, char *folder, size_t size); /* 0 if it is no file */
int ck_wanted(int wanted, int on, size_t n, const char *const categories[]);
int ck_category(const char *name);                            /* 0 if there is none */
void ck_double_percents(const char *message, char *safe, size_t size);

/* Handles are numbers that are checked before anything is touched: one that was freed, or never
   given out, is recognised; freeing twice does no harm. */
enum { CK_INSTANCES = 0, CK_STATES = 1 };

int ck_is_place(const void *place); /* for a handle; 0 for NULL, or a handle, which is no address */
void *ck_handle_new(int kind, void *content); /* NULL if there are too many */
void *ck_handle_content(int kind, const void *handle);
void *ck_handle_free(int kind, const void *handle); /* content, or NULL if it was no handle */

#endif
