/* A film that cavitates, of any face: a round cavity between discs, or the liquid on a grid. */

#include "film.h"
#include "grid.h"

#include <math.h>
#include <string.h>

/* Of the error of the grid: a cavity that grows has kinks in its force, cell by cell, which finer steps
   would follow (separation/face/cavity.py). */
#define PER_STEP 0.1
#define REFORMED 1e-9 /* void over the film, below which a cavity never was one (face/cavity.py) */
/* Cost of a step with a cavity over that of a full film, of 1 to 2 us: 20 to 40 us between discs where
   values are hostile. On a grid a step solves some twenty-five systems and takes up to 12 us for each of
   its cells, 36 ms for 2900; that is counted as a hundredth, or no step of a host would end within the
   100 000 that are its limit by default, which so take 10 s at most in place of 0.2 s. */
#define DISC_COST 20
#define CELLS_PER_COST 10

static ck_grid_liquid liquid_of(const ck_cavity_law *law) {
    return (ck_grid_liquid){law->viscosity, law->drop};
}

/* Highest tension in the full film; between discs of one with a void. */
double ck_tension_at(const ck_cavity_law *law, double gap, double speed, double hollow) {
    double ignored;
    if (!law->grid) return ck_disc_tension_at(law, gap, speed, hollow);
    return law->viscosity * speed * ck_table_at(law->damping, gap, log(gap), &ignored) *
           ck_grid_onset(law->grid, gap);
}

int ck_is_inception(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at) {
    return cavity->phase == CK_FULL && ck_tension_at(law, at.gap, at.speed, 0.0) >= law->strength;
}

double ck_time_rtol(const ck_cavity_law *law, double rtol) {
    return law->grid ? fmax(rtol, PER_STEP * law->grid->record->rtol) : rtol;
}

int ck_cavity_cost(const ck_cavity_law *law) {
    return law->grid ? DISC_COST + law->grid->n / CELLS_PER_COST : DISC_COST;
}

static void hold(const ck_cavity_law *law, const ck_grid_force *f, ck_held *held) {
    held->force = law->menisci * f->force;
    held->by_gap = law->menisci * f->by_gap, held->by_speed = law->menisci * f->by_speed;
}

/* Of a grid that has no solution all is nan: no step is taken with it. */
static void grid_held(const ck_cavity_law *law, double from, ck_place at, ck_grid_force *found) {
    if (!ck_grid_held(law->grid, liquid_of(law), from, at.gap, at.speed, found))
        found->force = found->by_gap = found->by_speed = found->area = NAN;
}

static void grid_spot(const ck_cavity_law *law, double from, ck_place at, ck_spot *spot) {
    ck_grid_force found;
    grid_held(law, from, at, &found);
    memset(spot, 0, sizeof *spot);
    spot->rim = from, spot->edge = found.area / CK_PI;
}

void ck_spot_at(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at, double hollow,
                ck_spot *spot) {
    if (law->grid) grid_spot(law, cavity->phase == CK_FULL ? 0.0 : at.gap, at, spot);
    else ck_disc_spot_at(law, cavity, at, hollow, spot);
}

void ck_spot_of(const ck_cavity_law *law, const ck_cavity *cavity, double gap, ck_place at,
                ck_spot *spot) {
    double fraction = cavity->fraction, ignored;
    if (law->grid) {
        grid_spot(law, cavity->phase == CK_FULL ? 0.0 : gap, at, spot);
        return;
    }
    if (cavity->phase == CK_FULL) {
        fraction = ck_receding_edge(ck_disc_tension_at(law, at.gap, at.speed, 0.0) / law->drop);
        gap = at.gap;
    }
    memset(spot, 0, sizeof *spot);
    spot->rim = ck_disc_rim(law, gap, cavity->hollow, &ignored);
    spot->fraction = fraction, spot->edge = fraction * spot->rim;
}

void ck_held_at(const ck_cavity_law *law, const ck_spot *spot, ck_place at, ck_held *held) {
    ck_grid_force found;
    if (!law->grid) {
        ck_disc_held_at(law, spot, at, held);
        return;
    }
    grid_held(law, spot->rim, at, &found);
    hold(law, &found, held);
}

int ck_hollow_solve(const ck_cavity_law *law, const ck_cavity *cavity, ck_place begin, double dt,
                    const ck_place at[3], ck_hollow *found) {
    double gaps[3];
    ck_grid_force force;
    int i;
    found->length = dt;
    if (!law->grid) return ck_disc_hollow_solve(law, cavity, begin, dt, at, found);
    memset(found->spots, 0, sizeof found->spots);
    for (i = 0; i < 3; i++) gaps[i] = at[i].gap;
    if (!ck_grid_step(law->grid, liquid_of(law), begin.gap, dt, gaps)) return 0;
    for (i = 0; i < 3; i++) {
        if (!ck_grid_at_stage(law->grid, liquid_of(law), i, at[i].gap, at[i].speed, &force)) return 0;
        hold(law, &force, &found->held[i]);
        found->voids[i] = law->grid->hollow[i];
    }
    found->error = law->grid->error;
    return 1;
}

/* Distance beyond the next event at the start of a step and at its end; below zero before it. On a grid
   a cavity has none: the film that is full again is found after the step. */
void ck_beyond_event(const ck_cavity_law *law, const ck_cavity *cavity, const ck_hollow *solved,
                     ck_place begin, const ck_place at[3], double *behind, double *ahead) {
    double highest = -HUGE_VAL;
    int i;
    if (solved && !law->grid) {
        ck_disc_beyond_event(law, cavity, solved, at, behind, ahead);
        return;
    }
    *behind = *ahead = -1.0;
    if (solved) return;
    for (i = 0; i < 3; i++) {
        double one = ck_tension_at(law, at[i].gap, at[i].speed, 0.0);
        if (one > highest) highest = one;
    }
    *behind = ck_tension_at(law, begin.gap, begin.speed, 0.0) / law->strength - 1.0;
    *ahead = highest / law->strength - 1.0;
}

/* The step is that which was solved last, or it is solved again: a host goes back and forth. */
static int grid_after(const ck_cavity_law *law, ck_cavity *cavity, double length, double begin_gap,
                      const double gaps[3]) {
    double nothing;
    if (!ck_grid_step(law->grid, liquid_of(law), begin_gap, length, gaps)) return 0;
    nothing = REFORMED * ck_grid_volume(law->grid, gaps[2]);
    cavity->hollow = ck_grid_after(law->grid, gaps[2]);
    if (cavity->hollow == 0.0 && cavity->largest > nothing) {
        memset(cavity, 0, sizeof *cavity);
        return 1;
    }
    cavity->fraction = cavity->hollow / ck_grid_volume(law->grid, gaps[2]);
    if (cavity->hollow > cavity->largest) cavity->largest = cavity->hollow;
    return 1;
}

int ck_cavity_step(const ck_cavity_law *law, ck_cavity *cavity, const ck_hollow *solved,
                   double begin_gap, const double gaps[3]) {
    if (law->grid) return grid_after(law, cavity, solved->length, begin_gap, gaps);
    ck_disc_cavity_step(cavity, solved, begin_gap, gaps);
    return 1;
}

/* The liquid cavitates from its strength to its cavity: the first voids form in the step that follows. */
static void grid_inception(const ck_cavity_law *law, ck_cavity *cavity, double gap) {
    memset(cavity, 0, sizeof *cavity);
    cavity->phase = CK_RECEDING;
    ck_grid_fill(law->grid, gap);
}

void ck_cavity_event(const ck_cavity_law *law, ck_cavity *cavity, ck_place at) {
    if (!law->grid) ck_disc_cavity_event(law, cavity, at);
    else if (cavity->phase == CK_FULL) grid_inception(law, cavity, at.gap);
}

void ck_cavity_jump(const ck_cavity_law *law, ck_cavity *cavity, ck_place at) {
    int begins = ck_is_inception(law, cavity, at);
    if (!law->grid) ck_disc_cavity_jump(law, cavity, at, begins);
    else if (begins) grid_inception(law, cavity, at.gap);
}
