/* valve-drive: coil, return spring and end stop of a valve; motion in, pull out.

   As fmu/slaves/valve_drive.py. The gap that is set before a step is where the step begins; within it the
   gap runs on at the speed that was set. */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MU0 (4e-7 * 3.141592653589793) /* of vacuum [H/m], as coil.py has it */
#define MOST_STEPS 250000 /* of the flux, in one step of the host: 0.1 to 0.2 s */
#define MOST_SWITCHINGS 100000 /* of the voltage in one step of the host: some 0.1 s of them */
#define CLOSE 1e-12         /* fraction of a step before which no pause is made */

enum { SWITCHES = 1 };

/* Voltage [V] over time. */
static double voltage_at(const ck_profile *p, double time) {
    double since = time - p->delay;
    if (!(since >= 0.0 && since < p->cycles * p->period)) return p->off;
    since = fmod(since, p->period);
    if (since >= p->on_time) return p->off;
    return since < p->boost_time ? p->boost : p->hold;
}

static double next_switch(const ck_profile *p, double start, double end) {
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
static double voltage_after(const ck_profile *p, double time) {
    double next = next_switch(p, time, HUGE_VAL);
    return next < HUGE_VAL ? voltage_at(p, 0.5 * (time + next)) : p->off;
}

static const char *apply(ck_model *model) {
    const double *v = model->state.values;
    ck_drive *drive = &model->drive;
    ck_coil *coil = &drive->coil;
    ck_profile *profile = &drive->profile;
    coil->resistance = v[CK_R_COIL], coil->air_gap = v[CK_G_AIR], coil->iron_gap = v[CK_G_IRON];
    coil->pole = MU0 * (v[CK_N_TURNS] * v[CK_N_TURNS]) * v[CK_A_POLE];
    coil->knee = v[CK_B_SAT] > 0.0 ? v[CK_N_TURNS] * v[CK_A_POLE] * v[CK_B_SAT] : HUGE_VAL;
    profile->delay = v[CK_T_DELAY], profile->period = v[CK_T_PERIOD];
    profile->on_time = v[CK_T_ON], profile->boost_time = v[CK_T_BOOST];
    profile->boost = v[CK_U_BOOST], profile->hold = v[CK_U_HOLD], profile->off = v[CK_U_OFF];
    profile->cycles = v[CK_N_CYCLES];
    drive->spring = v[CK_K_SPRING], drive->preload = v[CK_F_PRELOAD];
    drive->stop_gap = v[CK_H_STOP], drive->stop_stiffness = v[CK_K_STOP];
    drive->damping = v[CK_D_STOP];
    if (v[CK_T_BOOST] > v[CK_T_ON]) return ck_wrong(model, CK_T_BOOST, "not exceed", CK_T_ON, "s");
    if (v[CK_T_ON] > v[CK_T_PERIOD])
        return ck_wrong(model, CK_T_ON, "not exceed", CK_T_PERIOD, "s");
    if (v[CK_H_STOP] >= v[CK_G_AIR])
        return "h_stop must be less than g_air, else the armature meets the poles before the spool "
               "meets the stop";
    return NULL;
}

static void start(ck_model *model) {
    double *v = model->state.values;
    memset(&model->state.driven, 0, sizeof model->state.driven);
    model->state.driven.pending = CK_NONE;
    v[CK_FLUX] = v[CK_DF_EXT] = 0.0;
    v[CK_U] = voltage_at(&model->drive.profile, model->state.start_time);
}

/* The stop without its damping. */
static ck_pressed press(const ck_model *model, double gap) {
    const ck_drive *drive = &model->drive;
    double depth = gap - drive->stop_gap;
    ck_pressed found = {0.0, 0.0, 0.0};
    if (model->data.contents.has_faces)
        return ck_faces_pressed(&model->data.contents.faces, depth, model->state.driven.largest,
                                drive->stop_stiffness);
    if (!(depth <= 0.0)) { /* nan is for others to find */
        found.slope = drive->stop_stiffness;
        found.force = drive->stop_stiffness * depth;
    }
    return found;
}

/* What the damping makes of a force of the stop: it never pulls. */
static double damped(const ck_drive *drive, double speed) {
    double by = 1.0 + drive->damping * speed;
    return 0.0 > by ? 0.0 : by;
}

/* Everything that follows gap and speed at once. */
typedef struct {
    double pull, magnet, spring, stop, current, approach;
} forces;

static forces forces_at(const ck_model *model, double gap, double speed) {
    const ck_drive *drive = &model->drive;
    double flux = model->state.values[CK_FLUX];
    ck_pressed pressed = press(model, gap);
    forces f;
    f.approach = pressed.approach;
    f.stop = pressed.force == 0.0 ? 0.0 : pressed.force * damped(drive, speed);
    f.spring = drive->preload + drive->spring * gap;
    f.magnet = ck_coil_force(&drive->coil, flux);
    f.current = ck_coil_current(&drive->coil, flux, gap);
    f.pull = f.magnet - (f.spring + f.stop);
    return f;
}

static int show(ck_model *model) {
    double *v = model->state.values, speed = v[CK_V];
    forces f = forces_at(model, v[CK_H] + speed * model->state.driven.ahead, speed);
    if (!isfinite(f.pull) || !isfinite(f.current)) return 0;
    v[CK_F_EXT] = f.pull, v[CK_F_MAG] = f.magnet, v[CK_F_SPRING] = f.spring;
    v[CK_F_STOP] = f.stop, v[CK_I] = f.current;
    return 1;
}

/* Where a step has come to: how long it took, the flux, whether it paused. */
typedef struct {
    double length, flux;
    int pauses;
} motion;

/* Take the flux from one switch of the voltage to the next; 0 if it cannot follow. */
static int carry(const ck_model *model, double time, motion *gone) {
    const ck_profile *profile = &model->drive.profile;
    double gap = model->state.values[CK_H], speed = model->state.values[CK_V];
    double begin = 0.0, mark = time, end = gone->length; /* counted from the begin of the step: late in a run clocks are coarse */
    long budget = MOST_STEPS;
    for (;;) {
        double next, voltage, reached;
        mark = next_switch(profile, mark, time + end);
        next = mark < time + end ? ck_smaller(mark - time, end) : end;
        voltage = voltage_at(profile, time + 0.5 * (begin + next));
        reached = ck_coil_advance(&model->drive.coil, &gone->flux, gap + speed * begin, speed,
                                  voltage, next - begin, &budget);
        if (reached < next - begin) {
            gone->length = begin + reached;
            return 0;
        }
        if (next >= end) return 1;
        if (model->pauses && next > CLOSE * ck_larger(fabs(time), gone->length)) {
            gone->length = next, gone->pauses = 1;
            return 1;
        }
        begin = next;
    }
}

static int no_step(ck_model *model, double length, const motion *gone) {
    char message[400];
    snprintf(message, sizeof message,
             "the flux of the coil did not follow a gap of %.6g m that moves at %.6g m/s for %.6g "
             "s: it got to %.6g s; give a smaller speed or shorter steps",
             model->state.values[CK_H], model->state.values[CK_V], length, gone->length);
    return ck_model_discard(model, message);
}

/* Refuse a step with more switchings of the voltage than can be followed in a second or so. */
static int too_many(ck_model *model, double length, double count) {
    char message[400];
    snprintf(message, sizeof message,
             "a step of %.6g s holds %.3g switchings of the voltage, with T_period = %.6g s, and at "
             "most %d are followed in one step; take shorter steps",
             length, count, model->drive.profile.period, MOST_SWITCHINGS);
    return ck_model_discard(model, message);
}

/* Say once that the faces are pressed further than was solved. */
static void warn_beyond(ck_model *model, double known, double time) {
    double end = model->data.contents.faces.first.end, now = model->state.driven.largest;
    char message[400];
    if (!(known <= end && end < now)) return;
    snprintf(message, sizeof message,
             "the rough end-stop faces are pressed by %.6g m at t = %.9g s, beyond %.6g m where their "
             "tables end: the force goes on along its tangent; give the stop a larger area, or "
             "faces solved to larger loads",
             now, time, end);
    model->say(model->host, CK_WARNING, "logStatusWarning", message);
}

/* Outputs whose mean slope over the last step is kept: that of the pull is dF_ext, too. */
static const int RATED[CK_RATES] = {CK_F_EXT, CK_F_MAG, CK_F_SPRING, CK_F_STOP, CK_I, CK_FLUX};

static int rate(const ck_model *model, int output, double *found) {
    int k;
    *found = 0.0; /* of the voltage and of dF_ext, which stay for a step */
    for (k = 0; k < CK_RATES; k++)
        if (RATED[k] == output) *found = model->state.driven.rates[k];
    return 1;
}

static void keep_rates(ck_model *model, const forces *begun, double flux, double length) {
    const double first[CK_RATES] = {begun->pull, begun->magnet,  begun->spring,
                                    begun->stop, begun->current, flux};
    int k;
    for (k = 0; k < CK_RATES; k++)
        model->state.driven.rates[k] = (model->state.values[RATED[k]] - first[k]) / length;
}

static int step(ck_model *model, double time, double length) {
    ck_state *state = &model->state, before = *state;
    double *v = state->values;
    forces begun = forces_at(model, v[CK_H], v[CK_V]);
    const ck_profile *profile = &model->drive.profile;
    double switchings = 3.0 * ck_smaller(profile->cycles, length / profile->period);
    motion gone = {length, v[CK_FLUX], 0};
    int fine;
    if (switchings > MOST_SWITCHINGS) return too_many(model, length, switchings);
    fine = carry(model, time, &gone);
    if (!fine) return no_step(model, length, &gone);
    /* What is remembered is where the spool was, not where it may be at the end of the step. */
    state->driven.largest = ck_larger(begun.approach, state->driven.largest);
    state->driven.ahead = gone.length;
    state->driven.pending = gone.pauses ? SWITCHES : CK_NONE;
    state->end = time + gone.length;
    v[CK_FLUX] = gone.flux;
    if (!gone.pauses) v[CK_U] = voltage_at(&model->drive.profile, state->end);
    fine = isfinite(gone.flux) && show(model);
    keep_rates(model, &begun, before.values[CK_FLUX], gone.length);
    v[CK_DF_EXT] = state->driven.rates[0];
    if (!fine || !isfinite(v[CK_DF_EXT])) {
        *state = before;
        return ck_model_discard(model, "the forces at the end of the step are no finite numbers; "
                                       "give a smaller gap, speed or step");
    }
    state->shown = 1;
    warn_beyond(model, before.driven.largest, time);
    return CK_OK;
}

/* The voltage switches, for which a step has paused. */
static void resolve(ck_model *model) {
    model->state.driven.pending = CK_NONE;
    model->state.values[CK_U] = voltage_after(&model->drive.profile, model->state.time);
}

/* Slopes at the gap and the speed that are set. */
static int slope(const ck_model *model, int unknown, int known, double *found) {
    const ck_drive *drive = &model->drive;
    double gap = model->state.values[CK_H], speed = model->state.values[CK_V], stop;
    ck_pressed pressed = press(model, gap);
    if (known != CK_H && known != CK_V) return 0;
    if (known == CK_H) stop = pressed.slope * damped(drive, speed);
    else stop = damped(drive, speed) > 0.0 ? pressed.force * drive->damping : 0.0;
    *found = 0.0;
    if (unknown == CK_F_STOP) *found = stop;
    if (unknown == CK_F_EXT) *found = -(stop + (known == CK_H ? drive->spring : 0.0));
    if (unknown == CK_F_SPRING && known == CK_H) *found = drive->spring;
    if (unknown == CK_I && known == CK_H)
        *found = ck_coil_current_by_gap(&drive->coil, model->state.values[CK_FLUX], gap);
    return isfinite(*found);
}

const ck_kind ck_valve_drive = {apply, start, show, step, resolve, 1, slope, rate, NULL};
