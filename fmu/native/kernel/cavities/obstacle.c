/* The complementarity problem of a film that cavitates: pressure above that of the cavity, or a void.

   A primal-dual active set, as contactkit/lubrication/reynolds/complementarity.py; the voids do not act
   on the full cells, so that each guess is one symmetric system of these. The matrix is an M-matrix, for
   which the sets settle from any guess (Hintermueller, Ito and Kunisch 2003). */

#include "grid.h"

#include <math.h>
#include <string.h>

#define ROUND_OFF 1e-13 /* negative pressure over the largest, and void, that count as zero */
#define TIED 1e-9       /* the same once sets repeat: a cell at the very edge fills and empties by turns */
/* Sets that are tried: the edge of a cavity moves by about a cell with each. */
#define MOST_SETS 200
#define MANY_SETS 100

/* Flow out of each cell, of a pressure. */
static void flow(const ck_grid_film *film, const double *pressure, double *out) {
    int i;
    for (i = 0; i < film->n; i++) out[i] = film->diagonal[i] * pressure[i];
    for (i = 0; i < film->n_sides; i++) {
        int a = film->low[i], b = film->high[i];
        out[a] -= film->sides[i] * pressure[b];
        out[b] -= film->sides[i] * pressure[a];
    }
}

/* Conductances of the sides over that of the gap: harmonic means of cubes, which are exact across a
   step of the gap; to a rim and to a pocket that of the cell. */
static void assemble(ck_grid_film *film, double gap) {
    const ck_grid *grid = film->record;
    int i, k;
    if (film->matrix_gap == gap || (film->is_even && film->matrix_gap > 0.0)) return;
    film->matrix_gap = gap;
    for (i = 0; i < film->n; i++) {
        double ratio = 1.0 + grid->cells.relief[i] / gap;
        film->work[i] = ratio * ratio * ratio;
        film->diagonal[i] = grid->cells.rim[i] * film->work[i];
    }
    for (i = 0; i < film->n_sides; i++) {
        double a = film->work[film->low[i]], b = film->work[film->high[i]];
        k = i - film->n_inner;
        film->sides[i] = k < 0 ? grid->sides.geometry[i] * (2.0 * a * b / (a + b))
                               : grid->pockets.geometry[k] * film->work[film->cell[k]];
        film->diagonal[film->low[i]] += film->sides[i];
        film->diagonal[film->high[i]] += film->sides[i];
    }
    memset(film->work, 0, (size_t)film->n * sizeof(double));
}

/* Not memcmp: compilers make a bcmp of it, which not every C library has. */
static int is_same(const unsigned char *one, const unsigned char *other, size_t n) {
    size_t i;
    for (i = 0; i < n; i++)
        if (one[i] != other[i]) return 0;
    return 1;
}

/* Factor of the full cells: the one that is there, or in place of that which was used longest ago. */
const ck_factor *ck_grid_factor(ck_grid_film *film, double gap, const unsigned char *full) {
    size_t n = (size_t)film->n;
    ck_factor *oldest = &film->factors[0];
    int i;
    assemble(film, gap);
    for (i = 0; i < CK_FACTORS; i++) {
        ck_factor *one = &film->factors[i];
        if (one->used && (film->is_even || one->gap == gap) && is_same(one->full, full, n)) {
            one->used = ++film->clock;
            return one;
        }
        if (one->used < oldest->used) oldest = one;
    }
    oldest->used = 0;
    if (!ck_factorise(&film->pattern, film->diagonal, film->sides, full, film->work, oldest)) {
        memset(film->work, 0, n * sizeof(double));
        return NULL;
    }
    memcpy(oldest->full, full, n);
    oldest->gap = gap, oldest->used = ++film->clock;
    return oldest;
}

/* Pressures of the full cells, and voids of the others. */
static int with_set(ck_grid_film *film, const ck_obstacle *p, const unsigned char *full) {
    const ck_factor *factor = ck_grid_factor(film, p->gap, full);
    double *q = film->pressure, *x = film->slope;
    int i;
    if (!factor) return 0;
    for (i = 0; i < film->n; i++) q[i] = full[i] ? 0.0 : p->floor;
    flow(film, q, x);
    for (i = 0; i < film->n; i++) x[i] = -x[i] - p->deficit[i];
    ck_factor_solve(&film->pattern, factor, x);
    for (i = 0; i < film->n; i++)
        if (full[i]) q[i] = x[i];
    flow(film, q, film->voids);
    for (i = 0; i < film->n; i++)
        film->voids[i] = full[i] ? 0.0 : (film->voids[i] + p->deficit[i]) / p->storage[i];
    return 1;
}

/* Pressure and voids are left in the film; `full` is the guess, and then what is found. */
int ck_obstacle_solve(ck_grid_film *film, const ck_obstacle *p, unsigned char *full) {
    size_t n = (size_t)film->n;
    int tries, i;
    for (tries = 0; tries < MOST_SETS; tries++) {
        double most = 0.0, slack = tries < MANY_SETS ? ROUND_OFF : TIED;
        if (!with_set(film, p, full)) return 0;
        for (i = 0; i < film->n; i++) most = fmax(most, fabs(film->pressure[i]));
        if (!isfinite(most)) return 0;
        for (i = 0; i < film->n; i++) {
            film->new[i] = full[i] ? film->pressure[i] - p->floor >= -slack * most
                                   : film->voids[i] < -slack;
            if (p->may_fill && !p->may_fill[i]) film->new[i] = 0;
        }
        if (is_same(film->new, full, n)) return 1;
        memcpy(full, film->new, n);
    }
    return 0;
}
