/* One implicit step of a mass held by a film: three-stage Radau IIA, as in
   contactkit/separation/integrator/radau.py, with slopes from the tables in place of differences. */

#ifndef CK_STEP_H
#define CK_STEP_H

#include "film.h"

typedef struct {
    double force, rate, time; /* the pull at a time and its rate */
    double bend;              /* half the slope of the rate */
} ck_pull;

typedef struct {
    double time, gap, speed;
} ck_point;

/* What one internal step solves, from where, and the size its error is measured against. */
typedef struct {
    const ck_acting *acting;
    ck_pull pull;
    double mass, spring, rest, rtol; /* of the spring: where it is slack */
    ck_point begin;
    double exponent, size, delivered, scale;
    double net, net_by_gap, net_by_speed, viscous; /* at the start */
    double taken; /* impulse that the film took so far */
    const ck_cavity *cavity; /* of the film at the start, or NULL */
    ck_spot spot;            /* where its edge is */
} ck_problem;

typedef struct {
    ck_point stages[3];
    ck_forces forces[3]; /* at the stages; slopes are those of the last iteration */
    double coordinates[3], exponent, gap_error, speed_error;
    double film_exponent; /* n of the viscous force at the end, which falls as gap^-n */
    int iterations;       /* of the iteration for the stages */
    ck_hollow hollow;     /* of a film with a cavity */
} ck_step;

/* As fmax, but of numbers: nan is for others to find. */
static inline double ck_larger(double a, double b) { return a > b ? a : b; }
static inline double ck_smaller(double a, double b) { return a < b ? a : b; }

double ck_pull_at(const ck_pull *pull, double time);
int ck_coordinate(double gap, double s, double q, double found[3]);
/* Forces with the cavity a film has at an edge and a rim. */
void ck_forces_with(const ck_acting *acting, const ck_spot *spot, ck_place at, ck_forces *found);
double ck_film_exponent(double gap, const ck_forces *forces);
int ck_attempt(const ck_problem *problem, double length, ck_step *taken);
double ck_error(const ck_problem *problem, const ck_step *taken, double length);

#endif
