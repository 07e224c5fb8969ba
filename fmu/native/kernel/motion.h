/* The motion of a mass held by a film: as contactkit/separation/motion/advance.py, with the same events. */

#ifndef CK_MOTION_H
#define CK_MOTION_H

#include "step.h"

#include <stdint.h>

/* The films of a scene with the parameters in; the second one is what is there when the bodies return,
   `max_steps` bounds the cost of a step of the host. */
typedef struct {
    const ck_film_tables *tables;
    int max_steps;
    int pauses; /* whether a motion ends where the film breaks or wets the bodies again */
    double ends[CK_MOST_FILMS];
    double recontact; /* gap of re-contact of detached solids */
    double mass, initial_gap, initial_speed, stiffness, release_gap, rest_gap, rtol;
    double viscosity, surface_tension, tension, strength;
    ck_cavity_law laws[CK_MOST_FILMS]; /* of films with a cavity, where strength is not 0 */
} ck_scene;

typedef struct {
    double time, gap, speed, step;
    double viscous_impulse, fixed_impulse, work, applied_impulse;
    double break_time, release_time, release_speed, peak_force, peak_time;
    int film, broken, in_contact, armed, detached, breaks, releases;
    int pending; /* what happens here, and has not yet where the motion pauses for it */
    int64_t steps, iterations; /* internal ones, and iterations in them */
    int64_t cost;              /* of this step of the host, in internal steps without a cavity */
    ck_forces here;        /* forces at this gap and speed, and the exponent of the viscous one */
    double exponent;
    int64_t known; /* whether the last step told them */
    double inception_time, reformation_time;
    int inceptions, reformations; /* how many times the film cavitated, and was full again */
    ck_cavity cavity;
} ck_motion;

enum { CK_NONE = 0, CK_RUPTURE = 1, CK_REWETTING = 2 };
enum { CK_DONE = 0, CK_NO_STEP = 1, CK_TOO_MANY_STEPS = 2 };

void ck_start(const ck_scene *scene, ck_motion *state); /* at time 0 */
void ck_act(const ck_scene *scene, int number, int broken, int detached, ck_acting *acting);
/* Forces at the gap and speed of a state, with its cavity, and where the edge of that is. */
void ck_forces_of(const ck_acting *acting, const ck_motion *state, ck_forces *found, ck_spot *spot);
void ck_resolve(const ck_scene *scene, ck_motion *state); /* make happen what is pending */
int ck_internal_step(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double end);
int ck_advance(const ck_scene *scene, ck_motion *state, const ck_pull *pull, double dt);
int ck_status(const ck_scene *scene, const ck_motion *state, const ck_acting *acting,
              const ck_forces *forces, double pull);

#endif
