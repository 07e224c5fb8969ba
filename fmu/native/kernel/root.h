/* Root of a continuous function of one number: Illinois false position, halved whenever it does not
   halve the bracket in three evaluations. As contactkit/numerics/roots.py. */

#ifndef CK_ROOT_H
#define CK_ROOT_H

#include <math.h>

/* Three times the bisections between the smallest and the largest double, some 1100 from 1e-300 to 1. */
#define CK_MOST_EVALUATIONS 4000

typedef double (*ck_function)(double at, const void *given);

/* Root between two points of opposite sign, to a relative width of the bracket. */
static double ck_root_between(ck_function function, const void *given, double low, double high,
                              double rtol) {
    double f_low = function(low, given), f_high = function(high, given), width = fabs(high - low);
    int i, since = 0;
    if (f_low == 0.0) return low;
    if (f_high == 0.0) return high;
    for (i = 0; i < CK_MOST_EVALUATIONS; i++) {
        double bottom = low < high ? low : high, top = low < high ? high : low, x, f;
        if (!(top - bottom > rtol * (fabs(low) > fabs(high) ? fabs(low) : fabs(high)))) break;
        x = high - f_high * (high - low) / (f_high - f_low);
        if (++since > 2 || !(x > bottom && x < top)) {
            x = 0.5 * (low + high);
            if (x == low || x == high) break;
        }
        f = function(x, given);
        if (f == 0.0) return x;
        if ((f > 0.0) == (f_high > 0.0)) f_low *= 0.5;
        else low = high, f_low = f_high;
        high = x, f_high = f;
        if (fabs(high - low) <= 0.5 * width) width = fabs(high - low), since = 0;
    }
    return high;
}

#endif
