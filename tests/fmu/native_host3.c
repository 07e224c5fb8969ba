/* A host in C for FMI 3.0: a release with event mode, and misuse of every function there is.

   native_host3 LIBRARY FOLDER TOKEN events FORCE STEP END   prints t h v F state n_break of each row
   native_host3 LIBRARY FOLDER TOKEN misuse                  ends with 0 if it lives

   Value references are those of stiction-mass in the order of kernel/model.h, from 1. */

#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3FunctionTypes.h"

#define EACH(DO)                                                                                  \
    DO(GetVersion) DO(SetDebugLogging) DO(InstantiateModelExchange) DO(InstantiateCoSimulation)   \
    DO(InstantiateScheduledExecution) DO(FreeInstance) DO(EnterInitializationMode)                \
    DO(ExitInitializationMode) DO(EnterEventMode) DO(Terminate) DO(Reset) DO(GetFloat32)          \
    DO(GetFloat64) DO(GetInt8) DO(GetUInt8) DO(GetInt16) DO(GetUInt16) DO(GetInt32) DO(GetUInt32) \
    DO(GetInt64) DO(GetUInt64) DO(GetBoolean) DO(GetString) DO(GetBinary) DO(GetClock)            \
    DO(SetFloat32) DO(SetFloat64) DO(SetInt8) DO(SetUInt8) DO(SetInt16) DO(SetUInt16)             \
    DO(SetInt32) DO(SetUInt32) DO(SetInt64) DO(SetUInt64) DO(SetBoolean) DO(SetString)            \
    DO(SetBinary) DO(SetClock) DO(GetNumberOfVariableDependencies) DO(GetVariableDependencies)    \
    DO(GetFMUState) DO(SetFMUState) DO(FreeFMUState) DO(SerializedFMUStateSize)                   \
    DO(SerializeFMUState) DO(DeserializeFMUState) DO(GetDirectionalDerivative)                    \
    DO(GetAdjointDerivative) DO(EnterConfigurationMode) DO(ExitConfigurationMode)                 \
    DO(GetIntervalDecimal) DO(GetIntervalFraction) DO(GetShiftDecimal) DO(GetShiftFraction)       \
    DO(SetIntervalDecimal) DO(SetIntervalFraction) DO(SetShiftDecimal) DO(SetShiftFraction)       \
    DO(EvaluateDiscreteStates) DO(UpdateDiscreteStates) DO(EnterContinuousTimeMode)               \
    DO(CompletedIntegratorStep) DO(SetTime) DO(SetContinuousStates)                               \
    DO(GetContinuousStateDerivatives) DO(GetEventIndicators) DO(GetContinuousStates)              \
    DO(GetNominalsOfContinuousStates) DO(GetNumberOfEventIndicators)                              \
    DO(GetNumberOfContinuousStates) DO(EnterStepMode) DO(GetOutputDerivatives) DO(DoStep)         \
    DO(ActivateModelPartition)

#define DECLARE(name) static fmi3##name##TYPE *name;
EACH(DECLARE)

enum { F_EXT = 1, H = 3, V = 4, F = 5, STATE = 11, T_BREAK = 13, N_BREAK = 16, MASS = 24, H_BREAK = 23, TIME = 35 };

static const char *folder, *token;
static int failures, messages;

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                 fmi3String message) {
    (void)environment, (void)status;
    messages++;
    if (!category || !message || strlen(message) > 3000) failures++;
    if (getenv("HEAR")) fprintf(stderr, "%s: %s\n", category, message);
}

static fmi3Instance open_one(int events) {
    return InstantiateCoSimulation("one", token, folder, fmi3False, fmi3True, events, events, NULL,
                                   0, NULL, hear, NULL);
}

static void expect(int is, int wanted, const char *what) {
    if (is == wanted) return;
    fprintf(stderr, "%s: %d, not %d\n", what, is, wanted);
    failures++;
}

static int update(fmi3Instance c) {
    fmi3Boolean again = 1, end = 1, nominals, values, defined;
    fmi3Float64 next;
    int status = UpdateDiscreteStates(c, &again, &end, &nominals, &values, &defined, &next);
    if (status == fmi3OK && (again || end || defined)) failures++;
    return status;
}

static fmi3Instance start_one(int events) {
    fmi3Instance c = open_one(events);
    fmi3ValueReference vr = H_BREAK;
    double gap = 6e-5; /* where the film breaks */
    if (!c) return NULL;
    expect(SetFloat64(c, &vr, 1, &gap, 1), fmi3OK, "set a parameter");
    EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0);
    ExitInitializationMode(c);
    if (events) {
        expect(update(c), fmi3OK, "update at the start");
        expect(EnterStepMode(c), fmi3OK, "enter step mode");
    }
    return c;
}

static void pull(fmi3Instance c, double force) {
    fmi3ValueReference vr = F_EXT;
    if (SetFloat64(c, &vr, 1, &force, 1) != fmi3OK) failures++;
}

static double real(fmi3Instance c, fmi3ValueReference vr) {
    fmi3Float64 value = NAN;
    if (GetFloat64(c, &vr, 1, &value, 1) != fmi3OK) failures++;
    return value;
}

/* Status of a step; what the FMU says of it in `said`: event, early return, time. */
static int step(fmi3Instance c, double time, double length, double said[3]) {
    fmi3Boolean event = 1, end = 1, early = 1;
    fmi3Float64 last = NAN;
    int status = DoStep(c, time, length, fmi3True, &event, &end, &early, &last);
    if (status == fmi3OK && end) failures++;
    if (said) said[0] = event, said[1] = early, said[2] = last;
    return status;
}

static void row(fmi3Instance c, double time) {
    fmi3ValueReference state = STATE, breaks = N_BREAK;
    fmi3Int64 film = 0;
    fmi3Int32 count = 0;
    if (GetInt64(c, &state, 1, &film, 1) != fmi3OK) failures++;
    if (GetInt32(c, &breaks, 1, &count, 1) != fmi3OK) failures++;
    printf("%.17g %.17g %.17g %.17g %d %d\n", time, real(c, H), real(c, V), real(c, F), (int)film,
           (int)count);
}

static void run(double force, double length, double end) {
    fmi3Instance c = start_one(1);
    double time = 0.0, said[3];
    pull(c, force);
    while (time < end * (1.0 - 1e-12)) {
        double target = fmin((floor(time / length * (1.0 + 1e-12)) + 1.0) * length, end);
        expect(step(c, time, target - time, said), fmi3OK, "a step");
        time = said[1] != 0.0 ? said[2] : target;
        row(c, time);
        if (said[0] == 0.0) continue;
        expect(EnterEventMode(c), fmi3OK, "enter event mode");
        expect(update(c), fmi3OK, "update");
        expect(EnterStepMode(c), fmi3OK, "back to step mode");
        row(c, time);
    }
    expect(Terminate(c), fmi3OK, "terminate");
    FreeInstance(c);
}

/* Every function with arguments that make no sense, in whatever phase an instance is. */
#define STRANGE(TYPE, CTYPE)                                                                      \
    {                                                                                             \
        CTYPE one = (CTYPE)0;                                                                     \
        for (i = 0; i < 8; i++) {                                                                 \
            Get##TYPE(c, &wild[i], 1, &one, 1), Set##TYPE(c, &wild[i], 1, &one, 1);               \
            Get##TYPE(c, &wild[i], 1, &one, 2), Set##TYPE(c, &wild[i], 1, &one, 0);               \
        }                                                                                         \
        Get##TYPE(c, NULL, 3, NULL, 3), Set##TYPE(c, NULL, 3, NULL, 3);                           \
        Get##TYPE(c, NULL, 0, NULL, 0), Set##TYPE(c, NULL, 0, NULL, 0);                           \
    }

static void torment_values(fmi3Instance c) {
    const double odd[] = {NAN, INFINITY, -INFINITY, 1e308, -1.0, 0.0};
    const fmi3ValueReference wild[] = {0, 1, 3, 18, 29, 30, 1000000, 4294967295u};
    size_t i, k, sizes = 0;
    double value;
    fmi3Binary none = NULL;
    fmi3Clock clock = 0;
    STRANGE(Float32, fmi3Float32)
    STRANGE(Int8, fmi3Int8)
    STRANGE(UInt8, fmi3UInt8)
    STRANGE(Int16, fmi3Int16)
    STRANGE(UInt16, fmi3UInt16)
    STRANGE(Int32, fmi3Int32)
    STRANGE(UInt32, fmi3UInt32)
    STRANGE(Int64, fmi3Int64)
    STRANGE(UInt64, fmi3UInt64)
    STRANGE(Boolean, fmi3Boolean)
    STRANGE(String, fmi3String)
    STRANGE(Float64, fmi3Float64)
    GetBinary(c, wild, 1, &sizes, &none, 1), SetBinary(c, wild, 1, &sizes, &none, 1);
    GetBinary(c, NULL, 1, NULL, NULL, 1), SetBinary(c, NULL, 1, NULL, NULL, 1);
    GetClock(c, wild, 1, &clock), SetClock(c, wild, 1, &clock);
    GetClock(c, NULL, 1, NULL), SetClock(c, NULL, 0, NULL);
    for (i = 0; i < 8; i++)
        for (k = 0; k < 6; k++) {
            SetFloat64(c, &wild[i], 1, &odd[k], 1);
            GetDirectionalDerivative(c, &wild[i], 1, &wild[k], 1, &odd[k], 1, &value, 1);
            GetAdjointDerivative(c, &wild[i], 1, &wild[k], 1, &odd[k], 1, &value, 1);
            step(c, odd[k], 1e-3, NULL), step(c, 0.0, odd[k], NULL);
        }
    GetDirectionalDerivative(c, NULL, 1, NULL, 1, NULL, 1, NULL, 1);
    GetDirectionalDerivative(c, wild, 1, wild, 1, odd, 2, &value, 1);
    GetAdjointDerivative(c, NULL, 1, NULL, 1, NULL, 1, NULL, 1);
    GetAdjointDerivative(c, wild, 1, wild, 1, odd, 1, &value, 0);
}

static void torment_rest(fmi3Instance c) {
    fmi3ValueReference vr = 1;
    double real_value = 0.0;
    size_t size = 0, one = 1;
    fmi3UInt64 whole = 0, more = 0;
    fmi3IntervalQualifier qualifier;
    fmi3DependencyKind kind;
    fmi3Boolean yes;
    GetNumberOfVariableDependencies(c, 1, &size), GetNumberOfVariableDependencies(c, 1, NULL);
    GetVariableDependencies(c, 1, &size, &vr, &one, &kind, 1);
    EnterConfigurationMode(c), ExitConfigurationMode(c);
    GetIntervalDecimal(c, &vr, 1, &real_value, &qualifier), GetIntervalDecimal(c, NULL, 1, NULL, NULL);
    GetIntervalFraction(c, &vr, 1, &whole, &more, &qualifier), GetShiftDecimal(c, &vr, 1, &real_value);
    GetShiftFraction(c, &vr, 1, &whole, &more), SetIntervalDecimal(c, &vr, 1, &real_value);
    SetIntervalFraction(c, &vr, 1, &whole, &more), SetShiftDecimal(c, &vr, 1, &real_value);
    SetShiftFraction(c, NULL, 1, NULL, NULL), ActivateModelPartition(c, 1, NAN);
    EvaluateDiscreteStates(c), UpdateDiscreteStates(c, NULL, NULL, NULL, NULL, NULL, NULL);
    EnterContinuousTimeMode(c), CompletedIntegratorStep(c, 1, NULL, NULL), SetTime(c, NAN);
    CompletedIntegratorStep(c, 1, &yes, &yes), SetContinuousStates(c, NULL, 1);
    GetContinuousStateDerivatives(c, NULL, 1), GetEventIndicators(c, NULL, 1);
    GetContinuousStates(c, &real_value, 1), GetNominalsOfContinuousStates(c, NULL, 1);
    GetNumberOfEventIndicators(c, NULL), GetNumberOfContinuousStates(c, &size);
    GetOutputDerivatives(c, NULL, 1, NULL, NULL, 1), DoStep(c, 0.0, 1.0, 1, NULL, NULL, NULL, NULL);
    SetDebugLogging(c, 1, 2, NULL);
}

static void torment(fmi3Instance c) {
    fmi3Int32 whole = -7;
    size_t size = 0;
    torment_values(c), torment_rest(c);
    SerializedFMUStateSize(c, (fmi3FMUState)&whole, &size), SetFMUState(c, NULL);
    SetFMUState(c, (fmi3FMUState)&whole), GetFMUState(c, NULL), FreeFMUState(c, NULL);
    SerializeFMUState(c, (fmi3FMUState)&whole, NULL, 0), DeserializeFMUState(c, NULL, 0, NULL);
    EnterStepMode(c), EnterEventMode(c), update(c);
    EnterInitializationMode(c, 1, NAN, INFINITY, 1, -1.0);
    EnterInitializationMode(c, 1, NAN, 0.0, 1, -1.0), torment_values(c), ExitInitializationMode(c);
    ExitInitializationMode(c), EnterEventMode(c), update(c), EnterStepMode(c), Terminate(c);
    step(c, 0.0, 1.0, NULL), torment_values(c);
}

static void wrong_order(void) {
    double said[3];
    fmi3FMUState state = NULL;
    fmi3ValueReference mass = MASS;
    double value = 1.0;
    fmi3Instance c = open_one(0), other;
    expect(step(c, 0.0, 1e-5, NULL), fmi3Error, "a step before initialization");
    expect(Reset(c), fmi3OK, "reset");
    expect(EnterEventMode(c), fmi3Error, "event mode of who does not use it");
    FreeInstance(c), c = start_one(1);
    pull(c, 40.0);
    expect(SetFloat64(c, &mass, 1, &value, 1), fmi3Error, "a parameter while stepping");
    expect(step(c, 0.0, 1e-5, NULL), fmi3Error, "a step after that");
    FreeInstance(c), c = start_one(1);
    expect(EnterStepMode(c), fmi3Error, "step mode twice");
    FreeInstance(c), c = start_one(1);
    expect(update(c), fmi3Error, "update in step mode");
    FreeInstance(c), c = start_one(1);
    pull(c, 40.0);
    expect(step(c, 0.0, 0.5, said), fmi3OK, "a long step");
    expect(said[0] == 1.0 && said[1] == 1.0, 1, "it ends at the rupture");
    expect(said[2] == real(c, TIME), 1, "the time is a variable");
    expect(GetFMUState(c, &state), fmi3OK, "a state just before");
    expect(step(c, said[2], 1e-5, NULL), fmi3Error, "on without event mode");
    expect(SetFMUState(c, state), fmi3OK, "back");
    expect(EnterEventMode(c), fmi3OK, "event mode");
    expect(SetFloat64(c, &mass, 1, &value, 1), fmi3Error, "a parameter in event mode");
    expect(SetFMUState(c, state), fmi3OK, "back");
    expect(EnterEventMode(c), fmi3OK, "event mode");
    expect(step(c, said[2], 1e-5, NULL), fmi3Error, "a step in event mode");
    expect(SetFMUState(c, state), fmi3OK, "back");
    other = start_one(0); /* who has no event mode sees it happen at once */
    expect(SetFMUState(other, state), fmi3OK, "into another instance");
    expect(real(other, T_BREAK) == said[2], 1, "it is broken");
    expect(step(other, said[2], 1e-5, said), fmi3OK, "and goes on");
    expect(said[0] == 0.0 && said[1] == 0.0, 1, "without events");
    FreeFMUState(c, &state), FreeFMUState(c, &state);
    FreeInstance(other), FreeInstance(c);
}

static void *work(void *unused) {
    fmi3Instance c = start_one(0);
    int i;
    (void)unused;
    pull(c, 40.0);
    for (i = 0; i < 100; i++) step(c, i * 1e-5, 1e-5, NULL);
    FreeInstance(c);
    return NULL;
}

static void misuse(void) {
    fmi3Instance c, many[20];
    fmi3ValueReference one = 1;
    pthread_t threads[4];
    double number = 1.0;
    int i;
    expect(InstantiateModelExchange("x", token, folder, 0, 1, NULL, hear) == NULL, 1, "ME");
    expect(InstantiateScheduledExecution("x", token, folder, 0, 1, NULL, hear, NULL, NULL, NULL) == NULL, 1, "SE");
    expect(messages, 2, "both got the reason");
    expect(InstantiateCoSimulation(NULL, token, folder, 0, 1, 0, 0, NULL, 0, NULL, hear, NULL) == NULL, 1, "name");
    expect(InstantiateCoSimulation("x", "other", folder, 0, 1, 0, 0, NULL, 0, NULL, hear, NULL) == NULL, 1, "token");
    expect(InstantiateCoSimulation("x", NULL, folder, 0, 1, 0, 0, NULL, 0, NULL, NULL, NULL) == NULL, 1, "no token");
    expect(InstantiateCoSimulation("x", token, NULL, 0, 1, 0, 0, NULL, 0, NULL, hear, NULL) == NULL, 1, "folder");
    expect(InstantiateCoSimulation("x", token, "/none%", 0, 1, 0, 0, NULL, 0, NULL, hear, NULL) == NULL, 1, "path");
    expect(InstantiateCoSimulation("x", token, folder, 0, 1, 0, 0, &one, 1, NULL, hear, NULL) == NULL, 1, "updates");
    torment(NULL), torment((fmi3Instance)&number), torment((fmi3Instance)(size_t)12345);
    for (i = 0; i < 2; i++) {
        c = open_one(i), torment(c), Reset(c), torment(c), FreeInstance(c), torment(c);
        FreeInstance(c);
        c = start_one(i), torment(c), Reset(c);
        expect(EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), fmi3OK, "after a reset");
        torment(c), FreeInstance(c);
    }
    wrong_order();
    for (i = 0; i < 20; i++) expect((many[i] = start_one(i % 2)) != NULL, 1, "twenty instances");
    for (i = 0; i < 20; i++) FreeInstance(many[i]), FreeInstance(many[i]);
    for (i = 0; i < 4; i++) pthread_create(&threads[i], NULL, work, NULL);
    for (i = 0; i < 4; i++) pthread_join(threads[i], NULL);
}

int main(int count, char **words) {
    void *library = count > 4 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) {
        fprintf(stderr, "%s\n", count > 4 ? dlerror() : "too few words");
        return 2;
    }
#define LOAD(name)                                                                                \
    if (!(*(void **)&name = dlsym(library, "fmi3" #name))) {                                      \
        fprintf(stderr, "there is no fmi3" #name "\n");                                           \
        return 3;                                                                                 \
    }
    EACH(LOAD)
    folder = words[2], token = words[3];
    if (strcmp(GetVersion(), "3.0") != 0) failures++;
    if (strcmp(words[4], "misuse") == 0) misuse();
    else if (count == 8) run(atof(words[5]), atof(words[6]), atof(words[7]));
    fprintf(stderr, "%d messages, %d failures\n", messages, failures);
    dlclose(library);
    return failures != 0;
}
