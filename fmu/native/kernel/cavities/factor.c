/* Factor of a sparse matrix, row by row: what is known of a row is solved with the rows above. */

#include "factor.h"

#include <string.h>

/* Pivot over the diagonal below which liquid has no way to a rim: round-off of 10 000 sums is 1e-12. */
#define SINGULAR 1e-12

/* Row i of the factor has the unknowns on the ways up the tree from the neighbours of i. */
static int reach(const ck_pattern *p, int i, int *parent, int *mark, int *row) {
    int count = 0, k, j;
    mark[i] = i, parent[i] = -1;
    for (k = p->first[i]; k < p->first[i + 1]; k++)
        for (j = p->beside[k]; mark[j] != i; j = parent[j]) {
            if (parent[j] < 0) parent[j] = i;
            mark[j] = i;
            if (row) row[count] = j;
            count++;
        }
    return count;
}

int ck_fill_of(const ck_pattern *p, int *parent, int *mark, int most) {
    int total = 0, i;
    for (i = 0; i < p->n; i++) mark[i] = -1;
    for (i = 0; i < p->n && total <= most; i++) total += reach(p, i, parent, mark, NULL);
    return total;
}

/* Rows are listed by columns and back: so their entries ascend, which is the order of elimination. */
void ck_pattern_rows(ck_pattern *p, int *parent, int *mark, int *columns) {
    int i, j, k;
    for (i = 0; i < p->n; i++) mark[i] = -1;
    memset(p->column_start, 0, (size_t)(p->n + 1) * sizeof(int));
    for (i = 0, p->row_start[0] = 0; i < p->n; i++) {
        p->row_start[i + 1] = p->row_start[i] + reach(p, i, parent, mark, p->row + p->row_start[i]);
        for (k = p->row_start[i]; k < p->row_start[i + 1]; k++) p->column_start[p->row[k] + 1]++;
    }
    for (i = 0; i < p->n; i++) p->column_start[i + 1] += p->column_start[i];
    for (i = 0; i < p->n; i++) mark[i] = p->column_start[i];
    for (i = 0; i < p->n; i++)
        for (k = p->row_start[i]; k < p->row_start[i + 1]; k++) columns[mark[p->row[k]]++] = i;
    for (i = 0; i < p->n; i++) mark[i] = p->row_start[i];
    for (j = 0; j < p->n; j++)
        for (k = p->column_start[j]; k < p->column_start[j + 1]; k++) p->row[mark[columns[k]]++] = j;
}

int ck_factorise(const ck_pattern *p, const double *diagonal, const double *sides,
                 const unsigned char *full, double *work, ck_factor *f) {
    int i, k, e;
    memset(f->count, 0, (size_t)p->n * sizeof(int));
    for (i = 0; i < p->n; i++) {
        double d = diagonal[i];
        f->pivot[i] = 1.0;
        if (!full[i]) continue;
        for (k = p->first[i]; k < p->first[i + 1]; k++)
            if (full[p->beside[k]]) work[p->beside[k]] -= sides[p->side[k]];
        for (k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
            int j = p->row[k], begin = p->column_start[j], end = begin + f->count[j];
            double y = work[j], l;
            if (y == 0.0) continue; /* it is out of the set, or has nothing to do with this row */
            work[j] = 0.0;
            for (e = begin; e < end; e++) work[f->place[e]] -= f->value[e] * y;
            l = y / f->pivot[j], d -= l * y;
            f->place[end] = i, f->value[end] = l, f->count[j]++;
        }
        if (!(d > SINGULAR * diagonal[i])) return 0;
        f->pivot[i] = d;
    }
    return 1;
}

void ck_factor_solve(const ck_pattern *p, const ck_factor *f, double *x) {
    int j, e;
    for (j = 0; j < p->n; j++) {
        int begin = p->column_start[j], end = begin + f->count[j];
        if (!f->full[j]) x[j] = 0.0;
        if (x[j] == 0.0) continue;
        for (e = begin; e < end; e++) x[f->place[e]] -= f->value[e] * x[j];
    }
    for (j = p->n - 1; j >= 0; j--) {
        int begin = p->column_start[j], end = begin + f->count[j];
        double sum = x[j] / f->pivot[j];
        for (e = begin; e < end; e++) sum -= f->value[e] * x[f->place[e]];
        x[j] = sum;
    }
}
