/* A film on rings under bodies that deform: linear elements for the pressure, a matrix of displacements.

   Unknowns: the pressures at all nodes but the last, where the film is flooded; in a cavity, whose pressure is
   known, the liquid per area (Jakobsson, Floberg and Olsson). As mesh.py and wet_gap.py of
   contactkit/lubrication/elastohydrodynamic. */

#include "deforming.h"

#include <math.h>

#define TWO_PI 6.283185307179586476925287 /* of a circle */

/* Points and weights of Gauss-Legendre on (0, 1): h^3 r on an element is a polynomial of degree 4. */
static const double POINT[3] = {0.11270166537925831148, 0.5, 0.88729833462074168852};
static const double WEIGHT[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

void ck_rings_share(ck_deforming *d) {
    const double *r = d->record->rings.radius;
    int e, q;
    for (e = 0; e < d->n; e++)
        for (q = 0; q < 3; q++) {
            double width = r[e + 1] - r[e];
            d->share[3 * e + q] = (r[e] + width * POINT[q]) * WEIGHT[q] / (12.0 * width);
        }
}

/* Pressures at the nodes; `cavity`: that in a cavity. */
static void press(ck_deforming *d, const double *y, const double *voids, double cavity) {
    int i;
    for (i = 0; i < d->n; i++) d->pressure[i] = voids[i] != 0.0 ? cavity : y[i];
}

static double displacement(const ck_deforming *d, int i) {
    const double *row = d->record->rings.compliance.entry + (long)i * (d->n + 1);
    double sum = 0.0;
    int j;
    for (j = 0; j < d->n; j++) sum += row[j] * d->pressure[j];
    return sum;
}

/* Flow of each element per difference of pressure, and its slopes by the gaps at its ends. */
static void conduct(ck_deforming *d) {
    int e, q;
    for (e = 0; e < d->n; e++) {
        double value = 0.0, sum = 0.0, outer = 0.0;
        for (q = 0; q < 3; q++) {
            double h = d->h[e] * (1.0 - POINT[q]) + d->h[e + 1] * POINT[q];
            double square = d->share[3 * e + q] * h * h;
            value += square * h, sum += 3.0 * square, outer += 3.0 * square * POINT[q];
        }
        d->flow[e] = value, d->left[e] = sum - outer, d->outer[e] = outer;
    }
}

void ck_rings_level(ck_deforming *d, const double *y, double gap, ck_level *l, int slopes) {
    const ck_rings *rings = &d->record->rings;
    const double *k = rings->compliance.entry;
    const double *p = d->pressure, *voids = l->voids;
    int n = d->n, m = d->size, wide = n + 1, i, j;
    double sum = 0.0, power = 0.0;
    l->closed = 0;
    press(d, y, voids, d->floor);
    for (i = 0; i <= n; i++) {
        d->h[i] = gap + rings->relief[i] + displacement(d, i);
        l->closed |= !(d->h[i] > 0.0);
    }
    conduct(d);
    for (i = 0; i < n; i++) {
        l->stored[i] = rings->area[i] * (voids[i] != 0.0 ? y[i] : d->h[i]), l->rest[i] = 0.0;
        sum += rings->area[i] * p[i];
    }
    for (i = 0; i < n; i++) {
        double drop = p[i] - (i + 1 < n ? p[i + 1] : 0.0), through = d->flow[i] * drop;
        l->rest[i] += through, power += through * drop;
        if (i + 1 < n) l->rest[i + 1] -= through;
    }
    l->force = -TWO_PI * sum, l->power = TWO_PI * power;
    if (!slopes) return;
    for (i = 0; i < n; i++) {
        double *stored = l->stored_slopes + (long)i * m, *rest = l->rest_slopes + (long)i * m;
        double here = 0.0, before = 0.0, after, drop = p[i] - (i + 1 < n ? p[i + 1] : 0.0);
        /* Slopes of the row by the gaps at the node and its neighbours. */
        here += d->left[i] * drop, after = d->outer[i] * drop;
        if (i > 0) {
            double last = p[i - 1] - p[i];
            before = -d->left[i - 1] * last, here -= d->outer[i - 1] * last;
        }
        for (j = 0; j < n; j++) {
            const double *column = k + (long)i * wide + j;
            stored[j] = rings->area[i] * column[0];
            rest[j] = here * column[0] + after * column[wide] + (i > 0 ? before * column[-wide] : 0.0);
        }
        rest[i] += d->flow[i];
        if (i + 1 < n) rest[i + 1] -= d->flow[i];
        if (i > 0) rest[i] += d->flow[i - 1], rest[i - 1] -= d->flow[i - 1];
        for (j = 0; j < n; j++) /* the pressure of a cavity is known */
            if (voids[j] != 0.0) stored[j] = rest[j] = 0.0;
        if (voids[i] != 0.0) {
            for (j = 0; j < n; j++) stored[j] = 0.0;
            stored[i] = rings->area[i];
        }
        l->stored_by_gap[i] = voids[i] != 0.0 ? 0.0 : rings->area[i];
        l->rest_by_gap[i] = here + after + before, l->rest_by_speed[i] = 0.0;
        l->force_slopes[i] = voids[i] != 0.0 ? 0.0 : -TWO_PI * rings->area[i];
    }
}

double ck_rings_axis(ck_deforming *d, const double *y, double gap) {
    press(d, y, d->voids, d->floor);
    return gap + displacement(d, 0);
}

/* Largest change of a gap over itself; `closing`: the largest fall. */
double ck_rings_moved(ck_deforming *d, const double *y, double gap, const double *dy, double dgap,
                      const double *voids, double *closing) {
    double most = 0.0, fall = 0.0;
    int i;
    press(d, y, voids, d->floor);
    for (i = 0; i <= d->n; i++) d->h[i] = gap + d->record->rings.relief[i] + displacement(d, i);
    press(d, dy, voids, 0.0);
    for (i = 0; i <= d->n; i++) {
        double part = (dgap + displacement(d, i)) / fabs(d->h[i]);
        if (!(fabs(part) <= most)) most = fabs(part);
        if (-part > fall) fall = -part;
    }
    *closing = fall;
    return most;
}

int ck_rings_rupture(ck_deforming *d, double *y, double gap, double *voids) {
    int i, changed = 0;
    if (!(d->floor > -HUGE_VAL)) return 0;
    press(d, y, voids, d->floor);
    for (i = 0; i < d->n; i++) d->h[i] = gap + d->record->rings.relief[i] + displacement(d, i);
    for (i = 0; i < d->n; i++) {
        int is_void = voids[i] != 0.0 ? y[i] < d->h[i] : y[i] < d->floor;
        if (is_void == (voids[i] != 0.0)) continue;
        /* A cavity opens full, and closes at its pressure. */
        y[i] = is_void ? d->h[i] : d->floor, voids[i] = is_void, changed = 1;
    }
    return changed;
}

double ck_rings_lowest(const ck_deforming *d, const double *y) {
    double lowest = 0.0;
    int i;
    for (i = 0; i < d->n; i++)
        if (y[i] < lowest) lowest = y[i];
    return lowest;
}
