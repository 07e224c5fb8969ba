/* The stages of a step and the estimate of its error.

   The forces are asked for as seldom as the accuracy allows, as that is what a step costs: the
   stages are first found with the forces at the start and their slopes, which are known, and one
   iteration with forces at the stages does for a short step. Forces at stages that moved once
   more, by no more than what the iteration is allowed to leave, follow by their slopes. */

#include "step.h"

#include <math.h>

#define R6 2.449489742783178098197284 /* the root of 6, of which the nodes are made */
#define MOST_ITERATIONS 12 /* Newton takes up to six: see radau.py */
/* Relative change over which the slopes at the start are good enough: they leave its square, 1e-8 of a
   force, in an estimate of an error. */
#define LINEAR 1e-4
#define FAR 0.5 /* change of the coordinate over which they are no guess any more */
#define RISING 3.0  /* these five as in radau.py, where the reasons are */
#define LEFT (0.1 / RISING)
#define FAST 2.0
#define TRAVEL 1e-2
#define IMPULSE 0.1

const double ck_nodes[3] = {(4.0 - R6) / 10.0, (4.0 + R6) / 10.0, 1.0};
const double ck_weights[3] = {(16.0 - R6) / 36.0, (16.0 + R6) / 36.0, 1.0 / 9.0};
const double ck_stages[3][3] = {
    {(88.0 - 7.0 * R6) / 360.0, (296.0 - 169.0 * R6) / 1800.0, (-2.0 + 3.0 * R6) / 225.0},
    {(296.0 + 169.0 * R6) / 1800.0, (88.0 + 7.0 * R6) / 360.0, (-2.0 - 3.0 * R6) / 225.0},
    {(16.0 - R6) / 36.0, (16.0 + R6) / 36.0, 1.0 / 9.0}};
/* 3 + 3^(2/3) - 3^(1/3), and the weights of the stage increments */
const double ck_gamma = 3.6378342527444957;
const double ck_estimate[3] = {(-13.0 - 7.0 * R6) / 3.0, (-13.0 + 7.0 * R6) / 3.0, -1.0 / 3.0};
/* weights of the stages in what a parabola through them is at the start, and in its slopes */
static const double BACK[3] = {(2.0 + 3.0 * R6) / 6.0, (2.0 - 3.0 * R6) / 6.0, 1.0 / 3.0};
static const double BACK_SLOPE[3] = {(8.0 - 13.0 * R6) / 6.0, (8.0 + 13.0 * R6) / 6.0, -8.0 / 3.0};
static const double END_SLOPE[3] = {-2.0 + 7.0 * R6 / 6.0, -2.0 - 7.0 * R6 / 6.0, 4.0};

/* The unknowns are the rates dq/dt of a coordinate q of the gap, not gaps. Where the film rules, q is
   proportional to the viscous impulse, (1 - (h0/h)^s)/s with s = n - 1: the impulse is what pulls
   determine, so that q goes on smoothly while the gap multiplies, and a gap cannot come out below
   zero. Where inertia rules (s = -1), q is the gap over that at the start. */
typedef struct {
    double q, first, swing; /* coordinate, slope of the gap by it, rate times its curvature */
    ck_point at;
    ck_forces forces;
    double net, by_gap, by_speed;
} stage;

double ck_pull_at(const ck_pull *pull, double time) {
    double since = time - pull->time;
    return pull->force + since * (pull->rate + pull->bend * since);
}

/* Gap and its first two derivatives by q; 0 outside the range of q. */
int ck_coordinate(double gap, double s, double q, double found[3]) {
    double base = 1.0 - s * q, h;
    if (!(base > 0.0)) return 0;
    if (s == -1.0) h = gap * base;
    else if (s == 0.0) h = gap * exp(q);
    else if (s == 2.0) h = gap / sqrt(base);
    else if (s == 4.0) h = gap / sqrt(sqrt(base));
    else h = gap * pow(base, -1.0 / s);
    if (!(h < HUGE_VAL)) return 0;
    found[0] = h;
    found[1] = h / base;
    found[2] = (1.0 + s) * found[1] / base;
    return 1;
}

/* Exponent n of the damping, which falls as gap^-n: 3 of flats, 5 of a film that narrows, 1 of a
   sphere. More is taken for a kink that begins; the coordinate only has to be close. */
double ck_film_exponent(double gap, const ck_forces *forces) {
    double found;
    if (!(forces->resistance > 0.0)) return 0.0;
    found = -gap * forces->resistance_by_gap / forces->resistance;
    if (fabs(found - 3.0) < 1e-6) return 3.0; /* where q has a root in place of a power */
    if (fabs(found - 5.0) < 1e-6) return 5.0;
    return found > 0.0 ? (found < 5.0 ? found : 5.0) : 0.0;
}

static double net_of(const ck_problem *p, const ck_point *at, const ck_forces *forces) {
    return ck_pull_at(&p->pull, at->time) - p->spring * (at->gap - p->rest) -
           (forces->viscous + forces->fixed);
}

/* A film with a cavity, in place of one that is whole; what no limit bounds stays. */
static void hold(const ck_held *held, double speed, ck_forces *found) {
    found->viscous = held->force + found->free * speed;
    found->viscous_by_gap = held->by_gap + found->free_by_gap * speed;
    found->viscous_by_speed = held->by_speed + found->free, found->limit = CK_LIMIT_KIND_TENSION;
}

void ck_forces_with(const ck_acting *acting, const ck_spot *spot, ck_place at, ck_forces *found) {
    ck_held held;
    ck_forces_at(acting, at.gap, at.speed, found);
    ck_held_at(acting->law, spot, at, &held);
    hold(&held, at.speed, found);
}

/* Void and forces at the stages of a film with a cavity; 0 if they are not found. */
static int with_cavity(const ck_problem *p, double dt, stage at[3], ck_hollow *hollow) {
    ck_place begin = {p->begin.gap, p->begin.speed}, places[3];
    int i;
    for (i = 0; i < 3; i++) places[i].gap = at[i].at.gap, places[i].speed = at[i].at.speed;
    if (!ck_hollow_solve(p->acting->law, p->cavity, begin, dt, places, hollow)) return 0;
    for (i = 0; i < 3; i++) hold(&hollow->held[i], at[i].at.speed, &at[i].forces);
    return 1;
}

/* Net force on the mass at a stage, and its slopes. */
static void evaluate(const ck_problem *p, stage *one) {
    one->by_gap = -p->spring - one->forces.fixed_by_gap - one->forces.viscous_by_gap;
    one->by_speed = -one->forces.viscous_by_speed;
    one->net = net_of(p, &one->at, &one->forces);
}

/* Forces a little way off, by their slopes. */
static void carry(ck_forces *f, const ck_point *from, const ck_point *to) {
    double dh = to->gap - from->gap;
    f->fixed += f->fixed_by_gap * dh;
    f->resistance += f->resistance_by_gap * dh;
    if (f->limit == CK_LIMIT_KIND_NONE && !f->bent) f->viscous = f->resistance * to->speed;
    else f->viscous += f->viscous_by_gap * dh + f->viscous_by_speed * (to->speed - from->speed);
}

/* Solve a 3 by 3 system by Cramer's rule; 0 if it is singular. What it loses to elimination with
   pivots only slows down Newton's iteration, which ends by its residual. */
static int solve3(double a[3][3], const double b[3], double x[3]) {
    double m0 = a[1][1] * a[2][2] - a[1][2] * a[2][1], m1 = a[1][2] * a[2][0] - a[1][0] * a[2][2];
    double m2 = a[1][0] * a[2][1] - a[1][1] * a[2][0];
    double det = a[0][0] * m0 + a[0][1] * m1 + a[0][2] * m2;
    if (det == 0.0 || !isfinite(det)) return 0;
    x[0] = (b[0] * m0 + a[0][1] * (a[1][2] * b[2] - b[1] * a[2][2]) +
            a[0][2] * (b[1] * a[2][1] - a[1][1] * b[2])) / det;
    x[1] = (a[0][0] * (b[1] * a[2][2] - a[1][2] * b[2]) + b[0] * m1 +
            a[0][2] * (a[1][0] * b[2] - b[1] * a[2][0])) / det;
    x[2] = (a[0][0] * (a[1][1] * b[2] - b[1] * a[2][1]) +
            a[0][1] * (b[1] * a[2][0] - a[1][0] * b[2]) + b[0] * m2) / det;
    return 1;
}

static int place_stages(const ck_problem *p, double dt, double s, const double rates[3],
                        stage found[3]) {
    int i;
    for (i = 0; i < 3; i++) {
        double where[3];
        double q = dt * (ck_stages[i][0] * rates[0] + ck_stages[i][1] * rates[1] + ck_stages[i][2] * rates[2]);
        if (!ck_coordinate(p->begin.gap, s, q, where) || !(where[0] > 1e-100)) return 0;
        found[i].q = q;
        found[i].first = where[1];
        found[i].swing = rates[i] * where[2];
        found[i].at.time = p->begin.time + ck_nodes[i] * dt;
        found[i].at.gap = where[0];
        found[i].at.speed = rates[i] * where[1];
    }
    return 1;
}

/* Residual m (v_i - v_0) - dt sum(a_ij G_j) of the stages, and its matrix. */
static void build(const ck_problem *p, double dt, const stage at[3], double residual[3],
                  double matrix[3][3]) {
    double line[3][3];
    int i, j, k;
    for (j = 0; j < 3; j++) {
        double both = (at[j].by_gap * at[j].first + at[j].by_speed * at[j].swing) * dt;
        for (k = 0; k < 3; k++) line[j][k] = both * ck_stages[j][k];
        line[j][j] += at[j].by_speed * at[j].first;
    }
    for (i = 0; i < 3; i++) {
        double given = ck_stages[i][0] * at[0].net + ck_stages[i][1] * at[1].net + ck_stages[i][2] * at[2].net;
        residual[i] = p->mass * (at[i].at.speed - p->begin.speed) - dt * given;
        for (k = 0; k < 3; k++) {
            double sum = ck_stages[i][0] * line[0][k] + ck_stages[i][1] * line[1][k] + ck_stages[i][2] * line[2][k];
            matrix[i][k] = dt * (p->mass * at[i].swing * ck_stages[i][k] - sum);
        }
        matrix[i][i] += p->mass * at[i].first;
    }
}

static double largest(const double values[3]) {
    double a = fabs(values[0]), b = fabs(values[1]), c = fabs(values[2]);
    a = a > b ? a : b;
    return a > c ? a : c;
}

/* Whether the momentum left over is small against what the film and the mass take. */
static int is_small(const ck_problem *p, double dt, const stage at[3], const double residual[3],
                    double rtol) {
    double momentum = 0.0;
    int i;
    for (i = 0; i < 3; i++) {
        double speed = fabs(at[i].at.speed), carried = fabs(at[i].by_speed) * (speed + p->scale);
        double one = p->mass * speed + dt * (fabs(at[i].net) + carried);
        if (one > momentum) momentum = one;
    }
    return largest(residual) <= rtol * momentum;
}

static void estimate(const ck_problem *p, double g, double s, double rate, double acceleration,
                     const double z[2], double error[2]) {
    double h0 = p->begin.gap, j11 = -p->begin.speed * (1.0 + s) / h0, j12 = 1.0 / h0;
    double j21 = p->net_by_gap * h0 / p->mass, j22 = p->net_by_speed / p->mass;
    double det = (g - j11) * (g - j22) - j12 * j21, a = rate + z[0], b = acceleration + z[1];
    error[0] = ((g - j22) * a + j12 * b) / det;
    error[1] = (j21 * a + (g - j11) * b) / det;
}

/* Whether slopes of forces may jump, follow from a memory, or are those of a force that is no multiple of
   the speed. */
static int has_limits(const ck_problem *p) {
    return p->acting->limited || p->acting->law || p->acting->rheology;
}

/* Net force where the first estimate leads; only far off it is asked for. */
static double net_near(const ck_problem *p, double gap, double speed) {
    double dh = gap - p->begin.gap, dv = speed - p->begin.speed;
    ck_point there;
    ck_forces found;
    if (fabs(dh) <= LINEAR * p->begin.gap && (!has_limits(p) || fabs(dv) <= LINEAR * fabs(speed)))
        return p->net + p->net_by_gap * dh + p->net_by_speed * dv;
    there.time = p->begin.time, there.gap = gap, there.speed = speed;
    if (p->cavity) ck_forces_with(p->acting, &p->spot, (ck_place){gap, speed}, &found);
    else ck_forces_at(p->acting, gap, speed, &found);
    return net_of(p, &there, &found);
}

/* How much an error is reduced by the estimate and by the film at the end of a step. */
static double held_by(const ck_problem *p, double dt, const ck_forces *end) {
    return ck_gamma + dt * ck_larger(end->viscous_by_speed, 0.0) / (RISING * p->mass);
}

/* Error of a speed by that of the acceleration at the end of a step. A film that leads a mass
   accelerates it as the balance of the other forces says; it lags a little behind. See radau.py. */
static double lag_error(const ck_problem *p, const ck_step *taken, double acceleration) {
    const ck_forces *end = &taken->forces[2];
    double damping = end->viscous_by_speed, speed = taken->stages[2].speed, rate, led, lag;
    if (!(damping > 0.0) || end->limit != CK_LIMIT_KIND_NONE || end->bent || speed == 0.0) return 0.0;
    rate = p->pull.rate + 2.0 * p->pull.bend * (taken->stages[2].time - p->pull.time);
    led = (rate - (p->spring + end->fixed_by_gap + end->viscous_by_gap) * speed) / damping;
    lag = p->mass / damping * led;
    return p->mass / damping * fabs(acceleration - led) - 5.0 * lag * lag / fabs(speed);
}

/* Error of the speed at the end of a step, `zv` of the increments of the stages: the smaller of two
   estimates, each of them safe, of how far the start is from a parabola through the stages. See
   radau.py. */
static double speed_error(const ck_problem *p, double dt, const ck_step *taken, double zv) {
    double held = held_by(p, dt, &taken->forces[2]), a0 = p->net / p->mass, slope = 0.0, led;
    double first = dt * fabs(a0 + zv) / held, off = p->begin.speed, ahead = 0.0, found;
    int i;
    if (!(-p->net_by_speed * dt > p->mass)) return first;
    for (i = 0; i < 3; i++) {
        off -= BACK[i] * taken->stages[i].speed;
        slope += BACK_SLOPE[i] * taken->stages[i].speed / dt;
        ahead += END_SLOPE[i] * taken->stages[i].speed / dt;
    }
    led = off - p->mass / p->net_by_speed * (a0 - slope);
    found = ck_smaller(first, 3.0 * ck_larger(fabs(led), LEFT * fabs(off)) / held);
    if (taken->stages[2].gap < FAST * p->begin.gap) return found;
    return ck_larger(found, lag_error(p, taken, ahead - 3.0 * led / dt));
}

/* Estimate the error of stages that are found. `were` is where the forces were asked for. */
static int finish(const ck_problem *p, double dt, double s, const double rates[3],
                  const stage were[3], ck_step *taken) {
    stage at[3];
    double z[2] = {0.0, 0.0}, error[2], where[3], h0 = p->begin.gap, v0 = p->begin.speed;
    int i;
    if (!place_stages(p, dt, s, rates, at)) return 0;
    for (i = 0; i < 3; i++) {
        z[0] += ck_estimate[i] * at[i].q / dt;
        z[1] += ck_estimate[i] * (at[i].at.speed - v0) / dt;
        taken->stages[i] = at[i].at;
        taken->coordinates[i] = at[i].q;
        taken->forces[i] = were[i].forces;
        carry(&taken->forces[i], &were[i].at, &at[i].at);
    }
    taken->film_exponent = ck_film_exponent(were[2].at.gap, &were[2].forces);
    estimate(p, ck_gamma / dt, s, v0 / h0, p->net / p->mass, z, error);
    if (ck_coordinate(h0, s, error[0], where) && where[0] > 0.0 && isfinite(where[0] + error[1])) {
        /* The second estimate, from where the first one leads, ignores what decays at once. */
        double speed = v0 + error[1];
        estimate(p, ck_gamma / dt, s, speed / where[1], net_near(p, where[0], speed) / p->mass, z, error);
    }
    taken->exponent = s;
    /* The coordinate grows along with the gap: an error of it counts with the slope at the end. */
    taken->gap_error = fabs(error[0] * at[2].first / at[2].at.gap);
    taken->speed_error = speed_error(p, dt, taken, z[1]);
    return isfinite(taken->gap_error) && isfinite(taken->speed_error);
}

/* First guess of the rates: the stages of the problem that is linear at the start. Returns how far
   it went, relatively; 0 if it is too far to be any good, and the rate at the start is the guess. */
static double guess(const ck_problem *p, double dt, double s, double floor, double rates[3]) {
    double h0 = p->begin.gap, v0 = p->begin.speed, first = v0 / h0, swing = (1.0 + s) * v0;
    double residual[3], matrix[3][3], change[3], reach = 0.0, size;
    double rate = p->pull.rate + 2.0 * p->pull.bend * (p->begin.time - p->pull.time);
    stage at[3];
    int i;
    for (i = 0; i < 3; i++) {
        double since = ck_nodes[i] * dt, dq = since * first, dv = swing * dq;
        at[i].first = h0, at[i].swing = swing;
        at[i].at.speed = v0 + dv;
        at[i].by_gap = p->net_by_gap, at[i].by_speed = p->net_by_speed;
        at[i].net = p->net + since * (rate + p->pull.bend * since) + p->net_by_gap * h0 * dq +
                    p->net_by_speed * dv;
    }
    rates[0] = rates[1] = rates[2] = first;
    build(p, dt, at, residual, matrix);
    if (!solve3(matrix, residual, change)) return 0.0;
    for (i = 0; i < 3; i++) reach = ck_larger(reach, dt * fabs(first - change[i]));
    if (!(reach < FAR)) return 0.0;
    for (i = 0; i < 3; i++) rates[i] = first - change[i];
    size = largest(change) / (largest(rates) + floor);
    return size + reach;
}

/* Try a step; in terms of the viscous impulse where the film rules, else of the gap. 0 if the
   stages cannot be solved and a smaller step is to be tried. */
int ck_attempt(const ck_problem *p, double dt, ck_step *taken) {
    /* The film rules if it takes the speed away within the step: dt > m/c. */
    int rules = -p->net_by_speed * dt > p->mass && p->exponent > 0.0, iteration, i;
    double s = rules ? p->exponent - 1.0 : -1.0, size, rates[3];
    double floor = p->scale / p->begin.gap < 1e-6 / dt ? p->scale / p->begin.gap : 1e-6 / dt;
    int known;
    size = guess(p, dt, s, floor, rates);
    known = size > 0.0;
    for (iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
        stage at[3];
        double residual[3], matrix[3][3], change[3], previous = size;
        double sure = 1.0; /* by how much the next change would be smaller than this one */
        int met, stalled;
        if (!place_stages(p, dt, s, rates, at)) return 0;
        for (i = 0; i < 3; i++)
            ck_forces_at(p->acting, at[i].at.gap, at[i].at.speed, &at[i].forces);
        if (p->cavity && !with_cavity(p, dt, at, &taken->hollow)) return 0;
        for (i = 0; i < 3; i++) {
            evaluate(p, &at[i]);
            if (!isfinite(at[i].net)) return 0;
        }
        build(p, dt, at, residual, matrix);
        if (!solve3(matrix, residual, change)) return 0;
        for (i = 0; i < 3; i++) rates[i] -= change[i];
        size = largest(change) / (largest(rates) + floor);
        if (isnan(size)) return 0;
        if (known && size < previous) {
            /* Where forces are smooth the iteration converges with its square. */
            sure = size / previous;
            if (!has_limits(p) && sure < 0.1) sure *= 10.0 * sure;
        }
        known = 1;
        /* 0.03 of the tolerance: an error of the iteration must not show in that of the step. */
        met = sure * size <= 0.03 * p->rtol && is_small(p, dt, at, residual, p->rtol / sure);
        stalled = iteration > 1 && size < 1e-6 && size >= previous; /* at round-off */
        if (met || (stalled && is_small(p, dt, at, residual, 1e-7))) {
            taken->iterations = iteration + 1;
            return finish(p, dt, s, rates, at, taken);
        }
        if (iteration > 5 && size > previous) return 0;
    }
    return 0;
}

/* Error of the viscous impulse over what it is so far. */
static double impulse_error(const ck_problem *p, const ck_step *taken, double length) {
    double wrong = p->viscous, grown = 0.0, least = -TRAVEL * p->net_by_speed * p->begin.gap;
    int i;
    if (!(p->net_by_speed < 0.0)) return 0.0;
    for (i = 0; i < 3; i++) {
        wrong -= BACK[i] * taken->forces[i].viscous;
        grown += length * fabs(taken->forces[i].viscous) / 3.0;
    }
    return length * fabs(wrong) / (held_by(p, length, &taken->forces[2]) * (p->taken + grown + least));
}

/* Error of a step over its tolerance: of the gap, of the momentum delivered so far, of the speed
   and of the viscous impulse. What the nodes miss of the impulse of the pull is nothing, as that is linear in time. */
double ck_error(const ck_problem *p, const ck_step *taken, double length) {
    double end = fabs(taken->stages[2].speed), wrong, speed;
    double momentum = p->mass * end + p->delivered + p->size * length, worst;
    wrong = ck_larger(p->mass * taken->speed_error,
                      -p->net_by_speed * p->begin.gap * taken->gap_error);
    /* A mass that the film leads has no momentum to speak of; its speed is an output all the same. */
    speed = taken->speed_error / (end + p->scale);
    worst = ck_larger(taken->gap_error, wrong / momentum);
    if (p->cavity) worst = ck_larger(worst, taken->hollow.error);
    worst = ck_larger(worst, IMPULSE * impulse_error(p, taken, length));
    return ck_larger(worst, speed) / p->rtol;
}
