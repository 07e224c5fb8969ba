/* Force of a film whose viscosity follows pressure and shear; see rheology.h.

   The logarithms of the ratios are splines of degree five over ln h and the logarithm of the speed, over a
   unit of its own at each gap. Their knots are evenly spaced, so that no search is needed, and one number
   is kept for each. */

#include "rheology.h"

#include <math.h>

#define DEGREE 5 /* of the splines, as in fmu/native/ratios.py */
#define EDGE 1e-9 /* of ln h: within an end of a table, on the near side of round-off */
#define NEAR 0.5 /* of the fastest speed, from which on that is what stands against a step */

/* What a ratio is at a gap and a speed: a logarithm, and its slopes by the logarithm of the speed and by
   the gap. */
typedef struct {
    double value, by_speed, by_gap;
} logarithm;

/* Splines that act between two knots at a fraction t, and their slopes by t. */
static void weights(double t, double w[DEGREE + 1], double s[DEGREE + 1]) {
    double u = 1.0 - t, t2 = t * t, u2 = u * u;
    w[0] = u2 * u2 * u / 120.0;
    w[1] = (26.0 + t * (-50.0 + t * (20.0 + t * (20.0 + t * (-20.0 + t * 5.0))))) / 120.0;
    w[2] = (66.0 + t2 * (-60.0 + t2 * (30.0 - t * 10.0))) / 120.0;
    w[3] = (26.0 + t * (50.0 + t * (20.0 + t * (-20.0 + t * (-20.0 + t * 10.0))))) / 120.0;
    w[4] = (1.0 + t * (5.0 + t * (10.0 + t * (10.0 + t * (5.0 - t * 5.0))))) / 120.0;
    w[5] = t2 * t2 * t / 120.0;
    s[0] = -u2 * u2 / 24.0;
    s[1] = (-10.0 + t * (8.0 + t * (12.0 + t * (-16.0 + t * 5.0)))) / 24.0;
    s[2] = t * (-24.0 + t2 * (24.0 - t * 10.0)) / 24.0;
    s[3] = (10.0 + t * (8.0 + t * (-12.0 + t * (-16.0 + t * 10.0)))) / 24.0;
    s[4] = (1.0 + t * (4.0 + t * (6.0 + t * (4.0 - t * 5.0)))) / 24.0;
    s[5] = t2 * t2 / 24.0;
}

/* First of the coefficients that act at a place, which stays within the knots, and the fraction there. */
static int knot(double place, int count, double *t) {
    int last = count - DEGREE - 1, first;
    if (!(place > 0.0)) place = 0.0;
    first = place < last ? (int)place : last;
    *t = place - first < 1.0 ? place - first : 1.0;
    return first;
}

static void spline(const ck_ratio *f, double y, double x, logarithm *found, double *by_y) {
    double wy[DEGREE + 1], sy[DEGREE + 1], wx[DEGREE + 1], sx[DEGREE + 1], t, place;
    double rows = f->gaps - DEGREE;
    int row, first, i, k;
    place = (y - f->first_gap) * f->per_gap;
    row = knot(place, f->gaps, &t);
    weights(t, wy, sy);
    first = knot((x - f->first_speed) * f->per_speed, f->speeds, &t);
    weights(t, wx, sx);
    found->value = found->by_speed = *by_y = 0.0;
    for (i = 0; i <= DEGREE; i++) {
        const double *c = f->coefficient + (row + i) * f->speeds + first;
        double sum = 0.0, slope = 0.0;
        for (k = 0; k <= DEGREE; k++) sum += wx[k] * c[k], slope += sx[k] * c[k];
        found->value += wy[i] * sum, found->by_speed += wy[i] * slope, *by_y += sy[i] * sum;
    }
    found->by_speed *= f->per_speed;
    *by_y = place < 0.0 || place > rows ? 0.0 : *by_y * f->per_gap; /* beyond its gaps it stays */
}

/* Minus the logarithm of the unit of the speed at a gap, and its slope; beyond the table it goes on as a
   power of the gap, as that of flats is. */
static double unit_at(const ck_ratio *f, double gap, double log_gap, double *by_gap) {
    double low = f->first_gap, high = low + (f->gaps - DEGREE) / f->per_gap, edge, found, slope;
    if (low <= log_gap && log_gap <= high) return ck_table_at(&f->unit, gap, log_gap, by_gap);
    edge = log_gap < low ? low + EDGE : high - EDGE;
    found = ck_table_at(&f->unit, exp(edge), edge, &slope);
    slope *= exp(edge);
    *by_gap = slope / gap;
    return found + slope * (log_gap - edge);
}

/* Logarithm of a speed over its unit, or of r/(1 - r) for a speed r of the fastest; its slopes by the
   logarithm of the speed and by the gap. nan beyond the fastest. */
static double place_of(const ck_ratio *f, double gap, double log_gap, double log_speed,
                       double *by_speed, double *by_gap) {
    double x = log_speed + unit_at(f, gap, log_gap, by_gap);
    *by_speed = 1.0;
    if (!f->has_pole) return x;
    if (!(x < 0.0)) return NAN;
    *by_speed = -1.0 / expm1(x);
    *by_gap *= *by_speed;
    return x - log(-expm1(x));
}

/* A ratio at a gap and a speed; 0 if that is slower than its slowest. Beyond its fastest it is nan. */
static int ratio_at(const ck_ratio *f, double gap, double log_gap, double log_speed, logarithm *found) {
    double x_by_speed, x_by_gap, by_y;
    double x = place_of(f, gap, log_gap, log_speed, &x_by_speed, &x_by_gap);
    int known = x > f->first_speed;
    spline(f, log_gap, known ? x : f->first_speed, found, &by_y);
    if (!known && x <= f->first_speed) {
        double left = exp(f->fade * (x - f->first_speed));
        found->value *= left, by_y *= left;
        found->by_speed = f->fade * found->value;
    }
    if (!(x <= f->end)) found->value = NAN;
    found->by_gap = by_y / gap + found->by_speed * x_by_gap;
    found->by_speed *= x_by_speed;
    return known;
}

static const ck_stretch *stretch_at(const ck_rheology *rheology, double gap) {
    const ck_stretch *found = rheology->stretches, *last = found + rheology->n_stretches - 1;
    while (found < last && gap >= found->high) found++;
    return found;
}

/* Logarithm of the speed at which the viscosity that the tables were made of has the same stresses. */
static double log_of(const ck_acting *a, double speed) {
    const ck_rheology *r = a->rheology;
    return log(fabs(speed) * (r->scaling == CK_SCALING_STRESS ? a->viscosity / r->viscosity : 1.0));
}

static const ck_ratio *full_ratio(const ck_stretch *s, double speed) {
    return speed < 0.0 && s->has_closing ? &s->closing : &s->opening;
}

void ck_rheological_force(const ck_acting *a, double gap, double log_gap, double speed, double liquid,
                          double liquid_by_gap, ck_forces *found) {
    const ck_stretch *s = stretch_at(a->rheology, gap);
    double log_speed = log_of(a, speed), force, by_gap, by_speed;
    logarithm full, left;
    ratio_at(full_ratio(s, speed), gap, log_gap, log_speed, &full);
    liquid_by_gap = exp(full.value) * (liquid_by_gap + liquid * full.by_gap);
    liquid *= exp(full.value);
    force = liquid * speed, by_gap = liquid_by_gap * speed, by_speed = liquid * (1.0 + full.by_speed);
    if (speed > 0.0 && s->has_cavity && ratio_at(&s->cavity, gap, log_gap, log_speed, &left)) {
        double rest = exp(left.value);
        by_gap = rest * (by_gap + force * left.by_gap);
        by_speed = rest * (by_speed + liquid * left.by_speed);
        force *= rest;
        found->limit = CK_LIMIT_KIND_TENSION;
    }
    found->resistance = liquid + found->free;
    found->resistance_by_gap = liquid_by_gap + found->free_by_gap;
    found->viscous = force + found->free * speed;
    found->viscous_by_gap = by_gap + found->free_by_gap * speed;
    found->viscous_by_speed = by_speed + found->free;
}

double ck_rheological_reach(const ck_acting *a, double gap, double speed) {
    const ck_ratio *f;
    double ignored;
    if (!a->any || !a->rheology || speed == 0.0) return 0.0;
    f = full_ratio(stretch_at(a->rheology, gap), speed);
    /* Of a pole the unit is the fastest speed. */
    return exp(log_of(a, speed) + unit_at(f, gap, log(gap), &ignored) -
               (f->has_pole ? 0.0 : f->end));
}

const char *ck_rheological_obstacle(const ck_acting *a, double gap, double speed) {
    if (!(ck_rheological_reach(a, gap, speed) > NEAR)) return NULL;
    if (full_ratio(stretch_at(a->rheology, gap), speed)->has_pole)
        return "the film closes nearly as fast as it can: its viscosity grows with pressure without bound, "
               "and no pressure drives the liquid out; close more slowly, or build the FMU with "
               "RoelandsViscosity, which grows less";
    return "the film moves nearly as fast as its tables hold; move it more slowly";
}
