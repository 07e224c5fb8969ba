/* Slots with a generation each: a handle is both, as one number in the shape of a pointer. */

#include "handles.h"

#include <stddef.h>
#include <stdint.h>

#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
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

#define SLOTS 65536u

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
