/* Variables, phases and refusals; see the head of model.h. */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROUNDING 1e-12 /* share of the time by which two clocks may differ after rounding */

static const char *const NAMES[CK_VARIABLES] = {
    "F_ext", "dF_ext",
    "h", "v", "F", "F_m", "F_v", "J", "J_m", "W", "state", "limit", "t_break",
    "t_release", "F_peak", "n_break", "n_release",
    "m", "h0", "v0", "k_s", "h_rel", "h_min", "h_break", "eta", "gamma", "dp_cav",
    "tau_lim", "rtol"};

const char *ck_name(int id) { return NAMES[id]; }

int ck_model_fail(ck_model *model, const char *message) {
    if (!model->state.failed) { /* the first failure explains those that follow */
        model->state.failed = 1;
        model->say(model->host, CK_ERROR, "logStatusError", message);
    }
    return CK_ERROR;
}

int ck_model_open(ck_model *model, const char *resources, const char *guid) {
    char path[1024], message[1400];
    const char *problem;
    int length = snprintf(path, sizeof path, "%s/film.bin", resources);
    if (length < 0 || (size_t)length >= sizeof path) problem = "its path is too long";
    else problem = ck_data_read(path, &model->data);
    if (!problem && strcmp(guid, model->data.guid) != 0)
        problem = "it belongs to an FMU with another GUID";
    if (!problem) {
        model->state.checksum = model->data.checksum;
        ck_model_reset(model);
        return 1;
    }
    snprintf(message, sizeof message, "resources/film.bin: %s; build or unpack the FMU again",
             problem);
    model->say(model->host, CK_ERROR, "logStatusError", message);
    ck_model_close(model);
    return 0;
}

void ck_model_close(ck_model *model) {
    free(model->data.numbers);
    model->data.numbers = NULL;
}

void ck_model_reset(ck_model *model) {
    int i;
    memset(&model->state, 0, sizeof model->state);
    model->state.checksum = model->data.checksum;
    for (i = 0; i < model->data.port_count; i++)
        model->state.values[model->data.ports[i].id] = model->data.ports[i].start;
}

int ck_model_is_in(ck_model *model, int phase, const char *call) {
    static const char *const phases[] = {"instantiated", "in initialization", "stepping",
                                         "terminated"};
    char message[200];
    if (model->state.phase == phase) return 1;
    snprintf(message, sizeof message, "%s is for an FMU that is %s, this one is %s; reset it", call,
             phases[phase], phases[model->state.phase]);
    ck_model_fail(model, message);
    return 0;
}

const ck_port *ck_model_port(ck_model *model, unsigned reference, int type, const char *call) {
    char message[200];
    if (reference >= 1 && reference <= (unsigned)model->data.port_count &&
        model->data.ports[reference - 1].type == type)
        return &model->data.ports[reference - 1];
    snprintf(message, sizeof message,
             "%s: value reference %u is not that of %s variable; reset the FMU and keep to the "
             "variables of its model description",
             call, reference, type == CK_REAL ? "a real" : "an integer");
    ck_model_fail(model, message);
    return NULL;
}

static int refuse(ck_model *model, const ck_port *port, double value, const char *expected) {
    char message[300];
    snprintf(message, sizeof message, "%s must %s, got %.17g; reset the FMU, then set it so",
             NAMES[port->id], expected, value);
    return ck_model_fail(model, message);
}

int ck_model_set(ck_model *model, unsigned reference, int type, double value) {
    const ck_port *port = ck_model_port(model, reference, type, "set");
    char expected[100];
    if (!port) return CK_ERROR;
    if (model->state.failed) return CK_ERROR;
    if (port->causality == CK_OUTPUT)
        return refuse(model, port, value, "not be set, because it is an output");
    if (model->state.phase == CK_TERMINATED)
        return refuse(model, port, value, "not be set after the end");
    if (port->causality == CK_PARAMETER && model->state.phase == CK_STEPPING)
        return refuse(model, port, value, "be set before initialization ends");
    if (!(port->low <= value && value <= port->high)) { /* nan is not, either */
        snprintf(expected, sizeof expected, "lie between %.9g and %.9g", port->low, port->high);
        return refuse(model, port, value, expected);
    }
    model->state.values[port->id] = value;
    if (port->causality == CK_PARAMETER || model->state.phase != CK_STEPPING)
        model->state.stale = 1;
    return CK_OK;
}

/* Put the parameters into the scene; the message says what is wrong with them. */
static const char *apply(ck_model *model) {
    const double *v = model->state.values;
    ck_scene *scene = &model->scene;
    int i;
    *scene = model->data.scene;
    if (v[CK_H_REL] <= v[CK_H0]) return "h_rel must exceed h0";
    if (v[CK_H_MIN] > v[CK_H0]) return "h_min must not exceed h0";
    if (v[CK_H_BREAK] > 0.0 && v[CK_H_BREAK] <= v[CK_H0]) return "h_break must exceed h0, or be 0";
    scene->mass = v[CK_M], scene->initial_gap = v[CK_H0], scene->initial_speed = v[CK_V0];
    scene->stiffness = v[CK_K_S], scene->release_gap = v[CK_H_REL], scene->rest_gap = v[CK_H_MIN];
    scene->rtol = v[CK_RTOL] > 1e-11 ? v[CK_RTOL] : 1e-11;
    scene->viscosity = v[CK_ETA], scene->surface_tension = v[CK_GAMMA];
    scene->tension = v[CK_DP_CAV], scene->strength = v[CK_TAU_LIM];
    for (i = 0; i < scene->film_count; i++) {
        double breaks = v[CK_H_BREAK] > 0.0 ? v[CK_H_BREAK] : scene->films[i].breaks;
        scene->ends[i] = scene->films[i].end < breaks ? scene->films[i].end : breaks;
    }
    if (scene->ends[0] <= v[CK_H0])
        return "no meniscus spans h0: lower it, or build the FMU from a scene with more liquid";
    scene->rejoin = 0.0;
    for (i = 0; i < scene->films[0].count; i++) {
        const ck_law *law = &scene->films[0].laws[i];
        if (law->release < HUGE_VAL && law->release <= v[CK_H0])
            return "h0 must be below the gap at which the solids let go of each other";
        if (law->rejoin > scene->rejoin) scene->rejoin = law->rejoin;
    }
    return NULL;
}

static int show(ck_model *model, double pull) {
    double *v = model->state.values;
    const ck_motion *motion = &model->state.motion;
    ck_acting acting;
    ck_forces found;
    ck_act(&model->scene, motion, &acting);
    ck_forces_at(&acting, motion->gap, motion->speed, 0, &found);
    if (!isfinite(found.fixed + found.viscous) || !isfinite(motion->work + motion->speed)) return 0;
    v[CK_H] = motion->gap, v[CK_V] = motion->speed;
    v[CK_F] = found.fixed + found.viscous, v[CK_F_M] = found.fixed, v[CK_F_V] = found.viscous;
    v[CK_J] = motion->viscous_impulse, v[CK_J_M] = motion->fixed_impulse, v[CK_W] = motion->work;
    v[CK_STATE] = ck_status(&model->scene, motion, &acting, &found, pull);
    v[CK_LIMIT] = found.limit + 1;
    v[CK_T_BREAK] = motion->break_time, v[CK_T_RELEASE] = motion->release_time;
    v[CK_F_PEAK] = motion->peak_force;
    v[CK_N_BREAK] = motion->breaks, v[CK_N_RELEASE] = motion->releases;
    return 1;
}

/* Start the motion from the parameters. */
static const char *prepare(ck_model *model) {
    const char *problem = apply(model);
    model->state.stale = 0;
    if (problem) return problem;
    ck_start(&model->scene, model->state.start_time, &model->state.motion);
    return show(model, 0.0) ? NULL : "the forces at the start are no finite numbers";
}

int ck_model_get(ck_model *model, unsigned reference, int type, double *value) {
    const ck_port *port = ck_model_port(model, reference, type, "get");
    if (!port) return CK_ERROR;
    if (model->state.stale && !model->state.failed && model->state.phase == CK_INITIALIZATION) {
        const char *problem = prepare(model); /* a tool may be half way through its parameters */
        if (problem) model->say(model->host, CK_WARNING, "logStatusWarning", problem);
    }
    *value = model->state.values[port->id];
    return CK_OK;
}

int ck_model_setup(ck_model *model, double start_time) {
    if (!isfinite(start_time))
        return ck_model_fail(model, "the start time must be finite [s]; reset the FMU");
    model->state.time = model->state.start_time = start_time;
    return CK_OK;
}

int ck_model_initialize(ck_model *model) {
    char message[300];
    const char *problem;
    if (!ck_model_is_in(model, CK_INITIALIZATION, "exitInitializationMode")) return CK_ERROR;
    if (model->state.failed) return CK_ERROR;
    problem = prepare(model);
    if (problem) {
        snprintf(message, sizeof message, "initialization: %s; reset the FMU, then set it so",
                 problem);
        return ck_model_fail(model, message);
    }
    model->state.phase = CK_STEPPING;
    return CK_OK;
}

static int no_step(ck_model *model, int trouble, const ck_motion *where) {
    char message[400];
    const char *cure = "loosen rtol";
    if (where->gap < 1e-12)
        cure = "the bodies are pressed together; give h_min [m], where asperities carry";
    snprintf(message, sizeof message,
             "%s from %.9g s, gap %.6g m, speed %.6g m/s; %s, then reset the FMU or go back to an "
             "earlier state",
             trouble == CK_NO_STEP ? "no step of time can be taken" : "too many internal steps led",
             where->time, where->gap, where->speed, cure);
    ck_model_fail(model, message);
    return CK_DISCARD;
}

static void tell(ck_model *model, const ck_motion *before) {
    const ck_motion *now = &model->state.motion;
    char message[80];
    if (now->releases > before->releases) {
        snprintf(message, sizeof message, "released at t = %.9g s", now->release_time);
        model->say(model->host, CK_OK, "logEvents", message);
    }
    if (now->breaks > before->breaks) {
        snprintf(message, sizeof message, "film broke at t = %.9g s", now->break_time);
        model->say(model->host, CK_OK, "logEvents", message);
    }
}

int ck_model_step(ck_model *model, double time, double step) {
    ck_state *state = &model->state;
    double nothing = ROUNDING * fmax(fabs(state->time), state->last_step);
    ck_motion before = state->motion;
    ck_pull pull;
    int trouble;
    if (state->failed || !ck_model_is_in(model, CK_STEPPING, "doStep")) return CK_DISCARD;
    if (!(fabs(time - state->time) <= nothing + 1e-6 * fabs(step) && isfinite(step)) ||
        step < -nothing) {
        char message[300];
        snprintf(message, sizeof message,
                 "a step must start at t = %.17g s, where the last one ended, and go forward, got "
                 "a start of %.17g s and a length of %.17g s; to go back set an earlier FMU state, "
                 "or reset the FMU",
                 state->time, time, step);
        ck_model_fail(model, message);
        return CK_DISCARD;
    }
    if (step <= nothing) return CK_OK; /* some masters end with a step of rounding size */
    pull.force = state->values[CK_F_EXT], pull.time = time;
    pull.rate = state->values[CK_DF_EXT] + state->rate;
    state->motion.time = time;
    trouble = ck_advance(&model->scene, &state->motion, &pull, step);
    if (trouble || !show(model, ck_pull_at(&pull, time + step))) {
        ck_motion where = state->motion;
        state->motion = before;
        return no_step(model, trouble ? trouble : CK_NO_STEP, &where);
    }
    state->time = time + step, state->last_step = step, state->rate = 0.0;
    tell(model, &before);
    return CK_OK;
}

int ck_model_restore(ck_model *model, const ck_state *state) {
    if (state->checksum != model->data.checksum || state->phase < CK_INSTANTIATED ||
        state->phase > CK_TERMINATED || state->motion.film < 0 ||
        state->motion.film >= model->data.scene.film_count)
        return ck_model_fail(model, "the FMU state is not one of this FMU; take it from this FMU, "
                                    "and keep its bytes unchanged");
    model->state = *state;
    if (state->phase >= CK_STEPPING) apply(model);
    return CK_OK;
}
