/* What a liquid cannot carry: tension below a pressure, shear above a strength.

   The same closed forms as contactkit/kernels/film_limits.py; the height of a film under a sphere
   is given as its thickness above the gap. */

#include "film.h"

#include <math.h>

#define CK_PI 3.14159265358979323846

typedef double (*ck_curve)(double at, const double *given);

/* Root of a continuous curve between two points of opposite sign: Illinois false position,
   halved whenever it does not halve the bracket in three evaluations. */
static double root_of(ck_curve curve, const double *given, double low, double high) {
    double f_low = curve(low, given), f_high = curve(high, given), width = fabs(high - low);
    int i, since = 0;
    if (f_low == 0.0) return low;
    if (f_high == 0.0) return high;
    for (i = 0; i < 4000; i++) {
        double bottom = low < high ? low : high, top = low < high ? high : low, x, f;
        if (!(top - bottom > 4e-16 * (fabs(low) > fabs(high) ? fabs(low) : fabs(high)))) break;
        x = high - f_high * (high - low) / (f_high - f_low);
        if (++since > 2 || !(x > bottom && x < top)) {
            x = 0.5 * (low + high);
            if (x == low || x == high) break;
        }
        f = curve(x, given);
        if (f == 0.0) return x;
        if ((f > 0.0) == (f_high > 0.0)) f_low *= 0.5;
        else low = high, f_low = f_high;
        high = x, f_high = f;
        if (fabs(high - low) <= 0.5 * width) width = fabs(high - low), since = 0;
    }
    return high;
}

double ck_disc_tension(double force, double area, double tension) {
    double cap = area * tension;
    return 2.0 * force <= cap ? force : cap - 0.25 * cap * cap / force;
}

static double stieber(double rho, const double *s) {
    return 1.0 - rho + rho * log(rho) - 1.0 / s[0];
}

double ck_disc_tension_reynolds(double force, double area, double tension) {
    double cap = area * tension, s = 2.0 * force / cap, x, rho, rest;
    if (!(s > 1.0)) return force;
    x = sqrt(2.0 / s);
    if (x < 1e-3) return cap * (1.0 - x / 3.0 - x * x * x / 360.0);
    rho = root_of(stieber, &s, 1e-300, 1.0);
    rest = 0.5 * (1.0 - rho) * (1.0 - rho) - rho * (1.0 - rho) - rho * rho * log(rho);
    return cap * (rho + s * rest);
}

double ck_disc_shear(double force, double radius, double gap, double strength) {
    double plastic = 2.0 * CK_PI * strength * radius * radius * radius / (3.0 * gap);
    double q = 4.0 * fabs(force) / (3.0 * plastic);
    return q <= 1.0 ? force : copysign(plastic * (1.0 - 0.25 / (q * q * q)), force);
}

double ck_sphere_tension(double force, double radius, double gap, double thickness, double tension) {
    double height = gap + thickness, share = thickness / height, k, per_height, cut, left;
    if (force <= 0.0 || share <= 0.0) return force;
    k = force * gap / (2.0 * CK_PI * radius * share * share);
    per_height = 1.0 / height;
    if (k * (1.0 / gap - per_height) * (1.0 / gap + per_height) <= tension) return force;
    cut = 1.0 / sqrt(tension / k + per_height * per_height);
    left = 1.0 - cut * per_height;
    return 2.0 * CK_PI * radius * ((cut - gap) * tension + k / cut * left * left);
}

/* given: k, radius, gap, strength */
static double shear_excess(double r, const double *given) {
    double height = given[2] + r * r / (2.0 * given[1]);
    return given[0] * r - given[3] * height * height;
}

static double shear_slope(double r, const double *given) {
    double height = given[2] + r * r / (2.0 * given[1]);
    return given[0] - 2.0 * given[3] * r * height / given[1];
}

static double share_within(double r, double thin) { return r * r / (r * r + thin); }

static double newtonian_between(double k, double radius, double gap, double inner, double outer) {
    double thin = 2.0 * radius * gap, a = share_within(outer, thin), b = share_within(inner, thin);
    return 2.0 * CK_PI * k * radius * radius / gap * (a - b) * (a + b);
}

static double plastic_between(double strength, double radius, double gap, double inner,
                              double outer) {
    double width = sqrt(2.0 * radius * gap);
    double angle = atan2((outer - inner) * width, width * width + outer * inner);
    return 4.0 * CK_PI * strength * radius * ((outer - inner) - width * angle);
}

double ck_sphere_shear(double force, double radius, double gap, double thickness, double strength) {
    double share = thickness / (gap + thickness), k, rim, reach, peak, inner, outer, far, left;
    double given[4];
    if (force == 0.0 || share <= 0.0) return force;
    k = fabs(force) * gap / (2.0 * CK_PI * radius * radius * share * share);
    rim = sqrt(2.0 * radius * thickness);
    given[0] = k, given[1] = radius, given[2] = gap, given[3] = strength;
    reach = cbrt(k * radius * radius / strength) + k * radius / (2.0 * strength * gap);
    if (rim < reach) reach = rim;
    peak = shear_slope(reach, given) >= 0.0 ? reach : root_of(shear_slope, given, 0.0, reach);
    if (!(shear_excess(peak, given) > 0.0)) return force;
    inner = root_of(shear_excess, given, 0.0, peak);
    for (far = peak; shear_excess(far, given) > 0.0 && far < rim;) far = 2.0 * far < rim ? 2.0 * far : rim;
    outer = shear_excess(far, given) >= 0.0 ? far : root_of(shear_excess, given, peak, far);
    left = newtonian_between(k, radius, gap, 0.0, inner) +
           plastic_between(strength, radius, gap, inner, outer) +
           newtonian_between(k, radius, gap, outer, rim);
    return copysign(left < fabs(force) ? left : fabs(force), force);
}
