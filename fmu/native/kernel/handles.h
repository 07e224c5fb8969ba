/* What the host gets in place of pointers: numbers that are checked before anything is touched.

   A handle that was freed, or never given out, is recognised; freeing twice does no harm. */

#ifndef CK_HANDLES_H
#define CK_HANDLES_H

enum { CK_INSTANCES = 0, CK_STATES = 1 };

void *ck_handle_new(int kind, void *content); /* NULL if there are too many */
void *ck_handle_content(int kind, const void *handle);
void *ck_handle_free(int kind, const void *handle); /* content, or NULL if it was no handle */

#endif
