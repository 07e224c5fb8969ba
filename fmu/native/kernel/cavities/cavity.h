/* A film that cavitates: the cavity, what it remembers, its forces and events (law.c).

   A round cavity between discs as contactkit/lubrication/disc_cavity.py, rupture_history.py and
   contactkit/separation/cavity, in the same order of operations, with squares of radii in place of
   radii, of one of `menisci` equal films (disc.c, history.c, events.c). On any other face the liquid of
   each cell of a grid (grid.h), which is remembered there: a film on a grid has one cavity. */

#ifndef CK_CAVITY_H
#define CK_CAVITY_H

#include "description.h"

#define CK_PI 3.14159265358979323846 /* ISO C has none */
/* Pieces of the history that are kept: see rupture_history.py. Each state of an FMU copies them all. */
#define CK_RUPTURE_PIECES 64

enum { CK_FULL = 0, CK_RECEDING = 1, CK_RETURNING = 2 };

/* Square of the radius and the gap at which the film ruptured there, both cubics of a parameter from 0
   to 1, and the liquid within where it begins. */
typedef struct {
    double y[4], h[4], before;
} ck_rupture_piece;

/* Cavity in one film: void, fraction of the disc within the edge, the largest void since it was full,
   and the rupture history from the centre outwards. */
typedef struct {
    double hollow, fraction, largest;
    int phase, count;
    ck_rupture_piece history[CK_RUPTURE_PIECES];
} ck_cavity;

/* One film, its tensile strength while it is full, as a drop of pressure, 0 if it does not
   cavitate, and that of the cavity. `volume` is HUGE_VAL where the rim is flooded; `grid` is NULL of a
   disc, and `damping` the force of the full film over viscosity and speed. */
typedef struct {
    double menisci, rim_square, volume, viscosity, strength, drop;
    struct ck_grid_film *grid;
    const ck_table *damping;
} ck_cavity_law;

typedef struct {
    double gap, speed;
} ck_place;

/* Where the edge is; growth of the void with its slope, and what flows over the edge. On a grid `edge` is
   the area of the cavity over pi, and `rim` the gap that the liquid is of, 0 where it fills any. */
typedef struct {
    double fraction, edge, rim, growth, by_void, returns;
} ck_spot;

/* Force of all films, with its slopes at an edge and a rim that stay. */
typedef struct {
    double force, by_gap, by_speed;
} ck_held;

/* Voids, edges and forces at the stages of a step, and its length; error of the last void over the
   film's volume. */
typedef struct {
    double voids[3];
    ck_spot spots[3];
    ck_held held[3];
    double error, length;
} ck_hollow;

/* Numbers of Radau IIA with three stages (step.c). */
extern const double ck_nodes[3], ck_weights[3], ck_stages[3][3], ck_estimate[3];
extern const double ck_gamma;

/* Rupture history (history.c). */
int ck_is_cavity(const ck_cavity *cavity);         /* whether its numbers are in range */
double ck_history_liquid(const ck_cavity *cavity);    /* within the outermost edge */
double ck_history_outermost(const ck_cavity *cavity); /* square of its radius */
double ck_history_edge(const ck_cavity *cavity, double gap, double hollow, double *rupture_gap);
void ck_history_cut(ck_cavity *cavity, double gap, double hollow);
void ck_history_add(ck_cavity *cavity, const ck_rupture_piece *piece);
void ck_history_along(ck_rupture_piece *piece, double before, const double squares[4],
                   const double gaps[4]);

/* A film that cavitates, of any face (law.c). `solved` is NULL for a film that is full. */
double ck_tension_at(const ck_cavity_law *law, double gap, double speed, double hollow);
int ck_is_inception(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at);
double ck_time_rtol(const ck_cavity_law *law, double rtol); /* of a step with a cavity */
int ck_cavity_cost(const ck_cavity_law *law); /* of one, in steps of a full film */
void ck_spot_at(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at, double hollow,
                ck_spot *spot);
/* Where the edge stays that a cavity has at a gap; of a full film where it would open at a place. */
void ck_spot_of(const ck_cavity_law *law, const ck_cavity *cavity, double gap, ck_place at,
                ck_spot *spot);
void ck_held_at(const ck_cavity_law *law, const ck_spot *spot, ck_place at, ck_held *held);
int ck_hollow_solve(const ck_cavity_law *law, const ck_cavity *cavity, ck_place begin, double dt,
                    const ck_place at[3], ck_hollow *found); /* 0 if a shorter step may do */
void ck_beyond_event(const ck_cavity_law *law, const ck_cavity *cavity, const ck_hollow *solved,
                     ck_place begin, const ck_place at[3], double *behind, double *ahead);
int ck_cavity_step(const ck_cavity_law *law, ck_cavity *cavity, const ck_hollow *solved,
                   double begin_gap, const double gaps[3]); /* 0 if there is none */
void ck_cavity_event(const ck_cavity_law *law, ck_cavity *cavity, ck_place at);
void ck_cavity_jump(const ck_cavity_law *law, ck_cavity *cavity, ck_place at);

/* The same between discs (disc.c, events.c). */
double ck_disc_rim(const ck_cavity_law *law, double gap, double hollow, double *by_void);
double ck_disc_tension_at(const ck_cavity_law *law, double gap, double speed, double hollow);
double ck_receding_edge(double sigma);
void ck_disc_spot_at(const ck_cavity_law *law, const ck_cavity *cavity, ck_place at, double hollow,
                     ck_spot *spot);
void ck_disc_held_at(const ck_cavity_law *law, const ck_spot *spot, ck_place at, ck_held *held);
int ck_disc_hollow_solve(const ck_cavity_law *law, const ck_cavity *cavity, ck_place begin, double dt,
                         const ck_place at[3], ck_hollow *found);
void ck_disc_beyond_event(const ck_cavity_law *law, const ck_cavity *cavity, const ck_hollow *solved,
                          const ck_place at[3], double *behind, double *ahead);
void ck_disc_cavity_step(ck_cavity *cavity, const ck_hollow *solved, double begin_gap,
                         const double gaps[3]);
void ck_disc_cavity_event(const ck_cavity_law *law, ck_cavity *cavity, ck_place at);
void ck_disc_cavity_jump(const ck_cavity_law *law, ck_cavity *cavity, ck_place at, int begins);

/* A step of some length, tried: keeps it and gives by how much it ends beyond an event; 0 if there is
   no such step, and the one before is kept. */
typedef int (*ck_trial)(void *context, double length, double *missed);
/* Length of the step that ends at the event; the one kept last. */
double ck_step_to_event(ck_trial trial, void *context, double begin, double missed, double length,
                        double enough);

/* A cavity whose gap moves at one speed: steps of time up to `end` (path.c). */
typedef struct {
    const ck_cavity_law *law;
    ck_cavity *cavity;
    double first, speed, time, end, rtol, planned;
    int tries; /* steps that were tried */
} ck_path;

enum { CK_PATH_END = 0, CK_PATH_STEP = 1, CK_PATH_LOST = 2 };
void ck_path_begin(ck_path *path, const ck_cavity_law *law, ck_cavity *cavity, ck_place at,
                   double end, double rtol, double step);
/* One step; its impulse, or whether the film was full in it, which has one that needs no way. */
int ck_path_next(ck_path *path, double *impulse, int *full);

#endif
