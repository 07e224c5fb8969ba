/* See saved.h. Bytes are letters and a checksum, then the state as it lies in memory. */

#include "saved.h"

#include "handles.h"

#include <stdlib.h>
#include <string.h>

#define HEAD 16u
#define SIZE (HEAD + sizeof(ck_state))

static const char NO_STATE[] = "that is no FMU state, or it was freed; take one first";

/* A state the host may keep: its own if it has one, else a new one. */
static int keep(ck_model *model, const ck_state *content, void **state) {
    ck_state *own = (ck_state *)ck_handle_content(CK_STATES, *state);
    if (!own) {
        void *handle;
        own = (ck_state *)malloc(sizeof *own);
        handle = own ? ck_handle_new(CK_STATES, own) : NULL;
        if (!handle) {
            free(own);
            return ck_model_fail(model, "there is no room for more FMU states; free some");
        }
        *state = handle;
    }
    memcpy(own, content, sizeof *own);
    return CK_OK;
}

int ck_saved_take(ck_model *model, void **state) {
    if (!state) return ck_model_fail(model, "getFMUstate: the argument is missing");
    return keep(model, &model->state, state);
}

int ck_saved_restore(ck_model *model, const void *state) {
    const ck_state *content = (const ck_state *)ck_handle_content(CK_STATES, state);
    return content ? ck_model_restore(model, content) : ck_model_fail(model, NO_STATE);
}

int ck_saved_free(void **state) {
    if (!state) return CK_OK;
    free(ck_handle_free(CK_STATES, *state));
    *state = NULL;
    return CK_OK;
}

int ck_saved_size(ck_model *model, const void *state, size_t *size) {
    if (!size || !ck_handle_content(CK_STATES, state)) return ck_model_fail(model, NO_STATE);
    *size = SIZE;
    return CK_OK;
}

int ck_saved_write(ck_model *model, const void *state, void *bytes, size_t size) {
    const ck_state *content = (const ck_state *)ck_handle_content(CK_STATES, state);
    char *to = (char *)bytes;
    uint64_t sum;
    if (!content || !to) return ck_model_fail(model, NO_STATE);
    if (size < SIZE) return ck_model_fail(model, "serializeFMUstate: there is too little room");
    sum = ck_checksum(content, sizeof *content);
    memcpy(to, "CKSTATE1", 8);
    memcpy(to + 8, &sum, 8);
    memcpy(to + HEAD, content, sizeof *content);
    return CK_OK;
}

int ck_saved_read(ck_model *model, const void *bytes, size_t size, void **state) {
    const char *from = (const char *)bytes;
    ck_state content;
    uint64_t sum;
    if (!from || !state || size < SIZE || memcmp(from, "CKSTATE1", 8) != 0)
        return ck_model_fail(model, "deSerializeFMUstate: these are no bytes of an FMU state; give those that "
                                    "serializeFMUstate wrote, unchanged");
    memcpy(&sum, from + 8, 8);
    memcpy(&content, from + HEAD, sizeof content);
    if (sum != ck_checksum(&content, sizeof content))
        return ck_model_fail(model, "deSerializeFMUstate: the bytes were changed; give those that "
                                    "serializeFMUstate wrote");
    return keep(model, &content, state);
}
