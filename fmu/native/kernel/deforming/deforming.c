/* deforming-mass and deforming-force: films between bodies that deform, with the mass inside or in a tool.

   `h` is the gap of the undeformed bodies, so that they move as rigid ones do; the film between them has a gap
   of its own. The motion that a tool sets runs along the parabola from where the last step ended to the gap and the
   speed that are set, which are those at the end of the step. */

#include "model.h"
#include "step_size.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of the step of the host: internal steps so short need not meet the tolerance. Whatever begins at once, a speed
   or a force, makes the film respond in all its times, and no estimate holds there. As Control.first. */
#define FIRST 1e-5
/* Mass over c^2/k of the film and the spring: 1/LIGHTEST^2 of fmu/native/deforming.py, less round-off. */
#define LIGHTEST 3.9999
#define SAFETY 0.85 /* these two as in elastohydrodynamic/follow.py, where the reasons are */
#define GROW 5.0
#define LOCATED 1e-6       /* of a step: where in it the film ruptures; this and the next as in follow.py */
#define AFTER_RUPTURE 1e-3 /* step after a rupture over that before it */
#define NO_LENGTH 1e-12 /* of the step of the host: an internal step this short does not help any more */

enum { SOLVED = 0, NO_STEP, TOO_MANY, TOO_SOFT };

static ck_deforming *film_of(ck_model *model) { return &model->deforming; }

static const char *apply(ck_model *model) {
    ck_deforming *d = film_of(model);
    double viscosity, tension;
    const char *problem = ck_liquid(model, &viscosity, &tension);
    if (problem) return problem;
    ck_deforming_units(d, viscosity);
    d->rtol = model->state.values[CK_RTOL];
    return NULL;
}

static const char *apply_mass(ck_model *model) {
    ck_deforming *d = film_of(model);
    const double *v = model->state.values;
    const char *problem;
    if (v[CK_H_REL] <= v[CK_H0]) return ck_wrong(model, CK_H_REL, "exceed", CK_H0, "m");
    problem = apply(model);
    if (problem) return problem;
    d->mass = v[CK_M] * d->gap / (d->force * d->time * d->time);
    if (d->record->has_series && d->mass < LIGHTEST) {
        snprintf(model->wrong, sizeof model->wrong,
                 "m must be %.3g kg at least, got %.9g kg: a lighter mass rings on the spring that stands for "
                 "the bodies; build the FMU with this mass, for the film on rings",
                 LIGHTEST * d->force * d->time * d->time / d->gap, v[CK_M]);
        return model->wrong;
    }
    d->spring = v[CK_K_S] * d->gap / d->force, d->relaxed = v[CK_H0] / d->gap;
    return NULL;
}

static void start(ck_model *model) {
    ck_deformed *now = &model->state.deformed;
    memset(now, 0, sizeof *now);
    ck_deforming_rest(film_of(model), model->state.values[CK_H0]);
    now->gap = now->axis = model->state.values[CK_H0];
    now->armed = 1;
}

/* Displacement by the film over its gap on the axis. */
static double softness(const ck_deforming *d, double force, double axis) {
    double x = axis / d->gap, k = d->record->stiffness * (d->record->widens ? sqrt(x) : 1.0);
    return d->record->ratio * fabs(force) / (k * axis);
}

/* Internal steps -------------------------------------------------------------------------------------- */

/* Add a step that was taken: the state, the integrals over it, and a release in it. */
static void accept(ck_model *model, ck_attempted *a, double error) {
    ck_deforming *d = film_of(model);
    ck_deformed *now = &model->state.deformed;
    int s = d->method->stages, m = d->size, changed = now->jumped, any = 0, k;
    const ck_level *end = &d->levels[s - 1];
    double speed, gap = ck_course_at(&a->course, a->time + a->length, &speed), grown;
    for (k = 0; k < s; k++) {
        double weight = d->method->weights[k] * a->length * d->time;
        now->impulse += weight * d->levels[k].force * d->force;
        now->work += weight * d->levels[k].power * d->force * d->gap / d->time;
        if (d->levels[k].force * d->force > now->peak) now->peak = d->levels[k].force * d->force;
    }
    memcpy(d->values, d->stages + (long)(s - 1) * m, (size_t)m * sizeof(double));
    memcpy(d->values + m, d->stages, (size_t)(s * m) * sizeof(double));
    /* Steps are extrapolated while cavities stay, as in elastohydrodynamic/follow.py. */
    for (k = 0; k < d->n; k++) {
        changed |= d->voids[k] != end->voids[k], any |= end->voids[k] != 0.0;
        d->voids[k] = end->voids[k];
    }
    if (!any) now->ruptured = 0;
    if (d->has_mass) gap = d->values[d->n], speed = d->values[d->n + 1];
    now->gap = gap * d->gap, now->speed = speed * d->gap / d->time;
    now->force = end->force * d->force, now->axis = ck_film_axis(d, d->values, gap) * d->gap;
    if (fabs(now->force) > now->highest) now->highest = fabs(now->force);
    now->before = changed ? 0.0 : a->length, now->jumped = 0;
    grown = error > 0.0 ? SAFETY * pow(error, -1.0 / d->method->order) : GROW;
    now->next = a->length * ck_smaller(grown, GROW);
}

/* Tension at which a whole film ruptures, if it exceeds that of a cavity; 0: cavities open by themselves. */
static double waits_for(const ck_model *model) {
    const ck_rings *rings = &model->deforming.record->rings;
    if (!model->deforming.record->has_rings || !rings->has_cavity || model->state.deformed.ruptured) return 0.0;
    return rings->cavity.strength > rings->cavity.tension ? rings->cavity.strength : 0.0;
}

/* Solve a step in which no cavity opens while the film waits for its rupture. */
static int solve(ck_model *model, const ck_attempted *a, double *error) {
    ck_deforming *d = film_of(model);
    const ck_rings *rings = &d->record->rings;
    int cavitates = d->record->has_rings && rings->has_cavity && !(waits_for(model) > 0.0);
    d->floor = cavitates ? -rings->cavity.tension : -HUGE_VAL;
    return ck_stages_solve(d, a, error);
}

/* Step up to the instant at which the tension reaches the strength: there cavities open. */
static int rupture_in(ck_model *model, ck_attempted *a, int *count) {
    ck_deforming *d = film_of(model);
    ck_deformed *now = &model->state.deformed;
    double strength = waits_for(model), whole = a->length, low = 0.0, high = 1.0, error;
    const double *end = d->stages + (long)(d->method->stages - 1) * d->size;
    int solved = 1;
    if (ck_rings_lowest(d, d->values) < -strength) high = 0.0;
    while (solved && high - low > LOCATED) {
        double share = 0.5 * (low + high);
        a->length = share * whole;
        solved = solve(model, a, &error), ++*count;
        if (solved && ck_rings_lowest(d, end) < -strength) high = share;
        else low = share;
    }
    a->length = high * whole;
    if (high > LOCATED) {
        if (!solved || !solve(model, a, &error)) return 0;
        accept(model, a, 1.0);
    } else a->length = 0.0;
    now->ruptured = 1, now->jumped = 1, now->before = 0.0, now->next = AFTER_RUPTURE * whole;
    return 1;
}

/* One internal step, shortened until its error is small. */
static int step_once(ck_model *model, ck_attempted *a, double left, double whole, int *count) {
    ck_deforming *d = film_of(model);
    ck_deformed *now = &model->state.deformed;
    double planned = now->next > 0.0 ? now->next : FIRST * whole, error;
    int most = ck_step_limit(model), first = 1;
    a->length = planned < left ? left / ceil(left / planned) : left;
    a->before = now->before, a->highest = now->highest / d->force;
    if (d->has_mass) a->highest = ck_larger(a->highest, fabs(ck_course_at(&a->course, a->time, &error)));
    for (;; first = 0) {
        int solved = solve(model, a, &error);
        if (++*count > most) return TOO_MANY;
        if (solved && now->jumped) error = 0.0; /* no estimate holds where pressures jump */
        if (solved && (error <= 1.0 || a->length <= FIRST * whole)) break;
        if (a->length <= NO_LENGTH * whole) return NO_STEP;
        a->length *= solved ? ck_larger(CK_SHRINK, SAFETY * pow(error, -1.0 / d->method->order))
                            : CK_UNSOLVED;
        if (!solved) a->before = 0.0;
    }
    if (waits_for(model) > 0.0 &&
        ck_rings_lowest(d, d->stages + (long)(d->method->stages - 1) * d->size) < -waits_for(model))
        return rupture_in(model, a, count) ? SOLVED : NO_STEP;
    accept(model, a, error);
    /* A step that was cut short by the end of the span is no reason against the one that was planned. */
    if (first && now->next < planned && error <= 1.0) now->next = planned;
    return SOLVED;
}

/* Note the release in an internal step, at the root of the cubic of its gaps and speeds. */
static void note_release(ck_model *model, double gap, double speed, double begin, double length) {
    ck_deformed *now = &model->state.deformed;
    double at = model->state.values[CK_H_REL], low = 0.0, high = 1.0;
    int i;
    if (now->gap <= model->state.values[CK_H0]) now->armed = 1;
    if (!now->armed || now->gap < at || gap >= at) return;
    for (i = 0; i < 60; i++) { /* bisection to round-off */
        double s = 0.5 * (low + high), r = 1.0 - s, value;
        value = (1.0 + 2.0 * s) * r * r * gap + s * r * r * length * speed +
                s * s * (3.0 - 2.0 * s) * now->gap - s * s * r * length * now->speed;
        if (value < at) low = s;
        else high = s;
    }
    now->armed = 0, now->releases += 1.0, now->release_time = begin + high * length;
}

/* Go along a course for a time [s]; what stopped it. */
static int go(ck_model *model, ck_attempted *a, double time, double length) {
    ck_deforming *d = film_of(model);
    ck_deformed *now = &model->state.deformed;
    double whole = length / d->time;
    int count = 0, trouble = SOLVED, i;
    for (i = 0; !d->has_mass && i < 2 * d->size; i++) d->held[i / d->size][i % d->size] = 0.0;
    now->before /= d->time, now->next /= d->time; /* kept in seconds */
    for (a->time = 0.0; !trouble && whole - a->time > NO_LENGTH * whole; a->time += a->length) {
        double gap = now->gap, speed = now->speed;
        trouble = step_once(model, a, whole - a->time, whole, &count);
        if (trouble) break;
        if (d->has_mass)
            note_release(model, gap, speed, time + a->time * d->time, a->length * d->time);
        else if (a->length > 0.0 && !ck_stages_slopes(d, a, whole)) return NO_STEP;
        if (!(softness(d, now->force, now->axis) <= model->state.values[CK_BETA_MAX])) trouble = TOO_SOFT;
    }
    now->before *= d->time, now->next *= d->time;
    return trouble;
}

static int refuse(ck_model *model, int trouble, double length, const ck_deformed *where) {
    char message[500];
    const ck_deforming *d = film_of(model);
    if (trouble == TOO_SOFT)
        snprintf(message, sizeof message,
                 "the film displaces the bodies by %.3g of its gap of %.6g m, more than beta_max = %.3g, up "
                 "to which this FMU holds: pull or press less, or %s",
                 softness(d, where->force, where->axis), where->axis, model->state.values[CK_BETA_MAX],
                 d->record->has_series ? "build it from a scene that pulls as hard, so that it has the film on rings"
                                       : "run the scene by ck.simulate");
    else
        snprintf(message, sizeof message,
                 "a step of %.6g s %s, at a gap of %.6g m of the undeformed bodies and %.6g m of the film; %s",
                 length, trouble == TOO_MANY ? "takes more than max_steps internal steps" : "cannot be taken",
                 where->gap, where->axis,
                 trouble == TOO_MANY ? "take shorter steps, loosen rtol, or raise max_steps"
                                     : "take shorter steps; where the bodies close nothing holds them apart");
    return ck_model_discard(model, message);
}

static int finish(ck_model *model, ck_attempted *a, double time, double length) {
    ck_deformed before = model->state.deformed, *now = &model->state.deformed, where;
    int trouble = go(model, a, time, length);
    if (!trouble && !isfinite(now->force + now->axis + now->work + now->speed)) trouble = NO_STEP;
    if (trouble) {
        where = *now, *now = before;
        return refuse(model, trouble, length, &where);
    }
    model->state.end = time + length, model->state.shown = 0;
    return CK_OK;
}

static int show(ck_model *model) {
    const ck_deformed *now = &model->state.deformed;
    double *v = model->state.values;
    v[CK_F] = now->force, v[CK_H_AXIS] = now->axis, v[CK_J] = now->impulse, v[CK_W] = now->work;
    v[CK_BETA] = softness(film_of(model), now->force, now->axis);
    return isfinite(v[CK_BETA]);
}

static void resolve(ck_model *model) { (void)model; } /* a step does not pause */

/* The film for a tool that owns the mass ---------------------------------------------------------------- */

static void start_force(ck_model *model) {
    double *v = model->state.values;
    start(model);
    v[CK_F_MEAN] = v[CK_C] = v[CK_K] = 0.0;
}

static int step_force(ck_model *model, double time, double length) {
    ck_deforming *d = film_of(model);
    ck_deformed *now = &model->state.deformed;
    double *v = model->state.values, impulse = now->impulse, whole = length / d->time;
    double begin = now->gap / d->gap, end = v[CK_H] / d->gap, speed = v[CK_V] * d->time / d->gap;
    ck_attempted a;
    int status;
    a.course.c[0] = begin, a.course.c[1] = 2.0 * (end - begin) / whole - speed;
    a.course.c[2] = (speed * whole - (end - begin)) / (whole * whole);
    status = finish(model, &a, time, length);
    if (status != CK_OK) return status;
    now->gap = v[CK_H], now->speed = v[CK_V];
    now->by_gap = d->force_by[0] * d->force / d->gap, now->by_speed = d->force_by[1] * d->force * d->time / d->gap;
    v[CK_F_MEAN] = (now->impulse - impulse) / length;
    return CK_OK;
}

static int show_force(ck_model *model) {
    double *v = model->state.values;
    v[CK_K] = model->state.deformed.by_gap, v[CK_C] = model->state.deformed.by_speed;
    return show(model) && isfinite(v[CK_K] + v[CK_C]);
}

/* Of the force at the end of a step by the gap and the speed that it went to. */
static int slope_force(const ck_model *model, int unknown, int known, double *found) {
    *found = 0.0;
    if (unknown == CK_F && known == CK_H) *found = model->state.deformed.by_gap;
    if (unknown == CK_F && known == CK_V) *found = model->state.deformed.by_speed;
    return 1;
}

const ck_kind ck_deforming_force = {apply,   start_force, show_force,  step_force,
                                    resolve, 0,           slope_force, NULL, NULL};

/* The mass inside ----------------------------------------------------------------------------------------- */

static int step_mass(ck_model *model, double time, double length) {
    ck_state *state = &model->state;
    ck_deforming *d = film_of(model);
    double *v = state->values, rate = v[CK_DF_EXT] + state->rate, released = state->deformed.releases;
    char message[80];
    ck_attempted a;
    int status;
    if (state->rate != 0.0 && v[CK_DF_EXT] != 0.0) return ck_rate_twice(model);
    a.course.c[0] = v[CK_F_EXT] / d->force, a.course.c[1] = rate * d->time / d->force, a.course.c[2] = 0.0;
    status = finish(model, &a, time, length);
    if (status != CK_OK) return status;
    if (state->deformed.releases > released) {
        snprintf(message, sizeof message, "released at t = %.9g s", state->deformed.release_time);
        model->say(model->host, CK_OK, "logEvents", message);
    }
    return CK_OK;
}

static int show_mass(ck_model *model) {
    const ck_deformed *now = &model->state.deformed;
    double *v = model->state.values;
    v[CK_H] = now->gap, v[CK_V] = now->speed, v[CK_F_PEAK] = now->peak;
    v[CK_T_RELEASE] = now->releases > 0.0 ? now->release_time : -1.0, v[CK_N_RELEASE] = now->releases;
    return show(model);
}

const ck_kind ck_deforming_mass = {apply_mass, start, show_mass, step_mass, resolve, 0, NULL, NULL, NULL};
