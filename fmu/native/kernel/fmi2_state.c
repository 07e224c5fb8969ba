/* FMI 2.0: the state of an instance, taken, restored, and as bytes. */

#include "fmi2Functions.h"

#include "handles.h"
#include "saved.h"

static ck_model *model_of(fmi2Component c) {
    return (ck_model *)ck_handle_content(CK_INSTANCES, c); /* it is the first of an instance */
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_take(model, state) : fmi2Error;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_restore(model, state) : fmi2Error;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_free(state) : fmi2Error;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_size(model, state, size) : fmi2Error;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_write(model, state, bytes, size) : fmi2Error;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state) {
    ck_model *model = model_of(c);
    return model ? (fmi2Status)ck_saved_read(model, bytes, size, state) : fmi2Error;
}
