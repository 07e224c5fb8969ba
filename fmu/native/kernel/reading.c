/* The highest force of a step and the work along its path: contactkit/separation/integrator/dense_output.py. */

#include "motion.h"

#include <math.h>

#define SHORT 1e-2 /* change of the coordinate up to which the quadrature of the method does */

/* Coefficients of a + b x + c x^2 + d x^3 through the start and the stages. */
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
double ck_highest(double first, const double stages[3], double *where) {
    double f[4], value = first, lowest = first, inside, q, roots[2];
    int i;
    *where = 0.0;
    if (jumps(first, stages) && 2.0 * (stages[2] - first) > stages[0] - first) {
        *where = 1.0; /* it stays up; on the way there the stages are not accurate */
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
double ck_travel_integral(const ck_point *start, const ck_step *taken, double first,
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
