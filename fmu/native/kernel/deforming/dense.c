/* Dense systems of equations: elimination with row exchanges. */

#include "dense.h"

#include <math.h>

int ck_dense_factor(double *matrix, int *exchanged, int n) {
    int i, j, k;
    for (k = 0; k < n; k++) {
        double *top = matrix + (long)k * n, best = 0.0;
        exchanged[k] = k;
        for (i = k; i < n; i++) {
            double size = fabs(matrix[(long)i * n + k]);
            if (!(size < HUGE_VAL)) return 0;
            if (size > best) best = size, exchanged[k] = i;
        }
        if (best == 0.0) return 0;
        if (exchanged[k] != k) {
            double *other = matrix + (long)exchanged[k] * n;
            for (j = 0; j < n; j++) {
                double kept = top[j];
                top[j] = other[j], other[j] = kept;
            }
        }
        for (i = k + 1; i < n; i++) {
            double *row = matrix + (long)i * n, factor = row[k] / top[k];
            row[k] = factor;
            if (factor != 0.0)
                for (j = k + 1; j < n; j++) row[j] -= factor * top[j];
        }
    }
    return 1;
}

void ck_dense_solve(const double *factors, const int *exchanged, int n, double *right) {
    int i, j;
    for (i = 0; i < n; i++) { /* the rows of the factors are already exchanged */
        double kept = right[exchanged[i]];
        right[exchanged[i]] = right[i], right[i] = kept;
    }
    for (i = 1; i < n; i++) {
        const double *row = factors + (long)i * n;
        double sum = right[i];
        for (j = 0; j < i; j++) sum -= row[j] * right[j];
        right[i] = sum;
    }
    for (i = n - 1; i >= 0; i--) {
        const double *row = factors + (long)i * n;
        double sum = right[i];
        for (j = i + 1; j < n; j++) sum -= row[j] * right[j];
        right[i] = sum / row[i];
    }
}
