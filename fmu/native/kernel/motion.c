/* Motion of a mass held by a film: adaptive internal steps, cut at events. */

#include "motion.h"
#include "step_size.h"

#include <math.h>
#include <string.h>

/* Change of the coordinate up to which the work is summed by the quadrature of the method: its error
   falls with the fifth power of the step; in a longer one the gap changes by percents and six Gauss
   points on the cubics are the better rule. */
#define SHORT 1e-2
/* Two gaps closer than this, relatively, are one: a step that is cut at an event ends within 1e-13 of
   it (`locate`), and the next one must not meet it again. */
#define SAME 1e-11
#define NO_FORCE 1e-290 /* sum of the forces [N] below which none acts; `pose` adds 1e-300 */
#define FOOT 1e-6       /* sum of the forces over the pull to come, at the foot of a ramp */
/* What an event of a cavity may be missed by, over its scale: far below rtol, and above what round-off
   leaves of rates that vanish there. */
#define TURN 1e-11
#define NO_TIME 1e-280 /* at time 0 the range of a float bounds a step, as in advance.py */
#define MOST_REJECTED 300 /* in a row: from 1 s to NO_TIME by tenths */
#define NOTHING 1e-13 /* a gap [m] a thousand times smaller than an atom means nothing any more */

static ck_place place_of(const ck_motion *state) { return (ck_place){state->gap, state->speed}; }

void ck_start(const ck_scene *scene, ck_motion *state) {
    ck_acting acting;
    memset(state, 0, sizeof *state);
    state->gap = scene->initial_gap;
    state->in_contact = scene->rest_gap >= scene->initial_gap && scene->initial_speed <= 0.0;
    state->speed = state->in_contact ? 0.0 : scene->initial_speed;
    state->armed = 1;
    state->break_time = state->release_time = state->peak_time = -1.0;
    state->inception_time = state->reformation_time = -1.0;
    ck_act(scene, 0, 0, 0, &acting);
    if (!acting.any || !acting.law || !ck_is_inception(acting.law, &state->cavity, place_of(state)))
        return;
    ck_cavity_event(acting.law, &state->cavity, place_of(state));
    state->inception_time = 0.0, state->inceptions = 1;
}

/* What acts: all, or what a broken film and parted solids leave. */
void ck_act(const ck_scene *scene, int number, int broken, int detached, ck_acting *acting) {
    const ck_film *film = &scene->tables->films[number];
    int i;
    acting->film = film;
    acting->any = 0;
    acting->release = HUGE_VAL;
    for (i = 0; i < film->n_laws; i++) {
        const ck_law *law = &film->laws[i];
        acting->acts[i] = !(broken && law->needs_film) && !(detached && law->release < HUGE_VAL);
        acting->any |= acting->acts[i];
        if (acting->acts[i] && law->release < acting->release) acting->release = law->release;
    }
    acting->end = broken ? HUGE_VAL : scene->ends[number];
    acting->rheology = !broken && film->has_rheology ? &film->rheology : NULL;
    acting->limited = !broken && (scene->tension > 0.0 || scene->strength > 0.0);
    if (acting->rheology) acting->limited = acting->rheology->stretches[0].has_cavity;
    acting->is_sphere = scene->tables->is_sphere;
    acting->reynolds = scene->tables->reynolds;
    acting->viscosity = scene->viscosity;
    acting->surface_tension = scene->surface_tension;
    acting->tension = scene->tension;
    acting->strength = scene->strength;
    acting->sphere_radius = scene->tables->sphere_radius;
    acting->menisci = scene->tables->menisci;
    acting->law = !broken && scene->laws[number].strength > 0.0 ? &scene->laws[number] : NULL;
}


/* Whether a film acts that has a cavity now. */
static int is_hollow(const ck_acting *acting, const ck_motion *state) {
    return acting->any && acting->law && state->cavity.phase != CK_FULL;
}

void ck_forces_of(const ck_acting *acting, const ck_motion *state, ck_forces *found, ck_spot *spot) {
    memset(spot, 0, sizeof *spot);
    if (!is_hollow(acting, state)) {
        ck_forces_at(acting, state->gap, state->speed, found);
        return;
    }
    ck_spot_at(acting->law, &state->cavity, place_of(state), state->cavity.hollow, spot);
    ck_forces_with(acting, spot, place_of(state), found);
}

int ck_status(const ck_scene *scene, const ck_motion *state, const ck_acting *acting,
              const ck_forces *forces, double pull) {
    double net = pull - scene->stiffness * (state->gap - scene->initial_gap) - forces->fixed;
    if (!acting->any) return CK_FILM_STATUS_BROKEN;
    if (pull > 0.0 && net <= 0.0 && state->speed <= 0.0) return CK_FILM_STATUS_STUCK;
    if (state->in_contact) return CK_FILM_STATUS_CONTACT;
    if (state->broken) return CK_FILM_STATUS_BROKEN;
    return state->gap <= acting->film->full_gap ? CK_FILM_STATUS_FULL : CK_FILM_STATUS_BRIDGE;
}

/* Rest on the asperities until the pull exceeds what holds the bodies together. */
static void rest_once(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double end) {
    ck_acting acting;
    double holding = scene->stiffness * (state->gap - scene->initial_gap), film, low = state->time;
    double leave = end, elapsed;
    ck_act(scene, state->film, state->broken, state->detached, &acting);
    /* Nothing ruptured at a smaller gap than this, so that no void is left here. */
    if (state->cavity.phase != CK_FULL) memset(&state->cavity, 0, sizeof state->cavity);
    film = ck_fixed_force(&acting, state->gap);
    if (ck_pull_at(pull, low) - holding - film > 0.0) {
        leave = low;
    } else if (ck_pull_at(pull, end) - holding - film > 0.0) {
        while (leave - low > 1e-15 * fabs(leave)) {
            double middle = 0.5 * (low + leave);
            if (!(low < middle && middle < leave)) break;
            if (ck_pull_at(pull, middle) - holding - film > 0.0) leave = middle;
            else low = middle;
        }
    }
    elapsed = leave - state->time;
    state->time = leave;
    state->in_contact = ck_pull_at(pull, leave) - holding - film <= 0.0;
    state->step = 0.0;
    state->fixed_impulse += elapsed * film;
}

/* Forces that a damping is read off: at rest a film that thins or thickens has that of a liquid at rest,
   so that one that crosses the gap in a step is asked. */
static ck_forces damping_of(const ck_acting *acting, const ck_motion *state, double crossing,
                            const ck_forces *first) {
    ck_forces found;
    if (!first->bent || !(fabs(state->speed) < crossing)) return *first;
    ck_forces_at(acting, state->gap, crossing, &found);
    return isfinite(found.resistance) ? found : *first;
}

static void pose(const ck_scene *scene, const ck_acting *acting, const ck_motion *state,
                 const ck_pull *pull, ck_problem *p, ck_forces *first) {
    double drive = ck_pull_at(pull, state->time), spring, crossing;
    ck_forces damped;
    p->cavity = is_hollow(acting, state) ? &state->cavity : NULL;
    if (p->cavity) {
        ck_forces_of(acting, state, first, &p->spot);
        p->exponent = ck_film_exponent(state->gap, first);
    } else if (state->known) {
        *first = state->here;
        p->exponent = state->exponent;
    } else {
        ck_forces_at(acting, state->gap, state->speed, first);
        p->exponent = ck_film_exponent(state->gap, first);
    }
    spring = scene->stiffness * (state->gap - scene->initial_gap);
    p->acting = acting;
    p->pull = *pull;
    p->mass = scene->mass, p->spring = scene->stiffness, p->rest = scene->initial_gap;
    p->rtol = p->cavity ? ck_time_rtol(acting->law, scene->rtol) : scene->rtol;
    p->begin.time = state->time, p->begin.gap = state->gap, p->begin.speed = state->speed;
    p->size = fabs(drive) + fabs(first->fixed) + fabs(spring) + 1e-300;
    p->delivered = state->applied_impulse + scene->mass * fabs(state->speed);
    crossing = state->gap / (state->step > 0.0 ? state->step : 1e-6);
    damped = damping_of(acting, state, crossing, first);
    if (damped.bent) p->exponent = ck_film_exponent(state->gap, &damped);
    /* Speed at which the film balances the other forces: what a creeping mass is measured against. */
    p->scale = damped.resistance > 0.0 ? ck_larger(p->size / damped.resistance, 1e-15 * crossing)
                                       : crossing;
    p->net = drive - spring - first->fixed - first->viscous;
    p->net_by_gap = -scene->stiffness - first->fixed_by_gap - first->viscous_by_gap;
    p->net_by_speed = -first->viscous_by_speed;
    p->viscous = first->viscous, p->taken = fabs(state->viscous_impulse);
}

/* Scale the error control by a force before the pull has risen to it: at the foot of a ramp nothing acts
   yet, and a stiff film would be followed through its transient. */
static void expect(ck_problem *p, const ck_forces *first, double force) {
    p->size += force;
    if (first->resistance > 0.0) p->scale = ck_larger(p->scale, force / first->resistance);
}

/* Time in which inertia alone would open a thousandth of the gap; a first guess. */
static double first_step(const ck_problem *p, double left) {
    double acceleration = fabs(p->net) / p->mass, still = left, moving = left;
    if (acceleration > 0.0) still = sqrt(2e-3 * p->begin.gap / acceleration);
    if (p->begin.speed != 0.0) moving = 1e-3 * p->begin.gap / fabs(p->begin.speed);
    return ck_smaller(ck_smaller(still, moving), left);
}

/* Error of a step over its tolerance, with what the estimate inside the step cannot see. */
static double judge(const ck_scene *scene, const ck_motion *state, const ck_pull *pull,
                    const ck_problem *p, int limit, const ck_step *taken, double length) {
    double error = ck_error(p, taken, length), rest = scene->rest_gap;
    const ck_point *end = &taken->stages[2];
    ck_problem second;
    ck_forces ignored;
    ck_step half, again;
    ck_motion there;
    if (error > 1.0) return error;
    if (end->gap < rest * (1.0 - SAME) && state->gap <= rest * (1.0 + SAME))
        return 16.0; /* a hop that begins and ends at the rest gap: there is no crossing to cut */
    if (!p->acting->limited || !p->acting->any) return error;
    /* Where a limit begins or ends to act, the slope of the force jumps: compare with two halves. */
    if (taken->forces[0].limit == limit && taken->forces[1].limit == limit &&
        taken->forces[2].limit == limit)
        return error;
    if (!ck_attempt(p, 0.5 * length, &half)) return 16.0;
    there = *state;
    there.time = half.stages[2].time, there.gap = half.stages[2].gap;
    there.speed = half.stages[2].speed, there.known = 0;
    pose(scene, p->acting, &there, pull, &second, &ignored);
    if (!ck_attempt(&second, 0.5 * length, &again)) return 16.0;
    half = *taken;
    half.gap_error = fabs(log(again.stages[2].gap / end->gap));
    half.speed_error = fabs(again.stages[2].speed - end->speed);
    return ck_larger(error, ck_error(p, &half, length));
}

/* Gap below which the bodies count as closed again, so that the next release is a new one. */
static double closed_gap(const ck_scene *scene) {
    return ck_smaller(2.0 * scene->initial_gap, 0.5 * (scene->initial_gap + scene->release_gap));
}

typedef struct {
    double begin, end, found;
    int rising;
} crossings;

/* An event that is closer to the start than SAME is behind. */
static void consider(crossings *c, double event) {
    int is_ahead = c->rising ? c->begin * (1.0 + SAME) < event && event <= c->end
                             : c->end <= event && event < c->begin * (1.0 - SAME);
    if (!is_ahead) return;
    if (c->found < 0.0 || (c->rising ? event < c->found : event > c->found)) c->found = event;
}

/* Gap of the first event on the way to `gap`; -1 if there is none. */
static double next_event(const ck_scene *scene, const ck_acting *acting, const ck_motion *state,
                         double gap) {
    crossings m;
    int i, k;
    m.rising = gap > state->gap;
    m.begin = state->gap, m.end = gap, m.found = -1.0;
    for (i = 0; i < acting->film->n_laws; i++)
        for (k = 0; acting->acts[i] && k < acting->film->laws[i].n_kinks; k++)
            if (acting->film->laws[i].kinks[k] < acting->end)
                consider(&m, acting->film->laws[i].kinks[k]);
    if (m.rising) {
        if (state->armed) consider(&m, scene->release_gap);
        if (acting->any) consider(&m, acting->end), consider(&m, acting->release);
    } else {
        consider(&m, scene->rest_gap);
        if (state->broken) consider(&m, scene->initial_gap);
        if (state->detached) consider(&m, scene->recontact);
        if (!state->armed) consider(&m, closed_gap(scene));
    }
    return m.found;
}

/* Step that ends at a gap: Newton on its length, whose slope is the speed at the end of the step and
   costs nothing. The bracket holds it where the mass turns back inside the step. */
static double locate(const ck_problem *p, double length, double event, ck_step *taken) {
    double low = 0.0, high = length;
    int rising = event > p->begin.gap, i;
    for (i = 0; i < 60; i++) {
        const ck_point *end = &taken->stages[2];
        double miss = end->gap - event, guess = -1.0;
        ck_step again;
        if (fabs(miss) <= 1e-13 * event || high - low <= 1e-15 * high) break;
        if ((miss > 0.0) == rising) high = length;
        else low = length;
        if (end->speed != 0.0) guess = length - miss / end->speed;
        length = low < guess && guess < high ? guess : 0.5 * (low + high);
        if (!ck_attempt(p, length, &again)) break;
        *taken = again;
    }
    return length;
}

/* Coefficients of a + b x + c x^2 + d x^3 through the start and the stages; the numbers are those of
   the nodes (4 -+ sqrt 6)/10 and 1. */
static void cubic(double first, const double stages[3], double found[4]) {
    double a = stages[0] - first, b = stages[1] - first, c = stages[2] - first;
    found[0] = first;
    found[1] = 10.0488093998274155625 * a - 1.38214273316074889579 * b + c / 3.0;
    found[2] = -25.6295914470766393868 * a + 10.2962581137433060534 * b - 8.0 / 3.0 * c;
    found[3] = 15.5807820472492238243 * a - 8.91411538058255715765 * b + 10.0 / 3.0 * c;
}

/* Whether a stiff film came up to its force at once, in a transient that was stepped over. */
static int jumps(double first, const double stages[3]) {
    double high = ck_larger(ck_larger(first, stages[0]), ck_larger(stages[1], stages[2]));
    double low = -ck_larger(ck_larger(-first, -stages[0]), ck_larger(-stages[1], -stages[2]));
    return stages[0] - first > 0.9 * (high - low);
}

/* Highest value on a step, and where: 0 start, 1 end. */
static double highest(double first, const double stages[3], double *where) {
    double f[4], value = first, lowest = first, inside, q, roots[2];
    int i;
    *where = 0.0;
    /* A stiff film comes up to its force within m/c, far less than the step. */
    if (jumps(first, stages) && 2.0 * (stages[2] - first) > stages[0] - first) {
        *where = 1.0; /* it stays up; before that the stages are not accurate */
        return stages[2];
    }
    for (i = 0; i < 3; i++) {
        if (stages[i] > value) value = stages[i], *where = ck_nodes[i];
        if (stages[i] < lowest) lowest = stages[i];
    }
    cubic(first, stages, f);
    inside = f[2] * f[2] - 3.0 * f[1] * f[3];
    if (inside < 0.0) return value;
    q = -(f[2] + copysign(sqrt(inside), f[2]));
    roots[0] = f[3] != 0.0 ? q / (3.0 * f[3]) : -1.0;
    roots[1] = q != 0.0 ? f[1] / q : -1.0;
    for (i = 0; i < 2; i++) {
        double x = roots[i], at;
        if (!(x > 0.0 && x < 1.0 && 2.0 * f[2] + 6.0 * f[3] * x < 0.0)) continue;
        at = f[0] + x * (f[1] + x * (f[2] + x * f[3]));
        /* A cubic swings away from smooth stretches; trust only a small rise above the nodes. */
        if (value < at && at <= value + 0.25 * (value - lowest)) value = at, *where = x;
    }
    return value;
}

/* Integral of a force over the time of the stages, by the quadrature of the method. */
static double by_stages(const ck_point *start, const ck_step *taken, const double values[3]) {
    double dt = taken->stages[2].time - start->time, total = 0.0;
    int i;
    for (i = 0; i < 3; i++) total += ck_weights[i] * values[i] * taken->stages[i].speed;
    return dt * total;
}

/* Integral of a force over the travel of a step; force and coordinate are cubics in time. */
static double travel_integral(const ck_point *start, const ck_step *taken, double first,
                          const double values[3]) {
    /* Gauss-Legendre nodes and weights of six points on (0, 1), one half of them. */
    static const double node[3] = {0.23861918608319690863, 0.66120938646626451366,
                                   0.93246951420315202781};
    static const double weight[3] = {0.46791393457269104739, 0.36076157304813860757,
                                     0.17132449237917034504};
    double f[4], q[4], total = 0.0;
    int i;
    if (fabs(taken->coordinates[2]) < SHORT) return by_stages(start, taken, values);
    if (jumps(first, values)) {
        /* The jump takes no time: begin where the stages, as a parabola, say it ended. */
        first = 1.55807820472492238243 * values[0] - 0.891411538058255715765 * values[1] +
                values[2] / 3.0;
    }
    cubic(first, values, f);
    cubic(0.0, taken->coordinates, q);
    for (i = 0; i < 6; i++) {
        double x = 0.5 + (i < 3 ? -0.5 : 0.5) * node[i % 3], where[3], rate;
        if (!ck_coordinate(start->gap, taken->exponent, ((q[3] * x + q[2]) * x + q[1]) * x, where))
            return by_stages(start, taken, values); /* the cubic overshoots */
        rate = (3.0 * q[3] * x + 2.0 * q[2]) * x + q[1];
        total += 0.5 * weight[i % 3] * (((f[3] * x + f[2]) * x + f[1]) * x + f[0]) * where[1] * rate;
    }
    return total;
}

/* Add a step to the impulses, the work and the peak, by the quadrature of the method itself. */
static void accumulate(const ck_problem *p, const ck_forces *first, const ck_step *taken,
                       double length, ck_motion *state) {
    double viscous[3], total[3], viscous_mean = 0.0, fixed_mean = 0.0, where, value;
    int i;
    for (i = 0; p->acting->any && i < 3; i++) {
        const ck_forces *found = &taken->forces[i];
        viscous[i] = found->viscous;
        total[i] = found->viscous + found->fixed;
        viscous_mean += ck_weights[i] * found->viscous;
        fixed_mean += ck_weights[i] * found->fixed;
    }
    if (p->acting->any) {
        state->work += travel_integral(&p->begin, taken, first->viscous, viscous);
        value = highest(first->viscous + first->fixed, total, &where);
        if (value > state->peak_force) {
            state->peak_force = value;
            state->peak_time = state->time + where * length;
        }
    }
    state->time += length;
    state->gap = taken->stages[2].gap;
    state->speed = taken->stages[2].speed;
    state->viscous_impulse += length * viscous_mean;
    state->fixed_impulse += length * fixed_mean;
    state->applied_impulse += length * p->size;
    state->steps++;
    state->iterations += taken->iterations;
    state->here = taken->forces[2], state->exponent = taken->film_exponent;
    state->known = 1;
}

void ck_resolve(const ck_scene *scene, ck_motion *state) {
    if (state->pending == CK_RUPTURE) {
        state->broken = 1;
        memset(&state->cavity, 0, sizeof state->cavity);
        state->break_time = state->time;
        state->breaks++;
    } else if (state->pending == CK_REWETTING) {
        state->broken = 0, state->film = scene->tables->n_films - 1;
    }
    state->pending = CK_NONE;
}

/* Apply the event at a gap: release, rupture, rest or re-wetting. */
static void apply_event(const ck_scene *scene, const ck_acting *acting, ck_motion *state, double event) {
    int rising = state->speed > 0.0, next = scene->tables->n_films - 1;
    state->gap = event;
    if (rising && event == scene->release_gap) {
        state->armed = 0;
        state->release_time = state->time;
        state->release_speed = state->speed;
        state->releases++;
    }
    if (rising && acting->any && event == acting->end) state->pending = CK_RUPTURE;
    if (rising && acting->any && event == acting->release) state->detached = 1;
    if (rising) return;
    if (event <= closed_gap(scene)) state->armed = 1;
    if (event <= scene->recontact) state->detached = 0;
    if (event > scene->initial_gap) return;
    if (state->broken && scene->tables->rewetting > 0.0 && scene->ends[next] > event)
        state->pending = CK_REWETTING;
    if (event == scene->rest_gap) state->in_contact = 1, state->speed = 0.0;
}

typedef struct {
    const ck_problem *problem;
    ck_step *taken;
} turning;

/* How far a step ends beyond an event of the cavity, and begins. */
static void beyond(const ck_problem *p, const ck_cavity *cavity, const ck_step *taken,
                   double *behind, double *ahead) {
    ck_place begin = {p->begin.gap, p->begin.speed}, at[3];
    int i;
    for (i = 0; i < 3; i++) at[i].gap = taken->stages[i].gap, at[i].speed = taken->stages[i].speed;
    ck_beyond_event(p->acting->law, cavity, p->cavity ? &taken->hollow : NULL, begin, at, behind, ahead);
}

static const ck_cavity WHOLE;

static int turn_trial(void *context, double length, double *missed) {
    turning *t = (turning *)context;
    double ignored;
    ck_step again;
    if (!ck_attempt(t->problem, length, &again)) return 0;
    *t->taken = again;
    beyond(t->problem, t->problem->cavity ? t->problem->cavity : &WHOLE, t->taken, &ignored, missed);
    return 1;
}

/* Cut a step at the first event of its cavity; 0 if there is none. */
static int cut_at_turn(const ck_problem *p, ck_step *taken, double *length) {
    turning context = {p, taken};
    double behind, ahead;
    if (!p->acting->any || !p->acting->law) return 0;
    beyond(p, p->cavity ? p->cavity : &WHOLE, taken, &behind, &ahead);
    if (ahead <= 0.0) return 0;
    *length = behind >= 0.0
                  ? 0.0
                  : ck_step_to_event(turn_trial, &context, behind, ahead, *length, TURN);
    return 1;
}

/* Keep what the cavity is after a step, and after the event at its end; 0 if it is not known. */
static int keep_cavity(const ck_problem *p, const ck_step *taken, int turn, ck_motion *state) {
    if (p->cavity) {
        double gaps[3];
        int i;
        for (i = 0; i < 3; i++) gaps[i] = taken->stages[i].gap;
        if (!ck_cavity_step(p->acting->law, &state->cavity, &taken->hollow, p->begin.gap, gaps)) return 0;
    }
    if (turn)
        ck_cavity_event(p->acting->law, &state->cavity,
                        (ck_place){taken->stages[2].gap, taken->stages[2].speed});
    return 1;
}

/* Take one internal step, shortened to the first event inside it. */
static int step_once(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double end) {
    ck_acting acting;
    ck_problem p;
    ck_forces first;
    ck_step taken;
    double left = end - state->time, length, error = HUGE_VAL, following, event, asked, coming;
    int rejected = 0, turn;
    if (state->gap < NOTHING) return CK_NO_STEP;
    if (state->speed < 0.0 && state->gap <= scene->rest_gap * (1.0 + SAME)) {
        state->in_contact = 1, state->gap = scene->rest_gap, state->speed = 0.0, state->known = 0;
        return CK_DONE;
    }
    ck_act(scene, state->film, state->broken, state->detached, &acting);
    if (acting.any && acting.law && ck_is_inception(acting.law, &state->cavity, place_of(state))) {
        ck_cavity_event(acting.law, &state->cavity, place_of(state));
        state->step = 0.0, state->known = 0;
        return CK_DONE;
    }
    pose(scene, &acting, state, pull, &p, &first);
    /* At the foot of a ramp errors would be measured against a force that is still nothing. */
    coming = fabs(ck_pull_at(pull, end));
    if (p.size <= ck_larger(NO_FORCE, FOOT * coming)) expect(&p, &first, 0.5 * coming);
    asked = state->step > 0.0 ? state->step : first_step(&p, left);
    length = ck_smaller(asked, left);
    for (;;) {
        error = HUGE_VAL;
        if (ck_attempt(&p, length, &taken))
            error = judge(scene, state, pull, &p, first.limit, &taken, length);
        if (error <= 1.0) break;
        rejected++;
        /* The error estimate is of order 3 (Hairer and Wanner, IV.8): it goes with dt^4. */
        length *= error < HUGE_VAL ? ck_larger(CK_SHRINK, CK_SAFETY * pow(error, -0.25)) : CK_UNSOLVED;
        if (!(length >= ck_larger(1e-15 * fabs(state->time), NO_TIME)) || rejected > MOST_REJECTED)
            return CK_NO_STEP;
    }
    state->cost += p.cavity ? (int64_t)ck_cavity_cost(acting.law) * rejected : rejected;
    following = length * ck_smaller(CK_GROW, CK_SAFETY / sqrt(sqrt(ck_larger(error, 1e-12))));
    if (!rejected && length < state->step) following = ck_larger(following, state->step);
    /* The step is taken first, as if there were no event, and cut afterwards: forces and error estimate
       go on smoothly beyond it, as laws are carried on until the event is applied. */
    event = next_event(scene, &acting, state, taken.stages[2].gap);
    if (event >= 0.0) length = locate(&p, length, event, &taken);
    turn = cut_at_turn(&p, &taken, &length);
    if (turn) event = -1.0;
    if (length == 0.0) {
        ck_cavity_event(acting.law, &state->cavity, place_of(state));
        state->known = 0;
        return CK_DONE;
    }
    if (!keep_cavity(&p, &taken, turn, state)) return CK_NO_STEP;
    accumulate(&p, &first, &taken, length, state);
    /* After an event of the cavity its rates start anew: a first guess, not the step before it. */
    state->step = turn ? 0.0 : following;
    if (turn) state->known = 0;
    if (event >= 0.0) apply_event(scene, &acting, state, event), state->known = 0;
    if (state->pending && !scene->pauses) ck_resolve(scene, state);
    return CK_DONE;
}

/* One internal step towards a time, cut at the first event inside it. */
int ck_internal_step(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double end) {
    int was = state->cavity.phase, trouble = CK_DONE, now;
    if (state->in_contact) rest_once(scene, state, pull, end);
    else trouble = step_once(scene, state, pull, end);
    now = state->cavity.phase;
    state->cost += was == CK_FULL && now == CK_FULL ? 1 : ck_cavity_cost(&scene->laws[state->film]);
    if (was == CK_FULL && now != CK_FULL) state->inception_time = state->time, state->inceptions++;
    if (was != CK_FULL && now == CK_FULL && !state->broken)
        state->reformation_time = state->time, state->reformations++;
    return trouble;
}

/* Advance by a time under a pull, however stiff the film; less if the motion pauses. */
int ck_advance(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double dt) {
    double end = state->time + dt;
    int trouble;
    state->cost = 0;
    while (state->cost <= scene->max_steps) {
        if (end - state->time <= 1e-13 * ck_larger(fabs(end), dt)) {
            state->time = end;
            return CK_DONE;
        }
        if (state->pending) return CK_DONE;
        trouble = ck_internal_step(scene, state, pull, end);
        if (trouble) return trouble;
    }
    return CK_TOO_MANY_STEPS;
}
