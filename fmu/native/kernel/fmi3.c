/* FMI 3.0 for co-simulation: life of an instance, its modes, its steps. Nothing the host does wrong
   may end its process.

   A host that uses event mode and allows an early return gets it where the film breaks or wets the
   bodies again: the step ends there, with everything as it is just before. Event mode then makes
   it happen. Outputs that are no continuous numbers change in event mode only; a step that ends
   with others than it began with asks for it. */

#include "fmi3_own.h"

#include <stdlib.h>
#include <string.h>

static void say(void *host, int status, const char *category, const char *message) {
    ck_own *own = (ck_own *)host;
    if (!own->logger || !(own->wanted & ck_category(category))) return;
    own->logger(own->environment, (fmi3Status)status, category, message);
}

fmi3Status ck_own_fail(ck_own *own, const char *message) {
    return (fmi3Status)ck_model_fail(&own->model, message);
}

fmi3Status ck_own_lacks(ck_own *own, const char *message) {
    say(own, CK_ERROR, "logStatusError", message);
    return fmi3Error;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n,
                               const fmi3String categories[]) {
    OWN(instance);
    if (n > 0 && !categories) return ck_own_fail(own, "setDebugLogging: categories are missing");
    own->wanted = ck_wanted(own->wanted, on, n, categories);
    return fmi3OK;
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logs,
    fmi3Boolean event_mode, fmi3Boolean early, const fmi3ValueReference intermediate[],
    size_t intermediate_count, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
    fmi3IntermediateUpdateCallback update) {
    ck_own *own = (ck_own *)calloc(1, sizeof *own);
    char folder[900];
    fmi3Instance handle = NULL;
    (void)visible, (void)intermediate, (void)update;
    if (!own) return NULL;
    own->logger = logger, own->environment = environment;
    own->wanted = logs ? CK_LOG_ALL : CK_LOG_ERROR; /* why it refuses is no debugging */
    own->model.say = say, own->model.host = own;
    own->model.event_mode = event_mode, own->model.pauses = event_mode && early;
    if (!name || !*name) ck_own_lacks(own, "the instance needs a name");
    else if (intermediate_count > 0) ck_own_lacks(own, "intermediate updates are not provided; ask for none");
    else if (!token || !resources || !ck_folder_of(resources, folder, sizeof folder))
        ck_own_lacks(own, "instantiation token or resource path is missing, or too long");
    else if (!ck_model_open(&own->model, folder, token)) handle = NULL; /* it has said why */
    else {
        handle = ck_handle_new(CK_INSTANCES, own);
        if (!handle) ck_own_lacks(own, "there are too many instances");
    }
    if (!handle) {
        ck_model_close(&own->model);
        free(own);
    }
    return handle;
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
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    if (!ck_model_is_in(&own->model, CK_INSTANTIATED, "enterInitializationMode")) return fmi3Error;
    if (ck_model_setup(&own->model, start) != CK_OK) return fmi3Error;
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
        return ck_own_fail(own, "enterEventMode: instantiate with eventModeUsed to use it");
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
        return ck_own_fail(own, "updateDiscreteStates: arguments are missing");
    *again = *terminate = *nominals_changed = *values_changed = *next_defined = fmi3False;
    *next = 0.0;
    return (fmi3Status)ck_model_update(&own->model);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    OWN(instance);
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

/* A failed step is an error: only a reset or an earlier state helps, a shorter step does not. */
fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step, fmi3Boolean keeps,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early,
                      fmi3Float64 *last) {
    int status;
    OWN(instance);
    (void)keeps;
    if (!event || !terminate || !early || !last)
        return ck_own_fail(own, "doStep: arguments are missing");
    *event = *terminate = *early = fmi3False;
    status = ck_model_step(&own->model, time, step);
    *last = own->model.state.time;
    if (status != CK_OK) return fmi3Error;
    *event = own->model.state.event != 0;
    *early = *last < time + step && ck_model_pends(&own->model);
    return fmi3OK;
}
