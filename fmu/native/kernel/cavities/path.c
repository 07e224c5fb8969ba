/* A cavity whose gap moves at one speed: steps of time with an error control, cut at events. As
   contactkit/separation/cavity/path.py. */

#include "cavity.h"
#include "step_size.h"

#include <math.h>
#include <stddef.h>

/* Of the travel, the first step. Just after its inception a cavity spreads as a root of time; too long a
   step is rejected, too short ones grow eightfold. */
#define FIRST 1e-3
#define EVENT 1e-10 /* what an event may be missed by: see separation/cavity/path.py */

typedef struct {
    const ck_path *path;
    ck_place begin, at[3];
    ck_hollow hollow;
    double ahead, behind;
} attempt;

static ck_place place(const ck_path *path, double time) {
    ck_place found;
    found.gap = path->first + path->speed * time, found.speed = path->speed;
    return found;
}

/* Try a step; 0 if there is none of that length. */
static int go(attempt *one, double dt) {
    const ck_path *path = one->path;
    int i;
    for (i = 0; i < 3; i++) one->at[i] = place(path, path->time + ck_nodes[i] * dt);
    if (path->cavity->phase == CK_FULL) return 1;
    return ck_hollow_solve(path->law, path->cavity, one->begin, dt, one->at, &one->hollow);
}

static void judge(attempt *one) {
    const ck_cavity *cavity = one->path->cavity;
    ck_beyond_event(one->path->law, cavity, cavity->phase == CK_FULL ? NULL : &one->hollow,
                    one->begin, one->at, &one->behind, &one->ahead);
}

static int trial(void *context, double length, double *missed) {
    attempt *kept = (attempt *)context, again = *kept;
    if (!go(&again, length)) return 0;
    judge(&again);
    *kept = again;
    *missed = again.ahead;
    return 1;
}

void ck_path_begin(ck_path *path, const ck_cavity_law *law, ck_cavity *cavity, ck_place at,
                   double end, double rtol, double step) {
    path->law = law, path->cavity = cavity;
    path->first = at.gap, path->speed = at.speed;
    path->tries = 0, path->time = 0.0, path->end = end, path->rtol = ck_time_rtol(law, rtol);
    path->planned = step > 0.0 ? step : FIRST * end;
    ck_cavity_jump(law, cavity, at);
}

/* Longest step that meets the tolerance, and its error over it; 0 if there is none. */
static double accepted(ck_path *path, attempt *one, double length, double *error) {
    int i, whole = path->cavity->phase == CK_FULL;
    for (i = 0; i < 80; i++) {
        path->tries++;
        *error = HUGE_VAL;
        if (go(one, length)) *error = whole ? 0.0 : one->hollow.error / path->rtol;
        if (*error <= 1.0) return length;
        length *= *error < HUGE_VAL ? fmax(CK_SHRINK, CK_SAFETY * pow(*error, -1.0 / 3.0)) : CK_UNSOLVED;
    }
    return 0.0;
}

int ck_path_next(ck_path *path, double *impulse, int *full) {
    attempt one;
    double left = path->end - path->time, length, error, planned, grown;
    int event = 0, i;
    *impulse = 0.0, *full = 0;
    one.path = path, one.begin = place(path, path->time);
    if (ck_is_inception(path->law, path->cavity, one.begin)) {
        ck_cavity_event(path->law, path->cavity, one.begin);
        return CK_PATH_STEP;
    }
    if (left <= 1e-14 * fabs(path->end)) return CK_PATH_END;
    planned = path->planned > left ? path->planned : 0.0; /* no shorter for being cut off */
    length = accepted(path, &one, fmin(path->planned, left), &error);
    if (length == 0.0) return CK_PATH_LOST;
    grown = error <= pow(CK_SAFETY / CK_GROW, 3.0) ? CK_GROW : CK_SAFETY * pow(error, -1.0 / 3.0);
    path->planned = fmax(length * grown, planned);
    judge(&one);
    if (one.ahead > 0.0) {
        double whole = length;
        event = 1;
        length = one.behind >= 0.0
                     ? 0.0
                     : ck_step_to_event(trial, &one, one.behind, one.ahead, length, EVENT);
        path->planned = fmax(length, 1e-3 * whole);
    }
    *full = path->cavity->phase == CK_FULL && length > 0.0;
    if (length > 0.0) {
        if (!*full) {
            double gaps[3];
            for (i = 0; i < 3; i++) {
                gaps[i] = one.at[i].gap;
                *impulse += length * ck_weights[i] * one.hollow.held[i].force;
            }
            if (!ck_cavity_step(path->law, path->cavity, &one.hollow, one.begin.gap, gaps))
                return CK_PATH_LOST;
        }
        path->time = length >= left * (1.0 - 1e-14) ? path->end : path->time + length;
    }
    if (event) ck_cavity_event(path->law, path->cavity, length > 0.0 ? one.at[2] : one.begin);
    return CK_PATH_STEP;
}
