/* Stands between a host and the library of pythonfmu, which trusts every pointer it is given.

   A host that frees an instance twice, uses one that is gone, forgets an argument or writes a
   resource location of odd letters hears fmi2Error and why, instead of losing its process. A host
   that is no Python, or keeps Python to itself, gets an interpreter loaded for the library. */

#define _GNU_SOURCE
#include "fmi2Functions.h"

#include "host.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EACH(DO)                                                                                 \
    DO(Instantiate) DO(FreeInstance) DO(SetDebugLogging) DO(SetupExperiment)                     \
    DO(EnterInitializationMode) DO(ExitInitializationMode) DO(Terminate) DO(Reset)               \
    DO(GetReal) DO(GetInteger) DO(GetBoolean) DO(GetString) DO(SetReal) DO(SetInteger)           \
    DO(SetBoolean) DO(SetString) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate)                \
    DO(SerializedFMUstateSize) DO(SerializeFMUstate) DO(DeSerializeFMUstate)                     \
    DO(GetDirectionalDerivative) DO(SetRealInputDerivatives) DO(GetRealOutputDerivatives)        \
    DO(DoStep) DO(CancelStep) DO(GetStatus) DO(GetRealStatus) DO(GetIntegerStatus)               \
    DO(GetBooleanStatus) DO(GetStringStatus)

#define DECLARE(name) static fmi2##name##TYPE *inner_##name;
EACH(DECLARE)

#define PATH 4096 /* of a resource, as long as Linux takes one */
#define LINE 200  /* of a text that the FMU holds: names of a module and of a script */
static const char NEWEST = 19, OLDEST = 11; /* versions of Python 3 to look for */

typedef struct instance {
    fmi2Component inner;
    fmi2CallbackFunctions callbacks; /* pythonfmu keeps the address and calls the logger unasked */
    char *name, *folder;
    fmi2Boolean visible;
    int lost; /* the library called it fatal, and has freed it */
    struct instance *next;
} instance;

/* Logging ------------------------------------------------------------------------------------ */

static void deaf(fmi2ComponentEnvironment e, fmi2String name, fmi2Status s, fmi2String category,
                 fmi2String message, ...) {
    (void)e, (void)name, (void)s, (void)category, (void)message;
}

static void tell(const fmi2CallbackFunctions *to, const char *name, const char *message) {
    char safe[1600];
    ck_double_percents(message, safe, sizeof safe);
    to->logger(to->componentEnvironment, name ? name : "", fmi2Error, "logStatusError", safe);
}

static fmi2Status refuse(const instance *own, const char *message) {
    tell(&own->callbacks, own->name, message);
    return fmi2Error;
}

/* Loading ------------------------------------------------------------------------------------ */

static void beside(const char *name, char *path, size_t size) {
    Dl_info own;
    const char *slash;
    int length = 0;
    if (dladdr((void *)&inner_Instantiate, &own) && own.dli_fname && (slash = strrchr(own.dli_fname, '/')))
        length = (int)(slash - own.dli_fname) + 1;
    snprintf(path, size, "%.*s%s", length, length ? own.dli_fname : "", name);
}

/* Make the symbols of Python visible to the library, which names no library they come from. */
static int find_python(void) {
    const char *wanted = getenv("CONTACTKIT_LIBPYTHON");
    char name[64];
    int version, pass;
    if (dlsym(RTLD_DEFAULT, "PyGILState_Ensure")) return 1;
    for (pass = 0; pass < 2; pass++) /* first what the host has loaded for itself, then what there is */
        for (version = NEWEST; version >= OLDEST; version--) {
            snprintf(name, sizeof name, "libpython3.%d.so.1.0", version);
            if (dlopen(name, RTLD_NOW | RTLD_GLOBAL | (pass ? 0 : RTLD_NOLOAD))) return 1;
            if (pass == 0 && version == OLDEST && wanted && dlopen(wanted, RTLD_NOW | RTLD_GLOBAL))
                return 1;
        }
    return 0;
}

/* Stay as the library of pythonfmu does: instances that were put aside are known here. */
static void pin(void) {
    Dl_info own;
    if (dladdr((void *)&inner_Instantiate, &own) && own.dli_fname)
        dlopen(own.dli_fname, RTLD_NOW | RTLD_NODELETE);
}

static const char *load_all(void) {
    static char problem[PATH + 400];
    char path[PATH];
    void *library;
    void (*let_go)(int, void *); /* takes nothing: what it is given lies in registers it does not read */
    int found;
    if (inner_Instantiate) return NULL;
    beside("pythonfmu.so", path, sizeof path);
    found = find_python();
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library) {
        snprintf(problem, sizeof problem, "%s%s", dlerror(),
                 found ? "" : "; this FMU needs Python 3.11 or later: let the loader find its "
                              "libpython3.so, or name the file in CONTACTKIT_LIBPYTHON, or build a native FMU");
        return problem;
    }
    /* When a process ends, pythonfmu gives up its hold of Python from a destructor that comes after those
       of C++, so a second time and into freed memory; done before them there is nothing left to do. */
    *(void **)&let_go = dlsym(library, "finalizePythonInterpreter");
    if (let_go) on_exit(let_go, NULL);
    pin();
#define LOAD(name)                                                                               \
    if (!(*(void **)&inner_##name = dlsym(library, "fmi2" #name))) {                             \
        inner_Instantiate = NULL;                                                                \
        return "the library of pythonfmu lacks fmi2" #name "; build the FMU again";              \
    }
    EACH(LOAD)
    return NULL;
}

static const char *load(void) {
    static char busy;
    const char *problem;
    while (__atomic_exchange_n(&busy, 1, __ATOMIC_ACQUIRE)) continue;
    problem = load_all();
    __atomic_store_n(&busy, 0, __ATOMIC_RELEASE);
    return problem;
}

/* Instances ---------------------------------------------------------------------------------- */

/* Whether a file of the resources has as many lines; the last of them, if there is room for it. */
static int read_line(const char *folder, const char *name, int number, char line[LINE]) {
    char path[PATH + LINE + 40];
    FILE *file;
    int fine = 1;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    file = fopen(path, "rb");
    if (!file) return 0;
    while (fine && number-- > 0) fine = fgets(line, LINE, file) != NULL;
    fclose(file);
    line[fine ? strcspn(line, "\r\n") : 0] = 0;
    return fine;
}

static const char *check(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                         char *folder) {
    char line[LINE], module[LINE], script[LINE + 4];
    if (!name || !*name) return "the instance needs a name";
    if (type != fmi2CoSimulation) return "this FMU is for co-simulation only";
    if (!resources || !ck_folder_of(resources, folder, PATH))
        return "the resource location is missing, or is no file";
    if (!read_line(folder, "slavemodule.txt", 1, module))
        return "the resource location is no folder of this FMU; give that of its folder resources";
    if (strstr(folder, "%20"))
        return "the path of the FMU must not hold the letters %20; unpack it elsewhere";
    if (!guid || !read_line(folder, "guard.txt", 1, line) || strcmp(line, guid) != 0)
        return "the GUID is not that of this FMU; take it from its modelDescription.xml";
    snprintf(script, sizeof script, "%s.py", module);
    if (!read_line(folder, "guard.txt", 2, line) || strcmp(line, module) != 0 ||
        !read_line(folder, script, 1, line))
        return "resources/slavemodule.txt, or the script it names, is not that of this FMU; unpack or "
               "build it again";
    return load();
}

static char *copy_of(const char *text) {
    char *copy = (char *)malloc((text ? strlen(text) : 0) + 1);
    if (copy) strcpy(copy, text ? text : "");
    return copy;
}

static void give_up(instance *own) {
    if (!own) return;
    free(own->name);
    free(own->folder);
    free(own);
}

/* Instances that were freed serve again: of each one it makes, pythonfmu keeps a part for ever. */
enum { MOST_IDLE = 16 };
static instance *idle;
static char idle_busy;

static void hold(void) {
    while (__atomic_exchange_n(&idle_busy, 1, __ATOMIC_ACQUIRE)) continue;
}

static void let_go_of(void) { __atomic_store_n(&idle_busy, 0, __ATOMIC_RELEASE); }

/* Keep an instance for later; the one that is too many, or NULL. */
static instance *put_aside(instance *own) {
    instance **last = &idle, *spare;
    int count = 0;
    own->callbacks.logger = deaf; /* that of the host may be gone */
    hold();
    own->next = idle, idle = own;
    while (*last && count++ < MOST_IDLE) last = &(*last)->next;
    spare = *last;
    *last = NULL;
    let_go_of();
    return spare;
}

/* One that was put aside, with the name and in the folder of a new one; NULL if there is none. */
static instance *take_back(const instance *new) {
    instance **at = &idle, *found;
    hold();
    while (*at && (strcmp((*at)->name, new->name) || strcmp((*at)->folder, new->folder) ||
                   (*at)->visible != new->visible))
        at = &(*at)->next;
    found = *at;
    if (found) *at = found->next;
    let_go_of();
    return found;
}

/* Instance of the library: one that was put aside and could be reset, or a new one. */
static instance *make(instance *new, fmi2String guid) {
    instance *old = take_back(new);
    fmi2Status status = fmi2Fatal;
    if (old) {
        old->callbacks = new->callbacks;
        status = inner_SetDebugLogging(old->inner, fmi2True, 0, NULL);
        if (status == fmi2OK) status = inner_Reset(old->inner);
        if (status == fmi2OK) {
            give_up(new);
            return old;
        }
        if (status != fmi2Fatal) inner_FreeInstance(old->inner);
        give_up(old);
    }
    /* a plain path: of a URI pythonfmu would undo nothing but blanks */
    new->inner = inner_Instantiate(new->name, fmi2CoSimulation, guid, new->folder, &new->callbacks,
                                   new->visible, fmi2True);
    return new;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logs) {
    instance *own = (instance *)calloc(1, sizeof *own);
    char folder[PATH] = "";
    const char *problem;
    void *handle = NULL;
    fmi2String errors = "logStatusError";
    if (!own) return NULL;
    if (functions) own->callbacks = *functions;
    if (!own->callbacks.logger) own->callbacks.logger = deaf;
    problem = check(name, type, guid, resources, folder);
    own->name = copy_of(name), own->folder = copy_of(folder), own->visible = visible;
    if (!own->name || !own->folder) problem = "there is no memory left";
    if (!problem) {
        own = make(own, guid);
        /* Why it refuses is no debugging, and said to a host that wants none of that, too. */
        if (own->inner && !logs) inner_SetDebugLogging(own->inner, fmi2True, 1, &errors);
        if (own->inner && !(handle = ck_handle_new(CK_INSTANCES, own))) {
            inner_FreeInstance(own->inner);
            problem = "there are too many instances";
        }
    }
    if (problem) tell(&own->callbacks, own->name, problem);
    if (!handle) give_up(own);
    return handle;
}

void fmi2FreeInstance(fmi2Component c) {
    instance *own = (instance *)ck_handle_free(CK_INSTANCES, c), *spare = own;
    if (!own) return;
    if (!own->lost) spare = put_aside(own);
    if (!spare) return;
    if (!spare->lost) inner_FreeInstance(spare->inner);
    give_up(spare);
}

#define OWN(c)                                                                                   \
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);                              \
    if (!own || own->lost) return fmi2Error
#define NEEDS(given, function)                                                                   \
    if (!(given)) return refuse(own, function ": arguments are missing; nothing was done")

/* After a fatal error the instance is gone: remember that, so that nothing touches it again. */
static fmi2Status pass(instance *own, fmi2Status status) {
    if (status == fmi2Fatal) own->lost = 1;
    return status;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) {
    size_t i;
    OWN(c);
    NEEDS(n == 0 || names, "setDebugLogging");
    for (i = 0; i < n; i++) NEEDS(names[i], "setDebugLogging");
    return pass(own, inner_SetDebugLogging(own->inner, on, n, names));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop) {
    OWN(c);
    return pass(own, inner_SetupExperiment(own->inner, has_tolerance, tolerance, start, has_stop, stop));
}

#define PLAIN(name)                                                                              \
    fmi2Status fmi2##name(fmi2Component c) {                                                     \
        OWN(c);                                                                                  \
        return pass(own, inner_##name(own->inner));                                              \
    }
PLAIN(EnterInitializationMode)
PLAIN(ExitInitializationMode)
PLAIN(Terminate)
PLAIN(Reset)
PLAIN(CancelStep)

/* Variables ---------------------------------------------------------------------------------- */

#define ACCESS(name, type)                                                                       \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference vr[], size_t n,           \
                             type value[]) {                                                     \
        OWN(c);                                                                                  \
        NEEDS(n == 0 || (vr && value), "get" #name);                                             \
        return pass(own, inner_Get##name(own->inner, vr, n, value));                             \
    }                                                                                            \
    fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference vr[], size_t n,           \
                             const type value[]) {                                               \
        OWN(c);                                                                                  \
        NEEDS(n == 0 || (vr && value), "set" #name);                                             \
        return pass(own, inner_Set##name(own->inner, vr, n, value));                             \
    }
ACCESS(Real, fmi2Real)
ACCESS(Integer, fmi2Integer)
ACCESS(Boolean, fmi2Boolean)

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[]) {
    OWN(c);
    NEEDS(n == 0 || (vr && value), "getString");
    return pass(own, inner_GetString(own->inner, vr, n, value));
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[]) {
    size_t i;
    OWN(c);
    NEEDS(n == 0 || (vr && value), "setString");
    for (i = 0; i < n; i++) NEEDS(value[i], "setString");
    return pass(own, inner_SetString(own->inner, vr, n, value));
}

/* States ------------------------------------------------------------------------------------- */

static const char NO_STATE[] = "that is no FMU state, or it was freed; take one first";

static void *inner_state(const void *state) { return ck_handle_content(CK_STATES, state); }

/* The host may hand in a state it has: it gets the new one in its place. */
static fmi2Status keep(instance *own, fmi2Status status, void *found, fmi2FMUstate *state) {
    void *old = ck_handle_free(CK_STATES, *state), *handle;
    if (old) inner_FreeFMUstate(own->inner, &old);
    *state = NULL;
    if (status != fmi2OK) return pass(own, status);
    handle = ck_handle_new(CK_STATES, found);
    if (!handle) {
        inner_FreeFMUstate(own->inner, &found);
        return refuse(own, "there is no room for more FMU states; free some");
    }
    *state = handle;
    return status;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    void *found = NULL;
    fmi2Status status;
    OWN(c);
    NEEDS(ck_is_place(state), "getFMUstate");
    status = inner_GetFMUstate(own->inner, &found);
    return keep(own, status, found, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    void *found = inner_state(state);
    OWN(c);
    return found ? pass(own, inner_SetFMUstate(own->inner, found)) : refuse(own, NO_STATE);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    void *found;
    int is_place = ck_is_place(state); /* some hosts leave out the & and give the state itself */
    OWN(c);
    if (!state) return fmi2OK;
    found = ck_handle_free(CK_STATES, is_place ? *state : (void *)state);
    if (is_place) *state = NULL;
    return found ? pass(own, inner_FreeFMUstate(own->inner, &found)) : fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    void *found = inner_state(state);
    OWN(c);
    if (!found || !size) return refuse(own, NO_STATE);
    return pass(own, inner_SerializedFMUstateSize(own->inner, found, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    void *found = inner_state(state);
    fmi2Status status;
    size_t needed = 0;
    OWN(c);
    if (!found || !bytes) return refuse(own, NO_STATE);
    status = inner_SerializedFMUstateSize(own->inner, found, &needed);
    if (status != fmi2OK) return pass(own, status);
    if (size < needed) return refuse(own, "serializeFMUstate: there is too little room");
    return pass(own, inner_SerializeFMUstate(own->inner, found, bytes, needed));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state) {
    void *found = NULL;
    fmi2Status status;
    OWN(c);
    NEEDS(bytes && ck_is_place(state), "deSerializeFMUstate");
    status = inner_DeSerializeFMUstate(own->inner, bytes, size, &found);
    return keep(own, status, found, state);
}

/* Steps and the rest ------------------------------------------------------------------------- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean keeps) {
    OWN(c);
    return pass(own, inner_DoStep(own->inner, time, step, keeps));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t n,
                                        const fmi2ValueReference known[], size_t m,
                                        const fmi2Real seed[], fmi2Real value[]) {
    OWN(c);
    return pass(own, inner_GetDirectionalDerivative(own->inner, unknown, n, known, m, seed, value));
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    OWN(c);
    return pass(own, inner_SetRealInputDerivatives(own->inner, vr, n, order, value));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[]) {
    OWN(c);
    return pass(own, inner_GetRealOutputDerivatives(own->inner, vr, n, order, value));
}

#define STATUS(name, type)                                                                       \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2StatusKind kind, type *value) {          \
        OWN(c);                                                                                  \
        NEEDS(value, "get" #name);                                                               \
        return pass(own, inner_Get##name(own->inner, kind, value));                              \
    }
STATUS(Status, fmi2Status)
STATUS(RealStatus, fmi2Real)
STATUS(IntegerStatus, fmi2Integer)
STATUS(BooleanStatus, fmi2Boolean)
STATUS(StringStatus, fmi2String)

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
