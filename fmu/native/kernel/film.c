/* Forces of a film at a gap and a speed, and its impulses between two gaps. */

#include "film.h"
#include "rheology.h"

#include <math.h>

/* A power of the gap by products: pow() of the C libraries differs in its last bits, and a table times a
   whole power is the same everywhere. */
static double power_of(double base, int power) {
    double result = power & 1 ? base : 1.0, square = base * base;
    for (power >>= 1; power > 0; power--) result *= square;
    return result;
}

/* Place of a gap along a piece, and its derivative by the gap. */
static double place(const ck_piece *piece, double gap, double log_gap, double *by_gap) {
    double depth, root;
    if (!piece->folds) {
        *by_gap = 1.0 / gap;
        return log_gap;
    }
    /* Close to the end the difference of logarithms keeps few digits, of which the root takes half. */
    depth = piece->log_end - log_gap;
    if (depth < 1e-3) depth = gap < piece->high ? log1p((piece->high - gap) / gap) : 0.0;
    if (depth <= 1e-12) { /* the slope of a fold has no bound */
        *by_gap = 0.0;
        return depth > 0.0 ? sqrt(depth) : 0.0;
    }
    root = sqrt(depth);
    *by_gap = -0.5 / (root * gap);
    return root;
}

/* A motion asks for gaps next to each other: the cell of the last call is tried first. */
static const ck_cell *cell_at(const ck_piece *piece, double x) {
    const ck_cell *cells = piece->cells;
    int low = *piece->hint, high = piece->n_nodes - 1;
    if (cells[low].x <= x && (low + 1 == high || x < cells[low + 1].x)) return &cells[low];
    low = 0;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (cells[middle].x <= x) low = middle;
        else high = middle;
    }
    *piece->hint = low;
    return &cells[low];
}

/* Quintics, whose slope and curvature are continuous, too: the slopes of forces go into Newton's
   iterations, and an error estimate of order three sees jumps of a curvature. */
static double value_at(const ck_piece *piece, double x, double *by_x) {
    const ck_cell *cell = cell_at(piece, x);
    const double *c = cell->c;
    double t = (x - cell->x) * cell->per_width;
    *by_x = (c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5])))) *
            cell->per_width;
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
}

/* Value at a gap whose logarithm is known, and its slope. Beyond the table y stays. */
double ck_table_at(const ck_table *table, double gap, double log_gap, double *by_gap) {
    const ck_piece *piece = &table->pieces[0], *last = &table->pieces[table->n_pieces - 1];
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
        y = value_at(piece, x, &by_x);
        by_x = 0.0;
    } else {
        x = place(piece, gap, log_gap, &x_by_gap);
        y = value_at(piece, x, &by_x);
    }
    factor = power_of(1.0 / gap, piece->power);
    y *= factor;
    *by_gap = by_x * x_by_gap * factor - piece->power * y / gap;
    return y;
}

/* Take the smaller one; `menisci` and the area of a disc go into the slopes. */
static void take(ck_left *found, ck_left *left, double menisci, double area, int kind,
                 int *limit) {
    if (!(fabs(menisci * left->value) < fabs(found->value))) return;
    *found = *left;
    found->value *= menisci, found->by_gap *= menisci, found->by_shape *= menisci * area;
    *limit = kind;
}

/* What the limits leave of the force of the liquid; what no limit bounds is added. */
static void limited(const ck_acting *a, double gap, double log_gap, double speed, double liquid,
                    double liquid_by_gap, ck_forces *found) {
    double by_gap, n = a->menisci, force = liquid * speed;
    double shape = ck_table_at(&a->film->shape, gap, log_gap, &by_gap);
    ck_left left, least = {force, 1.0, 0.0, 0.0};
    if (a->tension > 0.0 && speed > 0.0) {
        if (a->is_sphere) ck_sphere_tension(force / n, a->sphere_radius, gap, shape, a->tension, &left);
        else if (a->reynolds) ck_disc_tension_reynolds(force / n, CK_PI * shape, a->tension, &left);
        else ck_disc_tension(force / n, CK_PI * shape, a->tension, &left);
        take(&least, &left, n, a->is_sphere ? 1.0 : CK_PI, CK_LIMIT_KIND_TENSION, &found->limit);
    }
    if (a->strength > 0.0) {
        if (a->is_sphere) ck_sphere_shear(force / n, a->sphere_radius, gap, shape, a->strength, &left);
        else ck_disc_shear(force / n, shape, gap, a->strength, &left);
        take(&least, &left, n, 1.0, CK_LIMIT_KIND_SHEAR, &found->limit);
    }
    found->viscous = least.value + found->free * speed;
    found->viscous_by_gap = least.by_force * (liquid_by_gap * speed) + least.by_gap +
                            least.by_shape * by_gap + found->free_by_gap * speed;
    found->viscous_by_speed = least.by_force * liquid + found->free;
}

/* Forces at a gap and a speed, with their slopes. */
void ck_forces_at(const ck_acting *a, double gap, double speed, ck_forces *found) {
    double log_gap = log(gap), liquid = 0.0, liquid_by_gap = 0.0;
    int i;
    const ck_forces nothing = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, CK_LIMIT_KIND_NONE, 0};
    *found = nothing;
    for (i = 0; a->any && i < a->film->n_laws; i++) {
        const ck_law *law = &a->film->laws[i];
        double value, by_gap, scale = 1.0;
        if (!a->acts[i]) continue;
        value = ck_table_at(&law->table, gap, log_gap, &by_gap);
        if (law->scale == CK_SCALE_SURFACE_TENSION) scale = a->surface_tension;
        else if (law->scale == CK_SCALE_VISCOSITY) scale = a->viscosity;
        value *= scale, by_gap *= scale;
        if (law->rate == CK_RATE_AT_REST) found->fixed += value, found->fixed_by_gap += by_gap;
        else if (law->rate == CK_RATE_PER_SPEED) found->free += value, found->free_by_gap += by_gap;
        else liquid += value, liquid_by_gap += by_gap;
    }
    found->resistance = liquid + found->free;
    found->resistance_by_gap = liquid_by_gap + found->free_by_gap;
    found->viscous = found->resistance * speed;
    found->viscous_by_gap = found->resistance_by_gap * speed;
    found->viscous_by_speed = found->resistance;
    found->bent = a->rheology && liquid != 0.0;
    if (liquid * speed == 0.0) return;
    if (a->rheology) ck_rheological_force(a, gap, log_gap, speed, liquid, liquid_by_gap, found);
    else if (a->limited)
        limited(a, gap, log_gap, speed, liquid, liquid_by_gap, found);
}

double ck_fixed_force(const ck_acting *a, double gap) {
    ck_forces found;
    ck_forces_at(a, gap, 0.0, &found);
    return found.fixed;
}

/* Impulses over a change of the gap ------------------------------------------------------------ */

/* Gauss-Legendre in panels of the gap. Without limits the viscous impulse depends on the two gaps
   only, and the panels are fine enough for it to be as good as the tables, 1e-12. Where a limit sets
   in the force has a kink: the panel is halved until what the kink leaves out is negligible. */
#define WIDEST 0.25 /* of a panel, in ln h: six nodes leave 5e-13 of h^-3; 0.5 leaves 2e-9 */
#define MOST_PANELS 10000 /* more than there are between any two gaps that are numbers */
#define NARROW 0.01 /* three nodes leave 1e-14 of h^-3 below it; 2e-10 below 0.05 */
/* Halvings of a panel with a kink. What is left out of the force around it goes with the square of the
   last width: 4^-9 = 4e-6 of a panel's jump in slope. */
#define DEEPEST 9

/* Half of the symmetric nodes on (-1, 1), with their weights; three nodes, then six. */
static const double NODES[2][3] = {{0.0, 0.77459666924148337704, 0.0},
                                   {0.23861918608319690863, 0.66120938646626451366,
                                    0.93246951420315202781}};
static const double WEIGHTS[2][3] = {{0.88888888888888888889, 0.55555555555555555556, 0.0},
                                     {0.46791393457269104739, 0.36076157304813860757,
                                      0.17132449237917034504}};

typedef struct {
    const ck_acting *acting;
    double speed, pace; /* of the gap; time per gap, 0 while it rests */
    ck_impulse sum;
} travel;

static int add(travel *w, double gap, double time, int limit, ck_impulse *sum) {
    ck_forces f;
    ck_forces_at(w->acting, gap, w->speed, &f);
    sum->viscous += time * f.viscous;
    sum->fixed += time * f.fixed;
    sum->free += time * f.free * w->speed;
    return f.limit == limit;
}

/* One panel; a limit begins or ends to act inside if it differs between the ends and the nodes. */
static void panel(travel *w, double begin, double end, int depth) {
    double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), time = half * w->pace;
    int six = fabs(half) > 0.5 * NARROW * middle, i, is_smooth = 1, limit = CK_LIMIT_KIND_NONE;
    ck_impulse sum = {0.0, 0.0, 0.0};
    if (w->acting->limited) {
        ck_forces f;
        ck_forces_at(w->acting, begin, w->speed, &f);
        limit = f.limit;
        ck_forces_at(w->acting, end, w->speed, &f);
        is_smooth = f.limit == limit;
    }
    for (i = 0; i < (six ? 3 : 2); i++) {
        double x = half * NODES[six][i], t = time * WEIGHTS[six][i];
        is_smooth &= add(w, middle + x, t, limit, &sum);
        if (x != 0.0) is_smooth &= add(w, middle - x, t, limit, &sum);
    }
    if (!is_smooth && w->acting->limited && depth < DEEPEST) {
        panel(w, begin, middle, depth + 1);
        panel(w, middle, end, depth + 1);
        return;
    }
    w->sum.viscous += sum.viscous;
    w->sum.fixed += sum.fixed;
    w->sum.free += sum.free;
}

ck_impulse ck_along(const ck_acting *acting, double begin, double end, double length) {
    double ratio = log(end / begin), gap = begin, factor;
    travel w = {acting, (end - begin) / length, 0.0, {0.0, 0.0, 0.0}};
    int count, i;
    if (!acting->any) return w.sum;
    if (!(fabs(ratio) < WIDEST * MOST_PANELS)) { /* from nothing, or without end: for others to find */
        w.sum.viscous = w.sum.fixed = w.sum.free = NAN;
        return w.sum;
    }
    count = (int)ceil(fabs(ratio) / WIDEST);
    if (begin == end) {
        w.sum.fixed = length * ck_fixed_force(acting, begin);
        return w.sum;
    }
    w.pace = length / (end - begin);
    factor = count > 1 ? exp(ratio / count) : 1.0;
    for (i = 1; i < count; i++, gap *= factor) panel(&w, gap, gap * factor, 0);
    panel(&w, gap, end, 0);
    return w.sum;
}
