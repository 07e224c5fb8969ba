/* Impulses of a film along the way between two gaps: Gauss-Legendre in panels of the gap.

   Without limits the viscous impulse does not depend on the way, and the panels are fine enough
   for it to be right to rounding. Where a limit sets in the force has a kink: the panel is halved
   until what the kink leaves out is nothing. */

#include "film.h"

#include <math.h>

#define WIDEST 0.25 /* of a panel, in ln h */
#define NARROW 0.01 /* three nodes are enough below it */
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
} way;

static int add(way *w, double gap, double time, int limit, ck_impulse *sum) {
    ck_forces f;
    ck_forces_at(w->acting, gap, w->speed, &f);
    sum->viscous += time * f.viscous;
    sum->fixed += time * f.fixed;
    return f.limit == limit;
}

/* One panel; a limit sets in or lets go inside if it differs between the ends and the nodes. */
static void panel(way *w, double begin, double end, int depth) {
    double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), time = half * w->pace;
    int six = fabs(half) > 0.5 * NARROW * middle, i, is_smooth = 1, limit = 0;
    ck_impulse sum = {0.0, 0.0};
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
}

ck_impulse ck_along(const ck_acting *acting, double begin, double end, double length) {
    double ratio = log(end / begin), gap = begin, factor;
    int count = (int)ceil(fabs(ratio) / WIDEST), i;
    way w = {acting, (end - begin) / length, 0.0, {0.0, 0.0}};
    if (!acting->any) return w.sum;
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
