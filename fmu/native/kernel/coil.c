/* Flux, current and force of the coil: as models/injector/coil.py, operation by operation. The
   lengths of the steps hang on rounding where they are as long as they can be, so the same bits in
   mean the same bits out, and anything else the tolerance. */

#include "drive.h"
#include "step_size.h"

#include <float.h>
#include <math.h>

#define MOST_STEPS 100000 /* for one voltage: then the motion given is no motion */
#define RTOL 1e-11        /* of the flux: far below what an extrapolated gap is worth */
#define KNEE 8.0          /* how sharply the iron saturates: see models/injector/coil.py */

/* As Python's max(value, 0.0): nan stays, for others to find. */
static double at_least_zero(double value) { return 0.0 > value ? 0.0 : value; }

/* Length of air that resists as the iron that is not saturated. */
static double reluctance(const ck_coil *coil, double gap) {
    return 2.0 * at_least_zero(coil->air_gap - gap) + coil->iron_gap;
}

/* Additional resistance of the saturated iron, over that of the iron. */
static double crowding(const ck_coil *coil, double flux) {
    return pow(flux / coil->knee, KNEE);
}

double ck_coil_current(const ck_coil *coil, double flux, double gap) {
    return flux * (reluctance(coil, gap) + coil->iron_gap * crowding(coil, flux)) / coil->pole;
}

double ck_coil_current_by_gap(const ck_coil *coil, double flux, double gap) {
    return gap < coil->air_gap ? -2.0 * flux / coil->pole : 0.0;
}

double ck_coil_force(const ck_coil *coil, double flux) { return flux * flux / coil->pole; }

/* What does not change in a time under one voltage. */
typedef struct {
    const ck_coil *coil;
    double voltage, fall, gap, speed;
} problem;

static double rate(const problem *p, double flux, double gap) {
    double air = at_least_zero(2.0 * p->coil->air_gap - 2.0 * gap);
    double iron = p->coil->iron_gap * (1.0 + crowding(p->coil, flux));
    return p->voltage - p->fall * flux * (air + iron);
}

/* One classical Runge-Kutta step from a time since the start. Explicit: the time constant of the coil
   is that of the current that is wanted, so that nothing here is stiff. The error is that of two
   halves against the whole, and is taken out (order 5). */
static double runge_kutta(const problem *p, double flux, double time, double step) {
    double gap = p->gap + p->speed * time, half = 0.5 * step, middle = gap + 0.5 * p->speed * step;
    double k1 = rate(p, flux, gap), k2 = rate(p, flux + half * k1, middle);
    double k3 = rate(p, flux + half * k2, middle);
    double k4 = rate(p, flux + step * k3, gap + p->speed * step);
    return flux + step * (k1 + 2.0 * (k2 + k3) + k4) / 6.0;
}

/* How much longer the next step may be. */
static double growth(double error) {
    double by = CK_SAFETY * pow(error > 1e-12 ? error : 1e-12, -0.2);
    return by < CK_SHRINK ? CK_SHRINK : by > 4.0 ? 4.0 : by;
}

double ck_coil_advance(const ck_coil *coil, double *flux, double gap, double speed, double voltage,
                       double duration, long *budget) {
    problem p = {coil, voltage, coil->resistance / coil->pole, gap, speed};
    double time = 0.0, length = 0.5 * coil->pole / reluctance(coil, gap) / coil->resistance;
    double scale = RTOL * (*flux + fabs(voltage) * duration);
    int i;
    if (!(scale >= DBL_MIN)) scale = DBL_MIN;
    if (*flux <= 0.0 && voltage <= 0.0) { /* the diode blocks */
        *flux = 0.0;
        return duration;
    }
    for (i = 0; i < MOST_STEPS && (*budget)-- > 0; i++) {
        double whole, halves, error, half;
        if (time >= duration) return duration;
        if (!(length <= duration - time)) length = duration - time;
        half = 0.5 * length;
        whole = runge_kutta(&p, *flux, time, length);
        halves = runge_kutta(&p, runge_kutta(&p, *flux, time, half), time + half, half);
        error = fabs(halves - whole) / (15.0 * scale);
        if (error <= 1.0) {
            *flux = halves + (halves - whole) / 15.0, time += length;
            if (*flux <= 0.0 && voltage <= 0.0) {
                *flux = 0.0;
                return duration;
            }
            if (time >= duration) return duration;
        }
        length *= growth(error < 1e300 ? error : 1e5);
        if (time + length == time) break;
    }
    return time;
}
