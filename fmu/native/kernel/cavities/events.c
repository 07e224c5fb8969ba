/* Events of a round cavity: its inception, the turns of its edge, and the film that is full again. As
   contactkit/separation/cavity/events.py, and numerics/events.py for the step that ends at one. */

#include "cavity.h"

#include <math.h>
#include <string.h>

/* Void over the film at which it counts as full: the edge runs into the centre like a logarithm as the
   void vanishes, which no step size follows to the end. Larger, and it is full too early. */
#define REFORMED 1e-9
#define NOTHING 1e-8  /* the same of a cavity that never was deeper than SHALLOW */
#define SAME 1e-12    /* squares of the edge that are closer, relatively, are one */
/* Depth of the void at the edge over the gap. The edge is where the void left is that of the memory,
   a quotient of two small differences: below this round-off moves it. */
#define SHALLOW 1e-6
#define RECEDES 1e-6  /* flow over the edge, over that into the film, which is more than round-off */
#define MOST_TRIALS 60 /* these three as in numerics/events.py, where the reasons are */
#define QUICK 0.01
#define MOST_SECANTS 3

/* Void up to which a film counts as full. */
static double nothing(const ck_cavity_law *law, const ck_cavity *cavity, double gap) {
    double ignored, rim = ck_disc_rim(law, gap, cavity->hollow, &ignored);
    double film = CK_PI * rim * gap;
    return (cavity->largest < SHALLOW * film ? NOTHING : REFORMED) * film;
}

static void constant_piece(ck_rupture_piece *piece, double low, double high, double gap, double before) {
    memset(piece, 0, sizeof *piece);
    piece->y[0] = low, piece->y[1] = high - low, piece->h[0] = gap, piece->before = before;
}

/* The liquid cavitates: from its strength to its cavity, at once. */
static void inception(const ck_cavity_law *law, ck_cavity *cavity, ck_place at) {
    double ignored, rim = ck_disc_rim(law, at.gap, 0.0, &ignored);
    memset(cavity, 0, sizeof *cavity);
    cavity->phase = CK_RECEDING;
    cavity->fraction = ck_receding_edge(ck_disc_tension_at(law, at.gap, at.speed, 0.0) / law->drop);
    constant_piece(&cavity->history[0], 0.0, cavity->fraction * rim, at.gap, 0.0);
    cavity->count = 1;
}

static void squares_of(const ck_cavity *cavity, const ck_hollow *solved, double squares[4]) {
    int i;
    squares[0] = ck_history_outermost(cavity);
    for (i = 0; i < 3; i++) squares[i + 1] = solved->spots[i].edge;
}

/* Distance beyond the next event of a cavity at the start of a step and at its end; below zero before it. */
void ck_disc_beyond_event(const ck_cavity_law *law, const ck_cavity *cavity, const ck_hollow *solved,
                          const ck_place at[3], double *behind, double *ahead) {
    const double none[4] = {0.0, 0.0, 0.0, 0.0};
    const ck_spot *last;
    double left, size, rupture_gap, end;
    if (cavity->phase == CK_RECEDING) {
        ck_rupture_piece piece;
        double squares[4], first, final;
        squares_of(cavity, solved, squares);
        ck_history_along(&piece, 0.0, squares, none);
        first = piece.y[1], final = piece.y[1] + 2.0 * piece.y[2] + 3.0 * piece.y[3];
        size = fabs(first) + fabs(final);
        if (size == 0.0) size = 1.0;
        *behind = -first / size, *ahead = -final / size;
        return;
    }
    last = &solved->spots[2], end = solved->voids[2];
    left = nothing(law, cavity, at[2].gap);
    if (last->growth < 0.0 && end <= left) {
        size = cavity->hollow + fabs(end) + left;
        *behind = fmin((left - cavity->hollow) / size, 0.0);
        *ahead = (left - end) / size;
        return;
    }
    *behind = *ahead = -1.0;
    ck_history_edge(cavity, at[2].gap, end, &rupture_gap);
    if (at[2].gap - rupture_gap <= SHALLOW * at[2].gap) return;
    *ahead = -last->returns / (fabs(last->growth) + fabs(last->returns) + 1e-300) - RECEDES;
}

/* Cavity at the end of a step. */
void ck_disc_cavity_step(ck_cavity *cavity, const ck_hollow *solved, double begin_gap,
                    const double gaps[3]) {
    if (cavity->phase == CK_RECEDING) {
        double squares[4], all[4] = {begin_gap, gaps[0], gaps[1], gaps[2]};
        ck_rupture_piece piece;
        squares_of(cavity, solved, squares);
        ck_history_along(&piece, ck_history_liquid(cavity), squares, all);
        ck_history_add(cavity, &piece);
    }
    cavity->hollow = solved->voids[2], cavity->fraction = solved->spots[2].fraction;
    if (cavity->hollow > cavity->largest) cavity->largest = cavity->hollow;
}

/* Cavity after the event at the end of a step. */
void ck_disc_cavity_event(const ck_cavity_law *law, ck_cavity *cavity, ck_place at) {
    if (cavity->phase == CK_FULL) {
        inception(law, cavity, at);
    } else if (cavity->phase == CK_RECEDING) {
        cavity->hollow = CK_PI * at.gap * ck_history_outermost(cavity) - ck_history_liquid(cavity);
        cavity->phase = CK_RETURNING;
    } else if (cavity->hollow <= 2.0 * nothing(law, cavity, at.gap)) {
        memset(cavity, 0, sizeof *cavity);
    } else {
        ck_history_cut(cavity, at.gap, cavity->hollow);
        cavity->phase = CK_RECEDING;
    }
}

/* Cavity after the speed has jumped; begins: whether the full film cavitates at that speed. */
void ck_disc_cavity_jump(const ck_cavity_law *law, ck_cavity *cavity, ck_place at, int begins) {
    double ignored, rim, fraction, here;
    int recedes = cavity->phase == CK_RECEDING;
    ck_rupture_piece jump;
    if (cavity->phase == CK_FULL) {
        if (begins) inception(law, cavity, at);
        return;
    }
    rim = ck_disc_rim(law, at.gap, cavity->hollow, &ignored);
    fraction = ck_receding_edge(ck_disc_tension_at(law, at.gap, at.speed, cavity->hollow) / law->drop);
    here = recedes ? ck_history_outermost(cavity)
                   : ck_history_edge(cavity, at.gap, cavity->hollow, &ignored);
    if (fraction * rim > here * (1.0 + SAME)) {
        if (!recedes) ck_history_cut(cavity, at.gap, cavity->hollow);
        constant_piece(&jump, here, fraction * rim, at.gap, ck_history_liquid(cavity));
        ck_history_add(cavity, &jump);
        cavity->phase = CK_RECEDING, cavity->fraction = fraction;
    } else if (recedes && fraction * rim < here * (1.0 - SAME)) {
        ck_disc_cavity_event(law, cavity, at);
    }
}

/* Step that ends at an event: secants, kept inside the bracket, which is halved if they stall. */
double ck_step_to_event(ck_trial trial, void *context, double begin, double missed, double length,
                        double enough) {
    double low = 0.0, high = length, last = low, missed_last = begin, width = high;
    double size = fabs(missed), slope, guess, again;
    int since = 0, i, found;
    for (i = 0; i < MOST_TRIALS; i++) {
        if (fabs(missed) <= enough || high - low <= 1e-15 * high) break;
        if (missed < 0.0) low = length;
        else high = length;
        since++;
        if (high - low <= 0.5 * width || fabs(missed) <= QUICK * size)
            width = high - low, size = fabs(missed), since = 0;
        slope = (missed - missed_last) / (length - last);
        guess = slope != 0.0 ? length - missed / slope : -1.0;
        found = low < guess && guess < high && since < MOST_SECANTS && trial(context, guess, &again);
        while (!found) {
            guess = 0.5 * (low + high);
            if (guess == low || guess == high) return length;
            found = trial(context, guess, &again);
            if (!found) high = guess;
        }
        last = length, missed_last = missed;
        length = guess, missed = again;
    }
    return length;
}
