/* Event mode: outputs that are no continuous numbers change in it only, and what a step ended for
   happens in it. Between two events the host sees what it has seen; `latest` is what is true. */

#include "model.h"

static const int HELD[CK_HELD] = {CK_STATE,     CK_LIMIT,    CK_T_BREAK, CK_T_RELEASE, CK_N_BREAK,
                                  CK_N_RELEASE, CK_IN_DOUBT, CK_N_DOUBT, CK_U};

static int holds(const ck_model *model) {
    return model->event_mode && model->state.phase == CK_STEPPING;
}

int ck_model_pends(const ck_model *model) {
    const ck_state *state = &model->state;
    return state->motion.pending || state->memory.pending || state->driven.pending;
}

void ck_events_note(ck_model *model) {
    int i;
    for (i = 0; i < CK_HELD; i++) model->state.latest[i] = model->state.values[HELD[i]];
}

void ck_events_lift(ck_model *model, double seen[CK_HELD]) {
    int i;
    if (!holds(model)) return;
    for (i = 0; i < CK_HELD; i++) {
        seen[i] = model->state.values[HELD[i]];
        model->state.values[HELD[i]] = model->state.latest[i];
    }
}

void ck_events_hold(ck_model *model, const double seen[CK_HELD]) {
    int i;
    if (!holds(model)) return;
    ck_events_note(model);
    for (i = 0; i < CK_HELD; i++) model->state.values[HELD[i]] = seen[i];
}

int ck_events_lag(const ck_model *model) {
    int lags = ck_model_pends(model), i;
    for (i = 0; i < CK_HELD; i++) lags |= model->state.latest[i] != model->state.values[HELD[i]];
    return lags;
}

int ck_model_update(ck_model *model) {
    int i;
    if (model->state.failed || !ck_model_is_in(model, CK_EVENT, "updateDiscreteStates"))
        return CK_ERROR;
    for (i = 0; i < CK_HELD; i++) model->state.values[HELD[i]] = model->state.latest[i];
    if (ck_model_pends(model)) ck_model_kind(model)->resolve(model);
    model->state.event = model->state.shown = 0;
    ck_model_follow(model);
    ck_events_note(model);
    return model->state.failed ? CK_ERROR : CK_OK;
}

void ck_events_skip(ck_model *model) {
    int i;
    if (model->event_mode) return;
    if (model->state.phase == CK_EVENT) model->state.phase = CK_STEPPING;
    if (!model->state.event) return;
    for (i = 0; i < CK_HELD; i++) model->state.values[HELD[i]] = model->state.latest[i];
    if (ck_model_pends(model)) ck_model_kind(model)->resolve(model);
    model->state.event = model->state.shown = 0;
}
