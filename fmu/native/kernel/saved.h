/* The state of a model outside of it, for both versions of FMI. */

#ifndef CK_SAVED_H
#define CK_SAVED_H

#include "model.h"

int ck_saved_take(ck_model *model, void **state);
int ck_saved_restore(ck_model *model, const void *state);
int ck_saved_free(void **state);
int ck_saved_size(ck_model *model, const void *state, size_t *size);
int ck_saved_write(ck_model *model, const void *state, void *bytes, size_t size);
int ck_saved_read(ck_model *model, const void *bytes, size_t size, void **state);

#endif
