/* Model exchange, behind both versions of FMI: the host integrates, and stops where an event indicator
   changes its sign. What a model has of it is its `ck_exchange`. */

#include "model.h"

#include <math.h>
#include <stdio.h>

static const ck_exchange *own(const ck_model *model) { return ck_model_kind(model)->exchange; }

int ck_exchange_is_on(ck_model *model, int phase, const char *call) {
    char message[200];
    if (model->exchanges) return phase == CK_ANY || (!model->state.failed && ck_model_is_in(model, phase, call));
    snprintf(message, sizeof message, "%s is for model exchange, this instance is for co-simulation", call);
    model->say(model->host, CK_ERROR, "logStatusError", message); /* nothing changed */
    return 0;
}

int ck_exchange_has_state(const ck_model *model, int variable) {
    int i;
    for (i = 0; own(model) && i < own(model)->n_states; i++)
        if (own(model)->states[i] == variable) return 1;
    return 0;
}

int ck_exchange_time(ck_model *model, double time) {
    if (!isfinite(time)) return ck_model_fail(model, "setTime: the time must be finite [s]; reset the FMU");
    model->state.time = time;
    return CK_OK;
}

/* Whether a call has room for as many numbers as there are. */
static int fits(ck_model *model, const void *numbers, size_t n, int count) {
    char message[200];
    if (n == (size_t)count && (n == 0 || numbers)) return 1;
    snprintf(message, sizeof message,
             "there are %d states and %d event indicators: give room for as many; reset the FMU",
             own(model)->n_states, CK_INDICATORS);
    ck_model_fail(model, message);
    return 0;
}

int ck_exchange_states(ck_model *model, double found[], size_t n) {
    int i;
    if (!fits(model, found, n, own(model)->n_states)) return CK_ERROR;
    for (i = 0; i < own(model)->n_states; i++) found[i] = model->state.values[own(model)->states[i]];
    return CK_OK;
}

int ck_exchange_set_states(ck_model *model, const double given[], size_t n) {
    int i;
    if (!fits(model, given, n, own(model)->n_states)) return CK_ERROR;
    for (i = 0; i < own(model)->n_states; i++)
        if (!isfinite(given[i]))
            return ck_model_discard(model, "a continuous state is no finite number; take a shorter step");
    for (i = 0; i < own(model)->n_states; i++) model->state.values[own(model)->states[i]] = given[i];
    return CK_OK;
}

/* Outputs that belong to the motion that was set. */
static int follow(ck_model *model) {
    ck_model_follow(model);
    if (model->state.failed) return CK_ERROR;
    if (model->state.shown || model->state.phase < CK_STEPPING) return CK_OK;
    return ck_model_discard(model, "the forces there are no finite numbers; take a shorter step");
}

int ck_exchange_derivatives(ck_model *model, double found[], size_t n) {
    int i, status;
    if (!fits(model, found, n, own(model)->n_states)) return CK_ERROR;
    status = follow(model);
    for (i = 0; status == CK_OK && i < own(model)->n_states; i++)
        found[i] = model->state.values[own(model)->derivatives[i]];
    return status;
}

int ck_exchange_indicators(ck_model *model, double found[], size_t n) {
    int status, i;
    if (!fits(model, found, n, CK_INDICATORS)) return CK_ERROR;
    for (i = 0; i < CK_INDICATORS; i++) found[i] = 0.0;
    status = follow(model);
    if (status == CK_OK && model->scene.tables) own(model)->indicate(model, found); /* not before it is prepared */
    return status;
}

int ck_exchange_nominals(ck_model *model, double found[], size_t n) {
    const ck_contents *contents = &model->data.contents;
    int i, k;
    if (!fits(model, found, n, own(model)->n_states)) return CK_ERROR;
    for (i = 0; i < own(model)->n_states; i++)
        for (k = 0; k < contents->n_variables; k++)
            if (contents->variables[k].id == own(model)->states[i]) found[i] = contents->variables[k].nominal;
    return CK_OK;
}
