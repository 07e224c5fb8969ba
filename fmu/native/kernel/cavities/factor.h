/* Sparse symmetric positive definite systems whose pattern stays and whose unknowns come and go: L D L'
   without pivots, of the unknowns that are in a set. They are numbered in the order in which they are
   eliminated, which Python has chosen so that little fills in. */

#ifndef CK_FACTOR_H
#define CK_FACTOR_H

/* Pattern of a matrix, and of its factor by rows. `beside` are the neighbours before an unknown, and
   `side` the sides that lead there. */
typedef struct {
    int n, fill;
    int *first, *beside, *side;           /* [n + 1], [sides], [sides] */
    int *row_start, *row, *column_start; /* [n + 1], [fill], [n + 1] */
} ck_pattern;

/* A factor, and what it is the factor of: a set of unknowns, and the gap that the matrix is for. */
typedef struct {
    int *count, *place; /* entries of each column so far [n], and the rows of them [fill] */
    double *value, *pivot;
    unsigned char *full;
    double gap;
    long used; /* when it was last; 0: it holds nothing */
} ck_factor;

/* How much fills in, with the tree of elimination in `parent`; more than `most` are not counted. */
int ck_fill_of(const ck_pattern *pattern, int *parent, int *mark, int most);
void ck_pattern_rows(ck_pattern *pattern, int *parent, int *mark, int *columns); /* [fill] to work in */
/* 0 if the matrix is not positive definite; `work` is zero before and after. */
int ck_factorise(const ck_pattern *pattern, const double *diagonal, const double *sides,
                 const unsigned char *full, double *work, ck_factor *factor);
/* In place; unknowns that are not in the set are zero. */
void ck_factor_solve(const ck_pattern *pattern, const ck_factor *factor, double *x);

#endif
