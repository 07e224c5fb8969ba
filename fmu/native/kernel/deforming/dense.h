/* Dense systems of equations. */

#ifndef CK_DENSE_H
#define CK_DENSE_H

/* Factors of a matrix of n rows, in its place, with row exchanges; 0 if it is singular or not finite. */
int ck_dense_factor(double *matrix, int *exchanged, int n);
void ck_dense_solve(const double *factors, const int *exchanged, int n, double *right);

#endif
