/* Forces of a film at a gap and a speed. */

#include "film.h"

#include <math.h>

#define CK_PI 3.14159265358979323846

static double power_of(double base, int power) {
    double result = 1.0;
    int i;
    for (i = 0; i < power; i++) result *= base;
    return result;
}

/* Place of a gap along a piece, and its derivative by the gap. */
static double place(const ck_piece *piece, double gap, double log_gap, double *by_gap) {
    double depth, root;
    if (!piece->folds) {
        *by_gap = 1.0 / gap;
        return log_gap;
    }
    depth = piece->log_end - log_gap;
    if (depth < 1e-3) depth = gap < piece->end ? log1p((piece->end - gap) / gap) : 0.0;
    if (depth <= 1e-12) { /* the slope of a fold has no bound */
        *by_gap = 0.0;
        return depth > 0.0 ? sqrt(depth) : 0.0;
    }
    root = sqrt(depth);
    *by_gap = -0.5 / (root * gap);
    return root;
}

static int interval(const ck_piece *piece, double x) {
    int low = *piece->hint, high = piece->count - 1;
    if (piece->x[low] <= x && x < piece->x[low + 1]) return low;
    low = 0;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (piece->x[middle] <= x) low = middle;
        else high = middle;
    }
    *piece->hint = low;
    return low;
}

static double hermite(const ck_piece *piece, double x, double *by_x) {
    int i = interval(piece, x);
    double width = piece->x[i + 1] - piece->x[i], t = (x - piece->x[i]) / width;
    double rise = piece->y[i + 1] - piece->y[i];
    double a = piece->slope[i] * width, b = piece->slope[i + 1] * width;
    double c = 3.0 * rise - 2.0 * a - b, d = a + b - 2.0 * rise;
    *by_x = (a + t * (2.0 * c + 3.0 * d * t)) / width;
    return piece->y[i] + t * (a + t * (c + t * d));
}

/* Value at a gap whose logarithm is known, and its slope. Beyond the table y stays. */
double ck_table_at(const ck_table *table, double gap, double log_gap, double *by_gap) {
    const ck_piece *piece = &table->pieces[0], *last = &table->pieces[table->count - 1];
    double x, y, by_x, factor, x_by_gap;
    int beyond = 0;
    if (gap > last->high) {
        if (table->stays) {
            double ignored;
            y = ck_table_at(table, last->high, log(last->high), &ignored);
            *by_gap = 0.0;
            return y;
        }
        piece = last, beyond = 1;
    } else if (gap < piece->low) {
        beyond = 1;
    } else {
        while (piece < last && gap >= piece->high) piece++;
    }
    if (beyond) {
        double edge = gap < piece->low ? piece->low : piece->high;
        x = place(piece, edge, log(edge), &x_by_gap);
        y = hermite(piece, x, &by_x);
        by_x = 0.0;
    } else {
        x = place(piece, gap, log_gap, &x_by_gap);
        y = hermite(piece, x, &by_x);
    }
    factor = power_of(1.0 / gap, piece->power);
    y *= factor;
    *by_gap = by_x * x_by_gap * factor - piece->power * y / gap;
    return y;
}

static double limited(const ck_acting *a, double gap, double log_gap, double force, int opens,
                      int *limit) {
    double ignored, found = force, left, n = a->menisci;
    double shape = ck_table_at(&a->film->shape, gap, log_gap, &ignored);
    if (a->tension > 0.0 && opens) {
        if (a->is_sphere) left = n * ck_sphere_tension(force / n, a->sphere_radius, gap, shape, a->tension);
        else if (a->reynolds) left = ck_disc_tension_reynolds(force, n * CK_PI * shape, a->tension);
        else left = ck_disc_tension(force, n * CK_PI * shape, a->tension);
        if (fabs(left) < fabs(found)) found = left, *limit = 1;
    }
    if (a->strength > 0.0) {
        if (a->is_sphere) left = n * ck_sphere_shear(force / n, a->sphere_radius, gap, shape, a->strength);
        else left = n * ck_disc_shear(force / n, sqrt(shape), gap, a->strength);
        if (fabs(left) < fabs(found)) found = left, *limit = 2;
    }
    return found;
}

static double limited_at(const ck_acting *a, double gap, double speed) {
    double c = 0.0, log_gap = log(gap), ignored;
    int i, limit;
    for (i = 0; i < a->film->count; i++)
        if (a->acts[i] && a->film->laws[i].scale == CK_VISCOSITY)
            c = a->viscosity * ck_table_at(&a->film->laws[i].table, gap, log_gap, &ignored);
    return limited(a, gap, log_gap, c * speed, speed > 0.0, &limit);
}

/* Forces at a gap and a speed; slopes of the viscous force only where asked for. */
void ck_forces_at(const ck_acting *a, double gap, double speed, int slopes, ck_forces *found) {
    double log_gap = log(gap);
    int i;
    const ck_forces nothing = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
    *found = nothing;
    for (i = 0; a->any && i < a->film->count; i++) {
        const ck_law *law = &a->film->laws[i];
        double value, by_gap;
        if (!a->acts[i]) continue;
        value = ck_table_at(&law->table, gap, log_gap, &by_gap);
        if (law->scale == CK_VISCOSITY) {
            found->resistance = a->viscosity * value;
            found->resistance_by_gap = a->viscosity * by_gap;
        } else {
            double scale = law->scale == CK_TENSION_SURFACE ? a->surface_tension : 1.0;
            found->fixed += scale * value;
            found->fixed_by_gap += scale * by_gap;
        }
    }
    found->viscous = found->resistance * speed;
    found->viscous_by_gap = found->resistance_by_gap * speed;
    found->viscous_by_speed = found->resistance;
    if (!a->limited || found->resistance == 0.0) return;
    found->viscous = limited(a, gap, log_gap, found->viscous, speed > 0.0, &found->limit);
    if (found->limit && slopes) { /* no closed form that is worth its lines */
        double dh = 1e-5 * gap, dv = 1e-5 * fabs(speed);
        found->viscous_by_gap =
            (limited_at(a, gap + dh, speed) - limited_at(a, gap - dh, speed)) / (2.0 * dh);
        found->viscous_by_speed =
            (limited_at(a, gap, speed + dv) - limited_at(a, gap, speed - dv)) / (2.0 * dv);
    }
}

double ck_fixed_force(const ck_acting *a, double gap) {
    ck_forces found;
    ck_forces_at(a, gap, 0.0, 0, &found);
    return found.fixed;
}
