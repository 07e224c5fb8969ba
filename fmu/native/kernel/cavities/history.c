/* Rupture history: at which gap the film ruptured at each radius. See rupture_history.py for the
   equations. */

#include "cavity.h"

#include <math.h>

static double square_at(const ck_rupture_piece *p, double t) {
    return p->y[0] + t * (p->y[1] + t * (p->y[2] + t * p->y[3]));
}

static double gap_at(const ck_rupture_piece *p, double t) {
    return p->h[0] + t * (p->h[1] + t * (p->h[2] + t * p->h[3]));
}

static double rate_at(const ck_rupture_piece *p, double t) {
    return p->y[1] + t * (2.0 * p->y[2] + 3.0 * t * p->y[3]);
}

/* Liquid up to a parameter, exactly. */
static double liquid_at(const ck_rupture_piece *p, double t) {
    double y1 = p->y[1], y2 = 2.0 * p->y[2], y3 = 3.0 * p->y[3]; /* of the slope */
    double h0 = p->h[0], h1 = p->h[1], h2 = p->h[2], h3 = p->h[3], total = (h3 * y3) / 6.0;
    total = total * t + (h2 * y3 + h3 * y2) / 5.0;
    total = total * t + (h1 * y3 + h2 * y2 + h3 * y1) / 4.0;
    total = total * t + (h0 * y3 + h1 * y2 + h2 * y1) / 3.0;
    total = total * t + (h0 * y2 + h1 * y1) / 2.0;
    return p->before + CK_PI * t * (total * t + h0 * y1);
}

int ck_is_cavity(const ck_cavity *cavity) {
    return cavity->phase >= CK_FULL && cavity->phase <= CK_RETURNING && cavity->count >= 0 &&
           cavity->count <= CK_RUPTURE_PIECES;
}

double ck_history_liquid(const ck_cavity *cavity) {
    return cavity->count ? liquid_at(&cavity->history[cavity->count - 1], 1.0) : 0.0;
}

double ck_history_outermost(const ck_cavity *cavity) {
    return cavity->count ? square_at(&cavity->history[cavity->count - 1], 1.0) : 0.0;
}

/* Coefficients of the cubic through values at the start of a step and its stages. */
static void cubic(const double f[4], double found[4]) {
    double x[4], d1[3], d2[2], d;
    int i;
    x[0] = 0.0;
    for (i = 0; i < 3; i++) x[i + 1] = ck_nodes[i];
    for (i = 0; i < 3; i++) d1[i] = (f[i + 1] - f[i]) / (x[i + 1] - x[i]);
    for (i = 0; i < 2; i++) d2[i] = (d1[i + 1] - d1[i]) / (x[i + 2] - x[i]);
    d = (d2[1] - d2[0]) / x[3];
    found[0] = f[0], found[1] = d1[0] - d2[0] * x[1] + d * x[1] * x[2];
    found[2] = d2[0] - d * (x[0] + x[1] + x[2]), found[3] = d;
}

void ck_history_along(ck_rupture_piece *piece, double before, const double squares[4],
                   const double gaps[4]) {
    cubic(squares, piece->y);
    cubic(gaps, piece->h);
    piece->before = before;
}

/* Index of the piece in which the edge of a void is, and the parameter there. */
static int place(const ck_cavity *cavity, double gap, double hollow, double *where) {
    double reach = CK_PI * gap, below, above, low = 0.0, high = 1.0, t;
    int index = 0, last = cavity->count - 1, i;
    const ck_rupture_piece *history = cavity->history, *p;
    /* Outwards, to the first edge that holds the void: where the gap of rupture is above the present one
       the void falls again, as liquid is back. */
    while (index < last && reach * history[index + 1].y[0] - history[index + 1].before < hollow) {
        index++;
    }
    p = &history[index];
    below = reach * p->y[0] - p->before - hollow;
    above = reach * square_at(p, 1.0) - liquid_at(p, 1.0) - hollow;
    *where = 1.0;
    if (above <= 0.0) return index;
    *where = 0.0;
    if (below >= 0.0) return index;
    t = below / (below - above);
    for (i = 0; i < 60; i++) {
        double miss = reach * square_at(p, t) - liquid_at(p, t) - hollow, slope, guess;
        if (miss < 0.0) low = t;
        else high = t;
        slope = CK_PI * rate_at(p, t) * (gap - gap_at(p, t));
        guess = slope > 0.0 ? t - miss / slope : -1.0;
        if (!(low < guess && guess < high)) guess = 0.5 * (low + high);
        if (fabs(guess - t) <= 1e-15 || fabs(miss) <= 1e-16 * hollow) break;
        t = guess;
    }
    *where = t;
    return index;
}

/* Square of the radius of the edge of a void, and the gap at which it was there. */
double ck_history_edge(const ck_cavity *cavity, double gap, double hollow, double *rupture_gap) {
    double held, t;
    int index;
    *rupture_gap = gap;
    if (!cavity->count) return 0.0;
    held = CK_PI * gap * ck_history_outermost(cavity) - ck_history_liquid(cavity);
    if (hollow <= 0.0 && 0.0 < held) {
        *rupture_gap = cavity->history[0].h[0];
        return 0.0;
    }
    index = place(cavity, gap, hollow, &t);
    *rupture_gap = gap_at(&cavity->history[index], t);
    return square_at(&cavity->history[index], t);
}

/* Forget the ruptures beyond the edge of a void. */
void ck_history_cut(ck_cavity *cavity, double gap, double hollow) {
    double t, scale = 1.0;
    ck_rupture_piece *p;
    int i, index;
    if (!cavity->count) return;
    index = place(cavity, gap, hollow, &t);
    p = &cavity->history[index];
    for (i = 1; i < 4; i++) {
        scale *= t;
        p->y[i] *= scale, p->h[i] *= scale;
    }
    cavity->count = index + 1;
}

/* One piece for two neighbours with their liquid, in which both cubics ascend. */
static void join(ck_rupture_piece *first, const ck_rupture_piece *second) {
    double low = first->y[0], high = square_at(second, 1.0), begin = first->h[0];
    double end = gap_at(second, 1.0), liquid = liquid_at(second, 1.0) - first->before;
    double width = high - low, mean, share, bend;
    mean = width > 0.0 ? liquid / (CK_PI * width) : 0.5 * (begin + end);
    share = end != begin ? (mean - begin) / (end - begin) : 0.5;
    bend = fmin(fmax(4.0 * share - 2.0, -1.0), 1.0);
    if (share < 0.25) end = begin + 4.0 * (mean - begin);
    else if (share > 0.75) begin = end - 4.0 * (end - mean);
    first->y[1] = width * (bend >= 0.0 ? 1.0 - bend : 1.0 - 2.0 * bend);
    first->y[2] = width * (bend >= 0.0 ? 0.0 : 3.0 * bend);
    first->y[3] = width * (bend >= 0.0 ? bend : -bend);
    first->h[0] = begin, first->h[1] = end - begin, first->h[2] = first->h[3] = 0.0;
}

/* What two neighbours lose when they become one, by the radii and gaps they span. */
static double lost(const ck_cavity *cavity, const ck_rupture_piece *last, int i) {
    const ck_rupture_piece *low = &cavity->history[i], *high;
    double y, h;
    if (i + 2 == CK_RUPTURE_PIECES) y = last->y[0], h = last->h[0];
    else if (i + 2 > CK_RUPTURE_PIECES) y = square_at(last, 1.0), h = gap_at(last, 1.0);
    else high = &cavity->history[i + 2], y = high->y[0], h = high->h[0];
    return (y - low->y[0]) * fabs(h - low->h[0]);
}

/* Add a piece; where there are too many, two become one: those over which radius and gap change
   least. */
void ck_history_add(ck_cavity *cavity, const ck_rupture_piece *piece) {
    double least = HUGE_VAL;
    int i, index = 0;
    if (cavity->count < CK_RUPTURE_PIECES) {
        cavity->history[cavity->count++] = *piece;
        return;
    }
    for (i = 0; i < CK_RUPTURE_PIECES; i++) {
        double one = lost(cavity, piece, i);
        if (one < least) least = one, index = i;
    }
    if (index == CK_RUPTURE_PIECES - 1) {
        join(&cavity->history[index], piece);
        return;
    }
    join(&cavity->history[index], &cavity->history[index + 1]);
    for (i = index + 1; i < CK_RUPTURE_PIECES - 1; i++) cavity->history[i] = cavity->history[i + 1];
    cavity->history[CK_RUPTURE_PIECES - 1] = *piece;
}
