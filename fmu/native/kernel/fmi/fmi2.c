/* FMI 2.0 for co-simulation and, where a model has it, model exchange. Nothing the host does wrong may end its process. */

#include "fmi2Functions.h"

#include "host.h"
#include "model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WHOLE (CK_INTEGER | CK_ENUMERATION)

typedef struct {
    ck_model model;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    char *name;
    int wanted; /* categories of messages */
} instance;

static void say(void *host, int status, const char *category, const char *message) {
    instance *own = (instance *)host;
    char safe[1600];
    if (!own->logger || !(own->wanted & ck_category(category))) return;
    ck_double_percents(message, safe, sizeof safe);
    own->logger(own->environment, own->name, (fmi2Status)status, category, safe);
}

#define OWN(component)                                                         \
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, component);    \
    if (!own) return fmi2Error

static fmi2Status fail(instance *own, const char *message) {
    return (fmi2Status)ck_model_fail(&own->model, message);
}

/* A function that this FMU does not have; nothing changes. */
static fmi2Status lacks(instance *own, const char *message) {
    say(own, CK_ERROR, "logStatusError", message);
    return fmi2Error;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n,
                               const fmi2String categories[]) {
    OWN(c);
    if (n > 0 && !categories) return fail(own, "setDebugLogging: categories are missing");
    own->wanted = ck_wanted(own->wanted, on, n, categories);
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logs) {
    instance *own = (instance *)calloc(1, sizeof *own);
    char folder[900];
    size_t length = name ? strlen(name) : 0;
    fmi2Component handle = NULL;
    (void)visible;
    if (!own) return NULL;
    own->name = (char *)calloc(1, length + 1);
    if (own->name && name) memcpy(own->name, name, length);
    own->logger = functions ? functions->logger : NULL;
    own->environment = functions ? functions->componentEnvironment : NULL;
    own->wanted = logs ? CK_LOG_ALL : CK_LOG_ERROR; /* why it refuses is no debugging */
    own->model.say = say, own->model.host = own;
    if (!own->name || !name || !*name) say(own, CK_ERROR, "logStatusError", "the instance needs a name");
    else if (type != fmi2CoSimulation && type != fmi2ModelExchange)
        say(own, CK_ERROR, "logStatusError", "this FMU is for co-simulation or model exchange");
    else if (!guid || !resources || !ck_folder_of(resources, folder, sizeof folder))
        say(own, CK_ERROR, "logStatusError", "GUID or resource location is missing, or no file");
    else if (!ck_model_open(&own->model, folder, guid)) handle = NULL; /* it has said why */
    else if (type == fmi2ModelExchange && !ck_model_kind(&own->model)->exchange)
        say(own, CK_ERROR, "logStatusError", "this FMU is for co-simulation only");
    else {
        own->model.exchanges = own->model.event_mode = type == fmi2ModelExchange;
        handle = ck_handle_new(CK_INSTANCES, own);
        if (!handle) say(own, CK_ERROR, "logStatusError", "there are too many instances");
    }
    if (!handle) {
        ck_model_close(&own->model);
        free(own->name);
        free(own);
    }
    return handle;
}

void fmi2FreeInstance(fmi2Component c) {
    instance *own = (instance *)ck_handle_free(CK_INSTANCES, c);
    if (!own) return;
    ck_model_close(&own->model);
    free(own->name);
    free(own);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop) {
    OWN(c);
    if (!ck_model_is_in(&own->model, CK_INSTANTIATED, "setupExperiment")) return fmi2Error;
    return (fmi2Status)ck_model_setup(&own->model, start, has_stop ? &stop : NULL,
                                      has_tolerance ? &tolerance : NULL);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    OWN(c);
    if (!ck_model_is_in(&own->model, CK_INSTANTIATED, "enterInitializationMode")) return fmi2Error;
    own->model.state.phase = CK_INITIALIZATION;
    own->model.state.stale = 1;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    int status;
    OWN(c);
    status = ck_model_initialize(&own->model);
    if (status == CK_OK && own->model.exchanges) own->model.state.phase = CK_EVENT;
    return (fmi2Status)status;
}

fmi2Status fmi2Terminate(fmi2Component c) {
    OWN(c);
    own->model.state.phase = CK_TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
    OWN(c);
    ck_model_reset(&own->model);
    return fmi2OK;
}

/* Reading and writing variables -------------------------------------------------------------- */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
    size_t i;
    int status = CK_OK;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "getReal: arguments are missing");
    for (i = 0; i < n && status == CK_OK; i++)
        status = ck_model_get(&own->model, vr[i], CK_REAL, &value[i]);
    return (fmi2Status)status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Integer value[]) {
    size_t i;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "getInteger: arguments are missing");
    for (i = 0; i < n; i++) {
        double found;
        if (ck_model_get(&own->model, vr[i], WHOLE, &found) != CK_OK) return fmi2Error;
        value[i] = (fmi2Integer)found;
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                       const fmi2Real value[]) {
    size_t i;
    int status = CK_OK;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "setReal: arguments are missing");
    for (i = 0; i < n && status == CK_OK; i++)
        status = ck_model_set(&own->model, vr[i], CK_REAL, value[i]);
    return (fmi2Status)status;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Integer value[]) {
    size_t i;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "setInteger: arguments are missing");
    for (i = 0; i < n; i++)
        if (ck_model_set(&own->model, vr[i], WHOLE, (double)value[i]) != CK_OK) return fmi2Error;
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Boolean value[]) {
    size_t i;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "getBoolean: arguments are missing");
    for (i = 0; i < n; i++) {
        double found;
        if (ck_model_get(&own->model, vr[i], CK_BOOLEAN, &found) != CK_OK) return fmi2Error;
        value[i] = found != 0.0 ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Boolean value[]) {
    size_t i;
    OWN(c);
    if (n > 0 && (!vr || !value)) return fail(own, "setBoolean: arguments are missing");
    for (i = 0; i < n; i++)
        if (ck_model_set(&own->model, vr[i], CK_BOOLEAN, value[i] ? 1.0 : 0.0) != CK_OK)
            return fmi2Error;
    return fmi2OK;
}

static fmi2Status no_such_type(fmi2Component c, size_t n) {
    OWN(c);
    return n == 0 ? fmi2OK : fail(own, "no variable of this FMU is of that type; reset the FMU");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[]) {
    (void)vr, (void)value;
    return no_such_type(c, n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[]) {
    (void)vr, (void)value;
    return no_such_type(c, n);
}

/* Rate of the pull during the next step; `dF_ext` says the same to hosts that have no such call. */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    size_t i;
    OWN(c);
    if (n > 0 && (!vr || !order || !value))
        return fail(own, "setRealInputDerivatives: arguments are missing");
    for (i = 0; i < n; i++) {
        const ck_variable *port = ck_model_variable(&own->model, vr[i], CK_REAL, "setRealInputDerivatives");
        if (!port) return fmi2Error;
        if (port->id != CK_F_EXT || port->causality != CK_INPUT || order[i] != 1 || !isfinite(value[i]))
            return fail(own, "setRealInputDerivatives: only the first derivative of F_ext is taken, "
                             "and it must be finite [N/s]; reset the FMU");
        own->model.state.rate = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[]) {
    size_t i;
    int status = CK_OK;
    OWN(c);
    if (n > 0 && (!vr || !order || !value))
        return fail(own, "getRealOutputDerivatives: arguments are missing");
    for (i = 0; i < n && status == CK_OK; i++)
        status = ck_model_rate(&own->model, vr[i], order[i], &value[i]);
    return (fmi2Status)status;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t n, const fmi2ValueReference known[], size_t m,
                                        const fmi2Real seed[], fmi2Real value[]) {
    OWN(c);
    if ((n > 0 && (!unknown || !value)) || (m > 0 && (!known || !seed)))
        return fail(own, "getDirectionalDerivative: arguments are missing");
    return (fmi2Status)ck_model_derivative(&own->model, unknown, n, known, m, seed, value);
}

/* Stepping ------------------------------------------------------------------------------------ */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean keeps) {
    OWN(c);
    (void)keeps;
    return (fmi2Status)ck_model_step(&own->model, time, step);
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    OWN(c);
    return lacks(own, "steps are not taken in the background: there is none to cancel");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    OWN(c);
    (void)kind, (void)value;
    return lacks(own, "no step is pending: there is no status to ask for");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    OWN(c);
    if (kind != fmi2LastSuccessfulTime || !value) return fmi2Discard;
    *value = own->model.state.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    OWN(c);
    (void)own, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    OWN(c);
    (void)own;
    if (kind != fmi2Terminated || !value) return fmi2Discard;
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    OWN(c);
    (void)own, (void)kind, (void)value;
    return fmi2Discard;
}

/* Model exchange ------------------------------------------------------------------------------- */

#define OWN_EXCHANGE(component, phase, call) \
    OWN(component);                          \
    if (!ck_exchange_is_on(&own->model, phase, call)) return fmi2Error

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    OWN_EXCHANGE(c, CK_STEPPING, "enterEventMode");
    own->model.state.phase = CK_EVENT;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
    OWN_EXCHANGE(c, CK_EVENT, "newDiscreteStates");
    if (!info) return fail(own, "newDiscreteStates: arguments are missing");
    info->newDiscreteStatesNeeded = info->terminateSimulation = fmi2False;
    info->nominalsOfContinuousStatesChanged = info->valuesOfContinuousStatesChanged = fmi2False;
    info->nextEventTimeDefined = fmi2False, info->nextEventTime = 0.0;
    return (fmi2Status)ck_model_update(&own->model);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    OWN_EXCHANGE(c, CK_EVENT, "enterContinuousTimeMode");
    own->model.state.phase = CK_STEPPING;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean keeps, fmi2Boolean *event,
                                       fmi2Boolean *terminate) {
    OWN_EXCHANGE(c, CK_STEPPING, "completedIntegratorStep");
    (void)keeps;
    if (!event || !terminate) return fail(own, "completedIntegratorStep: arguments are missing");
    *event = *terminate = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    OWN(c);
    if (!ck_exchange_is_on(&own->model, CK_ANY, "setTime")) return fmi2Error;
    return (fmi2Status)ck_exchange_time(&own->model, time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) {
    OWN_EXCHANGE(c, CK_STEPPING, "setContinuousStates");
    return (fmi2Status)ck_exchange_set_states(&own->model, x, n);
}

#define NUMBERS(NAME, FUNCTION)                                                                \
    fmi2Status fmi2Get##NAME(fmi2Component c, fmi2Real found[], size_t n) {                    \
        OWN(c);                                                                                \
        if (!ck_exchange_is_on(&own->model, CK_ANY, "get" #NAME)) return fmi2Error; \
        return (fmi2Status)FUNCTION(&own->model, found, n);                                    \
    }

NUMBERS(Derivatives, ck_exchange_derivatives)
NUMBERS(EventIndicators, ck_exchange_indicators)
NUMBERS(ContinuousStates, ck_exchange_states)
NUMBERS(NominalsOfContinuousStates, ck_exchange_nominals)

/* The state of an instance --------------------------------------------------------------------- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_take(&own->model, state) : fmi2Error;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_restore(&own->model, state) : fmi2Error;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_free(state) : fmi2Error;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_size(&own->model, state, size) : fmi2Error;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_write(&own->model, state, bytes, size) : fmi2Error;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state) {
    instance *own = (instance *)ck_handle_content(CK_INSTANCES, c);
    return own ? (fmi2Status)ck_saved_read(&own->model, bytes, size, state) : fmi2Error;
}
