/* Impact of a spring tip on a site that deforms, and rest on it. As
   models/micromirror/tip_impact.py, operation by operation. */

#include "root.h"
#include "step_size.h"
#include "tip.h"

#include <math.h>

/* Halvings of an unloading curve towards its end, in which its work is summed: the force ends there like
   a power 3/2, and 2^-30 of the curve holds 1e-22 of the work. */
#define PARTS 30
#define SAME 1e-12          /* depths closer than this, relatively, are one */
#define SAME_FRACTION 1e-13 /* of a step: times closer than this are one */
#define GROW 5.0            /* as in tip_impact.py, as what follows */
#define UNSOLVED 0.1

/* Depth, speed, impulse of the spring, and work of the damping. */
enum { DEPTH, SPEED, IMPULSE, DAMPED, UNKNOWNS };

/* Dormand and Prince, order 5 with an error of order 4. */
static const double NODES[5] = {0.2, 0.3, 0.8, 8.0 / 9.0, 1.0};
static const double ROWS[5][5] = {
    {0.2, 0.0, 0.0, 0.0, 0.0},
    {3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0},
    {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0},
    {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0},
    {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0}};
static const double LAST[6] = {35.0 / 384.0,    0.0, 500.0 / 1113.0, 125.0 / 192.0,
                               -2187.0 / 6784.0, 11.0 / 84.0};
static const double ERROR[7] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                                -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};

/* Gauss-Legendre on (0, 1), eight points. */
static const double PLACES[8] = {0.019855071751231856, 0.10166676129318658, 0.2372337950418355,
                                 0.4082826787521751,   0.5917173212478248,  0.7627662049581645,
                                 0.8983332387068135,   0.9801449282487682};
static const double WEIGHTS[4] = {0.05061426814518809, 0.11119051722668723, 0.1568533229389437,
                                  0.181341891689181};

static double larger(double a, double b) { return a > b ? a : b; }
static double smaller(double a, double b) { return a < b ? a : b; }

static double force_at(const ck_site *site, double depth, double largest, double *slope) {
    *slope = 0.0;
    return depth > 0.0 ? ck_faces_force(site->faces, depth, largest, slope) : 0.0;
}

static void rates(const ck_site *site, double largest, double time, const double state[UNKNOWNS],
                  double found[UNKNOWNS]) {
    double unused, speed = state[SPEED], force = force_at(site, state[DEPTH], largest, &unused);
    double spring = site->stiffness * (ck_root_height(&site->root, time) + state[DEPTH]);
    double held = force * larger(1.0 + site->damping * speed, 0.0);
    found[DEPTH] = speed;
    found[SPEED] = (site->attraction - spring - held) / site->mass;
    found[IMPULSE] = spring;
    found[DAMPED] = (held - force) * speed;
}

static void combine(const double begin[UNKNOWNS], double slopes[7][UNKNOWNS], const double *weights,
                    int count, double length, double found[UNKNOWNS]) {
    int i, k;
    for (k = 0; k < UNKNOWNS; k++) found[k] = begin[k];
    for (i = 0; i < count; i++)
        for (k = 0; k < UNKNOWNS; k++) found[k] += weights[i] * length * slopes[i][k];
}

static const double NOTHING[UNKNOWNS] = {0.0, 0.0, 0.0, 0.0};

/* Where an impact stands, for the steps of its motion. */
static void begin_of(const ck_impact *here, double found[UNKNOWNS]) {
    found[DEPTH] = here->depth, found[SPEED] = here->speed, found[IMPULSE] = found[DAMPED] = 0.0;
}

/* Take one step: where it ends, and its error. */
static void take(const ck_site *site, const ck_impact *here, double length, double end[UNKNOWNS],
                 double error[UNKNOWNS]) {
    double slopes[7][UNKNOWNS], begin[UNKNOWNS], at[UNKNOWNS];
    int i;
    begin_of(here, begin);
    rates(site, here->largest, here->time, begin, slopes[0]);
    for (i = 0; i < 5; i++) {
        combine(begin, slopes, ROWS[i], i + 1, length, at);
        rates(site, here->largest, here->time + NODES[i] * length, at, slopes[i + 1]);
    }
    combine(begin, slopes, LAST, 6, length, end);
    rates(site, here->largest, here->time + length, end, slopes[6]);
    combine(NOTHING, slopes, ERROR, 7, length, error);
}

static double first_length(const ck_site *site, const ck_impact *begin) {
    double slope, swing;
    force_at(site, begin->depth, begin->largest, &slope);
    swing = sqrt(site->mass / (slope + site->stiffness));
    if (slope == 0.0 && begin->speed != 0.0)
        return smaller(0.05 * swing, 0.1 * site->faces->first.begin / fabs(begin->speed));
    return 0.05 * swing;
}

/* A step that meets the tolerance: its length, and that of the next; 0 if there is none. */
static double accepted(const ck_site *site, const ck_impact *here, double length, double rtol,
                       double end[UNKNOWNS], double *following) {
    double error[UNKNOWNS];
    while (length > 1e-15 * larger(fabs(here->time), 1e-15)) {
        double swift, far, ratio = 0.0;
        take(site, here, length, end, error);
        swift = larger(fabs(here->speed), larger(fabs(end[SPEED]), fabs(end[SPEED] - here->speed)));
        far = larger(fabs(end[DEPTH] - here->depth), swift * length);
        if (swift != 0.0) ratio = larger(fabs(error[SPEED]) / swift, fabs(error[DEPTH]) / far) / rtol;
        if (isnan(error[SPEED] + error[DEPTH])) ratio = HUGE_VAL;
        if (ratio <= 1.0) {
            double grown = ratio <= pow(CK_SAFETY / GROW, 5.0) ? GROW : CK_SAFETY * pow(ratio, -0.2);
            *following = length * grown;
            return length;
        }
        length *= ratio < HUGE_VAL ? larger(CK_SHRINK, CK_SAFETY * pow(ratio, -0.2)) : UNSOLVED;
    }
    return 0.0;
}

/* Depth or speed over a level, at a fraction of a step. */
typedef struct {
    const ck_site *site;
    const ck_impact *here;
    double length, level;
    int what;
} crossing;

static double over(double fraction, const void *given) {
    const crossing *c = given;
    double end[UNKNOWNS], error[UNKNOWNS];
    take(c->site, c->here, fraction * c->length, end, error);
    return end[c->what] - c->level;
}

/* End a step where the tip is deepest, or where the faces detach. */
static double shortened(const ck_site *site, const ck_impact *here, double length,
                        double reached[UNKNOWNS]) {
    double out = ck_faces_residual(site->faces, here->largest), error[UNKNOWNS];
    crossing c = {site, here, length, 0.0, SPEED};
    if (!(here->speed > 0.0 && reached[SPEED] <= 0.0)) {
        if (!(reached[SPEED] < 0.0 && reached[DEPTH] < out && out < here->depth)) return length;
        c.what = DEPTH, c.level = out;
    }
    length *= ck_root_between(over, &c, 0.0, 1.0, SAME_FRACTION);
    take(site, here, length, reached, error);
    reached[c.what] = c.level;
    return length;
}

/* Elastic work of unloading from an approach, after the maximum. */
static double rebound_work(const ck_site *site, double depth, double largest) {
    double begin = ck_faces_residual(site->faces, largest), length = depth - begin, total = 0.0;
    double width = log(2.0), a = length;
    int i, k;
    if (!(length > 0.0)) return 0.0;
    for (i = 0; i < PARTS; i++) {
        double sum = 0.0, unused;
        a *= 0.5;
        for (k = 0; k < 8; k++) {
            double x = a * exp(width * PLACES[k]), weight = WEIGHTS[k < 4 ? k : 7 - k];
            sum += weight * x * force_at(site, begin + x, largest, &unused);
        }
        total += width * sum;
    }
    return total;
}

/* Energy at an approach, over that where the faces detach. */
static double stored(const ck_site *site, const ck_impact *now, double at) {
    double out = ck_faces_residual(site->faces, now->largest);
    double height = ck_root_height(&site->root, now->time);
    double spring = site->stiffness * (height + 0.5 * (at + out));
    return rebound_work(site, at, now->largest) - (site->attraction - spring) * (at - out);
}

int ck_is_too_deep(const ck_faces *faces, double depth) {
    return !(depth <= faces->first.end * (1.0 + SAME));
}

double ck_rest_depth(const ck_site *site, double largest, double time) {
    double together = site->attraction / site->stiffness - ck_root_height(&site->root, time);
    double depth = ck_faces_pressed(site->faces, together, largest, site->stiffness).approach;
    depth = larger(depth, ck_faces_residual(site->faces, largest));
    return ck_is_too_deep(site->faces, depth) ? depth : smaller(depth, site->faces->first.end);
}

/* At the deepest point: remember it, and rest if there is not the energy to come out. */
static int turned(const ck_site *site, ck_impact *now) {
    double largest = larger(now->largest, now->depth), rest;
    double work = ck_faces_dissipated(site->faces, largest);
    work -= ck_faces_dissipated(site->faces, now->largest);
    now->largest = largest, now->dissipated += larger(work, 0.0);
    if (stored(site, now, now->depth) > 0.0) return CK_HIT;
    rest = ck_rest_depth(site, largest, now->time);
    if (!ck_is_too_deep(site->faces, rest))
        now->dissipated += larger(stored(site, now, now->depth) - stored(site, now, rest), 0.0);
    now->depth = rest, now->speed = 0.0, now->end = CK_AT_REST;
    return ck_is_too_deep(site->faces, rest) ? CK_TOO_DEEP : CK_HIT;
}

/* State at the end of a step, and whether the impact is over. */
static int moved(const ck_site *site, ck_impact *here, double length, const double reached[UNKNOWNS]) {
    double force, unused, came = here->speed, out = ck_faces_residual(site->faces, here->largest);
    here->time += length, here->depth = reached[DEPTH], here->speed = reached[SPEED];
    if (ck_is_too_deep(site->faces, here->depth)) return CK_TOO_DEEP;
    force = force_at(site, here->depth, here->largest, &unused);
    force *= larger(1.0 + site->damping * here->speed, 0.0);
    here->impulse += reached[IMPULSE], here->dissipated += reached[DAMPED];
    here->depth = smaller(here->depth, site->faces->first.end);
    here->peak = larger(here->peak, force);
    if (came > 0.0 && here->speed == 0.0) return turned(site, here);
    /* A tip that came and was drawn off before it pressed has nothing to turn at. */
    if (here->speed < 0.0 && here->depth <= out) here->depth = out, here->end = CK_OFF;
    return CK_HIT;
}

int ck_follow_impact(const ck_site *site, ck_impact *here, double end, double rtol, int64_t most) {
    double length, following = 0.0, reached[UNKNOWNS];
    int trouble;
    here->end = CK_GOES_ON;
    length = first_length(site, here);
    for (here->steps = 0; here->steps < most; here->steps++) {
        double left = end - here->time;
        if (left <= 1e-15 * fabs(end) || here->end != CK_GOES_ON) return CK_HIT;
        length = accepted(site, here, smaller(length, left), rtol, reached, &following);
        if (!(length > 0.0)) return CK_NO_HIT_STEP;
        length = shortened(site, here, length, reached);
        trouble = moved(site, here, length, reached);
        if (trouble) return trouble;
        length = following;
    }
    return CK_TOO_MANY_HIT_STEPS;
}
