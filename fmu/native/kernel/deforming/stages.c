/* One implicit step of a film between bodies that deform: Radau IIA, its stages solved together by Newton's
   method. As contactkit/lubrication/elastohydrodynamic/step.py, where the reasons are.

   The stages k satisfy sum_j B_kj (Q_j - Q_0)/dt + R_k = 0, with B the inverse of the matrix of the method; the
   last stage is the end. */

#include "deforming.h"
#include "dense.h"

#include <math.h>
#include <string.h>

#define SOLVED 1e-10     /* these five as in step.py */
#define STALLED 1e-7
#define MOST_ITERATIONS 30
#define CONTRACTION 0.1
#define LEAST_GAP 0.1
#define NO_PART 1e-8     /* of a correction, below which a gap closes */
#define EXTRAPOLATED 2.5 /* growth of a step up to which the last one is extrapolated */
#define NO_FORCE 1e-6    /* of the unit: a smaller one moves nothing, and is lost in the round-off of gaps */
/* Derivatives: corrections by the last factors, which are 1e-3 or less off, to this. */
#define REFINED 1e-9

static double *stage(const ck_deforming *d, int k) { return d->stages + (long)k * d->size; }

/* All stages; 0 if a gap closes. */
static int evaluate(ck_deforming *d, const ck_attempted *a, int slopes) {
    int k, open = 1;
    for (k = 0; k < d->method->stages; k++) {
        double rate, given = ck_course_at(&a->course, a->time + d->method->nodes[k] * a->length, &rate);
        ck_level_of(d, stage(d, k), given, rate, &d->levels[k], slopes);
        open &= !d->levels[k].closed;
    }
    return open;
}

/* Polynomial through the stages of the last step at those of this one; the start where there is none. */
static void guess(ck_deforming *d, const ck_attempted *a) {
    const ck_method *method = d->method;
    const double *last = d->values + d->size;
    int s = method->stages, m = d->size, k, j, i;
    int known = a->before > 0.0 && a->length <= EXTRAPOLATED * a->before;
    for (k = 0; k < s; k++) {
        double *to = stage(d, k), at = 1.0 + method->nodes[k] * a->length / (known ? a->before : 1.0);
        if (!known) {
            memcpy(to, d->values, (size_t)m * sizeof(double));
            continue;
        }
        for (i = 0; i < m; i++) to[i] = 0.0;
        for (j = 0; j < s; j++) {
            double weight = 1.0;
            for (i = 0; i < s; i++)
                if (i != j) weight *= (at - method->nodes[i]) / (method->nodes[j] - method->nodes[i]);
            for (i = 0; i < m; i++) to[i] += weight * last[(long)j * m + i];
        }
    }
}

static void residual(ck_deforming *d, double length) {
    int s = d->method->stages, m = d->size, k, j, i;
    for (k = 0; k < s; k++) {
        double *to = d->right + (long)k * m;
        for (i = 0; i < m; i++) to[i] = -d->levels[k].rest[i];
        for (j = 0; j < s; j++) {
            double b = d->method->inverse[k][j] / length;
            const double *stored = d->levels[j].stored;
            for (i = 0; i < m; i++) to[i] -= b * (stored[i] - d->start_stored[i]);
        }
    }
}

static int factorise(ck_deforming *d, double length) {
    int s = d->method->stages, m = d->size, k, j, i, c;
    for (k = 0; k < s; k++)
        for (j = 0; j < s; j++) {
            double b = d->method->inverse[k][j] / length;
            const ck_level *l = &d->levels[j];
            for (i = 0; i < m; i++) {
                double *to = d->whole + ((long)k * m + i) * s * m + (long)j * m;
                const double *stored = l->stored_slopes + (long)i * m, *rest = l->rest_slopes + (long)i * m;
                for (c = 0; c < m; c++) to[c] = b * stored[c];
                if (k == j)
                    for (c = 0; c < m; c++) to[c] += rest[c];
            }
        }
    return ck_dense_factor(d->whole, d->exchanged, s * m);
}

/* Gap of the undeformed bodies at a stage. */
static double gap_at(const ck_deforming *d, const ck_attempted *a, int k) {
    double rate;
    if (d->has_mass) return stage(d, k)[d->n];
    return ck_course_at(&a->course, a->time + d->method->nodes[k] * a->length, &rate);
}

/* Part of a correction that keeps gaps open. */
static double part_of(ck_deforming *d, const ck_attempted *a) {
    double part = 1.0, closing;
    int k;
    for (k = 0; k < d->method->stages; k++) {
        const double *change = d->right + (long)k * d->size;
        ck_film_moved(d, stage(d, k), gap_at(d, a, k), change, d->has_mass ? change[d->n] : 0.0,
                      d->levels[k].voids, &closing);
        if (closing * part > 1.0 - LEAST_GAP) part = (1.0 - LEAST_GAP) / closing;
    }
    return part;
}

/* Size of a correction over that of the unknowns. */
static double size_of(const ck_deforming *d) {
    double size = 0.0;
    int k;
    for (k = 0; k < d->method->stages; k++) {
        const double *change = d->right + (long)k * d->size;
        double one = ck_film_change(d, stage(d, k), change, d->levels[k].voids);
        if (d->has_mass && !(fabs(change[d->n]) <= one)) one = fabs(change[d->n]);
        if (!(one <= size)) size = one;
    }
    return size;
}

/* Error of the end over the tolerance: of the force, and of gaps over themselves. The estimate is
   (g/dt Q' + R')^-1 (sum e_i (Q_i - Q_0)/dt - R_0). */
static int estimate(ck_deforming *d, const ck_attempted *a, double *error) {
    int s = d->method->stages, m = d->size, i, k;
    const ck_level *end = &d->levels[s - 1];
    double force = 0.0, scale, moved, ignored, *found = d->right;
    for (i = 0; i < m; i++) {
        found[i] = -d->start_rest[i];
        for (k = 0; k < s; k++)
            found[i] += d->method->error[k] * (d->levels[k].stored[i] - d->start_stored[i]) / a->length;
    }
    for (i = 0; i < m * m; i++)
        d->square[i] = *d->method->gamma / a->length * end->stored_slopes[i] + end->rest_slopes[i];
    if (!ck_dense_factor(d->square, d->exchanged + s * m, m)) return 0;
    ck_dense_solve(d->square, d->exchanged + s * m, m, found);
    for (i = 0; i < d->n; i++) force += end->force_slopes[i] * found[i];
    scale = fabs(end->force) > a->highest ? fabs(end->force) : a->highest;
    if (!(scale > NO_FORCE)) scale = NO_FORCE;
    moved = ck_film_moved(d, stage(d, s - 1), gap_at(d, a, s - 1), found, d->has_mass ? found[d->n] : 0.0,
                          end->voids, &ignored);
    force = fabs(force) / scale;
    *error = (force > moved ? force : moved) / d->rtol;
    return *error < HUGE_VAL;
}

/* Change cavities where their conditions fail; 1 if one did. */
static int rupture(ck_deforming *d, const ck_attempted *a) {
    int k, changed = 0;
    if (!d->record->has_rings) return 0;
    for (k = 0; k < d->method->stages; k++)
        changed |= ck_rings_rupture(d, stage(d, k), gap_at(d, a, k), d->levels[k].voids);
    return changed;
}

int ck_stages_solve(ck_deforming *d, const ck_attempted *a, double *error) {
    int s = d->method->stages, m = d->size, known = 0, i, iteration;
    double before = HUGE_VAL, rate, given = ck_course_at(&a->course, a->time, &rate);
    ck_level_of(d, d->values, given, rate, &d->first, 0);
    guess(d, a);
    for (i = 0; i < s; i++) memcpy(d->levels[i].voids, d->voids, (size_t)d->n * sizeof(double));
    for (iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
        double part, size;
        if (!evaluate(d, a, !known)) return 0;
        residual(d, a->length);
        if (!known && !factorise(d, a->length)) return 0;
        known = 1;
        ck_dense_solve(d->whole, d->exchanged, s * m, d->right);
        part = part_of(d, a), size = size_of(d);
        if (!(part >= NO_PART && size < HUGE_VAL)) return 0;
        for (i = 0; i < s * m; i++) d->stages[i] += part * d->right[i];
        if (rupture(d, a) || part < 1.0) {
            known = 0, before = HUGE_VAL;
            continue;
        }
        if (size < SOLVED || (size < STALLED && size > 0.5 * before)) {
            return evaluate(d, a, 1) && estimate(d, a, error);
        }
        if (size > CONTRACTION * (before < HUGE_VAL ? before : CONTRACTION)) known = 0;
        before = size;
    }
    return 0;
}

/* The matrix of the stages, as it is where they were found, times a vector; subtracted. */
static void subtract_product(const ck_deforming *d, double length, const double *vector, double *from) {
    int s = d->method->stages, m = d->size, k, j, i, c;
    for (j = 0; j < s; j++) {
        const ck_level *l = &d->levels[j];
        const double *part = vector + (long)j * m;
        for (i = 0; i < m; i++) {
            double stored = 0.0, rest = 0.0;
            for (c = 0; c < m; c++) {
                stored += l->stored_slopes[(long)i * m + c] * part[c];
                rest += l->rest_slopes[(long)i * m + c] * part[c];
            }
            for (k = 0; k < s; k++) from[(long)k * m + i] -= d->method->inverse[k][j] / length * stored;
            from[(long)j * m + i] -= rest;
        }
    }
}

/* How the gap of the bodies and its rate at a time follow the gap, or the speed, at the end of a parabola. */
static void follow(int by_speed, double time, double span, double *gap, double *rate) {
    double x = time / span;
    *gap = by_speed ? -time * (1.0 - x) : x * (2.0 - x);
    *rate = by_speed ? 2.0 * x - 1.0 : 2.0 * (1.0 - x) / span;
}

static void sources(const ck_deforming *d, const ck_attempted *a, double span, int which, double *to) {
    int s = d->method->stages, m = d->size, k, j, i;
    for (i = 0; i < s * m; i++) to[i] = 0.0;
    for (j = 0; j < s; j++) {
        const ck_level *l = &d->levels[j];
        double gap, rate;
        follow(which, a->time + d->method->nodes[j] * a->length, span, &gap, &rate);
        for (i = 0; i < m; i++) {
            double stored = l->stored_by_gap[i] * gap - d->held[which][i];
            for (k = 0; k < s; k++) to[(long)k * m + i] -= d->method->inverse[k][j] / a->length * stored;
            to[(long)j * m + i] -= l->rest_by_gap[i] * gap + l->rest_by_speed[i] * rate;
        }
    }
}

int ck_stages_slopes(ck_deforming *d, const ck_attempted *a, double span) {
    int s = d->method->stages, m = d->size, which, iteration, i, c;
    const ck_level *end = &d->levels[s - 1];
    for (which = 0; which < 2; which++) {
        double *by = d->by[which], *right = d->right, *last = by + (long)(s - 1) * m, gap, rate;
        double change = HUGE_VAL, size = 0.0;
        for (i = 0; i < s * m; i++) by[i] = 0.0;
        for (iteration = 0; iteration < MOST_ITERATIONS && !(change <= REFINED * size); iteration++) {
            sources(d, a, span, which, right);
            subtract_product(d, a->length, by, right);
            ck_dense_solve(d->whole, d->exchanged, s * m, right);
            change = size = 0.0;
            for (i = 0; i < s * m; i++) {
                by[i] += right[i];
                if (!(fabs(right[i]) <= change)) change = fabs(right[i]);
                if (fabs(by[i]) > size) size = fabs(by[i]);
            }
            if (!(change < HUGE_VAL)) return 0;
        }
        follow(which, a->time + a->length, span, &gap, &rate);
        d->force_by[which] = 0.0;
        for (i = 0; i < m; i++) {
            double sum = end->stored_by_gap[i] * gap;
            for (c = 0; c < m; c++) sum += end->stored_slopes[(long)i * m + c] * last[c];
            d->held[which][i] = sum;
            d->force_by[which] += end->force_slopes[i] * last[i];
        }
    }
    return 1;
}
