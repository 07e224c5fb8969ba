/* The models behind both versions of FMI: their variables, phases, what they refuse.

   Common to all models (model.c): variables, phases, refusals; model exchange is in exchange.c.
   `stiction-mass` is in mass.c, a mass
   with its film; `stiction-force` in force.c, a film for a tool that owns the mass; `valve-drive`
   in drive.c and `contact-stop` in stop.c, which have no film; `tip-contact` in tip.c, spring tips with
   theirs. Which of them an instance is says its file of data.

   A step that cannot be taken is discarded: its reason is logged, nothing has changed, and a shorter
   one may do. Any other failure is logged with its cure and remembered: outputs stay at their last
   good values and steps are refused, until the host resets the model or restores an earlier state. */

#ifndef CK_MODEL_H
#define CK_MODEL_H

#include "deforming.h"
#include "drive.h"
#include "grid.h"
#include "motion.h"

#include <stdint.h>

enum { CK_ANY = -1, CK_INSTANTIATED = 0, CK_INITIALIZATION = 1, CK_STEPPING = 2, CK_EVENT = 3, CK_TERMINATED = 4 };
enum { CK_OK = 0, CK_WARNING = 1, CK_DISCARD = 2, CK_ERROR = 3 }; /* as in FMI 2 and 3 */

/* What the file of an FMU holds (description.h); its tables point into `numbers` and `cells`. */
typedef struct {
    char guid[40];
    uint64_t checksum;
    ck_contents contents;
    double *numbers;
    ck_cell *cells;
    int hints[CK_MOST_FILMS * (CK_MOST_LAWS + 1 + 3 * CK_MOST_STRETCHES) * CK_MOST_PIECES];
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

/* What bodies that deform remember besides their film: gap and rate of the undeformed bodies, what the film
   does to them, integrals since the start, and lengths of the last internal step and of the next [s]. */
typedef struct {
    double gap, speed, force, axis, impulse, work, peak, highest, before, next;
    double by_gap, by_speed; /* derivatives of the force over the last step of the host */
    double release_time, releases;
    int armed, ruptured, jumped, padding; /* the film has cavities below its strength; its pressures jump now */
} ck_deformed;

/* Everything that changes, in one piece without pointers. `stale`: the parameters were set since
   the outputs were made; `shown`: the outputs in `values` are those of the state it is in; `event`:
   outputs that change in event mode only are not. */
typedef struct {
    uint64_t checksum; /* of the data it belongs to */
    double values[CK_VARIABLES];
    double latest[CK_DISCRETE]; /* of outputs that event mode changes */
    double time, start_time, stop_time, last_step, rate, pull;
    double end; /* of the last step, where it paused */
    ck_motion motion; /* of stiction-mass, and of a tip */
    ck_memory memory; /* of stiction-force */
    ck_driven driven; /* of valve-drive */
    ck_stopped stopped; /* of contact-stop */
    ck_tip tip; /* of tip-contact */
    ck_deformed deformed; /* of deforming-mass and deforming-force */
    int phase, failed, stale, shown, event;
    int cut; /* the last step ended before its end, as it would have cost too much */
    int has_rtol; /* the host has set `rtol`: its tolerance does not stand for it any more */
} ck_state;

typedef void (*ck_say)(void *host, int status, const char *category, const char *message);

typedef struct {
    ck_data data;
    ck_scene scene; /* that of the data with the parameters in */
    ck_grid_film grid; /* of a film with one, and the liquid on it, which is part of the state */
    ck_deforming deforming; /* bodies that deform; their film is part of the state */
    ck_drive drive; /* the parameters of a drive */
    ck_state state;
    ck_say say;
    void *host;
    int event_mode, early, pauses; /* of FMI 3: whether it is used, a step may end early, and at an event */
    int exchanges;                 /* model exchange: the host integrates, event mode is used */
    char wrong[200];        /* what is wrong with parameters */
} ck_model;

/* Model exchange of a model: its continuous states and their derivatives, as variables in the order of
   the model description; why what was set has none, or NULL; event indicators, which change their sign
   at events; and the events at the motion where the host stopped for one. */
typedef struct {
    int n_states;
    const int *states, *derivatives;
    const char *(*obstacle)(const ck_model *model);
    void (*indicate)(const ck_model *model, double found[CK_INDICATORS]);
    void (*apply_events)(ck_model *model);
} ck_exchange;

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
    const ck_exchange *exchange; /* NULL: co-simulation only */
} ck_kind;

extern const ck_kind CK_KIND_NAMES;

/* Reading the file (data.c); the message says what is wrong with it, NULL if nothing is. */
typedef int ck_read(void *from, void *to, size_t size); /* the next bytes; 0 if there are fewer */
const char *ck_data_read(const char *path, ck_data *data);
const char *ck_data_from(ck_read *read, void *from, ck_data *data);
const char *ck_data_take(ck_data *data, size_t count); /* of numbers that are in it already */
uint64_t ck_checksum(const void *bytes, size_t count);

/* Living: open (0 if it fails), then setup, initialize, step; reset starts anew. */
int ck_model_open(ck_model *model, const char *resources, const char *guid);
const char *ck_model_made(ck_model *model); /* after its data, what is made of them; what is wrong */
void ck_model_close(ck_model *model);
void ck_model_reset(ck_model *model);
/* The start, and what the host says besides: NULL where it says nothing. */
int ck_model_setup(ck_model *model, double start_time, const double *stop_time,
                   const double *tolerance);
int ck_model_initialize(ck_model *model);
int ck_model_step(ck_model *model, double time, double step);
int ck_model_restore(ck_model *model, const ck_state *state, const double *field);

/* States of the host: taken, restored, freed, and as bytes. */
int ck_saved_take(ck_model *model, void **state);
int ck_saved_restore(ck_model *model, const void *state);
int ck_saved_free(void **state); /* or of the state itself: hosts leave out the & */
int ck_saved_size(ck_model *model, const void *state, size_t *size);
int ck_saved_write(ck_model *model, const void *state, void *bytes, size_t size);
int ck_saved_read(ck_model *model, const void *bytes, size_t size, void **state);

/* Variables by value reference, from 1; `types` says which the call takes. */
const ck_variable *ck_model_variable(ck_model *model, unsigned reference, int types, const char *call);
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
void ck_events_lift(ck_model *model, double seen[CK_DISCRETE]);
void ck_events_hold(ck_model *model, const double seen[CK_DISCRETE]);
int ck_events_lag(const ck_model *model); /* whether event mode has anything to show */
void ck_events_skip(ck_model *model); /* if it is not used nothing waits for it */

/* Model exchange (exchange.c). A host tries motions beyond what the tables hold while it looks for a
   step: those are discarded. Numbers are read in any phase, CK_ANY. */
int ck_exchange_is_on(ck_model *model, int phase, const char *call);
int ck_exchange_time(ck_model *model, double time);
int ck_exchange_states(ck_model *model, double found[], size_t n);
int ck_exchange_set_states(ck_model *model, const double given[], size_t n);
int ck_exchange_derivatives(ck_model *model, double found[], size_t n);
int ck_exchange_indicators(ck_model *model, double found[], size_t n);
int ck_exchange_nominals(ck_model *model, double found[], size_t n);
int ck_exchange_has_state(const ck_model *model, int variable);

/* For the models themselves. */
int ck_model_fail(ck_model *model, const char *message);    /* CK_ERROR, and so on */
int ck_model_discard(ck_model *model, const char *message); /* CK_DISCARD, of this step only */
int ck_model_is_in(ck_model *model, int phase, const char *call);
const ck_kind *ck_model_kind(const ck_model *model);
const char *ck_model_prepare(ck_model *model);
const char *ck_common_parameters(ck_model *model);
const char *ck_liquid(ck_model *model, double *viscosity, double *surface_tension); /* at T */
int ck_step_limit(const ck_model *model); /* parameter max_steps */
int ck_rate_twice(ck_model *model);       /* the rate of F_ext was given in two ways */
/* What a parameter must do to another one of its unit, with the values of both. */
const char *ck_wrong(ck_model *model, int id, const char *must, int other, const char *unit);
void ck_model_follow(ck_model *model);                           /* outputs nobody has read yet */

#endif
