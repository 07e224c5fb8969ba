/* FMI 3.0: functions that mean nothing for this FMU. Each says so and changes nothing. */

#include "fmi3_own.h"

#include <stddef.h>

static fmi3Status lacks(fmi3Instance instance, const char *message) {
    OWN(instance);
    return ck_own_lacks(own, message);
}

/* Asked for no variables there is nothing to refuse. */
static fmi3Status lacks_type(fmi3Instance instance, size_t n, size_t m) {
    OWN(instance);
    return n == 0 && m == 0 ? fmi3OK : ck_own_fail(own, "no variable of this FMU is of that type; "
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

/* Other kinds of FMU -------------------------------------------------------------------------- */

static const char CO_SIMULATION[] = "this FMU is for co-simulation only";

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    return lacks(instance, "evaluateDiscreteStates is not provided; call updateDiscreteStates");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t m) {
    (void)vr, (void)n, (void)orders, (void)values, (void)m;
    return lacks(instance, "derivatives of outputs by time are not provided");
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    return lacks(instance, CO_SIMULATION);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean keeps,
                                       fmi3Boolean *enter_event_mode, fmi3Boolean *terminate) {
    (void)keeps, (void)enter_event_mode, (void)terminate;
    return lacks(instance, CO_SIMULATION);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    (void)time;
    return lacks(instance, CO_SIMULATION);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[], size_t n) {
    (void)states, (void)n;
    return lacks(instance, CO_SIMULATION);
}

#define LACKS_STATES(NAME)                                                                        \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, fmi3Float64 values[], size_t n) {             \
        (void)values, (void)n;                                                                    \
        return lacks(instance, CO_SIMULATION);                                                    \
    }

LACKS_STATES(ContinuousStateDerivatives)
LACKS_STATES(EventIndicators)
LACKS_STATES(ContinuousStates)
LACKS_STATES(NominalsOfContinuousStates)

#define LACKS_COUNT(NAME)                                                                         \
    fmi3Status fmi3GetNumberOf##NAME(fmi3Instance instance, size_t *count) {                      \
        (void)count;                                                                              \
        return lacks(instance, CO_SIMULATION);                                                    \
    }

LACKS_COUNT(EventIndicators)
LACKS_COUNT(ContinuousStates)

/* Nobody can be told through an instance that there is none. */
static fmi3Instance no_instance(fmi3LogMessageCallback logger, fmi3InstanceEnvironment environment) {
    if (logger) logger(environment, fmi3Error, "logStatusError", CO_SIMULATION);
    return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String folder,
                                          fmi3Boolean visible, fmi3Boolean logs,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger) {
    (void)name, (void)token, (void)folder, (void)visible;
    return no_instance(logs ? logger : NULL, environment);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String folder, fmi3Boolean visible, fmi3Boolean logs,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)token, (void)folder, (void)visible, (void)update, (void)lock, (void)unlock;
    return no_instance(logs ? logger : NULL, environment);
}
