/* A film whose viscosity follows pressure and shear: its force over that at the viscosity at rest, from
   tables over gap and speed (fmu/native/rheology.py). */

#ifndef CK_RHEOLOGY_H
#define CK_RHEOLOGY_H

#include "film.h"

/* Forces of a film that moves, whose `fixed` and `free` parts are known; `liquid` is its force per speed
   at the viscosity at rest. All is nan at a speed that the tables do not hold. */
void ck_rheological_force(const ck_acting *acting, double gap, double log_gap, double speed,
                          double liquid, double liquid_by_gap, ck_forces *found);

/* A speed over the fastest that the film is known for at a gap; 0 of a film without a rheology. */
double ck_rheological_reach(const ck_acting *acting, double gap, double speed);

/* What stands against a motion that got to there, or NULL: its speed is near the fastest. */
const char *ck_rheological_obstacle(const ck_acting *acting, double gap, double speed);

#endif
