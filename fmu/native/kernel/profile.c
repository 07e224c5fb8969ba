/* The voltage over time, and when it switches: as contactkit/models/valve.py. */

#include "drive.h"

#include <math.h>

double ck_profile_at(const ck_profile *p, double time) {
    double since = time - p->delay;
    if (!(since >= 0.0 && since < p->cycles * p->period)) return p->off;
    since = fmod(since, p->period);
    if (since >= p->on_time) return p->off;
    return since < p->boost_time ? p->boost : p->hold;
}

double ck_profile_next(const ck_profile *p, double start, double end) {
    /* one cycle early, as the quotient may be rounded up */
    double cycle = floor((start - p->delay) / p->period) - 1.0;
    int i, k;
    if (!(cycle > 0.0)) cycle = 0.0;
    for (i = 0; i < 5 && cycle < p->cycles; i++, cycle += 1.0) {
        double begin = p->delay + cycle * p->period;
        double times[3] = {begin, begin + p->boost_time, begin + p->on_time};
        for (k = 0; k < 3; k++)
            if (times[k] > start) return times[k] < end ? times[k] : end;
    }
    return end;
}

/* A time at which it switches, worked out from the times of the profile, may be rounded to either
   side; the middle up to the next one is on neither. */
double ck_profile_after(const ck_profile *p, double time) {
    double next = ck_profile_next(p, time, HUGE_VAL);
    return next < HUGE_VAL ? ck_profile_at(p, 0.5 * (time + next)) : p->off;
}
