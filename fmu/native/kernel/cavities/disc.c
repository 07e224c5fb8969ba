/* Edge, force and growth of a round cavity, and its void at the stages of a step. See disc_cavity.py and
   separation/cavity/stages.py for the equations. */

#include "cavity.h"

#include <math.h>

#define NARROW 0.03 /* width of the ring below which the closed form would cancel: see disc_cavity.py */
/* Fraction of the disc within an edge that is taken for a point: the logarithm of the edge stays below
   32, and the area left out is at round-off. */
#define SMALLEST 1e-14
#define MOST_ITERATIONS 30 /* Newton takes up to eight: see separation/cavity/stages.py */
#define ENOUGH 1e-15       /* change of the void, over the volume of the film: round-off */

static double larger(double a, double b) { return a > b ? a : b; }
static double smaller(double a, double b) { return a < b ? a : b; }

static double conductance(const ck_cavity_law *law, double gap) {
    return gap * gap * gap / (12.0 * law->viscosity);
}

/* Square of the radius of the film, and its slope: as far as liquid and void fill the gap. */
double ck_disc_rim(const ck_cavity_law *law, double gap, double hollow, double *by_void) {
    double reach = CK_PI * gap, free = (law->volume + hollow) / reach;
    *by_void = free < law->rim_square ? 1.0 / reach : 0.0;
    return free < law->rim_square ? free : law->rim_square;
}

/* Tension in the centre of the full film. */
double ck_disc_tension_at(const ck_cavity_law *law, double gap, double speed, double hollow) {
    double ignored;
    return 0.25 * speed * ck_disc_rim(law, gap, hollow, &ignored) / conductance(law, gap);
}

/* 1 - rho + rho ln(rho) of x = 1 - rho, without cancellation. */
static double pressure_of(double x) {
    double term = x * x, total = 0.0;
    int n = 2;
    if (x > 0.1) return x + (1.0 - x) * log1p(-x);
    for (; term > 1e-18 * x * x; n++, term *= x) total += term / (n * (n - 1));
    return total;
}

/* Fraction of the disc within the edge of a cavity from which the liquid recedes. */
double ck_receding_edge(double sigma) {
    double full, x, rest, rho;
    int i;
    if (!(sigma > 1.0)) return 0.0;
    full = 1.0 / sigma;
    if (full < 0.5) {
        x = sqrt(2.0 * full);
        for (i = 0; i < 60; i++) {
            double change = (pressure_of(x) - full) / -log1p(-x);
            x -= change;
            if (fabs(change) <= 1e-16 * x) break;
        }
        return 1.0 - x;
    }
    rest = 1.0 - full;
    rho = rest / (1.0 - log(rest / (1.0 - log(rest))));
    for (i = 0; i < 60; i++) {
        double l = log(rho), change = (rho * (1.0 - l) - rest) / -l;
        rho -= change;
        if (fabs(change) <= 1e-16 * rho) break;
    }
    return rho;
}

/* Force of a ring of film around a cavity, with that of the cavity itself, and its slope. */
static double ring(double rho, double rim, double k, double drop, double speed, double *by_speed) {
    /* 1 - x/2 - x^2/12 - ... is x/ln(1/(1 - x)); coefficients from x^2 on */
    static const double gregory[8] = {1.0 / 12.0,      1.0 / 24.0,         19.0 / 720.0,
                                      3.0 / 160.0,     863.0 / 60480.0,    275.0 / 24192.0,
                                      33953.0 / 3628800.0, 8183.0 / 1036800.0};
    double disc = CK_PI * rim, width = 1.0 - rho, held, shape, rest, power;
    int i;
    if (rho <= 0.0) {
        *by_speed = 0.125 * disc * rim / k;
        return *by_speed * speed;
    }
    if (width < NARROW) {
        rest = power = width * width;
        rest *= gregory[0];
        for (i = 1; i < 8; i++) power *= width, rest += gregory[i] * power;
        held = 1.0 - 0.5 * width - rest;
        shape = 0.25 * width * rest;
    } else {
        held = width / -log(rho);
        shape = 0.125 * width * (1.0 + rho - 2.0 * held);
    }
    *by_speed = disc * rim / k * shape;
    return disc * drop * held + *by_speed * speed;
}

/* Edge of the cavity at a gap, a speed and a void, in the phase it is in. */
void ck_disc_spot_at(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at, double hollow,
                ck_spot *spot) {
    double rim_by_void, rim = ck_disc_rim(law, at.gap, hollow, &rim_by_void), tau = 2.0 * CK_PI;
    double k = conductance(law, at.gap), speed = at.speed, edge, rupture_gap;
    double l, c, by_edge, by_rim, deeper;
    spot->rim = rim;
    if (cavity->phase == CK_RECEDING) {
        double full = speed > 0.0 ? 4.0 * k * law->drop / (speed * rim) : HUGE_VAL;
        double rho = full < 1.0 ? ck_receding_edge(1.0 / full) : 0.0;
        double over_rim = rho > 0.0 ? rho - full / log(rho) : 0.0, rate = CK_PI * speed;
        spot->fraction = rho, spot->edge = rho * rim;
        spot->growth = rate * spot->edge, spot->by_void = rate * over_rim * rim_by_void;
        spot->returns = 0.0;
        return;
    }
    edge = ck_history_edge(cavity, at.gap, hollow, &rupture_gap);
    edge = smaller(larger(edge, SMALLEST * rim), (1.0 - 1e-15) * rim);
    l = rim < 1.03 * edge ? log1p((rim - edge) / edge) : log(rim / edge);
    c = 2.0 * (k * law->drop - 0.25 * speed * (rim - edge)) / l;
    by_edge = -tau * ((0.5 * speed + c / edge) / l);
    by_rim = -tau * (-(0.5 * speed + c / rim) / l);
    deeper = CK_PI * larger(at.gap - rupture_gap, 1e-12 * at.gap);
    spot->fraction = edge / rim, spot->edge = edge;
    spot->growth = -tau * c, spot->by_void = by_edge / deeper + by_rim * rim_by_void;
    spot->returns = tau * (0.5 * speed * edge + c);
}

void ck_disc_held_at(const ck_cavity_law *law, const ck_spot *spot, ck_place at, ck_held *held) {
    double n = law->menisci, by_speed;
    held->force = n * ring(spot->fraction, spot->rim, conductance(law, at.gap), law->drop, at.speed,
                           &by_speed);
    held->by_gap = -3.0 * n * by_speed * at.speed / at.gap;
    held->by_speed = n * by_speed;
}

/* The void is the unknown, not the edge: it is an integral of the flow and smooth where the edge jumps
   from one piece of the memory to the next. */
/* Change of the voids that the equations of the stages ask for; 0 if there is none. */
static int newton(double first, double dt, const double voids[3], const ck_spot spots[3],
                  double change[3]) {
    double a[3][3], r[3], m0, m1, m2, det;
    int i, j;
    for (i = 0; i < 3; i++) {
        double sum = 0.0;
        for (j = 0; j < 3; j++) {
            sum += ck_stages[i][j] * spots[j].growth;
            a[i][j] = (i == j) - dt * ck_stages[i][j] * spots[j].by_void;
        }
        r[i] = voids[i] - first - dt * sum;
    }
    m0 = a[1][1] * a[2][2] - a[1][2] * a[2][1], m1 = a[1][2] * a[2][0] - a[1][0] * a[2][2];
    m2 = a[1][0] * a[2][1] - a[1][1] * a[2][0];
    det = a[0][0] * m0 + a[0][1] * m1 + a[0][2] * m2;
    if (det == 0.0 || !isfinite(det)) return 0;
    change[0] = (r[0] * m0 + a[0][1] * (a[1][2] * r[2] - r[1] * a[2][2]) +
                 a[0][2] * (r[1] * a[2][1] - a[1][1] * r[2])) / det;
    change[1] = (a[0][0] * (r[1] * a[2][2] - a[1][2] * r[2]) + r[0] * m1 +
                 a[0][2] * (a[1][0] * r[2] - r[1] * a[2][0])) / det;
    change[2] = (a[0][0] * (a[1][1] * r[2] - r[1] * a[2][1]) +
                 a[0][1] * (r[1] * a[2][0] - a[1][0] * r[2]) + r[0] * m2) / det;
    return isfinite(change[0] + change[1] + change[2]);
}

/* Error of the void at the end of a step, by the estimate of the method. */
static double error_of(double first, double dt, const double voids[3], const ck_spot *start) {
    double gone = 0.0, slope = isfinite(start->by_void) ? smaller(start->by_void, 0.0) : 0.0;
    int i;
    for (i = 0; i < 3; i++) gone += ck_estimate[i] * (voids[i] - first);
    return fabs((start->growth + gone / dt) / (ck_gamma / dt - slope));
}

/* Voids at the stages of a step, with the edges and forces there. */
int ck_disc_hollow_solve(const ck_cavity_law *law, const ck_cavity *cavity, ck_place begin, double dt,
                    const ck_place at[3], ck_hollow *found) {
    double first = cavity->hollow, scale, change[3], *voids = found->voids;
    ck_spot start;
    int i, iteration;
    ck_disc_spot_at(law, cavity, begin, first, &start);
    scale = CK_PI * start.rim * begin.gap;
    for (i = 0; i < 3; i++) {
        voids[i] = first + CK_PI * start.edge * (at[i].gap - begin.gap);
        if (cavity->phase == CK_RETURNING) voids[i] = larger(voids[i], 0.0);
    }
    for (iteration = 0;; iteration++) {
        double most = 0.0;
        if (iteration == MOST_ITERATIONS) return 0;
        for (i = 0; i < 3; i++) ck_disc_spot_at(law, cavity, at[i], voids[i], &found->spots[i]);
        if (!newton(first, dt, voids, found->spots, change)) return 0;
        for (i = 0; i < 3; i++) {
            voids[i] -= change[i];
            most = larger(most, fabs(change[i]));
        }
        if (most <= ENOUGH * scale) break;
    }
    for (i = 0; i < 3; i++) ck_disc_held_at(law, &found->spots[i], at[i], &found->held[i]);
    found->error = error_of(first, dt, voids, &start) / scale;
    return 1;
}
