/* What the tips of tip-contact are made of: how their root moves, their flight (flight.c), and their
   impact on a site that deforms (impact.c).

   Heights are over the place where an unbent tip just touches its site, positive upwards. */

#ifndef CK_TIP_H
#define CK_TIP_H

#include "drive.h"

#include <stdint.h>

/* Height and speed of the root at a time, under a steady acceleration. */
typedef struct {
    double height, speed, acceleration, time;
} ck_root;

ck_root ck_root_after(const ck_root *root, double elapsed);
double ck_root_height(const ck_root *root, double time);

/* A free tip about its root: where it hangs, decay, frequency, swing. */
typedef struct {
    double rest, decay, frequency, cosine, sine;
} ck_flight;

/* Bend of the tip after a time, and its rate. */
double ck_flight_at(const ck_flight *flight, double time, double *rate);

#define CK_MOST_SWINGS 62500 /* that are followed in one flight */

/* Time, at most `left`, after which the tip first lands; -1 if it does not, HUGE_VAL if it swings too
   often to tell. The swings it followed are added to `swings`. */
double ck_landing_time(const ck_flight *flight, const ck_root *root, double left, int64_t *swings);

/* A tip in contact: site with its damping over force, attraction, spring and mass of the tip. */
typedef struct {
    const ck_faces *faces;
    double damping, attraction, stiffness, mass;
    ck_root root;
} ck_site;

/* An impact. `speed` is that of approach, `largest` the largest approach at a turning point,
   `peak` the largest force of the site, `steps` those taken. */
typedef struct {
    double time, depth, speed, largest, impulse, dissipated, peak;
    int end, steps;
} ck_impact;

enum { CK_GOES_ON = 1, CK_OFF = 2, CK_AT_REST = 3 };
enum { CK_HIT = 0, CK_NO_HIT_STEP = 1, CK_TOO_MANY_HIT_STEPS = 2, CK_TOO_DEEP = 3 };

/* Follow an impact until it is over, or to a time, in at most so many steps: CK_HIT, or what is wrong
   with the state reached. */
int ck_follow_impact(const ck_site *site, ck_impact *state, double end, double rtol, int64_t most);

/* Approach of a tip that is pressed slowly; beyond the end of the curve what it would be. */
double ck_rest_depth(const ck_site *site, double largest, double time);
int ck_is_too_deep(const ck_faces *faces, double depth);

#endif
