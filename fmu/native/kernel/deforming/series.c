/* A film of rigid bodies in series with a spring (a Maxwell element), for bodies that deform little.

   Unknowns: the gap of the film x and its force f, in units. x' = f/c(x), f' = k(x) (z' - x'), where k
   grows as the root of the gap under a sphere: (f + K(x))' = k(x) z', K the integral of k. As
   contactkit/separation/deforming/maxwell.py. */

#include "deforming.h"

#include <math.h>

void ck_series_level(ck_deforming *d, const double *y, double speed, ck_level *l, int slopes) {
    const ck_bodies *record = d->record;
    double x = y[0], f = y[1], gap = d->gap * x, by_gap;
    double c = ck_table_at(&record->series.damping, gap, log(gap), &by_gap) / d->damping;
    double by_x = by_gap * d->gap / d->damping;
    double k = record->widens ? sqrt(x) : 1.0;
    int m = d->size;
    l->stored[0] = x, l->rest[0] = -f / c;
    l->stored[1] = f + k * x / (record->widens ? 1.5 : 1.0), l->rest[1] = -k * speed;
    l->force = f, l->power = f * f / c, l->closed = !(x > 0.0);
    if (!slopes) return;
    l->stored_slopes[0] = 1.0, l->stored_slopes[1] = 0.0;
    l->stored_slopes[m] = k, l->stored_slopes[m + 1] = 1.0;
    l->rest_slopes[0] = f * by_x / (c * c), l->rest_slopes[1] = -1.0 / c;
    l->rest_slopes[m] = record->widens ? -0.5 * k / x * speed : 0.0, l->rest_slopes[m + 1] = 0.0;
    l->stored_by_gap[0] = l->stored_by_gap[1] = l->rest_by_gap[0] = l->rest_by_gap[1] = 0.0;
    l->rest_by_speed[0] = 0.0, l->rest_by_speed[1] = -k;
    l->force_slopes[0] = 0.0, l->force_slopes[1] = 1.0;
}
