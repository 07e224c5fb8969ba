/* FMI 3.0 for co-simulation and, where a model has it, model exchange: life of an instance, its modes, its steps. Nothing the host does wrong
   may end its process.

   A host that uses event mode and allows an early return gets it where the film breaks or wets the
   bodies again: the step ends there, with everything as it is just before. Event mode then makes
   it happen. Outputs that are no continuous numbers change in event mode only; a step that ends
   with others than it began with asks for it. */

#include "fmi3Functions.h"

#include "host.h"
#include "model.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    ck_model model;
    fmi3LogMessageCallback logger;
    fmi3InstanceEnvironment environment;
    int wanted; /* categories of messages */
} ck_own;

#define OWN(instance)                                                     \
    ck_own *own = (ck_own *)ck_handle_content(CK_INSTANCES, instance);    \
    if (!own) return fmi3Error

static void say(void *host, int status, const char *category, const char *message) {
    ck_own *own = (ck_own *)host;
    if (!own->logger || !(own->wanted & ck_category(category))) return;
    own->logger(own->environment, (fmi3Status)status, category, message);
}

static fmi3Status fail(ck_own *own, const char *message) {
    return (fmi3Status)ck_model_fail(&own->model, message);
}

static fmi3Status lack(ck_own *own, const char *message) {
    say(own, CK_ERROR, "logStatusError", message);
    return fmi3Error;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n,
                               const fmi3String categories[]) {
    OWN(instance);
    if (n > 0 && !categories) return fail(own, "setDebugLogging: categories are missing");
    own->wanted = ck_wanted(own->wanted, on, n, categories);
    return fmi3OK;
}

static const char CO_SIMULATION[] = "this FMU is for co-simulation only";

/* An instance that logs to its host. */
static ck_own *start(fmi3Boolean logs, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
    ck_own *own = (ck_own *)calloc(1, sizeof *own);
    if (!own) return NULL;
    own->logger = logger, own->environment = environment;
    own->wanted = logs ? CK_LOG_ALL : CK_LOG_ERROR; /* why it refuses is no debugging */
    own->model.say = say, own->model.host = own;
    return own;
}

/* Its handle, or NULL and nothing left of it; `refused` says why it cannot be. */
static fmi3Instance opened(ck_own *own, fmi3String name, fmi3String token, fmi3String resources,
                           const char *refused) {
    char folder[900];
    fmi3Instance handle = NULL;
    if (!name || !*name) lack(own, "the instance needs a name");
    else if (refused) lack(own, refused);
    else if (!token || !resources || !ck_folder_of(resources, folder, sizeof folder))
        lack(own, "instantiation token or resource path is missing, or too long");
    else if (!ck_model_open(&own->model, folder, token)) handle = NULL; /* it has said why */
    else if (own->model.exchanges && !ck_model_kind(&own->model)->exchange) lack(own, CO_SIMULATION);
    else {
        handle = ck_handle_new(CK_INSTANCES, own);
        if (!handle) lack(own, "there are too many instances");
    }
    if (!handle) {
        ck_model_close(&own->model);
        free(own);
    }
    return handle;
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logs,
    fmi3Boolean event_mode, fmi3Boolean early, const fmi3ValueReference intermediate[],
    size_t intermediate_count, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
    fmi3IntermediateUpdateCallback update) {
    ck_own *own = start(logs, environment, logger);
    (void)visible, (void)intermediate, (void)update;
    if (!own) return NULL;
    own->model.event_mode = event_mode, own->model.early = early;
    own->model.pauses = event_mode && early;
    return opened(own, name, token, resources,
                  intermediate_count > 0 ? "intermediate updates are not provided; ask for none" : NULL);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logs,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger) {
    ck_own *own = start(logs, environment, logger);
    (void)visible;
    if (!own) return NULL;
    own->model.exchanges = own->model.event_mode = 1;
    return opened(own, name, token, resources, NULL);
}

void fmi3FreeInstance(fmi3Instance instance) {
    ck_own *own = (ck_own *)ck_handle_free(CK_INSTANCES, instance);
    if (!own) return;
    ck_model_close(&own->model);
    free(own);
}

/* Modes --------------------------------------------------------------------------------------- */

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
    OWN(instance);
    if (!ck_model_is_in(&own->model, CK_INSTANTIATED, "enterInitializationMode")) return fmi3Error;
    if (ck_model_setup(&own->model, start, has_stop ? &stop : NULL,
                       has_tolerance ? &tolerance : NULL) != CK_OK)
        return fmi3Error;
    own->model.state.phase = CK_INITIALIZATION;
    own->model.state.stale = 1;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    int status;
    OWN(instance);
    status = ck_model_initialize(&own->model);
    if (status == CK_OK && own->model.event_mode) own->model.state.phase = CK_EVENT;
    return (fmi3Status)status;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    OWN(instance);
    if (!own->model.event_mode)
        return fail(own, "enterEventMode: instantiate with eventModeUsed to use it");
    if (!ck_model_is_in(&own->model, CK_STEPPING, "enterEventMode")) return fmi3Error;
    own->model.state.phase = CK_EVENT;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again,
                                    fmi3Boolean *terminate, fmi3Boolean *nominals_changed,
                                    fmi3Boolean *values_changed, fmi3Boolean *next_defined,
                                    fmi3Float64 *next) {
    OWN(instance);
    if (!again || !terminate || !nominals_changed || !values_changed || !next_defined || !next)
        return fail(own, "updateDiscreteStates: arguments are missing");
    *again = *terminate = *nominals_changed = *values_changed = *next_defined = fmi3False;
    *next = 0.0;
    return (fmi3Status)ck_model_update(&own->model);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    OWN(instance);
    if (own->model.exchanges)
        return fail(own, "enterStepMode: this instance is for model exchange, call enterContinuousTimeMode");
    if (!ck_model_is_in(&own->model, CK_EVENT, "enterStepMode")) return fmi3Error;
    own->model.state.phase = CK_STEPPING;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    OWN(instance);
    own->model.state.phase = CK_TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    OWN(instance);
    ck_model_reset(&own->model);
    return fmi3OK;
}

/* A step is discarded where a shorter one may do; otherwise only a reset or an earlier state helps. */
fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step, fmi3Boolean keeps,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early,
                      fmi3Float64 *last) {
    int status;
    OWN(instance);
    (void)keeps;
    if (!event || !terminate || !early || !last)
        return fail(own, "doStep: arguments are missing");
    *event = *terminate = *early = fmi3False;
    status = ck_model_step(&own->model, time, step);
    *last = own->model.state.time;
    if (status != CK_OK) return own->model.state.failed ? fmi3Error : fmi3Discard;
    *event = own->model.state.event != 0;
    *early = *last < time + step && (ck_model_pends(&own->model) || own->model.state.cut);
    return fmi3OK;
}

/* Variables ------------------------------------------------------------------------------------ */

/* Every variable is a scalar, so there are as many values as references. */
static int fit(ck_own *own, const void *vr, size_t n, const void *values, size_t m) {
    if (n == m && (n == 0 || (vr && values))) return 1;
    fail(own, n != m ? "there must be as many values as value references; reset the FMU"
                            : "value references or values are missing; reset the FMU");
    return 0;
}

static int get(ck_own *own, fmi3ValueReference vr, int type, double *found) {
    /* The time comes after all variables, the event indicators after the time. */
    fmi3ValueReference last = (fmi3ValueReference)own->model.data.contents.n_variables + 1;
    double indicators[CK_INDICATORS];
    int status;
    if (type != CK_REAL || vr < last) return ck_model_get(&own->model, vr, type, found);
    if (vr == last) {
        *found = own->model.state.time;
        return CK_OK;
    }
    if (vr > last + CK_INDICATORS || !ck_model_kind(&own->model)->exchange)
        return ck_model_get(&own->model, vr, type, found); /* which refuses it */
    status = ck_exchange_indicators(&own->model, indicators, CK_INDICATORS);
    if (status == CK_OK) *found = indicators[vr - last - 1];
    return status;
}

#define ACCESS(TYPE, OUR_TYPE)                                                                    \
    fmi3Status fmi3Get##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             fmi3##TYPE values[], size_t m) {                                     \
        size_t i;                                                                                 \
        OWN(instance);                                                                            \
        if (!fit(own, vr, n, values, m)) return fmi3Error;                                        \
        for (i = 0; i < n; i++) {                                                                 \
            double found;                                                                         \
            int status = get(own, vr[i], OUR_TYPE, &found);                                       \
            if (status != CK_OK) return (fmi3Status)status;                                       \
            values[i] = (fmi3##TYPE)found;                                                        \
        }                                                                                         \
        return fmi3OK;                                                                            \
    }                                                                                             \
    fmi3Status fmi3Set##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             const fmi3##TYPE values[], size_t m) {                               \
        size_t i;                                                                                 \
        OWN(instance);                                                                            \
        if (!fit(own, vr, n, values, m)) return fmi3Error;                                        \
        for (i = 0; i < n; i++) {                                                                 \
            int status = ck_model_set(&own->model, vr[i], OUR_TYPE, (double)values[i]);           \
            if (status != CK_OK) return (fmi3Status)status;                                       \
        }                                                                                         \
        return fmi3OK;                                                                            \
    }

ACCESS(Float64, CK_REAL)
ACCESS(Int32, CK_INTEGER)
ACCESS(Int64, CK_ENUMERATION) /* as the standard has it */
ACCESS(Boolean, CK_BOOLEAN)

/* Slopes -------------------------------------------------------------------------------------- */

static int fit_slopes(ck_own *own, const void *unknown, size_t n, const void *known, size_t m,
                      const void *seed, const void *found) {
    if ((n == 0 || unknown) && (m == 0 || known) && ((n == 0 && m == 0) || (seed && found))) return 1;
    fail(own, "derivatives: arguments are missing; reset the FMU");
    return 0;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknown[],
                                        size_t n, const fmi3ValueReference known[], size_t m,
                                        const fmi3Float64 seed[], size_t seeds,
                                        fmi3Float64 found[], size_t founds) {
    OWN(instance);
    if (!fit_slopes(own, unknown, n, known, m, seed, found)) return fmi3Error;
    if (seeds != m || founds != n)
        return lack(own, "getDirectionalDerivative: give a seed for each known and room "
                                 "for each unknown");
    return (fmi3Status)ck_model_derivative(&own->model, unknown, n, known, m, seed, found);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknown[],
                                    size_t n, const fmi3ValueReference known[], size_t m,
                                    const fmi3Float64 seed[], size_t seeds, fmi3Float64 found[],
                                    size_t founds) {
    static const double one = 1.0;
    size_t i, k;
    OWN(instance);
    if (!fit_slopes(own, unknown, n, known, m, seed, found)) return fmi3Error;
    if (seeds != n || founds != m)
        return lack(own, "getAdjointDerivative: give a seed for each unknown and room for "
                                 "each known");
    for (k = 0; k < m; k++) {
        double sum = 0.0, slope;
        for (i = 0; i < n; i++) {
            if (ck_model_derivative(&own->model, &unknown[i], 1, &known[k], 1, &one, &slope) != CK_OK)
                return fmi3Error;
            sum += seed[i] * slope;
        }
        found[k] = sum;
    }
    return fmi3OK;
}

/* Model exchange ------------------------------------------------------------------------------ */

#define OWN_EXCHANGE(instance, phase, call) \
    OWN(instance);                          \
    if (!ck_exchange_is_on(&own->model, phase, call)) return fmi3Error

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    OWN_EXCHANGE(instance, CK_EVENT, "enterContinuousTimeMode");
    own->model.state.phase = CK_STEPPING;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean keeps, fmi3Boolean *event,
                                       fmi3Boolean *terminate) {
    OWN_EXCHANGE(instance, CK_STEPPING, "completedIntegratorStep");
    (void)keeps;
    if (!event || !terminate) return fail(own, "completedIntegratorStep: arguments are missing");
    *event = *terminate = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    OWN(instance);
    if (!ck_exchange_is_on(&own->model, CK_ANY, "setTime")) return fmi3Error;
    return (fmi3Status)ck_exchange_time(&own->model, time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[], size_t n) {
    OWN_EXCHANGE(instance, CK_STEPPING, "setContinuousStates");
    return (fmi3Status)ck_exchange_set_states(&own->model, states, n);
}

#define NUMBERS(NAME, FUNCTION)                                                                   \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, fmi3Float64 found[], size_t n) {              \
        OWN(instance);                                                                            \
        if (!ck_exchange_is_on(&own->model, CK_ANY, "get" #NAME)) return fmi3Error; \
        return (fmi3Status)FUNCTION(&own->model, found, n);                                       \
    }

NUMBERS(ContinuousStateDerivatives, ck_exchange_derivatives)
NUMBERS(EventIndicators, ck_exchange_indicators)
NUMBERS(ContinuousStates, ck_exchange_states)
NUMBERS(NominalsOfContinuousStates, ck_exchange_nominals)

#define COUNT(NAME, NUMBER)                                                                       \
    fmi3Status fmi3GetNumberOf##NAME(fmi3Instance instance, size_t *count) {                      \
        OWN(instance);                                                                            \
        if (!ck_exchange_is_on(&own->model, CK_ANY, "getNumberOf" #NAME))         \
            return fmi3Error;                                                                     \
        if (!count) return fail(own, "getNumberOf" #NAME ": arguments are missing");              \
        *count = (size_t)(NUMBER);                                                                \
        return fmi3OK;                                                                            \
    }

COUNT(EventIndicators, CK_INDICATORS)
COUNT(ContinuousStates, ck_model_kind(&own->model)->exchange->n_states)

/* The state ----------------------------------------------------------------------------------- */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_take(&own->model, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
    OWN(instance);
    return (fmi3Status)ck_saved_restore(&own->model, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_free(state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size) {
    OWN(instance);
    return (fmi3Status)ck_saved_size(&own->model, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size) {
    OWN(instance);
    return (fmi3Status)ck_saved_write(&own->model, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_read(&own->model, bytes, size, state);
}

/* Functions that mean nothing for this FMU ----------------------------------------------------- */

/* Each reports so and changes nothing. */
static fmi3Status lacks(fmi3Instance instance, const char *message) {
    OWN(instance);
    return lack(own, message);
}

/* Asked for no variables there is nothing to refuse. */
static fmi3Status lacks_type(fmi3Instance instance, size_t n, size_t m) {
    OWN(instance);
    return n == 0 && m == 0 ? fmi3OK : fail(own, "no variable of this FMU is of that type; "
                                                        "reset the FMU");
}

#define LACKS_TYPE(TYPE)                                                                          \
    fmi3Status fmi3Get##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             fmi3##TYPE values[], size_t m) {                                     \
        (void)vr, (void)values;                                                                   \
        return lacks_type(instance, n, m);                                                        \
    }                                                                                             \
    fmi3Status fmi3Set##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             const fmi3##TYPE values[], size_t m) {                               \
        (void)vr, (void)values;                                                                   \
        return lacks_type(instance, n, m);                                                        \
    }

LACKS_TYPE(Float32)
LACKS_TYPE(Int8)
LACKS_TYPE(UInt8)
LACKS_TYPE(Int16)
LACKS_TYPE(UInt16)
LACKS_TYPE(UInt32)
LACKS_TYPE(UInt64)
LACKS_TYPE(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                         size_t sizes[], fmi3Binary values[], size_t m) {
    (void)vr, (void)sizes, (void)values;
    return lacks_type(instance, n, m);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                         const size_t sizes[], const fmi3Binary values[], size_t m) {
    (void)vr, (void)sizes, (void)values;
    return lacks_type(instance, n, m);
}

/* Clocks -------------------------------------------------------------------------------------- */

static const char NO_CLOCKS[] = "this FMU has no clocks";

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                        fmi3Clock values[]) {
    (void)vr, (void)values;
    return lacks_type(instance, n, n);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                        const fmi3Clock values[]) {
    (void)vr, (void)values;
    return lacks_type(instance, n, n);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]) {
    (void)vr, (void)n, (void)intervals, (void)qualifiers;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[]) {
    (void)vr, (void)n, (void)counters, (void)resolutions, (void)qualifiers;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                               fmi3Float64 shifts[]) {
    (void)vr, (void)n, (void)shifts;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
    (void)vr, (void)n, (void)counters, (void)resolutions;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                  const fmi3Float64 intervals[]) {
    (void)vr, (void)n, (void)intervals;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    (void)vr, (void)n, (void)counters, (void)resolutions;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                               const fmi3Float64 shifts[]) {
    (void)vr, (void)n, (void)shifts;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    (void)vr, (void)n, (void)counters, (void)resolutions;
    return lacks(instance, NO_CLOCKS);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock,
                                      fmi3Float64 time) {
    (void)clock, (void)time;
    return lacks(instance, NO_CLOCKS);
}

/* Arrays and structural parameters ------------------------------------------------------------ */

static const char NO_ARRAYS[] = "this FMU has no arrays and no structural parameters";

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference vr,
                                               size_t *count) {
    (void)vr, (void)count;
    return lacks(instance, NO_ARRAYS);
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elements[], fmi3ValueReference independents[],
                                       size_t of_independents[], fmi3DependencyKind kinds[],
                                       size_t n) {
    (void)dependent, (void)elements, (void)independents, (void)of_independents, (void)kinds;
    (void)n;
    return lacks(instance, NO_ARRAYS);
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) { return lacks(instance, NO_ARRAYS); }

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) { return lacks(instance, NO_ARRAYS); }

/* Other calls --------------------------------------------------------------------------------- */

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    return lacks(instance, "evaluateDiscreteStates is not provided; call updateDiscreteStates");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t m) {
    size_t i;
    int status = CK_OK;
    OWN(instance);
    if (!fit(own, vr, n, values, m) || (n > 0 && !orders)) return fmi3Error;
    for (i = 0; i < n && status == CK_OK; i++)
        status = ck_model_rate(&own->model, vr[i], orders[i], &values[i]);
    return (fmi3Status)status;
}

/* There is no instance yet to log through. */
static fmi3Instance no_instance(fmi3LogMessageCallback logger, fmi3InstanceEnvironment environment) {
    if (logger) logger(environment, fmi3Error, "logStatusError", "this FMU has no clocks to schedule");
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String folder, fmi3Boolean visible, fmi3Boolean logs,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)token, (void)folder, (void)visible, (void)update, (void)lock, (void)unlock;
    return no_instance(logs ? logger : NULL, environment);
}
