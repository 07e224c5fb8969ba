/* stiction-force: a film for a tool that owns the mass; motion in, forces and impulses out.

   As fmu/slaves/stiction_force.py. The gap that was set when a step is taken is where the step ends. */

#include "model.h"
#include "rheology.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define SAME 1e-9  /* gaps closer than this, relatively, are one: a host rounds its gaps, too */
#define DOUBT 0.2  /* coupling error beyond which the flag is raised: the answer is no estimate then */
/* Error of the void in a step of time, over the volume of the film. Impulses of discs that swing are
   1e-4 off with 1e-8, some 1e-5 with this and below; each quarter takes 1.4 times the steps. */
#define VOID 1e-9
#define MOST_STOPS 1000 /* kinks and limits met in one step of the host; a film has some ten */
/* What a cavity may cost in one step of the host: 5000 steps between discs, of 20 to 40 us each where
   values are hostile, and 142 on a grid of 7000 cells. */
#define MOST_COST 100000


static const char *apply(ck_model *model) { return ck_common_parameters(model); }

static void start(ck_model *model) {
    ck_memory *memory = &model->state.memory;
    double *v = model->state.values;
    ck_acting acting;
    ck_forces found;
    memory->gap = v[CK_H0];
    memory->film = memory->broken = memory->detached = memory->pending = CK_NONE;
    memset(&memory->cavity, 0, sizeof memory->cavity);
    ck_act(&model->scene, 0, 0, 0, &acting);
    ck_forces_at(&acting, memory->gap, 0.0, &found);
    memory->damping = found.resistance;
    v[CK_J] = v[CK_J_M] = v[CK_F_MEAN] = v[CK_COUPLING_ERROR] = 0.0;
    v[CK_IN_DOUBT] = v[CK_N_DOUBT] = v[CK_N_BREAK] = 0.0;
    v[CK_T_BREAK] = -1.0;
}

/* What acts at a gap; beyond an end of the film what is left of it. Whether the film is broken. */
static int act_at(const ck_model *model, double gap, ck_acting *acting) {
    const ck_memory *memory = &model->state.memory;
    int broken = memory->broken, detached = memory->detached;
    ck_act(&model->scene, memory->film, broken, detached, acting);
    if (memory->pending) return broken; /* it shows what is there just before */
    /* In model exchange the film stays as it is up to the event, so that the host sees no jump. */
    if (model->exchanges && model->state.phase >= CK_STEPPING) return broken;
    if (!broken && gap >= acting->end * (1.0 - SAME)) broken = 1;
    if (!detached && gap >= acting->release * (1.0 - SAME)) detached = 1;
    if (broken != memory->broken || detached != memory->detached)
        ck_act(&model->scene, memory->film, broken, detached, acting);
    return broken;
}

/* Gap the outputs are those of: where the motion is, or where it was interrupted. */
static double gap_of(const ck_model *model) {
    const ck_memory *memory = &model->state.memory;
    return memory->pending ? memory->gap : model->state.values[CK_H];
}

/* Forces at a gap and a speed with a cavity whose edge and rim stay, and the radius of the edge. */
static void forces_of(const ck_model *model, const ck_acting *acting, double gap, double speed,
                      ck_forces *found, double *radius) {
    const ck_memory *memory = &model->state.memory;
    const ck_cavity_law *law = acting->any ? acting->law : NULL;
    ck_place at = {gap, speed};
    ck_spot spot;
    *radius = 0.0;
    ck_forces_at(acting, gap, speed, found);
    if (!law) return;
    if (memory->cavity.phase == CK_FULL && !ck_is_inception(law, &memory->cavity, at)) return;
    ck_spot_of(law, &memory->cavity, memory->gap, at, &spot);
    ck_forces_with(acting, &spot, at, found);
    *radius = sqrt(spot.edge);
}

/* Slope of an output by an input; 0 if the tables do not tell it. */
static int slope(const ck_model *model, int unknown, int known, double *found) {
    double gap = gap_of(model), radius;
    ck_acting acting;
    ck_forces f;
    *found = 0.0;
    if (known != CK_H && known != CK_V) return 0;
    if (unknown == CK_H_ABOVE || unknown == CK_H_BELOW) return 1;
    if (unknown != CK_F && unknown != CK_F_M && unknown != CK_F_V) return 0;
    act_at(model, gap, &acting);
    forces_of(model, &acting, gap, model->state.values[CK_V], &f, &radius);
    if (unknown != CK_F_V && known == CK_H) *found += f.fixed_by_gap;
    if (unknown != CK_F_M) *found += known == CK_H ? f.viscous_by_gap : f.viscous_by_speed;
    return 1;
}

static void consider(double mark, double gap, double *above, double *below) {
    if (gap * (1.0 + SAME) < mark && mark < *above) *above = mark;
    if (*below < mark && mark < gap * (1.0 - SAME)) *below = mark;
}

/* Next gaps above and below at which a force is not smooth; HUGE_VAL and 0 where there is none. */
static void marks(const ck_model *model, const ck_acting *acting, int broken, double gap,
                  double *above, double *below) {
    int i, k;
    *above = HUGE_VAL, *below = 0.0;
    for (i = 0; i < acting->film->n_laws; i++)
        for (k = 0; acting->acts[i] && k < acting->film->laws[i].n_kinks; k++)
            if (acting->film->laws[i].kinks[k] < acting->end)
                consider(acting->film->laws[i].kinks[k], gap, above, below);
    if (acting->any) {
        consider(acting->end, gap, above, below);
        consider(acting->release, gap, above, below);
    }
    if (broken && model->scene.tables->rewetting > 0.0 && model->scene.initial_gap < gap &&
        *below < model->scene.initial_gap)
        *below = model->scene.initial_gap;
    if (model->state.memory.detached) consider(model->scene.recontact, gap, above, below);
}

static int show(ck_model *model) {
    double *v = model->state.values, gap = gap_of(model), above, below, radius;
    ck_acting acting;
    ck_forces f;
    int broken = act_at(model, gap, &acting);
    forces_of(model, &acting, gap, v[CK_V], &f, &radius);
    if (!isfinite(f.fixed + f.viscous) || !isfinite(f.viscous_by_speed) ||
        !isfinite(f.fixed_by_gap + f.viscous_by_gap))
        return 0;
    marks(model, &acting, broken, gap, &above, &below);
    v[CK_F] = f.fixed + f.viscous, v[CK_F_M] = f.fixed, v[CK_F_V] = f.viscous;
    v[CK_C] = f.viscous_by_speed, v[CK_K] = f.fixed_by_gap + f.viscous_by_gap;
    v[CK_H_STABLE] = v[CK_C] > 0.0 ? fmin(v[CK_M_REF] / v[CK_C], DBL_MAX) : DBL_MAX;
    v[CK_STATE] = broken || !acting.any                              ? CK_FILM_STATUS_BROKEN
                  : gap <= acting.film->full_gap * (1.0 + SAME) ? CK_FILM_STATUS_FULL
                                                                : CK_FILM_STATUS_BRIDGE;
    v[CK_LIMIT] = f.limit;
    v[CK_R_CAV] = radius, v[CK_V_VOID] = broken ? 0.0 : model->scene.tables->menisci * model->state.memory.cavity.hollow;
    v[CK_H_ABOVE] = above < HUGE_VAL ? above : 0.0;
    v[CK_H_BELOW] = below;
    return 1;
}

static void settle(ck_model *model, double time) {
    ck_memory *memory = &model->state.memory;
    double *v = model->state.values;
    if (memory->pending == CK_RUPTURE) {
        memory->broken = 1;
        memset(&memory->cavity, 0, sizeof memory->cavity);
        v[CK_T_BREAK] = time, v[CK_N_BREAK] += 1.0;
    } else if (memory->pending == CK_REWETTING) {
        memory->broken = 0, memory->film = model->scene.tables->n_films - 1;
    }
    memory->pending = CK_NONE;
}

/* Apply the event at the gap that the motion has reached: rupture, pull-off, re-wetting, contact. */
static void apply_event(ck_model *model, double gap, int rising, double time) {
    ck_memory *memory = &model->state.memory;
    int next = model->scene.tables->n_films - 1;
    ck_acting acting;
    ck_act(&model->scene, memory->film, memory->broken, memory->detached, &acting);
    if (!memory->broken && gap >= acting.end * (1.0 - SAME)) {
        memory->pending = CK_RUPTURE;
    } else if (memory->broken && !rising && gap <= model->scene.initial_gap * (1.0 + SAME) &&
               model->scene.tables->rewetting > 0.0 && model->scene.ends[next] * (1.0 - SAME) > gap) {
        memory->pending = CK_REWETTING;
    }
    if (!model->scene.pauses) settle(model, time);
    if (acting.any && gap >= acting.release * (1.0 - SAME)) memory->detached = 1;
    else if (!rising && gap <= model->scene.recontact * (1.0 + SAME)) memory->detached = 0;
}

/* Whether a force acts that depends on the speed and that no limit of the liquid bounds. */
static int free_of(const ck_acting *acting) {
    int i;
    for (i = 0; i < acting->film->n_laws; i++)
        if (acting->acts[i] && acting->film->laws[i].rate == CK_RATE_PER_SPEED) return 1;
    return 0;
}

/* Go along a stretch with a film that remembers its cavity: its viscous impulse, and the time of the
   stretch at which it cavitated or was full again last. nan if there is no way, or it is too long:
   `left` is what it may cost. */
static double with_memory(ck_model *model, const ck_acting *acting, double from, double to, double length,
                          int *left, double *changed) {
    ck_cavity *cavity = &model->state.memory.cavity;
    ck_place at = {from, (to - from) / length};
    int was = cavity->phase == CK_FULL && !ck_is_inception(acting->law, cavity, at), full;
    int found = CK_PATH_STEP, tries = 0;
    double total = 0.0, part, gap = from;
    ck_path path;
    ck_path_begin(&path, acting->law, cavity, at, length, VOID, 0.0);
    while (*left >= 0 && (found = ck_path_next(&path, &part, &full)) == CK_PATH_STEP) {
        double after = path.time == length ? to : path.first + path.speed * path.time;
        if (after != gap && (full || free_of(acting))) {
            ck_impulse along = ck_along(acting, gap, after, (after - gap) / path.speed);
            part = full ? along.viscous : part + along.free;
        }
        total += part;
        if (was != (cavity->phase == CK_FULL)) was = !was, *changed = path.time;
        gap = after;
        *left -= ck_cavity_cost(acting->law) * (path.tries - tries), tries = path.tries;
    }
    return found == CK_PATH_END ? total : NAN;
}

/* Integrate over the motion of the step, from kink to kink; `changed` is when the film cavitated
   last, or was full again. */
static ck_impulse go(ck_model *model, double time, double step, double target, int *left,
                     double *changed) {
    ck_memory *memory = &model->state.memory;
    double begin = memory->gap, gap = begin, pace = step / (target - begin);
    int rising = target > begin, i;
    ck_impulse sum = {0.0, 0.0, 0.0}, part;
    ck_acting acting;
    for (i = 0; i < MOST_STOPS; i++) {
        double above, below, next = target;
        ck_act(&model->scene, memory->film, memory->broken, memory->detached, &acting);
        if (begin == target) {
            part = ck_along(&acting, gap, gap, step);
        } else {
            marks(model, &acting, memory->broken, gap, &above, &below);
            if (rising && above < target) next = above;
            if (!rising && below > target) next = below;
            part = next == gap ? (ck_impulse){0.0, 0.0, 0.0}
                               : ck_along(&acting, gap, next, (next - gap) * pace);
        }
        if (acting.any && acting.law && (begin == target || next != gap)) {
            double length = begin == target ? step : (next - gap) * pace, since = -1.0;
            part.viscous = with_memory(model, &acting, gap, next, length, left, &since);
            if (since >= 0.0) *changed = time + (begin == target ? 0.0 : (gap - begin) * pace) + since;
        }
        sum.viscous += part.viscous, sum.fixed += part.fixed;
        gap = next;
        model->state.end = begin == target ? time : time + (gap - begin) * pace;
        apply_event(model, gap, rising, model->state.end);
        if (gap == target || memory->pending) break;
    }
    memory->gap = memory->pending ? gap : target;
    if (gap == target) model->state.end = time + step;
    return sum;
}

static void warn(ck_model *model, double step, double stable, double error) {
    static const char cure[] =
        "use the FMU stiction-mass, which has the mass inside and needs no short steps, or a "
        "master that exchanges impulses (contactkit.fmu.master.couple)";
    char message[600];
    if (stable > 0.0)
        snprintf(message, sizeof message,
                 "the communication step of %.3g s exceeds %.3g s = m_ref/c, the longest with "
                 "which this film can be coupled by its force; take a tenth of that, or %s",
                 step, stable, cure);
    else
        snprintf(message, sizeof message,
                 "the force at the end of the step differs from that on its way by %.0f%% of what "
                 "moves the mass; take shorter steps than %.3g s, or %s",
                 100.0 * error, step, cure);
    model->say(model->host, CK_WARNING, "logCoupling", message);
}

/* Compare the force at the end with that within the step, and the step with m/c. */
static void doubt(ck_model *model, double step, double damping) {
    double *v = model->state.values, mass = v[CK_M_REF], gone = v[CK_F_MEAN];
    double scale = fmax(fmax(fabs(v[CK_F]), fabs(gone)), mass * fabs(v[CK_V]) / step);
    double error = scale > 0.0 ? fabs(v[CK_F] - gone) / scale : 0.0;
    double stiffest = fmax(damping, model->state.memory.damping);
    int unstable = step * stiffest > mass, was = v[CK_IN_DOUBT] != 0.0;
    int doubted = v[CK_EXCHANGE] == CK_EXCHANGE_FORCE && (unstable || error > DOUBT);
    v[CK_COUPLING_ERROR] = error;
    v[CK_IN_DOUBT] = doubted;
    v[CK_N_DOUBT] += doubted;
    if (doubted && !was) warn(model, step, unstable ? mass / stiffest : 0.0, error);
}

static void tell(ck_model *model) {
    char message[80];
    snprintf(message, sizeof message, "film broke at t = %.9g s", model->state.values[CK_T_BREAK]);
    model->say(model->host, CK_OK, "logEvents", message);
}

static void tell_cavity(ck_model *model, int was, double time) {
    int now = model->state.memory.cavity.phase;
    char message[80];
    if ((was == CK_FULL) == (now == CK_FULL) || model->state.memory.broken) return;
    snprintf(message, sizeof message, "%s at t = %.9g s",
             now == CK_FULL ? "film reformed" : "film cavitated", time);
    model->say(model->host, CK_OK, "logEvents", message);
}

/* What stands against a step to the gap that was set, at the speed there or on the way; or NULL. */
static const char *too_fast(const ck_model *model, double from, double length) {
    const double *v = model->state.values;
    const char *found;
    ck_acting acting;
    ck_act(&model->scene, model->state.memory.film, model->state.memory.broken, 0, &acting);
    found = ck_rheological_obstacle(&acting, v[CK_H], v[CK_V]);
    return found ? found : ck_rheological_obstacle(&acting, fmin(from, v[CK_H]), (v[CK_H] - from) / length);
}

static int step(ck_model *model, double time, double length) {
    ck_state *state = &model->state;
    ck_state before = *state;
    double *v = state->values;
    double changed = time;
    int left = MOST_COST;
    ck_impulse done = go(model, time, length, v[CK_H], &left, &changed);
    double elapsed = state->memory.pending ? state->end - time : length;
    ck_acting acting;
    ck_forces found;
    if (!isfinite(done.viscous + done.fixed) || !show(model)) {
        static const char cure[] = "take shorter steps, with a gap nearer to the first";
        char message[600];
        const char *obstacle = too_fast(model, before.memory.gap, length);
        *state = before;
        snprintf(message, sizeof message, "%s between a gap of %.6g m and %.6g m; %s",
                 left < 0 ? "the cavity takes too many internal steps" : "the forces are no finite numbers",
                 state->memory.gap, v[CK_H], obstacle ? obstacle : cure);
        return ck_model_discard(model, message);
    }
    ck_act(&model->scene, state->memory.film, state->memory.broken, 0, &acting);
    ck_forces_at(&acting, gap_of(model), 0.0, &found);
    state->memory.damping = found.resistance;
    tell_cavity(model, before.memory.cavity.phase, changed);
    state->shown = 1;
    v[CK_J] += done.viscous, v[CK_J_M] += done.fixed;
    if (elapsed > 0.0) {
        v[CK_F_MEAN] = (done.viscous + done.fixed) / elapsed;
        doubt(model, elapsed, before.memory.damping);
    }
    if (v[CK_N_BREAK] > before.values[CK_N_BREAK]) tell(model);
    return CK_OK;
}

/* What a step paused for happens. */
static void resolve(ck_model *model) {
    int breaks = model->state.memory.pending == CK_RUPTURE;
    settle(model, model->state.time);
    if (breaks) tell(model);
}

/* Model exchange ------------------------------------------------------------------------------- */

/* The states are the impulses: their derivatives are the forces, in the order of the variables. */
static const int STATES[] = {CK_J_M, CK_J}, DERIVATIVES[] = {CK_F_M, CK_F_V};

/* The liquid that a cavity has left behind is a history, which no few continuous states hold. */
static const char *obstacle(const ck_model *model) {
    int i;
    for (i = 0; i < model->scene.tables->n_films; i++)
        if (model->scene.laws[i].strength > 0.0)
            return "dp_inception must be 0 in model exchange: a cavity remembers its history; take "
                   "dp_cav instead, which truncates the pressure, or co-simulation";
    return NULL;
}

/* Whether a law that acts before this one has the same kink: laws share those of the film's shape. */
static int is_shared(const ck_acting *acting, int law, double kink) {
    int i, k;
    for (i = 0; i < law; i++)
        for (k = 0; acting->acts[i] && k < acting->film->laws[i].n_kinks; k++)
            if (fabs(acting->film->laws[i].kinks[k] / kink - 1.0) <= SAME) return 1;
    return 0;
}

/* Distance to the nearest kink over its gap, with a sign that changes at each. */
static double kinks(const ck_acting *acting, double gap) {
    double nearest = 1.0;
    int i, k, odd = 0;
    for (i = 0; i < acting->film->n_laws; i++)
        for (k = 0; acting->acts[i] && k < acting->film->laws[i].n_kinks; k++) {
            double kink = acting->film->laws[i].kinks[k];
            if (is_shared(acting, i, kink)) continue;
            odd ^= kink < gap;
            nearest = fmin(nearest, fabs(gap / kink - 1.0));
        }
    return odd ? nearest : -nearest;
}

/* Gap over that of an event less 1; 1 where there is no such event below, -1 where none above. */
static double beyond(double gap, double event) {
    if (!(event > 0.0)) return 1.0;
    return event < HUGE_VAL ? gap / event - 1.0 : -1.0;
}

static void indicate(const ck_model *model, double found[CK_INDICATORS]) {
    const ck_memory *memory = &model->state.memory;
    double gap = model->state.values[CK_H];
    ck_acting acting;
    ck_act(&model->scene, memory->film, memory->broken, memory->detached, &acting);
    if (memory->broken)
        found[CK_Z_FILM] = beyond(gap, model->scene.tables->rewetting > 0.0 ? model->scene.initial_gap : 0.0);
    else found[CK_Z_FILM] = beyond(gap, acting.end);
    found[CK_Z_SOLIDS] = beyond(gap, memory->detached ? model->scene.recontact : acting.release);
    found[CK_Z_KINK] = kinks(&acting, gap);
    found[CK_Z_OUTPUTS] = model->event_mode && ck_events_lag(model) ? -1.0 : 1.0;
}

/* Events at the gap where the host stopped. */
static void apply_events(ck_model *model) {
    ck_memory *memory = &model->state.memory;
    double gap = model->state.values[CK_H], breaks = model->state.values[CK_N_BREAK];
    memory->gap = gap;
    apply_event(model, gap, 0, model->state.time);
    if (model->state.values[CK_N_BREAK] > breaks) tell(model);
}

static const ck_exchange exchange = {2, STATES, DERIVATIVES, obstacle, indicate, apply_events};

const ck_kind ck_stiction_force = {apply, start, show, step, resolve, 1, slope, NULL, &exchange};
