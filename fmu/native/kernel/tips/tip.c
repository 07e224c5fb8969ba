/* tip-contact: spring tips on a landing site; motion of their root in, force out.

   As fmu/slaves/tip_contact.py: models/micromirror/tip.py steps a tip that is landed, held
   by its film, free, or strikes a site that deforms. What is set when a step is taken is where the
   root is at its start. */

#include "tip.h"

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PIECE 3 /* cost of a piece of the motion beside its steps, in internal steps of 1 to 2 us */

enum { TOO_MANY_SWINGS = 10, TOO_MANY_PIECES = 11, IMPACT = 20 }; /* troubles; and those of impacts */

static int gives(const ck_model *model) { return model->data.contents.has_faces; }

/* Gap beyond which a tip is free: that of solids, or where the film breaks beyond. */
static double free_gap(const ck_scene *scene) {
    double end = scene->ends[0];
    return end < HUGE_VAL && end > scene->release_gap ? end : scene->release_gap;
}

/* Force of film and solids at touch. */
static double attraction(const ck_model *model) {
    const ck_motion *motion = &model->state.motion;
    ck_acting acting;
    ck_act(&model->scene, motion->film, motion->broken, motion->detached, &acting);
    return acting.any ? ck_fixed_force(&acting, model->scene.initial_gap) : 0.0;
}

static ck_site site_of(const ck_model *model, const ck_root *root) {
    ck_site site = {&model->data.contents.faces, model->state.values[CK_D_STOP], 0.0, 0.0, 0.0, {0.0, 0.0, 0.0, 0.0}};
    site.attraction = attraction(model);
    site.stiffness = model->scene.stiffness, site.mass = model->scene.mass, site.root = *root;
    return site;
}

/* Where the root is, by what was set. */
static ck_root root_of(const ck_model *model, double time) {
    const double *v = model->state.values;
    ck_root root = {v[CK_Z], v[CK_VZ], v[CK_AZ], time};
    return root;
}

/* Start ----------------------------------------------------------------------------------------- */

/* Refuse a tip that starts beyond the end of its curve. */
static const char *pressed_in(ck_model *model) {
    const ck_faces *faces = &model->data.contents.faces;
    ck_root root = root_of(model, 0.0);
    ck_motion saved = model->state.motion;
    ck_site site;
    double depth;
    memset(&model->state.motion, 0, sizeof model->state.motion);
    site = site_of(model, &root);
    model->state.motion = saved;
    depth = ck_rest_depth(&site, 0.0, 0.0);
    if (!ck_is_too_deep(faces, depth)) return NULL;
    snprintf(model->wrong, sizeof model->wrong,
             "a tip is pressed %.4g m deep, beyond %.4g m and %.4g N where its curve ends; make it "
             "with a larger approach",
             depth, faces->first.end, faces->first.high);
    return model->wrong;
}

static const char *apply(ck_model *model) {
    const double *v = model->state.values;
    ck_scene *scene = &model->scene;
    const char *problem = ck_common_parameters(model);
    double critical = 2.0 * sqrt(v[CK_K] * v[CK_M]);
    scene->mass = v[CK_M], scene->stiffness = v[CK_K], scene->initial_speed = 0.0;
    scene->release_gap = v[CK_H_FREE], scene->rest_gap = v[CK_H0], scene->rtol = v[CK_RTOL];
    scene->max_steps = ck_step_limit(model);
    scene->pauses = 0; /* the root follows its inputs, whatever the tips do */
    if (v[CK_H_FREE] <= v[CK_H0]) return ck_wrong(model, CK_H_FREE, "exceed", CK_H0, "m");
    if (problem) return problem;
    if (!(v[CK_C] < critical)) {
        snprintf(model->wrong, sizeof model->wrong,
                 "c must be less than critical, %.9g N.s/m, got %.9g N.s/m", critical, v[CK_C]);
        return model->wrong;
    }
    if (v[CK_D_STOP] > 0.0 && !gives(model)) {
        snprintf(model->wrong, sizeof model->wrong,
                 "d_stop must be 0 on a rigid site, got %.9g s/m; build the FMU with a curve",
                 v[CK_D_STOP]);
        return model->wrong;
    }
    if (gives(model) && model->state.phase < CK_STEPPING && v[CK_Z] <= 0.0) return pressed_in(model);
    return NULL;
}

/* Remember how deep the faces are pressed, and the residual indentation. */
static void press(ck_model *model, double depth) {
    ck_tip *tip = &model->state.tip;
    const ck_faces *faces = &model->data.contents.faces;
    double unused;
    tip->depth = depth;
    tip->largest = ck_larger(tip->largest, depth);
    if (depth > 0.0)
        tip->peak = ck_larger(tip->peak, ck_faces_force(faces, depth, tip->largest, &unused));
    tip->residual = ck_faces_residual(faces, tip->largest);
}

static void start(ck_model *model) {
    ck_motion *motion = &model->state.motion;
    ck_tip *tip = &model->state.tip;
    ck_root root = root_of(model, 0.0);
    memset(tip, 0, sizeof *tip);
    tip->landing_time = tip->free_time = -1.0;
    ck_start(&model->scene, motion);
    motion->in_contact = root.height <= 0.0;
    model->state.values[CK_F_MEAN] = 0.0;
    if (!motion->in_contact) {
        motion->gap += root.height, motion->speed = root.speed;
        motion->broken = tip->free = 1, motion->armed = 0;
    } else if (gives(model)) {
        ck_site site = site_of(model, &root);
        press(model, ck_rest_depth(&site, 0.0, 0.0));
    }
}

/* Pieces of a step ------------------------------------------------------------------------------ */

static void land(ck_model *model, double loss) {
    ck_tip *tip = &model->state.tip;
    tip->loss += loss, tip->landings++, tip->landing_time = model->state.motion.time;
}

/* One internal step while the tip has landed or its film acts. */
static int one(ck_model *model, const ck_root *root, double end, int strikes) {
    const ck_scene *scene = &model->scene;
    ck_motion *now = &model->state.motion, before = *now;
    ck_tip *tip = &model->state.tip;
    double k = scene->stiffness, mass = scene->mass, origin = scene->initial_gap;
    double elapsed, bent, twelfth, impulse, film, speed;
    ck_pull pull;
    int trouble;
    pull.force = k * root->height, pull.rate = k * root->speed;
    pull.bend = 0.5 * k * root->acceleration, pull.time = root->time;
    trouble = ck_internal_step(scene, now, &pull, end);
    if (trouble) return trouble;
    elapsed = now->time - before.time;
    impulse = ck_pull_at(&pull, before.time) - k * (before.gap - origin);
    impulse += ck_pull_at(&pull, now->time) - k * (now->gap - origin);
    impulse *= 0.5 * elapsed;
    /* What the trapezoid misses: the slopes at its ends differ by the spring times this speed. */
    bent = root->acceleration * elapsed, twelfth = elapsed * elapsed * k / 12.0;
    if (before.in_contact) {
        impulse -= twelfth * bent;
    } else {
        film = now->viscous_impulse - before.viscous_impulse;
        film += now->fixed_impulse - before.fixed_impulse;
        /* Where it lands its speed is lost: the momentum says what it was. */
        speed = now->in_contact ? before.speed + (impulse - film) / mass : now->speed;
        impulse += twelfth * (speed - before.speed - bent);
        if (now->in_contact) {
            speed = before.speed + (impulse - film) / mass;
            strikes = strikes && speed < 0.0;
            land(model, strikes ? 0.0 : 0.5 * mass * speed * speed);
            if (strikes) now->in_contact = 0, now->speed = speed, now->known = 0, tip->touching = 1;
        }
    }
    if (now->speed > 0.0 && now->gap >= free_gap(scene) * (1.0 - 1e-9))
        tip->free = 1, tip->free_time = now->time;
    tip->impulse += impulse;
    return CK_DONE;
}

/* Land after a flight: the tip stops, or strikes a site that deforms; its film is there again. */
static void touch(ck_model *model) {
    const ck_scene *scene = &model->scene;
    ck_motion *motion = &model->state.motion;
    ck_tip *tip = &model->state.tip;
    int wets = scene->tables->rewetting > 0.0, strikes = gives(model);
    land(model, strikes ? 0.0 : 0.5 * scene->mass * motion->speed * motion->speed);
    motion->gap = scene->initial_gap, motion->in_contact = !strikes;
    if (!strikes) motion->speed = 0.0;
    motion->broken = !wets, motion->armed = 1, motion->detached = 0;
    if (wets) motion->film = scene->tables->n_films - 1;
    tip->free = 0, tip->touching = strikes;
}

/* Let a free tip swing for a time, or until it lands. */
static int fly(ck_model *model, const ck_root *root, double left) {
    const ck_scene *scene = &model->scene;
    ck_motion *motion = &model->state.motion;
    ck_tip *tip = &model->state.tip;
    double came = motion->speed, lands, elapsed, bend, rate;
    ck_flight flight;
    ck_root there;
    flight.decay = 0.5 * model->state.values[CK_C] / scene->mass;
    flight.frequency = sqrt(scene->stiffness / scene->mass - flight.decay * flight.decay);
    flight.rest = -scene->mass * root->acceleration / scene->stiffness;
    flight.cosine = motion->gap - scene->initial_gap - root->height - flight.rest;
    flight.sine = (motion->speed - root->speed + flight.decay * flight.cosine) / flight.frequency;
    lands = ck_landing_time(&flight, root, left, &motion->cost);
    if (!(lands < HUGE_VAL)) return TOO_MANY_SWINGS;
    elapsed = lands < 0.0 ? left : lands;
    bend = ck_flight_at(&flight, elapsed, &rate), there = ck_root_after(root, elapsed);
    motion->time += elapsed, motion->gap = scene->initial_gap + there.height + bend;
    motion->speed = there.speed + rate, motion->step = 0.0, motion->known = 0;
    tip->impulse += scene->mass * (motion->speed - came);
    if (lands >= 0.0) touch(model);
    return CK_DONE;
}

/* Follow an impact until it is over, or the step. */
static int strike(ck_model *model, const ck_root *root, double end) {
    ck_motion *motion = &model->state.motion;
    ck_tip *tip = &model->state.tip;
    ck_site site = site_of(model, root);
    ck_impact hit = {motion->time, tip->depth, -motion->speed, tip->largest, 0.0, 0.0, tip->peak, 0, 0};
    int64_t left = model->scene.max_steps + 1 - motion->cost;
    int trouble = ck_follow_impact(&site, &hit, end, model->scene.rtol, left);
    motion->cost += hit.steps;
    motion->time = hit.time, motion->speed = -hit.speed, motion->in_contact = hit.end == CK_AT_REST;
    motion->step = 0.0, motion->known = 0;
    tip->touching = hit.end == CK_GOES_ON;
    tip->impulse += hit.impulse, tip->loss += hit.dissipated;
    tip->depth = hit.depth, tip->largest = hit.largest, tip->peak = hit.peak;
    tip->residual = ck_faces_residual(&model->data.contents.faces, hit.largest);
    return trouble ? IMPACT + trouble : CK_DONE;
}

/* Let the faces follow the spring while a tip rests; its impulse, by Simpson's rule. */
static int rest(ck_model *model, const ck_root *root, const ck_root *raised, double end) {
    static const double weights[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    ck_motion *motion = &model->state.motion;
    ck_tip *tip = &model->state.tip;
    ck_site site = site_of(model, root);
    double begin = motion->time, impulse = tip->impulse, mean = 0.0, elapsed;
    int trouble = one(model, raised, end, 0), i;
    if (trouble) return trouble;
    elapsed = motion->time - begin;
    for (i = 0; i < 3; i++) {
        double time = begin + 0.5 * i * elapsed, depth = ck_rest_depth(&site, tip->largest, time);
        if (ck_is_too_deep(&model->data.contents.faces, depth)) {
            tip->depth = depth;
            return IMPACT + CK_TOO_DEEP;
        }
        press(model, depth);
        mean += weights[i] * site.stiffness * (ck_root_height(root, time) + depth);
    }
    tip->impulse = impulse + elapsed * mean;
    if (!motion->in_contact) tip->depth = tip->residual; /* it leaves the residual indentation */
    return CK_DONE;
}

/* Advance a tip while its root moves on; what is wrong with the state reached, or CK_DONE. */
static int advance(ck_model *model, const ck_root *root, double dt) {
    ck_motion *motion = &model->state.motion;
    const ck_tip *tip = &model->state.tip;
    double end = motion->time + dt;
    int trouble = CK_DONE;
    motion->cost = 0;
    while (motion->cost <= model->scene.max_steps && !trouble) {
        double left = end - motion->time;
        ck_root raised = *root, there;
        if (left <= 1e-13 * ck_larger(fabs(end), dt)) {
            motion->time = end;
            return CK_DONE;
        }
        motion->cost += PIECE;
        raised.height += tip->residual; /* over the residual indentation */
        there = ck_root_after(&raised, motion->time - root->time);
        if (gives(model) && tip->touching) trouble = strike(model, root, end);
        else if (gives(model) && motion->in_contact) trouble = rest(model, root, &raised, end);
        else if (tip->free) trouble = fly(model, &there, left);
        else trouble = one(model, &raised, end, gives(model));
    }
    return trouble ? trouble : TOO_MANY_PIECES;
}

/* Outputs --------------------------------------------------------------------------------------- */

/* Time of the host for one since the start; -1 stays. */
static double clock_at(const ck_model *model, double time) {
    return time >= 0.0 ? model->state.start_time + time : -1.0;
}

/* Force of film and solids on one tip. */
static double film_force(const ck_model *model) {
    const ck_motion *motion = &model->state.motion;
    ck_acting acting;
    ck_forces found;
    if (model->state.tip.free) return 0.0;
    if (model->state.tip.touching) return attraction(model);
    ck_act(&model->scene, motion->film, motion->broken, motion->detached, &acting);
    ck_forces_at(&acting, motion->gap, motion->speed, &found);
    return found.fixed + found.viscous;
}

/* Force with which one tip pulls its root down. */
static double tip_force(const ck_model *model, const ck_root *root) {
    const ck_motion *motion = &model->state.motion;
    const ck_tip *tip = &model->state.tip;
    double bend = model->scene.initial_gap + root->height - motion->gap + tip->depth;
    double force = model->scene.stiffness * bend;
    return tip->free ? force + model->state.values[CK_C] * (root->speed - motion->speed) : force;
}

static int show(ck_model *model) {
    double *v = model->state.values, n = v[CK_N], film = film_force(model);
    const ck_motion *motion = &model->state.motion;
    const ck_tip *tip = &model->state.tip;
    ck_root root = root_of(model, 0.0), there = ck_root_after(&root, tip->ahead);
    double force = n * tip_force(model, &there);
    if (!isfinite(force + film + motion->speed) || !isfinite(tip->impulse + motion->work + tip->loss))
        return 0;
    v[CK_F] = force, v[CK_F_FILM] = film;
    v[CK_H] = motion->gap - (tip->depth - tip->residual), v[CK_V] = motion->speed;
    v[CK_J] = n * tip->impulse, v[CK_W_VISC] = n * motion->work, v[CK_W_LAND] = n * tip->loss;
    v[CK_STATE] = motion->in_contact || tip->touching ? CK_TIP_STATUS_LANDED : tip->free ? CK_TIP_STATUS_FREE : CK_TIP_STATUS_HELD;
    v[CK_T_BREAK] = clock_at(model, motion->break_time);
    v[CK_T_FREE] = clock_at(model, tip->free_time);
    v[CK_T_LAND] = clock_at(model, tip->landing_time);
    v[CK_N_BREAK] = motion->breaks, v[CK_N_LAND] = tip->landings;
    v[CK_D] = tip->depth, v[CK_D_MAX] = tip->largest, v[CK_F_MAX] = tip->peak;
    v[CK_W_PLASTIC] = gives(model) ? n * ck_faces_dissipated(&model->data.contents.faces, tip->largest) : 0.0;
    /* of all tips, which may be too much where that of one is not */
    return isfinite(v[CK_J] + v[CK_W_VISC] + v[CK_W_LAND] + v[CK_W_PLASTIC]);
}

/* Steps ----------------------------------------------------------------------------------------- */

static int no_step(ck_model *model, int trouble, double length, const ck_motion *where, double depth) {
    const ck_faces *faces = &model->data.contents.faces;
    double time = clock_at(model, where->time);
    char message[400];
    if (trouble == IMPACT + CK_TOO_DEEP)
        snprintf(message, sizeof message,
                 "at t = %.9g s a tip is pressed %.4g m deep, beyond %.4g m and %.4g N where its "
                 "curve ends; make it with a larger approach, or take shorter steps",
                 time, depth, faces->first.end, faces->first.high);
    else if (trouble == TOO_MANY_SWINGS)
        snprintf(message, sizeof message,
                 "a step of %.6g s holds more than %d swings of a free tip; take shorter steps",
                 length, CK_MOST_SWINGS);
    else if (trouble == IMPACT + CK_NO_HIT_STEP)
        snprintf(message, sizeof message,
                 "no step of an impact of a tip meets rtol = %g at %.9g s; loosen it, or take "
                 "shorter steps",
                 model->scene.rtol, time);
    else if (trouble == IMPACT + CK_TOO_MANY_HIT_STEPS || trouble == TOO_MANY_PIECES)
        snprintf(message, sizeof message,
                 "a step of %.6g s takes too many internal steps, as max_steps = %d led to %.9g s; take "
                 "shorter steps, loosen rtol, or raise max_steps",
                 length, model->scene.max_steps, time);
    else
        snprintf(message, sizeof message,
                 "no step of time can be taken from %.9g s, gap %.6g m, speed %.6g m/s; loosen rtol, "
                 "or take shorter steps",
                 time, where->gap, where->speed);
    return ck_model_discard(model, message);
}

static void tell(ck_model *model, const ck_state *before) {
    char message[80];
    if (model->state.motion.breaks > before->motion.breaks) {
        snprintf(message, sizeof message, "film broke at t = %.9g s", model->state.values[CK_T_BREAK]);
        model->say(model->host, CK_OK, "logEvents", message);
    }
    if (model->state.tip.landings > before->tip.landings) {
        snprintf(message, sizeof message, "landed at t = %.9g s", model->state.values[CK_T_LAND]);
        model->say(model->host, CK_OK, "logEvents", message);
    }
}

static int step(ck_model *model, double time, double length) {
    ck_state *state = &model->state, before = *state;
    double *v = state->values;
    ck_root root = root_of(model, state->motion.time); /* its time counts from the start */
    int trouble = advance(model, &root, length);
    if (trouble) {
        ck_motion where = state->motion;
        double depth = state->tip.depth;
        *state = before;
        return no_step(model, trouble, length, &where, depth);
    }
    v[CK_F_MEAN] = v[CK_N] * (state->tip.impulse - before.tip.impulse) / length;
    state->tip.ahead = length;
    state->end = time + length, state->shown = 1;
    if (!show(model) || !isfinite(v[CK_F_MEAN])) {
        *state = before;
        return ck_model_discard(model, "the forces at the end of the step are no finite numbers; "
                                       "give a smaller height, speed or acceleration, or take "
                                       "shorter steps");
    }
    tell(model, &before);
    return CK_OK;
}

static void resolve(ck_model *model) { (void)model; } /* a step does not pause */

/* Slopes at the height and the speed that are set. */
static int slope(const ck_model *model, int unknown, int known, double *found) {
    const double *v = model->state.values;
    *found = 0.0;
    if (model->state.phase < CK_STEPPING) return 0; /* they decide how the tips start */
    if (unknown == CK_F && known == CK_Z) *found = v[CK_N] * v[CK_K];
    if (unknown == CK_F && known == CK_VZ && model->state.tip.free) *found = v[CK_N] * v[CK_C];
    return 1;
}

const ck_kind ck_tip_contact = {apply, start, show, step, resolve, 1, slope, NULL, NULL};
