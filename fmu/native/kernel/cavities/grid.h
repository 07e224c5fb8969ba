/* A film on a grid, for a face that is no disc: which cells are full, what the others hold of liquid.

   As contactkit/separation/face/cavity.py and held_voids.py, on the cells and sides that
   contactkit/lubrication/reynolds has made of the face. */

#ifndef CK_GRID_H
#define CK_GRID_H

#include "description.h"
#include "factor.h"

#include <stddef.h>

/* Factors that are kept. Between even faces one serves at every gap for as long as its cells are full:
   three stages and the whole step, each for the liquid that flows and for the force. */
enum { CK_FACTORS = 8, CK_GRID_BLOCKS = 80 };

/* The grid of a file, the liquid in it, and room to work. Pressures are from ambient and times the
   conductance gap^3/(12 eta), so that between even faces the matrix is of the geometry alone. */
typedef struct ck_grid_film {
    const ck_grid *record;
    int n, n_inner, n_sides, is_even;
    int *low, *high; /* unknowns at both ends of a side, the lower number first */
    int *cell, *pocket; /* the same of the sides of pockets, by which is which */
    ck_pattern pattern;
    ck_factor factors[CK_FACTORS];
    long clock;
    double matrix_gap; /* for which `sides` and `diagonal` are */
    double *sides, *diagonal;
    double *liquid, *kept, *next;   /* its thickness: now, before the step of the host, after a step */
    double *fraction, *deficit, *storage, *pressure, *voids, *work, *slope;
    unsigned char *full, *last, *new, *begin, *stages[3]; /* sets of cells */
    /* The step whose liquid is in `next` and whose voids are in `stages`, and how much of it there is. */
    long stamp, of;
    double start, dt, gaps[3], hollow[3], error;
    void *blocks[CK_GRID_BLOCKS];
    int n_blocks;
} ck_grid_film;

/* Force of a film whose voids stay, with its slopes, and the area at the pressure of the cavity. */
typedef struct {
    double force, by_gap, by_speed, area;
} ck_grid_force;

/* What a film is pulled at: viscosity, and ambient pressure less that of the cavity. */
typedef struct {
    double viscosity, drop;
} ck_grid_liquid;

/* NULL, or what is wrong; what was allocated is freed by ck_grid_close in any case. */
const char *ck_grid_open(ck_grid_film *film, const ck_grid *record);
void ck_grid_close(ck_grid_film *film);
void ck_grid_keep(ck_grid_film *film);     /* the liquid that there is before a step of the host */
void ck_grid_go_back(ck_grid_film *film);  /* to it */
void ck_grid_put(ck_grid_film *film, const double *liquid); /* NULL: none */
void ck_grid_fill(ck_grid_film *film, double gap);
double ck_grid_volume(const ck_grid_film *film, double gap);

/* Highest tension of the full film over its force, per area. */
double ck_grid_onset(const ck_grid_film *film, double gap);
/* Force with the voids that the liquid leaves at one gap, at another gap and speed; from a gap of 0 all
   is full. 0 if there is none. */
int ck_grid_held(ck_grid_film *film, ck_grid_liquid liquid, double from, double gap, double speed,
                 ck_grid_force *found);
/* Voids at the stages of a step and the error of the last one over the volume; 0 if there is none. */
int ck_grid_step(ck_grid_film *film, ck_grid_liquid liquid, double start, double dt,
                 const double gaps[3]);
/* Force at a stage of the step that was found last. */
int ck_grid_at_stage(ck_grid_film *film, ck_grid_liquid liquid, int stage, double gap, double speed,
                     ck_grid_force *found);
/* Keep the liquid at the end of that step, where the gap is now this one: the void that is left. */
double ck_grid_after(ck_grid_film *film, double gap);

/* Pressure and voids of a film from a guess of its full cells (obstacle.c). */
typedef struct {
    double gap, floor;            /* of the pressure */
    const double *deficit;        /* volume that a full film without pressure would lack, per time */
    const double *storage;        /* what a void takes of it */
    const unsigned char *may_fill; /* cells that are not held empty */
} ck_obstacle;

const ck_factor *ck_grid_factor(ck_grid_film *film, double gap, const unsigned char *full);
int ck_obstacle_solve(ck_grid_film *film, const ck_obstacle *problem, unsigned char *full);

#endif
