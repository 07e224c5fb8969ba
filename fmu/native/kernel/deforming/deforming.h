/* A film between two bodies that deform, as equations dQ/dt + R = 0, and implicit steps of them.

   Everything is in units of the file: the gap and the force of its record, and the time in which a film
   of that gap relaxes against the stiffness of the bodies. As in
   contactkit/lubrication/elastohydrodynamic, without contact and a rim that moves. */

#ifndef CK_DEFORMING_H
#define CK_DEFORMING_H

#include "film.h"

enum { CK_MOST_STAGES = 3 };

/* A method Radau IIA. */
typedef struct {
    int stages, order; /* of the error estimate, in the length of the step */
    const double *nodes, *weights, *gamma, *error;
    double inverse[CK_MOST_STAGES][CK_MOST_STAGES];
} ck_method;

/* What moves the bodies, over the time since the step of the host began: a gap, or a force on a mass;
   c[0] + c[1] t + c[2] t^2. */
typedef struct {
    double c[3];
} ck_course;

/* Q and R of an instant, and the force; matrices by rows of `size`, the others of the film's unknowns. */
typedef struct {
    double *stored, *rest, *stored_slopes, *rest_slopes;
    double *stored_by_gap, *rest_by_gap, *rest_by_speed, *force_slopes;
    double force, power; /* power: what the film dissipates */
    int closed;          /* a gap is not above 0: there is no film */
    double *voids;       /* by unknowns of the film: 1 in a cavity, whose unknown is its liquid per area */
} ck_level;

/* Room for a film and its steps, taken once. Unknowns are those of the film, then the gap of the
   undeformed bodies and its rate where they have a mass. */
typedef struct ck_deforming {
    const ck_bodies *record;
    const ck_method *method;
    int n, size, count;       /* unknowns of the film, all of them, numbers of a state */
    int has_mass;
    double gap, force, time;  /* units [m], [N], [s] */
    double mass, spring, relaxed, rtol; /* in these units; gap at which the spring is relaxed */
    double damping;           /* of the table at that gap */
    double *values;           /* the state: unknowns, and stages of the last step */
    double *voids;            /* of the state, a part of it: cavities, as in a level */
    double *kept;             /* that before the step of the host */
    double floor;             /* pressure of cavities; -HUGE_VAL: none opens */
    double *pressure;         /* of a level */
    double *share;            /* of rings: radius over 12 lengths at the points of an element */
    double *stages, *right, *whole, *square, *start_stored, *start_rest;
    double *by[2], *held[2], force_by[2]; /* derivatives by gap and speed that the host sets: of stages, of
                                             Q where the last step ended, of the force there */
    double *h, *flow, *left, *outer;
    int *exchanged;
    ck_level levels[CK_MOST_STAGES], first;
    double *block;
} ck_deforming;

/* Opening (bodies.c); NULL, or what is wrong. */
const char *ck_deforming_open(ck_deforming *d, const ck_bodies *record, int has_mass);
void ck_deforming_close(ck_deforming *d);
void ck_deforming_keep(ck_deforming *d);
void ck_deforming_go_back(ck_deforming *d);
void ck_deforming_put(ck_deforming *d, const double *values); /* NULL: none */
/* Units of a viscosity, and the state at rest at a gap [m]. */
void ck_deforming_units(ck_deforming *d, double viscosity);
void ck_deforming_rest(ck_deforming *d, double gap);

/* One of the two films: rigid bodies in series with a spring (series.c), and rings (rings.c). `slopes`:
   whether they are asked for, too. */
void ck_level_of(ck_deforming *d, const double *y, double gap, double speed, ck_level *level, int slopes);
void ck_series_level(ck_deforming *d, const double *y, double speed, ck_level *level, int slopes);
void ck_rings_level(ck_deforming *d, const double *y, double gap, ck_level *level, int slopes);
void ck_rings_share(ck_deforming *d); /* fills `share`, which stays as it is */
double ck_rings_axis(ck_deforming *d, const double *y, double gap);
double ck_rings_moved(ck_deforming *d, const double *y, double gap, const double *dy, double dgap,
                      const double *voids, double *closing);
/* Cavities where their conditions fail, at unknowns of a gap: 1 if one opens or closes. */
int ck_rings_rupture(ck_deforming *d, double *y, double gap, double *voids);
double ck_rings_lowest(const ck_deforming *d, const double *y);
/* Gap of the film on the axis; largest change of a gap over itself, and the largest fall; change of unknowns
   over their size. */
double ck_film_axis(ck_deforming *d, const double *y, double gap);
double ck_film_moved(ck_deforming *d, const double *y, double gap, const double *dy, double dgap,
                     const double *voids, double *closing);
double ck_film_change(const ck_deforming *d, const double *y, const double *dy, const double *voids);

/* A step from a time since that of the host began (stages.c): its stages are in `stages`, `error` is that of
   its end over the tolerance. 0 if it cannot be solved. */
typedef struct {
    ck_course course;
    double time, length;    /* of the internal step */
    double before, highest; /* length of the last one, 0: none; force that errors are related to */
} ck_attempted;

int ck_stages_solve(ck_deforming *d, const ck_attempted *a, double *error);
/* Derivatives by the gap and the speed at the end of the step of the host, which takes `span`. */
int ck_stages_slopes(ck_deforming *d, const ck_attempted *a, double span);
double ck_course_at(const ck_course *course, double time, double *rate);

#endif
