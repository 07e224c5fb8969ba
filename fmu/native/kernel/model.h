/* The models behind both versions of FMI: their variables, phases, what they refuse.

   Common to all models (model.c): ports, phases, refusals. `stiction-mass` is in mass.c, a mass
   with its film; `stiction-force` in force.c, a film for a tool that owns the mass; `valve-drive`
   in drive.c and `contact-stop` in stop.c, which have no film; `tip-contact` in tip.c, spring tips with
   theirs. Which of them an instance is says its file of data.

   A step that cannot be taken is discarded: its reason is logged, nothing has changed, and a shorter
   one may do. Any other failure is logged with its cure and remembered: outputs stay at their last
   good values and steps are refused, until the host resets the model or restores an earlier state. */

#ifndef CK_MODEL_H
#define CK_MODEL_H

#include "drive.h"
#include "motion.h"

#include <stdint.h>

enum {
    CK_STICTION_MASS = 0, CK_STICTION_FORCE = 1, CK_VALVE_DRIVE = 2, CK_CONTACT_STOP = 3,
    CK_TIP_CONTACT = 4
};
/* Types of variables, as bits: a call of one version of FMI may take several of them. */
enum { CK_REAL = 1, CK_INTEGER = 2, CK_ENUMERATION = 4, CK_BOOLEAN = 8 };
enum { CK_INPUT = 0, CK_OUTPUT = 1, CK_PARAMETER = 2 };
enum { CK_INSTANTIATED = 0, CK_INITIALIZATION = 1, CK_STEPPING = 2, CK_EVENT = 3, CK_TERMINATED = 4 };
enum { CK_OK = 0, CK_WARNING = 1, CK_DISCARD = 2, CK_ERROR = 3 }; /* as in FMI 2 and 3 */

/* Every variable there may be; fmu/native/data.py has the same list in the same order. */
enum {
    CK_F_EXT, CK_DF_EXT,
    CK_H, CK_V, CK_F, CK_F_M, CK_F_V, CK_J, CK_J_M, CK_W, CK_STATE, CK_LIMIT, CK_T_BREAK,
    CK_T_RELEASE, CK_F_PEAK, CK_N_BREAK, CK_N_RELEASE,
    CK_M, CK_H0, CK_V0, CK_K_S, CK_H_REL, CK_H_MIN, CK_H_BREAK, CK_ETA, CK_GAMMA, CK_DP_CAV,
    CK_TAU_LIM, CK_RTOL,
    CK_C, CK_K, CK_F_MEAN, CK_COUPLING_ERROR, CK_H_STABLE, CK_IN_DOUBT, CK_N_DOUBT, CK_H_ABOVE,
    CK_H_BELOW, CK_M_REF, CK_EXCHANGE,
    CK_F_MAG, CK_F_SPRING, CK_F_STOP, CK_I, CK_U, CK_FLUX,
    CK_R_COIL, CK_N_TURNS, CK_A_POLE, CK_G_AIR, CK_G_IRON, CK_B_SAT, CK_K_SPRING, CK_F_PRELOAD,
    CK_H_STOP, CK_K_STOP, CK_D_STOP, CK_T_DELAY, CK_T_PERIOD, CK_T_ON, CK_U_BOOST, CK_T_BOOST,
    CK_U_HOLD, CK_U_OFF, CK_N_CYCLES,
    CK_F_EL, CK_CONTACT_AREA, CK_PLASTIC_AREA, CK_D, CK_D_MAX, CK_D_RES, CK_W_D, CK_N_BEYOND,
    CK_H_TOUCH, CK_SIDE, CK_SCALE, CK_K_BODY, CK_D_MAX0,
    CK_Z, CK_VZ, CK_AZ, CK_F_FILM, CK_W_VISC, CK_W_LAND, CK_T_FREE, CK_T_LAND, CK_N_LAND, CK_F_MAX,
    CK_W_PLASTIC, CK_N, CK_H_FREE,
    CK_R_CAV, CK_V_VOID, CK_DP_TEAR, CK_DP_HOLD, CK_MAX_STEPS,
    CK_VARIABLES
};

enum { CK_HELD = 13 }; /* outputs that change at events only */

typedef struct {
    int id, type, causality;
    double low, high, start;
} ck_port;

/* What the file of an FMU holds; the tables point into `cells`. */
typedef struct {
    char guid[40];
    uint64_t checksum;
    int kind, port_count;
    ck_port ports[CK_VARIABLES];
    ck_scene scene; /* of a film */
    ck_faces faces; /* of a drive, a stop, or the site of tips */
    double *numbers;
    ck_cell *cells;
    int hints[CK_FILMS * (CK_LAWS + 1) * CK_PIECES];
} ck_data;

/* What a film without its mass remembers: where the last step ended, and what happened so far. */
typedef struct {
    double gap, damping;
    int film, broken, detached, pending; /* as in ck_motion */
    ck_cavity cavity;
} ck_memory;

enum { CK_RATES = 6 };

/* What a drive remembers besides its outputs: the largest approach of its faces, for how long the
   gap has run on at its speed since it was set, mean slopes of outputs over the last step, and
   whether the voltage has yet to switch. */
typedef struct {
    double largest, ahead, rates[CK_RATES];
    int pending, padding;
} ck_driven;

/* What a stop remembers: the largest approach of its faces, and where the last step ended, with
   the damping there. */
typedef struct {
    double largest, depth, damping;
    int beyond, padding;
} ck_stopped;

/* What a tip remembers besides its motion: its impulse on the root and its losses; the approach of
   apex and site, or the residual indentation while they are apart, the maximum approach, and the
   largest force of the site; for how long the root has gone on since it was set. */
typedef struct {
    double impulse, loss, landing_time, free_time;
    double depth, residual, largest, peak, ahead;
    int free, touching, landings, padding;
} ck_tip;

/* Everything that changes, in one piece without pointers. `stale`: the parameters were set since
   the outputs were made; `shown`: the outputs in `values` are those of the state it is in; `event`:
   outputs that change in event mode only are not. */
typedef struct {
    uint64_t checksum; /* of the data it belongs to */
    double values[CK_VARIABLES];
    double latest[CK_HELD]; /* of outputs that event mode changes */
    double time, start_time, stop_time, last_step, rate, pull;
    double end; /* of the last step, where it paused */
    ck_motion motion; /* of stiction-mass, and of a tip */
    ck_memory memory; /* of stiction-force */
    ck_driven driven; /* of valve-drive */
    ck_stopped stopped; /* of contact-stop */
    ck_tip tip; /* of tip-contact */
    int phase, failed, stale, shown, event;
    int cut; /* the last step ended before its end, as it would have cost too much */
    int has_rtol; /* the host has set `rtol`: its tolerance does not stand for it any more */
} ck_state;

typedef void (*ck_say)(void *host, int status, const char *category, const char *message);

typedef struct {
    ck_data data;
    ck_scene scene; /* that of the data with the parameters in */
    ck_drive drive; /* the parameters of a drive */
    ck_state state;
    ck_say say;
    void *host;
    int event_mode, early, pauses; /* of FMI 3: whether it is used, a step may end early, and at an event */
    char wrong[200];        /* what is wrong with parameters */
} ck_model;

/* What one of the models is made of. */
typedef struct {
    const char *(*apply)(ck_model *model); /* parameters into the scene; what is wrong, or NULL */
    void (*start)(ck_model *model);        /* the state at the start */
    int (*show)(ck_model *model);          /* outputs into `values`; 0 if they are not finite */
    int (*step)(ck_model *model, double time, double step); /* status; nothing changes if not CK_OK */
    void (*resolve)(ck_model *model);      /* make happen what is pending; */
    int follows;                           /* whether outputs follow inputs without a step */
    /* Slope of an output by an input it follows, exactly; 0 if it is not known so. */
    int (*slope)(const ck_model *model, int unknown, int known, double *slope);
    /* Derivative of an output by time, over the last step; 0 if there is none. NULL: of none. */
    int (*rate)(const ck_model *model, int output, double *rate);
} ck_kind;

extern const ck_kind ck_stiction_mass, ck_stiction_force, ck_valve_drive, ck_contact_stop, ck_tip_contact;

/* Reading the file (data.c); the message says what is wrong with it, NULL if nothing is. */
const char *ck_data_read(const char *path, ck_data *data);
uint64_t ck_checksum(const void *bytes, size_t count);

/* Living: open (0 if it fails), then setup, initialize, step; reset starts anew. */
int ck_model_open(ck_model *model, const char *resources, const char *guid);
void ck_model_close(ck_model *model);
void ck_model_reset(ck_model *model);
/* The start, and what the host says besides: NULL where it says nothing. */
int ck_model_setup(ck_model *model, double start_time, const double *stop_time,
                   const double *tolerance);
int ck_model_initialize(ck_model *model);
int ck_model_step(ck_model *model, double time, double step);
int ck_model_restore(ck_model *model, const ck_state *state);

/* States of the host: taken, restored, freed, and as bytes. */
int ck_saved_take(ck_model *model, void **state);
int ck_saved_restore(ck_model *model, const void *state);
int ck_saved_free(void **state); /* or of the state itself: hosts leave out the & */
int ck_saved_size(ck_model *model, const void *state, size_t *size);
int ck_saved_write(ck_model *model, const void *state, void *bytes, size_t size);
int ck_saved_read(ck_model *model, const void *bytes, size_t size, void **state);

/* Variables by value reference, from 1; `types` says which the call takes. */
const ck_port *ck_model_port(ck_model *model, unsigned reference, int types, const char *call);
int ck_model_set(ck_model *model, unsigned reference, int types, double value);
int ck_model_get(ck_model *model, unsigned reference, int types, double *value);

/* Sum over the knowns of the slope of each unknown by it, times its seed (derivative.c). */
int ck_model_derivative(ck_model *model, const unsigned unknown[], size_t n,
                        const unsigned known[], size_t m, const double seed[], double value[]);

/* First derivative of an output by time; CK_DISCARD if there is none. */
int ck_model_rate(ck_model *model, unsigned reference, int order, double *value);

/* Event mode. Around whatever makes outputs: put true values in place of those the host
   has seen, then back; noted as seen once event mode has shown them. */
int ck_model_update(ck_model *model); /* let happen what the step ended for */
int ck_model_pends(const ck_model *model);
void ck_events_note(ck_model *model);
void ck_events_lift(ck_model *model, double seen[CK_HELD]);
void ck_events_hold(ck_model *model, const double seen[CK_HELD]);
int ck_events_lag(const ck_model *model); /* whether event mode has anything to show */
void ck_events_skip(ck_model *model); /* if it is not used nothing waits for it */

/* For the models themselves. */
int ck_model_fail(ck_model *model, const char *message);    /* CK_ERROR, and so on */
int ck_model_discard(ck_model *model, const char *message); /* CK_DISCARD, of this step only */
int ck_model_is_in(ck_model *model, int phase, const char *call);
const ck_kind *ck_model_kind(const ck_model *model);
const char *ck_model_prepare(ck_model *model);
const char *ck_common_parameters(ck_model *model);
int ck_step_limit(const ck_model *model); /* parameter max_steps */
/* What a parameter must do to another one of its unit, with the values of both. */
const char *ck_wrong(ck_model *model, int id, const char *must, int other, const char *unit);
void ck_model_follow(ck_model *model);                           /* outputs nobody has read yet */
const char *ck_name(int id);

#endif
