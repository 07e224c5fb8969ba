/* Rough faces of an end stop, and the spring behind them: as contactkit/analyses/load_displacement/curve.py and
   impact.py, from tables of nodes, values and slopes (fmu/native/faces.py). */

#include "drive.h"

#include <math.h>

#define ROUNDS 100 /* as many bisections reach round-off from any bracket; Newton takes some five */
#define CLOSE 1e-13 /* of the approach: digits that a curve through tabulated values has */
#define SAME 1e-12 /* approaches closer than this, relatively, are one */

/* Piece in which a number lies, between the first and the last node. */
static int piece_of(const ck_curve *curve, double x) {
    int low = 0, high = curve->n_nodes - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (x < curve->x[middle]) high = middle;
        else low = middle;
    }
    return low;
}

/* Value of a curve and its slope; constant beyond both ends. */
static double plain(const ck_curve *curve, double x, double *by_x) {
    int last = curve->n_nodes - 1, i;
    double h, t, rise, bend, twist, value, begin, end;
    *by_x = 0.0;
    if (x < curve->x[0]) return curve->y[0];
    if (x > curve->x[last]) return curve->y[last];
    i = piece_of(curve, x);
    begin = curve->slope[i], end = curve->slope[i + 1];
    h = curve->x[i + 1] - curve->x[i], t = x - curve->x[i];
    rise = (curve->y[i + 1] - curve->y[i]) / h;
    bend = (3.0 * rise - 2.0 * begin - end) / h, twist = (begin + end - 2.0 * rise) / (h * h);
    value = curve->y[i] + t * (begin + t * (bend + t * twist));
    *by_x = begin + t * (2.0 * bend + 3.0 * t * twist);
    if (*by_x < 0.0) *by_x = 0.0;
    if (value < curve->y[0]) return curve->y[0];
    return value > curve->y[last] ? curve->y[last] : value;
}

/* The same of a curve in logarithms: a power law before the first node, the tangent after the
   last, zero up to zero. */
static double power(const ck_power_curve *curve, double x, double *by_x) {
    const double *slopes = curve->log.slope;
    double value, slope;
    *by_x = 0.0;
    if (x <= 0.0) return 0.0;
    if (x <= curve->begin) {
        value = curve->low * pow(x / curve->begin, slopes[0]);
        *by_x = slopes[0] * value / x;
        return value;
    }
    if (x >= curve->end) {
        *by_x = slopes[curve->log.n_nodes - 1] * curve->high / curve->end;
        return curve->high + *by_x * (x - curve->end);
    }
    value = exp(plain(&curve->log, log(x), &slope));
    *by_x = slope * value / x;
    return value;
}

/* Value of an unloading curve over that at its maximum approach, at a fraction of the length of the
   curve; before all others comes the loading curve up to the elastic limit. */
static double unloading_curve(const ck_faces *faces, int of_area, int i, double fraction,
                              double *by_fraction) {
    const ck_power_curve *first = of_area ? &faces->area : &faces->first;
    double value, whole, unused;
    if (i >= 0) {
        const ck_unloading *one = &faces->unloading[i];
        return power(of_area ? &one->area : &one->force, fraction, by_fraction);
    }
    value = power(first, fraction * faces->limit, by_fraction);
    whole = power(first, faces->limit, &unused);
    *by_fraction *= faces->limit / whole;
    return value / whole;
}

static double end_of(const ck_faces *faces, int i) {
    return i >= 0 ? faces->unloading[i].end : faces->limit;
}

/* Unloading from a maximum approach: the solved curves on both sides of it, and how they mix. */
typedef struct {
    double residual, length, t;
    int low, high;
} mixture;

static mixture mixed(const ck_faces *faces, double largest) {
    int lowest = faces->limit > 0.0 ? -1 : 0, high = lowest;
    mixture m;
    m.residual = ck_faces_residual(faces, largest), m.length = largest - m.residual, m.t = 0.0;
    while (high < faces->n_unloading && end_of(faces, high) <= largest) high++;
    m.low = high > lowest ? high - 1 : lowest;
    m.high = high < faces->n_unloading && high > lowest ? high : m.low;
    if (m.high > m.low)
        m.t = log(largest / end_of(faces, m.low)) / log(end_of(faces, m.high) / end_of(faces, m.low));
    return m;
}

/* Value on unloading over that at the maximum approach, and its slope by the approach; of the force,
   or of the area of contact. */
static double unloading(const ck_faces *faces, int of_area, const mixture *m, double approach,
                        double *by_approach) {
    double fraction = (approach - m->residual) / m->length, value, slope, other, by_other;
    *by_approach = 0.0;
    if (fraction <= 0.0) return 0.0;
    value = unloading_curve(faces, of_area, m->low, fraction, &slope);
    if (m->high > m->low) {
        other = unloading_curve(faces, of_area, m->high, fraction, &by_other);
        value = (1.0 - m->t) * value + m->t * other, slope = (1.0 - m->t) * slope + m->t * by_other;
    }
    *by_approach = slope / m->length;
    return value;
}

double ck_faces_force(const ck_faces *faces, double approach, double largest, double *slope) {
    double first, force, whole, by_approach, unused, most = faces->first.end;
    mixture m;
    if (largest > most) largest = most;
    first = power(&faces->first, approach, slope);
    if (!faces->n_unloading || approach >= largest || largest <= faces->limit) return first;
    m = mixed(faces, largest);
    whole = power(&faces->first, largest, &unused);
    force = whole * unloading(faces, 0, &m, approach, &by_approach);
    if (force > first) return first; /* interpolated above the loading curve */
    *slope = whole * by_approach;
    return force;
}

/* Approach of the faces: what they and the spring fraction rises with it, so Newton, bracketed. */
static double shared(const ck_faces *faces, double approach, double largest, double stiffness) {
    double low = 0.0, high = approach, close = CLOSE * approach, slope;
    double near = faces->first.end, found = near < approach ? near : 0.5 * approach;
    int i;
    for (i = 0; i < ROUNDS; i++) {
        double force = ck_faces_force(faces, found, largest, &slope), step;
        double excess = found + force / stiffness - approach;
        if (excess > 0.0) high = found;
        else low = found;
        step = excess / (1.0 + slope / stiffness);
        found -= step;
        if (fabs(step) <= close || high - low <= close)
            return found < low ? low : found > high ? high : found;
        if (!(low < found && found < high)) found = 0.5 * (low + high);
    }
    return found;
}

ck_pressed ck_faces_pressed(const ck_faces *faces, double approach, double largest,
                            double stiffness) {
    ck_pressed found = {0.0, 0.0, approach};
    if (approach > 0.0 && stiffness > 0.0)
        found.approach = shared(faces, approach, largest, stiffness);
    found.force = ck_faces_force(faces, found.approach, largest, &found.slope);
    if (stiffness > 0.0) found.slope = found.slope * stiffness / (found.slope + stiffness);
    return found;
}

double ck_faces_residual(const ck_faces *faces, double largest) {
    double unused, most = faces->first.end;
    if (!faces->n_unloading || largest <= faces->limit) return 0.0;
    return plain(&faces->residual, largest < most ? largest : most, &unused);
}

double ck_faces_dissipated(const ck_faces *faces, double largest) {
    double unused;
    return faces->n_unloading && largest > faces->limit ? plain(&faces->dissipated, largest, &unused) : 0.0;
}

ck_touching ck_faces_touching(const ck_faces *faces, const ck_pressed *pressed, double largest) {
    double approach = pressed->approach, most = faces->first.end, unused, deepest;
    ck_touching found = {0.0, 0.0, CK_BRANCH_FREE};
    if (largest > most) largest = most;
    deepest = approach > largest ? approach : largest;
    found.plastic = plain(&faces->plastic, deepest < most ? deepest : most, &unused);
    if (!(pressed->force > 0.0)) return found;
    if (faces->n_unloading && approach < largest && largest > faces->limit) {
        mixture m = mixed(faces, largest);
        found.branch = CK_BRANCH_UNLOADING;
        found.area = power(&faces->area, largest, &unused) *
                     unloading(faces, 1, &m, approach, &unused);
        return found;
    }
    found.branch = approach > most * (1.0 + SAME) ? CK_BRANCH_BEYOND : CK_BRANCH_LOADING;
    found.area = power(&faces->area, approach < most ? approach : most, &unused);
    return found;
}
