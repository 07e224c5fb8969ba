/* stiction-mass: a mass held by a film; a pull in, motion out. */

#include "model.h"
#include "rheology.h"

#include <math.h>
#include <stdio.h>

static const char *apply(ck_model *model) {
    const double *v = model->state.values;
    ck_scene *scene = &model->scene;
    const char *problem = ck_common_parameters(model);
    if (v[CK_H_REL] <= v[CK_H0]) return ck_wrong(model, CK_H_REL, "exceed", CK_H0, "m");
    if (v[CK_H_MIN] > v[CK_H0]) return ck_wrong(model, CK_H_MIN, "not exceed", CK_H0, "m");
    scene->mass = v[CK_M], scene->initial_speed = v[CK_V0];
    scene->stiffness = v[CK_K_S], scene->release_gap = v[CK_H_REL], scene->rest_gap = v[CK_H_MIN];
    scene->rtol = v[CK_RTOL], scene->max_steps = ck_step_limit(model);
    return problem;
}

static void start(ck_model *model) {
    ck_start(&model->scene, &model->state.motion);
    model->state.pull = 0.0;
}

/* Time of the host for one since the start. */
static double clock_at(const ck_model *model, double time) { return model->state.start_time + time; }

static int show(ck_model *model) {
    double *v = model->state.values;
    const ck_motion *motion = &model->state.motion;
    ck_acting acting;
    ck_forces found;
    ck_spot spot;
    ck_act(&model->scene, motion->film, motion->broken, motion->detached, &acting);
    ck_forces_of(&acting, motion, &found, &spot);
    if (!isfinite(found.fixed + found.viscous) || !isfinite(motion->work + motion->speed)) return 0;
    v[CK_H] = motion->gap, v[CK_V] = motion->speed;
    v[CK_F] = found.fixed + found.viscous, v[CK_F_M] = found.fixed, v[CK_F_V] = found.viscous;
    v[CK_J] = motion->viscous_impulse, v[CK_J_M] = motion->fixed_impulse, v[CK_W] = motion->work;
    v[CK_STATE] = ck_status(&model->scene, motion, &acting, &found, model->state.pull);
    v[CK_LIMIT] = found.limit;
    v[CK_R_CAV] = sqrt(spot.edge), v[CK_V_VOID] = model->scene.tables->menisci * motion->cavity.hollow;
    v[CK_T_BREAK] = motion->breaks ? clock_at(model, motion->break_time) : -1.0;
    v[CK_T_RELEASE] = motion->releases ? clock_at(model, motion->release_time) : -1.0;
    v[CK_F_PEAK] = motion->peak_force;
    v[CK_N_BREAK] = motion->breaks, v[CK_N_RELEASE] = motion->releases;
    return 1;
}

static int no_step(ck_model *model, const ck_motion *where) {
    char message[600];
    const char *cure = "take shorter steps, or loosen rtol", *obstacle;
    ck_acting acting;
    ck_act(&model->scene, where->film, where->broken, where->detached, &acting);
    obstacle = ck_rheological_obstacle(&acting, where->gap, where->speed);
    if (where->gap < 1e-12)
        cure = "the bodies are pressed together; give h_min [m], where asperities carry";
    else if (obstacle) cure = obstacle;
    snprintf(message, sizeof message,
             "no step of time can be taken from %.9g s, gap %.6g m, speed %.6g m/s; %s",
             clock_at(model, where->time), where->gap, where->speed, cure);
    return ck_model_discard(model, message);
}

/* A step that costs too much: it ends where it has got to if the host allows that, else it is
   discarded. */
static int too_long(ck_model *model, double length, const ck_motion *before, const ck_motion *reached) {
    double gone = reached->time - before->time;
    int ends = model->early && gone > 0.0;
    char message[500];
    snprintf(message, sizeof message,
             "a step of %.6g s from %.9g s takes too many internal steps, as max_steps = %d led to "
             "%.9g s, gap %.6g m, speed %.6g m/s; %s, loosen rtol, or raise max_steps",
             length, clock_at(model, before->time), model->scene.max_steps,
             clock_at(model, reached->time), reached->gap, reached->speed,
             ends ? "it ends there: go on from there" : "take shorter steps");
    if (!ends) return ck_model_discard(model, message);
    model->say(model->host, CK_WARNING, "logStatusWarning", message);
    return CK_OK;
}

static void tell(ck_model *model, const ck_motion *before) {
    const ck_motion *now = &model->state.motion;
    char message[80];
    if (now->releases > before->releases) {
        snprintf(message, sizeof message, "released at t = %.9g s", clock_at(model, now->release_time));
        model->say(model->host, CK_OK, "logEvents", message);
    }
    if (now->breaks > before->breaks) {
        snprintf(message, sizeof message, "film broke at t = %.9g s", clock_at(model, now->break_time));
        model->say(model->host, CK_OK, "logEvents", message);
    }
    if (now->inceptions > before->inceptions) {
        snprintf(message, sizeof message, "film cavitated at t = %.9g s",
                 clock_at(model, now->inception_time));
        model->say(model->host, CK_OK, "logEvents", message);
    }
    if (now->reformations > before->reformations) {
        snprintf(message, sizeof message, "film reformed at t = %.9g s",
                 clock_at(model, now->reformation_time));
        model->say(model->host, CK_OK, "logEvents", message);
    }
}

int ck_rate_twice(ck_model *model) {
    char message[300];
    snprintf(message, sizeof message,
             "the rate of F_ext is given twice, as dF_ext = %.9g N/s and as the derivative of the "
             "input, %.9g N/s; give one of them, then reset the FMU",
             model->state.values[CK_DF_EXT], model->state.rate);
    ck_model_fail(model, message);
    return CK_DISCARD;
}

static int step(ck_model *model, double time, double length) {
    ck_state *state = &model->state;
    ck_motion before = state->motion, *now = &state->motion; /* its time counts from the start */
    ck_pull pull;
    int trouble;
    if (state->rate != 0.0 && state->values[CK_DF_EXT] != 0.0) return ck_rate_twice(model);
    pull.force = state->values[CK_F_EXT], pull.time = now->time;
    pull.rate = state->values[CK_DF_EXT] + state->rate, pull.bend = 0.0;
    trouble = ck_advance(&model->scene, now, &pull, length);
    if (trouble == CK_NO_STEP || !isfinite(now->gap + now->speed + now->work)) {
        ck_motion where = *now;
        *now = before;
        return no_step(model, &where);
    }
    if (trouble) {
        ck_motion where = *now;
        *now = before;
        trouble = too_long(model, length, &before, &where);
        if (trouble) return trouble;
        *now = where, state->cut = 1;
    }
    state->pull = ck_pull_at(&pull, now->time);
    state->end = time + (now->time - before.time);
    if ((now->pending || state->cut) && state->end < time + length) /* a ramp goes on from where it is */
        state->values[CK_F_EXT] = state->pull;
    state->shown = 0; /* outputs are made once they are read */
    tell(model, &before);
    return CK_OK;
}

/* What a step paused for happens. */
static void resolve(ck_model *model) {
    ck_motion before = model->state.motion;
    ck_resolve(&model->scene, &model->state.motion);
    tell(model, &before);
}

const ck_kind ck_stiction_mass = {apply, start, show, step, resolve, 0, NULL, NULL, NULL};
