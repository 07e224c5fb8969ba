/* A host in C without any Python: loads the library of an FMU and runs a release, or misuses it.

   native_host LIBRARY RESOURCES GUID run FORCE STEP END     prints t_release, F_peak and J
   native_host LIBRARY RESOURCES GUID misuse                 ends with 0 if it lives
   native_host LIBRARY RESOURCES GUID time COUNT             nanoseconds of set, step, get

   Value references are those of the variables in the order of kernel/model.h, from 1. */

#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2FunctionTypes.h"

#define EACH(DO)                                                                                 \
    DO(Instantiate) DO(FreeInstance) DO(SetupExperiment) DO(EnterInitializationMode)             \
    DO(ExitInitializationMode) DO(Terminate) DO(Reset) DO(GetReal) DO(GetInteger) DO(SetReal)    \
    DO(SetInteger) DO(GetString) DO(GetBoolean) DO(SetBoolean) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate) \
    DO(SerializedFMUstateSize) DO(SerializeFMUstate) DO(DeSerializeFMUstate) DO(DoStep)          \
    DO(CancelStep) DO(SetDebugLogging) DO(GetDirectionalDerivative) DO(SetRealInputDerivatives)  \
    DO(GetRealOutputDerivatives) DO(GetStatus) DO(GetRealStatus) DO(GetBooleanStatus)            \
    DO(GetIntegerStatus) DO(GetStringStatus) DO(GetVersion) DO(GetTypesPlatform)

#define DECLARE(name) static fmi2##name##TYPE *name;
EACH(DECLARE)

static const char *folder, *guid;
static int failures, messages;

static void hear(fmi2ComponentEnvironment e, fmi2String name, fmi2Status s, fmi2String category,
                 fmi2String message, ...) {
    (void)e, (void)name, (void)s;
    messages++;
    if (!category || !message || strlen(message) > 3000) failures++;
    if (getenv("HEAR")) fprintf(stderr, "%s: %s\n", category, message);
}

static const fmi2CallbackFunctions CALLBACKS = {hear, calloc, free, NULL, NULL};

static fmi2Component open_one(void) {
    return Instantiate("one", fmi2CoSimulation, guid, folder, &CALLBACKS, fmi2False, fmi2True);
}

static fmi2Component start_one(void) {
    fmi2Component c = open_one();
    if (!c) return NULL;
    SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
    EnterInitializationMode(c);
    ExitInitializationMode(c);
    return c;
}

static double real(fmi2Component c, fmi2ValueReference vr) {
    fmi2Real value = NAN;
    if (GetReal(c, &vr, 1, &value) != fmi2OK) failures++;
    return value;
}

static void expect(int is, int wanted, const char *what) {
    if (is == wanted) return;
    fprintf(stderr, "%s: status %d, not %d\n", what, is, wanted);
    failures++;
}

static void run(double force, double step, double end) {
    fmi2Component c = start_one();
    fmi2ValueReference pull = 1;
    long i, count = lround(end / step);
    SetReal(c, &pull, 1, &force);
    for (i = 0; i < count; i++)
        if (DoStep(c, (double)i * step, step, fmi2True) != fmi2OK) failures++;
    printf("%.17g %.17g %.17g\n", real(c, 14), real(c, 15), real(c, 8));
    FreeInstance(c);
}

static void *work(void *unused) {
    fmi2Component c = start_one();
    fmi2ValueReference pull = 1;
    double force = 40.0;
    int i;
    (void)unused;
    SetReal(c, &pull, 1, &force);
    for (i = 0; i < 100; i++) DoStep(c, i * 1e-5, 1e-5, fmi2True);
    FreeInstance(c);
    return NULL;
}

/* Whatever is asked of one instance in every phase, with arguments that make no sense. */
static void torment(fmi2Component c) {
    const double odd[] = {NAN, INFINITY, -INFINITY, 1e308, -1.0, 0.0};
    const fmi2ValueReference wild[] = {0, 1, 3, 20, 33, 34, 1000000, 4294967295u};
    const fmi2Integer order = 3;
    fmi2Real value;
    fmi2Integer whole = -7;
    fmi2Boolean yes = 1;
    fmi2String text = NULL;
    fmi2Status status;
    size_t i, k, size = 0;
    for (i = 0; i < 8; i++) {
        GetReal(c, &wild[i], 1, &value);
        GetInteger(c, &wild[i], 1, &whole);
        SetInteger(c, &wild[i], 1, &whole);
        SetBoolean(c, &wild[i], 1, &yes), GetBoolean(c, &wild[i], 1, &yes);
        GetString(c, &wild[i], 1, &text);
        for (k = 0; k < 6; k++) {
            SetReal(c, &wild[i], 1, &odd[k]);
            SetRealInputDerivatives(c, &wild[i], 1, &order, &odd[k]);
            GetDirectionalDerivative(c, &wild[i], 1, &wild[k], 1, &odd[k], &value);
            DoStep(c, odd[k], 1e-3, fmi2True);
            DoStep(c, 0.0, odd[k], fmi2True);
        }
    }
    GetReal(c, NULL, 3, NULL), SetReal(c, NULL, 3, NULL), GetInteger(c, NULL, 1, NULL);
    GetBoolean(c, NULL, 1, NULL), SetRealInputDerivatives(c, NULL, 1, NULL, NULL), SetDebugLogging(c, 1, 2, NULL);
    GetRealOutputDerivatives(c, NULL, 0, NULL, NULL), CancelStep(c);
    GetStatus(c, fmi2DoStepStatus, &status), GetRealStatus(c, fmi2LastSuccessfulTime, NULL);
    GetBooleanStatus(c, fmi2Terminated, NULL), GetIntegerStatus(c, fmi2DoStepStatus, NULL);
    GetStringStatus(c, fmi2PendingStatus, NULL);
    SerializedFMUstateSize(c, (fmi2FMUstate)&whole, &size), SetFMUstate(c, NULL);
    SetFMUstate(c, (fmi2FMUstate)&whole), GetFMUstate(c, NULL), FreeFMUstate(c, NULL);
    SetupExperiment(c, 1, NAN, INFINITY, 1, -1.0), EnterInitializationMode(c);
    EnterInitializationMode(c), ExitInitializationMode(c), ExitInitializationMode(c);
    SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), Terminate(c), DoStep(c, 0.0, 1.0, fmi2True);
}

static void states(void) {
    fmi2Component c = start_one(), other = start_one();
    fmi2FMUstate early = NULL, copy, back = NULL;
    fmi2ValueReference pull = 1;
    static fmi2Byte bytes[65536];
    double force = 40.0, gap;
    size_t size = 0;
    int i;
    SetReal(c, &pull, 1, &force);
    expect(DoStep(c, 0.0, 1e-5, fmi2True), fmi2OK, "a step");
    expect(GetFMUstate(c, &early), fmi2OK, "take a state");
    expect(SerializedFMUstateSize(c, early, &size), fmi2OK, "its size");
    expect(size <= sizeof bytes, 1, "room for them");
    expect(SerializeFMUstate(c, early, bytes, size), fmi2OK, "its bytes");
    expect(DoStep(c, 1e-5, 0.5, fmi2True), fmi2OK, "a long step, over the rupture");
    gap = real(c, 3);
    expect(SetFMUstate(c, early), fmi2OK, "go back");
    expect(DoStep(c, 1e-5, 0.5, fmi2True), fmi2OK, "again");
    if (real(c, 3) != gap) failures++, fprintf(stderr, "another gap the second time\n");
    expect(DeSerializeFMUstate(other, bytes, size, &back), fmi2OK, "state of bytes");
    expect(SetFMUstate(other, back), fmi2OK, "into another instance");
    expect(DoStep(other, 1e-5, 0.5, fmi2True), fmi2OK, "its step");
    if (real(other, 3) != gap) failures++, fprintf(stderr, "another gap in another instance\n");
    copy = early;
    expect(FreeFMUstate(c, &early), fmi2OK, "free a state");
    expect(FreeFMUstate(c, &copy), fmi2OK, "and a copy of it");
    expect(SetFMUstate(c, copy), fmi2Error, "a state that is gone");
    expect(SerializeFMUstate(other, back, bytes, 3), fmi2Error, "too little room");
    for (i = 0; i < 200; i++) { /* bytes that were changed anywhere */
        fmi2FMUstate none = NULL;
        bytes[(size_t)i * size / 200] ^= 0x10;
        expect(DeSerializeFMUstate(other, bytes, size, &none), fmi2Error, "changed bytes");
        expect(DeSerializeFMUstate(other, bytes, (size_t)i, &none), fmi2Error, "few bytes");
        bytes[(size_t)i * size / 200] ^= 0x10;
    }
    FreeFMUstate(other, &back);
    FreeInstance(c), FreeInstance(other);
}

static void misuse(void) {
    fmi2Component c, many[20];
    pthread_t threads[8];
    fmi2ValueReference pull = 1;
    double force = 40.0;
    int i;
    expect(Instantiate(NULL, fmi2CoSimulation, guid, folder, NULL, 0, 1) == NULL, 1, "no name");
    expect(Instantiate("x", fmi2CoSimulation, "other", folder, &CALLBACKS, 0, 1) == NULL, 1, "GUID");
    expect(Instantiate("x", (fmi2Type)7, guid, folder, &CALLBACKS, 0, 1) == NULL, 1, "kind");
    c = Instantiate("x", fmi2ModelExchange, guid, folder, &CALLBACKS, 0, 1); /* NULL: it has none */
    torment(c), FreeInstance(c), torment(c);
    expect(Instantiate("x", fmi2CoSimulation, guid, NULL, &CALLBACKS, 0, 1) == NULL, 1, "folder");
    expect(Instantiate("x", fmi2CoSimulation, guid, "file:///none%", &CALLBACKS, 0, 1) == NULL, 1, "path");
    torment(NULL), torment((fmi2Component)&force), torment((fmi2Component)(size_t)12345);
    c = open_one(), torment(c), Reset(c), torment(c), FreeInstance(c), torment(c), FreeInstance(c);
    c = start_one(), torment(c), Reset(c);
    expect(EnterInitializationMode(c), fmi2OK, "after a reset"), torment(c), FreeInstance(c);
    c = start_one();
    SetReal(c, &pull, 1, &force);
    expect(DoStep(c, 0.0, 1e-5, fmi2True), fmi2OK, "a step");
    expect(DoStep(c, 1e-5, 0.0, fmi2True), fmi2OK, "a step of nothing");
    expect(DoStep(c, 0.0, 1e-5, fmi2True), fmi2Discard, "a step back in time");
    expect(DoStep(c, 1e-5, 1e-5, fmi2True), fmi2Discard, "the next");
    expect(Reset(c), fmi2OK, "reset");
    FreeInstance(c);
    for (i = 0; i < 20; i++) expect((many[i] = start_one()) != NULL, 1, "twenty instances");
    for (i = 0; i < 20; i++) FreeInstance(many[i]), FreeInstance(many[i]);
    for (i = 0; i < 8; i++) pthread_create(&threads[i], NULL, work, NULL);
    for (i = 0; i < 8; i++) pthread_join(threads[i], NULL);
    states();
}

static void measure(long count) {
    fmi2Component c = start_one();
    fmi2ValueReference pull = 1;
    double force = 1e-3, step = 1e-6;
    struct timespec a, b;
    long i;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
    for (i = 0; i < count; i++) {
        SetReal(c, &pull, 1, &force);
        if (DoStep(c, (double)i * step, step, fmi2True) != fmi2OK) failures++;
        real(c, 3);
    }
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
    printf("%.1f\n", ((double)(b.tv_sec - a.tv_sec) * 1e9 + (double)(b.tv_nsec - a.tv_nsec)) / (double)count);
    FreeInstance(c);
}

int main(int count, char **words) {
    void *library = count > 4 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) {
        fprintf(stderr, "%s\n", count > 4 ? dlerror() : "too few words");
        return 2;
    }
#define LOAD(name) *(void **)&name = dlsym(library, "fmi2" #name);
    EACH(LOAD)
    folder = words[2], guid = words[3];
    if (strcmp(GetVersion(), "2.0") != 0 || strcmp(GetTypesPlatform(), "default") != 0) failures++;
    if (strcmp(words[4], "misuse") == 0) misuse();
    else if (strcmp(words[4], "time") == 0 && count == 6) measure(atol(words[5]));
    else if (count == 8) run(atof(words[5]), atof(words[6]), atof(words[7]));
    fprintf(stderr, "%d messages, %d failures\n", messages, failures);
    dlclose(library);
    return failures != 0;
}
