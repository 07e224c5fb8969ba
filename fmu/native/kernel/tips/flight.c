/* A free spring tip about a root that is steadily accelerated: its swing, and where it lands. As
   models/micromirror/flight.py. */

#include "tip.h"

#include <math.h>

#define PI 3.14159265358979323846 /* ISO C has none */

ck_root ck_root_after(const ck_root *root, double elapsed) {
    ck_root later = *root;
    later.speed = root->speed + root->acceleration * elapsed;
    later.height = root->height + 0.5 * (root->speed + later.speed) * elapsed;
    later.time = root->time + elapsed;
    return later;
}

double ck_root_height(const ck_root *root, double time) {
    double since = time - root->time;
    return root->height + since * (root->speed + 0.5 * root->acceleration * since);
}

double ck_flight_at(const ck_flight *f, double time, double *rate) {
    double angle = f->frequency * time, fade = exp(-f->decay * time), c, s, swing;
    volatile double same = angle; /* else compilers make one sincos, which not every system has */
    c = cos(angle), s = sin(same);
    swing = fade * (f->cosine * c + f->sine * s);
    *rate = fade * f->frequency * (f->sine * c - f->cosine * s) - f->decay * swing;
    return f->rest + swing;
}

/* Gap under the tip, less that at which it lands, after a time; and its speed. */
static double over(const ck_flight *flight, const ck_root *root, double time, double *speed) {
    ck_root there = ck_root_after(root, time);
    double rate, bend = ck_flight_at(flight, time, &rate);
    *speed = there.speed + rate;
    return there.height + bend;
}

/* First time at which the tip is down, or sinks no longer; it does so at `high`, not at `low`. */
static double first(const ck_flight *flight, const ck_root *root, double low, double high,
                    double near, int is_down) {
    while (high - low > 1e-15 * high && high - low > near) {
        double middle = 0.5 * (low + high), speed, gap = over(flight, root, middle, &speed);
        if (!(low < middle && middle < high)) break;
        if (is_down ? gap <= 0.0 : speed >= 0.0) high = middle;
        else low = middle;
    }
    return high;
}

double ck_landing_time(const ck_flight *flight, const ck_root *root, double left, int64_t *swings) {
    double swing = sqrt(flight->cosine * flight->cosine + flight->sine * flight->sine), near = 1e-16 * left;
    double last = root->speed + root->acceleration * left, low = 0.0, speed, gap, lowest = 0.0, count;
    int pieces, sinking, i;
    if (root->speed < lowest) lowest = root->speed;
    if (last < lowest) lowest = last;
    if (root->height + lowest * left + flight->rest > swing) return -1.0;
    /* A sixteenth of a swing at a time: between two of them there is at most one lowest point. */
    count = left * flight->frequency / (2.0 * PI);
    if (!(count <= CK_MOST_SWINGS)) return HUGE_VAL;
    pieces = count > 0.0625 ? (int)ceil(16.0 * count) : 1;
    gap = over(flight, root, 0.0, &speed);
    sinking = speed < 0.0;
    for (i = 1; i <= pieces; i++) {
        *swings += i % 16 == 0;
        double high = left * i / pieces, there = over(flight, root, high, &speed);
        if (there <= 0.0 && (gap > 0.0 || sinking)) return first(flight, root, low, high, near, 1);
        if (sinking && !(speed < 0.0)) { /* the lowest point lies between */
            double unused, bottom = first(flight, root, low, high, near, 0);
            if (over(flight, root, bottom, &unused) <= 0.0)
                return first(flight, root, low, bottom, near, 1);
        }
        low = high, gap = there, sinking = speed < 0.0;
    }
    return -1.0;
}
