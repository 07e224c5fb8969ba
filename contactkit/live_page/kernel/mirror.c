/* A micromirror as a page calls it: the equations of models/micromirror/mirror.py and electrostatics.py,
   and the tips of both sides, which are tip-contact, coupled as models/micromirror/coupling.py does.

   The tips of the side that has landed are the model of page.c, those of the other side are opened and
   set here. Then ck_mirror_set for each number of the mirror, ck_mirror_start, and ck_mirror_run until it
   returns no CK_PAGE_GOES_ON. */

#include "page.h"

#include <math.h>
#include <string.h>

/* Numbers of a mirror, in the order of `PARAMETERS` of live_page/mirror_page.py. */
enum { INERTIA, HINGE, DAMPING, WIDTH, INNER, OUTER, GAP, ARM, LANDING, BIAS, ADDRESS, RESET, RESET_TIME, NUMBERS };
enum { MIRROR_COLUMNS = 9, MOST_ROWS = 64, SIDES = 2 };

#define EPSILON0 8.8541878128e-12 /* [F/m], CODATA 2018 */
#define NEAR 0.2                  /* below which the logarithms cancel: see electrostatics.py */
#define TERMS 26
#define PARTS 400 /* of the way from landing to the electrode in which a balance is looked for */
#define FREE 3.0  /* state of tips that nothing holds */

/* Time, tilt, rate; of the tips that had landed gap, force of all of them, force of the film of one, and
   state; gap and state on the other side. */
static double rows[MOST_ROWS][MIRROR_COLUMNS];
static int n_rows;
static double at[NUMBERS];
static ck_model other;
static struct {
    double tilt, rate, slope, known, length, held;
    int step, steps, pulse; /* of `steps` up to the end the first `pulse` are those of the reset pulse */
    double pulse_time, wait;
} now;

EXPORT(ck_mirror_rows) const double *ck_mirror_rows(void) { return &rows[0][0]; }
EXPORT(ck_mirror_count) int ck_mirror_count(void) { return n_rows; }
EXPORT(ck_mirror_room) double *ck_mirror_room(int count) { return ck_page_room_of(&other, count); }
EXPORT(ck_mirror_open) int ck_mirror_open(int count) { return ck_page_open_of(&other, count); }
EXPORT(ck_mirror_reset) void ck_mirror_reset(void) { ck_model_reset(&other); }
EXPORT(ck_mirror_set) void ck_mirror_set(int number, double value) { at[number] = value; }

/* A parameter of the tips of the other side. */
EXPORT(ck_mirror_tip) int ck_mirror_tip(unsigned reference, double value) {
    return ck_model_set(&other, reference, CK_REAL | CK_INTEGER, value) == CK_OK;
}

static ck_model *tips(int side) { return side ? &other : &ck_page_model; }
static double sign(int side) { return side ? -1.0 : 1.0; }

/* Torque of an electrode over the square of the voltage; nan beyond it. */
static double torque(double tilt) {
    double s = sin(tilt), left = at[GAP] - at[OUTER] * s, rho, y, tau, second = 0.0;
    int n;
    if (!(left > 0.0)) return NAN;
    rho = (at[OUTER] - at[INNER]) / left, y = rho * s, tau = at[INNER] / (at[GAP] - at[INNER] * s);
    if (fabs(y) > NEAR) second = (y - log1p(y)) / (y * y);
    else
        for (n = TERMS + 1; n > 1; n--) second = 1.0 / n - y * second;
    return 0.5 * EPSILON0 * at[WIDTH] * cos(tilt) * rho * (tau + rho * second);
}

static double acceleration(double tilt, double rate, const double volts[SIDES], double force) {
    double turning = at[ARM] * cos(tilt) * force;
    if (volts[0] != 0.0) turning += torque(tilt) * volts[0] * volts[0];
    if (volts[1] != 0.0) turning -= torque(-tilt) * volts[1] * volts[1];
    return (turning - at[HINGE] * tilt - at[DAMPING] * rate) / at[INERTIA];
}

static double height(double tilt, int side) { return at[ARM] * (sin(at[LANDING]) - sign(side) * sin(tilt)); }
static double climb(double tilt, double rate, int side) { return -sign(side) * at[ARM] * cos(tilt) * rate; }

/* What is left of the balance of a landed mirror under its bias. */
static double left_over(double tilt) {
    double volts[SIDES] = {at[BIAS] - at[ADDRESS], at[BIAS]};
    double stiffness = ck_page_read(tips(0), CK_N) * ck_page_read(tips(0), CK_K);
    return acceleration(tilt, 0.0, volts, stiffness * height(tilt, 0));
}

/* Tilt at which the mirror rests on its tips; nan if it does not. */
static double landed(void) {
    double most = asin(fmin(at[GAP] / at[OUTER], 1.0)), low = at[LANDING], high = low;
    int i;
    if (!(left_over(low) > 0.0)) return NAN;
    for (i = 1; i < PARTS; i++) {
        high = at[LANDING] + (most - at[LANDING]) * i / PARTS;
        if (left_over(high) <= 0.0) break;
        low = high;
    }
    if (i == PARTS) return NAN;
    for (i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        if (left_over(middle) > 0.0) low = middle;
        else high = middle;
    }
    return 0.5 * (low + high);
}

/* Voltages over the electrodes at a step: the reset pulse, then none; the address has changed. */
static void volts_at(int step, double volts[SIDES]) {
    volts[0] = step < now.pulse ? (at[BIAS] < 0.0 ? -at[RESET] : at[RESET]) : 0.0;
    volts[1] = volts[0] - at[ADDRESS];
}

static double time_at(int step) {
    if (step <= now.pulse) return now.pulse ? now.pulse_time * step / now.pulse : 0.0;
    return now.pulse_time + now.wait * (step - now.pulse) / (now.steps - now.pulse);
}

/* A mirror under a force of its tips that changes steadily: classical Runge-Kutta. */
static void turn(double *tilt, double *rate, const double volts[SIDES], double force, double slope, double dt) {
    double half = 0.5 * dt, a1 = acceleration(*tilt, *rate, volts, force);
    double r2 = *rate + half * a1, a2 = acceleration(*tilt + half * *rate, r2, volts, force + slope * half);
    double r3 = *rate + half * a2, a3 = acceleration(*tilt + half * r2, r3, volts, force + slope * half);
    double r4 = *rate + dt * a3, a4 = acceleration(*tilt + dt * r3, r4, volts, force + slope * dt);
    *tilt += dt * (*rate + 2.0 * (r2 + r3) + r4) / 6.0;
    *rate += dt * (a1 + 2.0 * (a2 + a3) + a4) / 6.0;
}

static int lead(int side, double z, double speed, double rise) {
    ck_model *tip = tips(side);
    return ck_page_put(tip, CK_Z, z) && ck_page_put(tip, CK_VZ, speed) && ck_page_put(tip, CK_AZ, rise);
}

/* A row, and what the mirror knows of its tips. */
static int row_at(double time) {
    static const int ids[] = {CK_H, CK_F, CK_F_FILM, CK_STATE};
    double found[SIDES][4], *row = rows[n_rows++];
    int side, i;
    for (side = 0; side < SIDES; side++) {
        if (!lead(side, height(now.tilt, side), climb(now.tilt, now.rate, side), 0.0)) return 0;
        for (i = 0; i < 4; i++) found[side][i] = ck_page_read(tips(side), ids[i]);
    }
    row[0] = time, row[1] = now.tilt, row[2] = now.rate;
    memcpy(row + 3, found[0], sizeof found[0]);
    row[7] = found[1][0], row[8] = found[1][3];
    now.known = found[0][1] - found[1][1];
    if (found[0][3] < FREE) now.held = time;
    return 1;
}

/* The start, at rest under the bias: a pulse of `pulse` V, 0 for none, then no voltage for a time. */
EXPORT(ck_mirror_start) int ck_mirror_start(double pulse, double wait, double length) {
    int side;
    n_rows = 0;
    memset(&now, 0, sizeof now);
    at[RESET] = pulse;
    now.pulse_time = pulse > 0.0 ? at[RESET_TIME] : 0.0, now.wait = wait;
    now.pulse = now.pulse_time > 0.0 ? (int)ceil(now.pulse_time / length - 1e-9) : 0;
    now.steps = now.pulse + (int)ceil(wait / length - 1e-9);
    now.tilt = landed();
    if (!isfinite(now.tilt)) {
        ck_page_say(NULL, CK_ERROR, "", "no balance: the bias does not hold the mirror down, or presses the plate on the electrode");
        return 0;
    }
    for (side = 0; side < SIDES; side++) {
        tips(side)->state.phase = CK_INSTANTIATED;
        if (!lead(side, height(now.tilt, side), 0.0, 0.0) || !ck_page_start_of(tips(side))) return 0;
    }
    return row_at(0.0);
}

static int met(void) {
    ck_page_say(NULL, CK_ERROR, "", "the plate meets the electrode; take a lower voltage, stiffer tips or more height");
    return 0;
}

/* One communication step: the mirror ahead, the tips after it, the mirror for good. */
static int exchange(double time, double dt) {
    double volts[SIDES], ahead = now.tilt, unused = now.rate, mean = 0.0, last = 0.0, known = now.known;
    int side;
    volts_at(now.step, volts);
    turn(&ahead, &unused, volts, known, now.slope, dt);
    if (!isfinite(ahead)) return met();
    for (side = 0; side < SIDES; side++) {
        double z = height(now.tilt, side), speed = climb(now.tilt, now.rate, side);
        double travel = height(ahead, side) - z;
        if (!lead(side, z, speed, 2.0 * (travel / dt - speed) / dt)) return 0;
        if (ck_model_step(tips(side), time, dt) != CK_OK) return 0;
        mean += sign(side) * ck_page_read(tips(side), CK_F_MEAN), last += sign(side) * ck_page_read(tips(side), CK_F);
    }
    now.slope = (last - known) / dt;
    turn(&now.tilt, &now.rate, volts, mean - 0.5 * now.slope * dt, now.slope, dt);
    return isfinite(now.tilt + now.rate) ? 1 : met();
}

/* Steps to the end, or until the tilt is below some; rows of some of them. */
EXPORT(ck_mirror_run) int ck_mirror_run(double away) {
    n_rows = 0;
    while (n_rows < MOST_ROWS) {
        double time = time_at(now.step), next;
        if (now.step >= now.steps) return CK_PAGE_LATE;
        next = time_at(now.step + 1);
        if (!exchange(time, next - time)) return CK_PAGE_FAILS;
        now.step++;
        if (!row_at(next)) return CK_PAGE_FAILS;
        if (now.tilt < away) return CK_PAGE_RELEASED;
    }
    return CK_PAGE_GOES_ON;
}

/* Latest time at which something held the tips of the side that had landed. */
EXPORT(ck_mirror_held) double ck_mirror_held(void) { return now.held; }
EXPORT(ck_mirror_tilt) double ck_mirror_tilt(void) { return now.tilt; }
EXPORT(ck_mirror_bend) double ck_mirror_bend(void) { return -height(now.tilt, 0); }
