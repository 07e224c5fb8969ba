/* FMI 3.0 for co-simulation as a WebAssembly component calls it, by the draft FMI-LS-WASM 0.1.0.

   A component hands over numbers, and lists as places in memory that it has asked `ck_component_room`
   for. What has more than one number comes back as the place of a struct: a byte that is 0 for a
   result and 1 for a status, and behind it the result. fmu/native/component.py wraps these functions;
   each is called `ck_` and the name that the draft gives it. */

#ifdef CK_COMPONENT

#include "fmi3Functions.h"

#include "model.h"

#include <stdlib.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name("ck_" name)))
#define IMPORT(name) __attribute__((import_module("host"), import_name(name)))

/* Of the host: how it hears of us, and a file of the resources: 0, its bytes and their number; or 1. */
typedef struct {
    unsigned char failed;
    const char *bytes;
    size_t size;
} file;

IMPORT("log_message")
void host_log_message(const char *name, size_t name_size, int status, const char *category,
                      size_t category_size, const char *message, size_t message_size);
IMPORT("read_file") void host_read_file(const char *path, size_t size, file *found);

typedef struct {
    fmi3Instance instance;
    char *name;
} component;

/* Results: a list, a step, and what an event changed. */
typedef struct {
    unsigned char failed;
    union {
        unsigned char status;
        const void *first;
    } is;
    size_t count;
} list;

typedef struct {
    unsigned char failed;
    union {
        unsigned char status;
        struct {
            double last;
            fmi3Boolean event, terminate, early;
        } step;
        struct {
            fmi3Boolean again, terminate, nominals, values, has_next;
            double next;
        } update;
        uint64_t number;
    } is;
} record;

static list answer;    /* each is read before the next call */
static record record_of;
static void *answered; /* values of `answer` */

EXPORT("room") void *ck_component_room(void *old, size_t old_size, size_t align, size_t size) {
    void *found = size ? realloc(old, size) : (void *)align;
    (void)old_size;
    if (!found) __builtin_trap(); /* a component has no other way to refuse */
    return found;
}

/* An empty list has no room of its own. */
static void drop(void *first, size_t count) {
    if (count) free(first);
}

static const list *listed(int status, const void *first, size_t count) {
    answer.failed = status != fmi3OK;
    answer.count = count;
    if (answer.failed) answer.is.status = (unsigned char)status;
    else answer.is.first = first;
    return &answer;
}

/* Room for the values of a list, until the next one. */
static void *values_of(size_t count, size_t size) {
    free(answered);
    answered = calloc(count ? count : 1, size);
    if (!answered) __builtin_trap();
    return answered;
}

/* Life ---------------------------------------------------------------------------------------- */

static char *text(char *bytes, size_t size) {
    char *found = (char *)calloc(1, size + 1);
    if (!found) __builtin_trap();
    if (size) memcpy(found, bytes, size);
    drop(bytes, size);
    return found;
}

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                fmi3String message) {
    const component *own = (const component *)environment;
    host_log_message(own->name, strlen(own->name), (int)status, category, strlen(category), message,
                     strlen(message));
}

typedef struct {
    const char *next;
    size_t left;
} bytes;

static int take(void *from, void *to, size_t size) {
    bytes *own = (bytes *)from;
    if (own->left < size) return 0;
    memcpy(to, own->next, size);
    own->next += size, own->left -= size;
    return 1;
}

/* The host gives it once; all instances read it. */
const char *ck_data_read(const char *path, ck_data *data) {
    static const char name[] = "film.bin";
    static file found = {1, NULL, 0};
    const char *problem;
    bytes from;
    (void)path;
    memset(data, 0, sizeof *data);
    if (found.failed) host_read_file(name, sizeof name - 1, &found);
    if (found.failed) return "the host does not give it";
    from.next = found.bytes, from.left = found.size;
    problem = ck_data_from(take, &from, data);
    found.failed = problem != NULL; /* another time it may be whole */
    return problem;
}

EXPORT("get-version") const list *ck_component_version(void) {
    static list version;
    version.is.first = fmi3GetVersion();
    version.count = strlen(fmi3GetVersion());
    return (const list *)&version.is; /* a text has no status before it */
}

EXPORT("instantiate")
const list *ck_component_instantiate(char *name, size_t name_size, char *token, size_t token_size,
                                     int visible, int logs, int events, int early, void *wanted,
                                     size_t n_wanted) {
    component *own = (component *)calloc(1, sizeof *own);
    char *guid = text(token, token_size);
    if (!own) __builtin_trap();
    own->name = text(name, name_size);
    own->instance = fmi3InstantiateCoSimulation(own->name, guid, ".", visible, logs, events, early,
                                                (const fmi3ValueReference *)wanted, n_wanted, own, say,
                                                NULL);
    drop(wanted, n_wanted);
    free(guid);
    answer.failed = own->instance != NULL; /* an option: 1 if there is one */
    answer.is.first = own;
    if (own->instance) return &answer;
    free(own->name);
    free(own);
    return &answer;
}

EXPORT("free") void ck_component_free(component *own) {
    fmi3FreeInstance(own->instance);
    free(own->name);
    free(own);
}

EXPORT("set-debug-logging")
int ck_component_logging(component *own, int on, char **names, size_t n) {
    fmi3String *texts = (fmi3String *)calloc(n ? n : 1, sizeof *texts);
    size_t i;
    int status;
    if (!texts) __builtin_trap();
    for (i = 0; i < n; i++) texts[i] = text(names[2 * i], (size_t)names[2 * i + 1]);
    status = fmi3SetDebugLogging(own->instance, on, n, texts);
    for (i = 0; i < n; i++) free((void *)texts[i]);
    free(texts);
    drop(names, n);
    return status;
}

EXPORT("enter-initialization-mode")
int ck_component_enter(component *own, int has_tolerance, double tolerance, double start, int has_stop,
                       double stop) {
    return fmi3EnterInitializationMode(own->instance, has_tolerance, tolerance, start, has_stop, stop);
}

#define MODE(NAME, CALL)                                                                          \
    EXPORT(NAME) int ck_component_##CALL(component *own) { return fmi3##CALL(own->instance); }

MODE("exit-initialization-mode", ExitInitializationMode)
MODE("enter-event-mode", EnterEventMode)
MODE("enter-step-mode", EnterStepMode)
MODE("terminate", Terminate)
MODE("reset", Reset)
MODE("enter-configuration-mode", EnterConfigurationMode)
MODE("exit-configuration-mode", ExitConfigurationMode)
MODE("evaluate-discrete-states", EvaluateDiscreteStates)

static const record *recorded(int status) {
    record_of.failed = status != fmi3OK;
    if (record_of.failed) record_of.is.status = (unsigned char)status;
    return &record_of;
}

EXPORT("update-discrete-states") const record *ck_component_update(component *own) {
    fmi3Boolean again, terminate, nominals, values, has_next;
    double next = 0.0;
    int status = fmi3UpdateDiscreteStates(own->instance, &again, &terminate, &nominals, &values,
                                          &has_next, &next);
    record_of.is.update.again = again, record_of.is.update.terminate = terminate;
    record_of.is.update.nominals = nominals, record_of.is.update.values = values;
    record_of.is.update.has_next = has_next, record_of.is.update.next = next;
    return recorded(status);
}

EXPORT("do-step")
const record *ck_component_step(component *own, double time, double step, int keeps) {
    fmi3Boolean event = fmi3False, terminate = fmi3False, early = fmi3False;
    double last = time;
    int status = fmi3DoStep(own->instance, time, step, keeps, &event, &terminate, &early, &last);
    record_of.is.step.last = last, record_of.is.step.event = event;
    record_of.is.step.terminate = terminate, record_of.is.step.early = early;
    return recorded(status);
}

/* Variables ----------------------------------------------------------------------------------- */

#define ACCESS(NAME, TYPE)                                                                        \
    EXPORT("get-" NAME)                                                                           \
    const list *ck_component_get_##TYPE(component *own, fmi3ValueReference *vr, size_t n) {       \
        fmi3##TYPE *values = (fmi3##TYPE *)values_of(n, sizeof *values);                          \
        int status = fmi3Get##TYPE(own->instance, vr, n, values, n);                              \
        drop(vr, n);                                                                              \
        return listed(status, values, n);                                                         \
    }                                                                                             \
    EXPORT("set-" NAME)                                                                           \
    int ck_component_set_##TYPE(component *own, fmi3ValueReference *vr, size_t n,                 \
                                fmi3##TYPE *values, size_t m) {                                   \
        int status = fmi3Set##TYPE(own->instance, vr, n, values, m);                              \
        drop(vr, n), drop(values, m);                                                             \
        return status;                                                                            \
    }

ACCESS("float32", Float32)
ACCESS("float64", Float64)
ACCESS("int8", Int8)
ACCESS("int16", Int16)
ACCESS("int32", Int32)
ACCESS("int64", Int64)
ACCESS("uint8", UInt8)
ACCESS("uint16", UInt16)
ACCESS("uint32", UInt32)
ACCESS("uint64", UInt64)
ACCESS("boolean", Boolean)

/* Types that no variable has: lists, of which the lists inside are dropped too. */
#define NONE_OF(NAME, TYPE, DEPTH)                                                                \
    EXPORT("get-" NAME)                                                                           \
    const list *ck_component_get_##TYPE(component *own, fmi3ValueReference *vr, size_t n) {       \
        int status = fmi3GetFloat32(own->instance, vr, n, NULL, n);                               \
        drop(vr, n);                                                                              \
        return listed(status, values_of(0, 1), 0);                                                \
    }                                                                                             \
    EXPORT("set-" NAME)                                                                           \
    int ck_component_set_##TYPE(component *own, fmi3ValueReference *vr, size_t n, char **values,  \
                                size_t m) {                                                       \
        size_t i;                                                                                 \
        int status = fmi3SetFloat32(own->instance, vr, n, NULL, m);                               \
        for (i = 0; DEPTH && i < m; i++) drop(values[2 * i], (size_t)values[2 * i + 1]);          \
        drop(vr, n), drop(values, m);                                                             \
        return status;                                                                            \
    }

NONE_OF("string", String, 1)
NONE_OF("binary", Binary, 1)
NONE_OF("clock", Clock, 0)

/* Slopes, rates ------------------------------------------------------------------------------- */

#define SLOPES(NAME, CALL, COUNT)                                                                 \
    EXPORT(NAME)                                                                                  \
    const list *ck_component_##CALL(component *own, fmi3ValueReference *unknown, size_t n,        \
                                    fmi3ValueReference *known, size_t m, double *seed,            \
                                    size_t seeds) {                                               \
        double *found = (double *)values_of(COUNT, sizeof *found);                                \
        int status = fmi3Get##CALL(own->instance, unknown, n, known, m, seed, seeds, found, COUNT); \
        drop(unknown, n), drop(known, m), drop(seed, seeds);                                      \
        return listed(status, found, COUNT);                                                      \
    }

SLOPES("get-directional-derivative", DirectionalDerivative, n)
SLOPES("get-adjoint-derivative", AdjointDerivative, m)

EXPORT("get-output-derivatives")
const list *ck_component_rates(component *own, fmi3ValueReference *asked, size_t n) {
    fmi3ValueReference *vr = (fmi3ValueReference *)calloc(n ? n : 1, sizeof *vr);
    fmi3Int32 *orders = (fmi3Int32 *)calloc(n ? n : 1, sizeof *orders);
    double *found = (double *)values_of(n, sizeof *found);
    size_t i;
    int status;
    if (!vr || !orders) __builtin_trap();
    for (i = 0; i < n; i++) vr[i] = asked[2 * i], orders[i] = (fmi3Int32)asked[2 * i + 1];
    status = fmi3GetOutputDerivatives(own->instance, vr, n, orders, found, n);
    free(vr), free(orders);
    drop(asked, n);
    return listed(status, found, n);
}

/* The state: bytes at once, as a host cannot hold what is inside. */
EXPORT("get-fmu-state") const list *ck_component_take(component *own) {
    fmi3FMUState state = NULL;
    size_t size = 0;
    fmi3Byte *room = NULL;
    int status = fmi3GetFMUState(own->instance, &state);
    if (status == fmi3OK) status = fmi3SerializedFMUStateSize(own->instance, state, &size);
    if (status == fmi3OK) {
        room = (fmi3Byte *)values_of(size, 1);
        status = fmi3SerializeFMUState(own->instance, state, room, size);
    }
    if (state) fmi3FreeFMUState(own->instance, &state);
    return listed(status, room, size);
}

EXPORT("set-fmu-state") int ck_component_restore(component *own, fmi3Byte *given, size_t size) {
    fmi3FMUState state = NULL;
    int status = fmi3DeserializeFMUState(own->instance, given, size, &state);
    if (status == fmi3OK) status = fmi3SetFMUState(own->instance, state);
    if (state) fmi3FreeFMUState(own->instance, &state);
    drop(given, size);
    return status;
}

/* What this FMU does not have ------------------------------------------------------------------ */

EXPORT("get-number-of-variable-dependencies")
const record *ck_component_dependency_count(component *own, unsigned vr) {
    size_t count = 0;
    return recorded(fmi3GetNumberOfVariableDependencies(own->instance, vr, &count));
}

EXPORT("get-variable-dependencies")
const list *ck_component_dependencies(component *own, unsigned vr) {
    return listed(fmi3GetVariableDependencies(own->instance, vr, NULL, NULL, NULL, NULL, 0), NULL, 0);
}

#define CLOCK(NAME, CALL)                                                                         \
    EXPORT("get-" NAME)                                                                           \
    const list *ck_component_get_##CALL(component *own, unsigned *vr, size_t n) {                 \
        drop(vr, n);                                                                              \
        return listed(fmi3GetShiftDecimal(own->instance, NULL, 0, NULL), NULL, 0);                \
    }                                                                                             \
    EXPORT("set-" NAME)                                                                           \
    int ck_component_set_##CALL(component *own, unsigned *vr, size_t n, void *values, size_t m) { \
        drop(vr, n), drop(values, m);                                                             \
        return fmi3SetShiftDecimal(own->instance, NULL, 0, NULL);                                 \
    }

CLOCK("interval-decimal", IntervalDecimal)
CLOCK("interval-fraction", IntervalFraction)
CLOCK("shift-decimal", ShiftDecimal)
CLOCK("shift-fraction", ShiftFraction)

EXPORT("set-input-derivatives")
int ck_component_input_rates(component *own, unsigned *asked, size_t n, double *values, size_t m) {
    drop(asked, n), drop(values, m);
    if (n == 0 && m == 0) return fmi3OK;
    say((fmi3InstanceEnvironment)own, fmi3Error, "logStatusError",
        "setInputDerivatives: FMI 3.0 has none; set the input dF_ext");
    return fmi3Error;
}

#else

typedef int ck_no_component; /* a file of C is not empty */

#endif
