/* The forces of a film, read from tables that the Python model wrote (description.h).

   Conventions: SI units; a force is positive where it resists opening; the gap is the shortest
   distance of the bodies. */

#ifndef CK_FILM_H
#define CK_FILM_H

#include "cavity.h"
#include "description.h"

#include <stddef.h>

/* Between two nodes: where the first is, one over the width, and powers of the fraction of it. */
typedef struct ck_cell {
    double x, per_width, c[6];
} ck_cell;

/* What acts in a state, with the parameters of the liquid in. */
typedef struct {
    const ck_film *film;
    int acts[CK_MOST_LAWS];
    int any, limited, is_sphere, reynolds;
    double viscosity, surface_tension, tension, strength, sphere_radius, menisci;
    double end, release;
    const ck_cavity_law *law; /* how the film cavitates, where that is remembered, or NULL */
    const ck_rheology *rheology; /* of a liquid that is not Newtonian, or NULL */
} ck_acting;

/* Forces at a gap and a speed, with slopes by gap and by speed. */
typedef struct {
    double fixed, fixed_by_gap;
    double viscous, viscous_by_gap, viscous_by_speed;
    double resistance, resistance_by_gap; /* viscous force per speed without limits */
    double free, free_by_gap;             /* the part of that which no limit bounds */
    int limit;                            /* CK_LIMIT_KIND_... */
    int bent;                             /* whether the viscous one is no multiple of the speed */
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
