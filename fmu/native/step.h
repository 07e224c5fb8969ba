/* One implicit step of a mass held by a film: three-stage Radau IIA, as in
   contactkit/kernels/stiff_step.py, with slopes from the tables in place of differences. */

#ifndef CK_STEP_H
#define CK_STEP_H

#include "film.h"

typedef struct {
    double force, rate, time; /* the pull at a time and its rate */
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
    double net, net_by_gap, net_by_speed; /* at the start */
} ck_problem;

typedef struct {
    ck_point stages[3];
    double coordinates[3], exponent, gap_error, speed_error;
} ck_step;

extern const double ck_nodes[3], ck_weights[3];

double ck_pull_at(const ck_pull *pull, double time);
int ck_coordinate(double gap, double s, double q, double found[3]);
double ck_net(const ck_problem *problem, const ck_point *at, double *by_gap, double *by_speed);
int ck_attempt(const ck_problem *problem, double length, ck_step *taken);
double ck_error(const ck_problem *problem, const ck_step *taken, double length);

#endif
