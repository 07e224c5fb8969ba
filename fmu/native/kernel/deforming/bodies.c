/* Room for a film between bodies that deform, its units, and the rows of the motion of a mass. */

#include "deforming.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define R6 2.449489742783178098197284 /* the root of 6 */
#define MOST_RINGS 256 /* 60 leave 3e-3 of a force, and the factors of a step cost as their cube */

/* Radau IIA with two and three stages (Hairer and Wanner, table IV.5.5 and section IV.8), the inverse of
   its matrix, and an estimate of the error by a formula on the same nodes and the start. */
static const double NODES[2] = {1.0 / 3.0, 1.0}, WEIGHTS[2] = {0.75, 0.25}, ERROR[2] = {-4.5, 0.5};
static const double GAMMA = R6;
static const ck_method TWO = {2, 3, NODES, WEIGHTS, &GAMMA, ERROR, {{1.5, 0.5}, {-4.5, 2.5}}};
static const ck_method THREE = {
    3,
    4,
    ck_nodes,
    ck_weights,
    &ck_gamma,
    ck_estimate,
    {{2.0 + R6 / 2.0, -1.2 + R6 * 29.0 / 30.0, 0.4 - R6 * 4.0 / 15.0},
     {-1.2 - R6 * 29.0 / 30.0, 2.0 - R6 / 2.0, 0.4 + R6 * 4.0 / 15.0},
     {-1.0 + R6 * 8.0 / 3.0, -1.0 - R6 * 8.0 / 3.0, 5.0}}};

/* Opening ------------------------------------------------------------------------------------------ */

static const char *check_rings(const ck_rings *rings) {
    const char *wrong = "its rings make no sense";
    int n = rings->n_nodes, i;
    if (n > MOST_RINGS + 1 || rings->compliance.n_nodes != n * n || rings->radius[0] != 0.0) return wrong;
    for (i = 0; i < n; i++)
        if (!(rings->area[i] > 0.0)) return wrong;
    return NULL;
}

static double *take(double **next, long count) {
    double *found = *next;
    *next += count;
    return found;
}

/* Parts of the block; called twice, the first time from NULL to count. */
static long divide(ck_deforming *d, double *block) {
    long n = d->n, m = d->size, s = d->method->stages, k;
    double *next = block;
    d->values = take(&next, d->count), d->kept = take(&next, d->count);
    d->voids = d->values + m * (1 + s), d->pressure = take(&next, n);
    d->share = take(&next, 3 * n), d->h = take(&next, n + 1);
    d->flow = take(&next, n), d->left = take(&next, n), d->outer = take(&next, n);
    d->stages = take(&next, s * m), d->right = take(&next, s * m);
    d->whole = take(&next, s * m * s * m), d->square = take(&next, m * m);
    d->start_stored = take(&next, m), d->start_rest = take(&next, m);
    for (k = 0; k < 2; k++) d->by[k] = take(&next, s * m), d->held[k] = take(&next, m);
    for (k = 0; k < s; k++) {
        ck_level *l = &d->levels[k];
        l->stored = take(&next, m), l->rest = take(&next, m);
        l->stored_slopes = take(&next, m * m), l->rest_slopes = take(&next, m * m);
        l->stored_by_gap = take(&next, n), l->rest_by_gap = take(&next, n);
        l->rest_by_speed = take(&next, n), l->force_slopes = take(&next, n), l->voids = take(&next, n);
    }
    d->first = d->levels[0];
    d->first.stored = d->start_stored, d->first.rest = d->start_rest, d->first.voids = d->voids;
    return (long)(next - block);
}

const char *ck_deforming_open(ck_deforming *d, const ck_bodies *record, int has_mass) {
    static double none[1];
    const char *problem = NULL;
    if (record->has_series == record->has_rings) return "it has no film, or two";
    if (record->has_rings) problem = check_rings(&record->rings);
    if (problem) return problem;
    d->record = record, d->has_mass = has_mass;
    /* Steps of three stages need a third of the number, and of rings cost three times as much each. */
    d->method = record->has_rings ? &TWO : &THREE;
    d->n = record->has_rings ? record->rings.n_nodes - 1 : 2;
    d->size = d->n + (has_mass ? 2 : 0);
    d->count = d->size * (1 + d->method->stages) + d->n;
    d->floor = -HUGE_VAL;
    d->block = (double *)calloc((size_t)divide(d, none), sizeof(double));
    d->exchanged = (int *)calloc((size_t)(d->size * (d->method->stages + 1)), sizeof(int));
    if (!d->block || !d->exchanged) return "there is no memory for it";
    divide(d, d->block);
    if (record->has_rings) ck_rings_share(d);
    return NULL;
}

void ck_deforming_close(ck_deforming *d) {
    free(d->block);
    free(d->exchanged);
    memset(d, 0, sizeof *d);
}

/* The state ---------------------------------------------------------------------------------------- */

static void copy(double *to, const double *from, int count) {
    memcpy(to, from, (size_t)count * sizeof(double));
}

void ck_deforming_keep(ck_deforming *d) {
    if (d->count) copy(d->kept, d->values, d->count);
}

void ck_deforming_go_back(ck_deforming *d) {
    if (d->count) copy(d->values, d->kept, d->count);
}

void ck_deforming_put(ck_deforming *d, const double *values) {
    if (!d->count) return;
    if (values) copy(d->values, values, d->count);
    else memset(d->values, 0, (size_t)d->count * sizeof(double));
}

void ck_deforming_units(ck_deforming *d, double viscosity) {
    const ck_bodies *record = d->record;
    double w = record->rings.width, by_gap;
    d->gap = record->gap;
    if (record->has_rings) {
        d->force = record->rings.pressure * w * w;
        d->time = viscosity * w * w / (d->gap * d->gap * record->rings.pressure);
        return;
    }
    d->force = record->stiffness * d->gap;
    d->damping = ck_table_at(&record->series.damping, d->gap, log(d->gap), &by_gap);
    d->time = viscosity * d->damping / record->stiffness;
}

void ck_deforming_rest(ck_deforming *d, double gap) {
    ck_deforming_put(d, NULL);
    if (d->record->has_series) d->values[0] = gap / d->gap;
    if (d->has_mass) d->values[d->n] = gap / d->gap;
}

/* Levels ------------------------------------------------------------------------------------------- */

double ck_course_at(const ck_course *course, double time, double *rate) {
    const double *c = course->c;
    *rate = c[1] + 2.0 * c[2] * time;
    return c[0] + time * (c[1] + time * c[2]);
}

/* Rows of a mass: z' = w, m w' = pull + spring - force of the film. */
static void mass_rows(const ck_deforming *d, const double *y, double pull, ck_level *l, int slopes) {
    int n = d->n, m = d->size, j;
    double *z = l->stored_slopes + (long)n * m, *rest = l->rest_slopes + (long)n * m;
    l->stored[n] = y[n], l->rest[n] = -y[n + 1];
    l->stored[n + 1] = d->mass * y[n + 1];
    l->rest[n + 1] = l->force - pull - d->spring * (d->relaxed - y[n]);
    if (!slopes) return;
    for (j = 0; j < 2 * m; j++) z[j] = rest[j] = 0.0;
    for (j = 0; j < n; j++) {
        l->stored_slopes[(long)j * m + n] = l->stored_by_gap[j];
        l->stored_slopes[(long)j * m + n + 1] = 0.0;
        l->rest_slopes[(long)j * m + n] = l->rest_by_gap[j];
        l->rest_slopes[(long)j * m + n + 1] = l->rest_by_speed[j];
        rest[m + j] = l->force_slopes[j];
    }
    z[n] = 1.0, rest[n + 1] = -1.0;
    z[m + n + 1] = d->mass, rest[m + n] = d->spring;
}

/* At a time of a course, which is that of the gap or of the force on the mass. */
void ck_level_of(ck_deforming *d, const double *y, double given, double rate, ck_level *l, int slopes) {
    double gap = d->has_mass ? y[d->n] : given, speed = d->has_mass ? y[d->n + 1] : rate;
    if (d->record->has_rings) ck_rings_level(d, y, gap, l, slopes);
    else ck_series_level(d, y, speed, l, slopes);
    if (d->has_mass) mass_rows(d, y, given, l, slopes);
}

double ck_film_axis(ck_deforming *d, const double *y, double gap) {
    return d->record->has_rings ? ck_rings_axis(d, y, gap) : y[0];
}

double ck_film_moved(ck_deforming *d, const double *y, double gap, const double *dy, double dgap,
                     const double *voids, double *closing) {
    if (d->record->has_rings) return ck_rings_moved(d, y, gap, dy, dgap, voids, closing);
    *closing = -dy[0] / y[0];
    return fabs(dy[0] / y[0]);
}

/* Change of unknowns over their size; one below 1e-6 of the unit moves nothing. */
double ck_film_change(const ck_deforming *d, const double *y, const double *dy, const double *voids) {
    double size = 1e-6, change = 0.0, liquid = 0.0;
    int first = d->record->has_rings ? 0 : 1, i;
    for (i = first; i < d->n; i++) {
        if (voids[i] != 0.0) { /* its liquid over a gap of 1 */
            if (!(fabs(dy[i]) <= liquid)) liquid = fabs(dy[i]);
            continue;
        }
        if (fabs(y[i]) > size) size = fabs(y[i]);
        if (!(fabs(dy[i]) <= change)) change = fabs(dy[i]);
    }
    change /= size;
    if (!(liquid <= change)) change = liquid;
    if (first && !(fabs(dy[0] / y[0]) <= change)) change = fabs(dy[0] / y[0]);
    return change;
}
