/* What a liquid cannot carry: tension below a pressure, shear above a strength.

   The same closed forms as contactkit/lubrication/film_limits.py; the height of a film under a sphere
   is given as its thickness above the gap. The slopes of what is left follow from that the profiles
   are continuous where the limit begins: moving that place changes nothing to first order. */

#include "film.h"
#include "root.h"

#include <math.h>

#define ROUND_OFF 4e-16 /* of a root: two units of the last place */

static void untouched(double force, ck_left *left) {
    left->value = force, left->by_force = 1.0, left->by_gap = left->by_shape = 0.0;
}

/* `by_shape` of a disc is by its area. */
void ck_disc_tension(double force, double area, double tension, ck_left *left) {
    double cap = area * tension, fraction = 0.5 * cap / force;
    untouched(force, left);
    if (2.0 * force <= cap) return;
    left->value = cap - 0.5 * cap * fraction;
    left->by_force = fraction * fraction;
    left->by_shape = (1.0 - fraction) * tension;
}

/* given: twice the force over what the tension holds */
static double stieber(double rho, const void *given) {
    const double *s = given;
    return 1.0 - rho + rho * log(rho) - 1.0 / s[0];
}

void ck_disc_tension_reynolds(double force, double area, double tension, ck_left *left) {
    double cap = area * tension, s = 2.0 * force / cap, x, g, by_s;
    untouched(force, left);
    if (!(s > 1.0)) return;
    x = sqrt(2.0 / s);
    if (x < 1e-3) {
        g = 1.0 - x / 3.0 - x * x * x / 360.0;
        by_s = (1.0 / 3.0 + x * x / 120.0) * 0.5 * x / s;
    } else {
        double rho = ck_root_between(stieber, &s, 1e-300, 1.0, ROUND_OFF);
        double rest = 0.5 * (1.0 - rho) * (1.0 - rho) - rho * (1.0 - rho) - rho * rho * log(rho);
        g = rho + s * rest;
        by_s = rest + 1.0 / (s * s * log(rho));
    }
    left->value = cap * g;
    left->by_force = 2.0 * by_s;
    left->by_shape = tension * (g - s * by_s);
}

/* `shape` is the square of the radius. */
void ck_disc_shear(double force, double shape, double gap, double strength, ck_left *left) {
    double plastic = 2.0 * CK_PI * strength * shape * sqrt(shape) / (3.0 * gap);
    double q = 4.0 * fabs(force) / (3.0 * plastic), rest, by_plastic;
    untouched(force, left);
    if (q <= 1.0) return;
    rest = 1.0 / (q * q * q);
    by_plastic = copysign((1.0 - rest) * plastic, force);
    left->value = copysign(plastic * (1.0 - 0.25 * rest), force);
    left->by_force = 0.75 * rest * plastic / fabs(force);
    left->by_gap = -by_plastic / gap;
    left->by_shape = 1.5 * by_plastic / shape;
}

void ck_sphere_tension(double force, double radius, double gap, double shape, double tension,
                       ck_left *left) {
    double height = gap + shape, fraction = shape / height, k, per_height, cut, rest;
    double by_k, by_height, whole = 2.0 * CK_PI * radius;
    untouched(force, left);
    if (force <= 0.0 || fraction <= 0.0) return;
    k = force * gap / (whole * fraction * fraction);
    per_height = 1.0 / height;
    if (k * (1.0 / gap - per_height) * (1.0 / gap + per_height) <= tension) return;
    cut = 1.0 / sqrt(tension / k + per_height * per_height);
    rest = 1.0 - cut * per_height;
    by_k = whole * rest * rest / cut;
    by_height = 2.0 * whole * k * rest * per_height * per_height;
    left->value = whole * (cut - gap) * tension + k * by_k;
    left->by_force = by_k * k / force;
    left->by_gap = by_k * k * (1.0 / gap + 2.0 * per_height) + by_height - whole * tension;
    left->by_shape = by_height - by_k * 2.0 * k * gap * per_height / shape;
}

/* given: k, radius, gap, strength */
static double shear_excess(double r, const void *given) {
    const double *of = given;
    double height = of[2] + r * r / (2.0 * of[1]);
    return of[0] * r - of[3] * height * height;
}

static double shear_slope(double r, const void *given) {
    const double *of = given;
    double height = of[2] + r * r / (2.0 * of[1]);
    return of[0] - 2.0 * of[3] * r * height / of[1];
}

static double fraction_within(double r, double thin) { return r * r / (r * r + thin); }

static double newtonian_between(double k, double radius, double gap, double inner, double outer) {
    double thin = 2.0 * radius * gap, a = fraction_within(outer, thin), b = fraction_within(inner, thin);
    return 2.0 * CK_PI * k * radius * radius / gap * (a - b) * (a + b);
}

static double plastic_between(double strength, double radius, double gap, double inner,
                              double outer) {
    double width = sqrt(2.0 * radius * gap);
    double angle = atan2((outer - inner) * width, width * width + outer * inner);
    return 4.0 * CK_PI * strength * radius * ((outer - inner) - width * angle);
}

/* Slope of both by the gap between fixed radii. */
static double newtonian_by_gap(double k, double radius, double gap, double inner, double outer) {
    double thin = 2.0 * radius * gap, a = fraction_within(outer, thin), b = fraction_within(inner, thin);
    double rate = a * a / (outer * outer + thin) - b * b / (inner * inner + thin);
    return -newtonian_between(k, radius, gap, inner, outer) / gap -
           8.0 * CK_PI * k * radius * radius * radius / gap * rate;
}

static double plastic_by_gap(double strength, double radius, double gap, double inner,
                             double outer) {
    double thin = 2.0 * radius * gap, width = sqrt(thin);
    double angle = atan2((outer - inner) * width, thin + outer * inner);
    double rate = angle / width - outer / (outer * outer + thin) + inner / (inner * inner + thin);
    return -4.0 * CK_PI * strength * radius * radius * rate;
}

/* Where the liquid yields: from `inner` to `outer`; 0 if it does nowhere. given as above. */
static int yields(const double given[4], double rim, double *inner, double *outer) {
    double k = given[0], radius = given[1], far, peak;
    double reach = cbrt(k * radius * radius / given[3]) + k * radius / (2.0 * given[3] * given[2]);
    if (rim < reach) reach = rim;
    peak = shear_slope(reach, given) >= 0.0
               ? reach
               : ck_root_between(shear_slope, given, 0.0, reach, ROUND_OFF);
    if (!(shear_excess(peak, given) > 0.0)) return 0;
    *inner = ck_root_between(shear_excess, given, 0.0, peak, ROUND_OFF);
    for (far = peak; shear_excess(far, given) > 0.0 && far < rim;) far = 2.0 * far < rim ? 2.0 * far : rim;
    *outer = shear_excess(far, given) >= 0.0
                 ? far
                 : ck_root_between(shear_excess, given, peak, far, ROUND_OFF);
    return 1;
}

void ck_sphere_shear(double force, double radius, double gap, double shape, double strength,
                     ck_left *left) {
    double height = gap + shape, fraction = shape / height, k, rim, inner, outer, value, by_rim;
    double given[4], thin = 2.0 * radius * gap, newtonian, by_k, by_gap, sign = copysign(1.0, force);
    untouched(force, left);
    if (force == 0.0 || fraction <= 0.0) return;
    k = fabs(force) * gap / (2.0 * CK_PI * radius * radius * fraction * fraction);
    rim = sqrt(2.0 * radius * shape);
    given[0] = k, given[1] = radius, given[2] = gap, given[3] = strength;
    if (!yields(given, rim, &inner, &outer)) return;
    newtonian = newtonian_between(k, radius, gap, 0.0, inner) +
                newtonian_between(k, radius, gap, outer, rim);
    value = newtonian + plastic_between(strength, radius, gap, inner, outer);
    if (!(value < fabs(force))) return;
    by_k = newtonian / k;
    by_gap = newtonian_by_gap(k, radius, gap, 0.0, inner) +
             plastic_by_gap(strength, radius, gap, inner, outer) +
             newtonian_by_gap(k, radius, gap, outer, rim);
    by_rim = outer < rim ? 8.0 * CK_PI * k * radius * radius / gap * fraction_within(rim, thin) * rim *
                               thin / ((rim * rim + thin) * (rim * rim + thin))
                         : 4.0 * CK_PI * strength * radius * fraction_within(rim, thin);
    left->value = sign * value;
    left->by_force = by_k * k / fabs(force);
    left->by_gap = sign * (by_gap + by_k * k * (1.0 / gap + 2.0 / height));
    left->by_shape = sign * (by_rim * radius / rim - by_k * 2.0 * k * gap / (height * shape));
}
