/* The forces of a film, read from tables that the Python model wrote.

   Conventions: SI units; a force is positive where it resists opening; the gap is the shortest
   distance of the bodies. A table holds y over x, quintic Hermite, and stands for y h^-power; x is
   ln h, or sqrt(ln(end/h)) where the law ends, in a fold or not, at a gap `end`. */

#ifndef CK_FILM_H
#define CK_FILM_H

#include "cavity.h"

#include <stddef.h>

#define CK_LAWS 8    /* most forces of one film */
#define CK_KINKS 8   /* most gaps at which the slope of one force jumps */
#define CK_PIECES 12 /* most pieces of one table */
#define CK_FILMS 2   /* the film of the scene, and what is left of it after a rupture */

/* Between two nodes: where the first is, one over the width, and powers of the fraction of it. */
typedef struct {
    double x, per_width, c[6];
} ck_cell;

typedef struct {
    double low, high, end, log_end; /* gaps; `end` only where x runs from it */
    int folds, power, count;        /* of the cells */
    const ck_cell *cells;
    int *hint; /* where the last search ended; it saves time and changes nothing */
} ck_piece;

typedef struct {
    int count, stays; /* whether the force beyond the last piece stays what it was there */
    ck_piece pieces[CK_PIECES];
} ck_table;

/* What a force is proportional to. */
enum { CK_FIXED = 0, CK_TENSION_SURFACE = 1, CK_VISCOSITY = 2 };

/* How a force depends on the speed; limits of the liquid bound the last kind. */
enum { CK_STATIC = 0, CK_PER_SPEED = 1, CK_LIQUID = 2 };

typedef struct {
    int scale, rate, needs_film, kink_count;
    double end, release, recontact;
    double kinks[CK_KINKS];
    ck_table table;
} ck_law;

typedef struct {
    double end, breaks, full_gap; /* end of its laws; where a rule breaks it; full to the rim */
    int count;
    ck_law laws[CK_LAWS];
    ck_table shape; /* square of the radius between flats, height less gap under a sphere */
    double rim_square, volume; /* of one film between flats, for a cavity; 0: it can have none */
} ck_film;

/* What acts in a state, with the parameters of the liquid in. */
typedef struct {
    const ck_film *film;
    int acts[CK_LAWS];
    int any, limited, is_sphere, reynolds;
    double viscosity, surface_tension, tension, strength, sphere_radius, menisci;
    double end, release;
    const ck_cavity_law *law; /* how the film tears, where that is remembered, or NULL */
} ck_acting;

/* Forces at a gap and a speed, with slopes by gap and by speed. */
typedef struct {
    double fixed, fixed_by_gap;
    double viscous, viscous_by_gap, viscous_by_speed;
    double resistance, resistance_by_gap; /* viscous force per speed without limits */
    double free, free_by_gap;             /* the part of that which no limit bounds */
    int limit;                            /* 0 none, 1 tension, 2 shear */
    int padding;                          /* so that no byte of a saved state is left open */
} ck_forces;

/* What a limit leaves of a force, and how that follows the force, the gap and the shape. */
typedef struct {
    double value, by_force, by_gap, by_shape;
} ck_left;

/* Impulses of the motion between two gaps. */
typedef struct {
    double viscous, fixed, free; /* `free` is in the viscous one, too */
} ck_impulse;

double ck_table_at(const ck_table *table, double gap, double log_gap, double *by_gap);
void ck_forces_at(const ck_acting *acting, double gap, double speed, ck_forces *found);
double ck_fixed_force(const ck_acting *acting, double gap);

/* Over a time in which the gap moves at one speed; kinks are where it is to be cut. */
ck_impulse ck_along(const ck_acting *acting, double begin, double end, double length);

void ck_disc_tension(double force, double area, double tension, ck_left *left);
void ck_disc_tension_reynolds(double force, double area, double tension, ck_left *left);
void ck_disc_shear(double force, double shape, double gap, double strength, ck_left *left);
void ck_sphere_tension(double force, double radius, double gap, double shape, double tension,
                       ck_left *left);
void ck_sphere_shear(double force, double radius, double gap, double shape, double strength,
                     ck_left *left);

#endif
