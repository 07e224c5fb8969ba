/* Variables, phases and refusals; see the head of model.h. */

#include "model.h"

#include "host.h"
#include "rheology.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Fraction of the time by which two clocks may differ: master and model add up steps on their own, and
   each sum is off by some units of round-off. */
#define CLOCK (16.0 * DBL_EPSILON)
#define REST 1e-9 /* fraction of a step up to which another is put off, as masters end with round-off */
#define OFF 1e-6  /* fraction of a step by which it may start or end off its time */

const ck_kind *ck_model_kind(const ck_model *model) {
    static const ck_kind *const kinds[CK_MODELS] = {CK_KINDS};
    return kinds[model->data.contents.model];
}

int ck_model_fail(ck_model *model, const char *message) {
    if (!model->state.failed) { /* the first failure explains those that follow */
        model->state.failed = 1;
        model->say(model->host, CK_ERROR, "logStatusError", message);
    }
    return CK_ERROR;
}

int ck_model_discard(ck_model *model, const char *message) {
    model->say(model->host, CK_DISCARD, "logStatusError", message);
    return CK_DISCARD;
}

const char *ck_model_made(ck_model *model) {
    const ck_contents *contents = &model->data.contents;
    const char *problem = NULL;
    if (contents->has_tables && contents->tables.has_grid)
        problem = ck_grid_open(&model->grid, &contents->tables.grid);
    if (!problem && contents->has_bodies)
        problem = ck_deforming_open(&model->deforming, &contents->bodies,
                                    contents->model == CK_DEFORMING_MASS);
    return problem;
}

int ck_model_open(ck_model *model, const char *resources, const char *guid) {
    char path[1024], message[1400];
    const char *problem;
    int length = snprintf(path, sizeof path, "%s/film.bin", resources);
    if (length < 0 || (size_t)length >= sizeof path) problem = "its path is too long";
    else problem = ck_data_read(path, &model->data);
    if (!problem) problem = ck_model_made(model);
    if (!problem && strcmp(guid, model->data.guid) != 0)
        problem = "it belongs to an FMU with another GUID";
    if (!problem) {
        model->state.checksum = model->data.checksum;
        ck_model_reset(model);
        return 1;
    }
    snprintf(message, sizeof message, "resources/film.bin: %s; build or unpack the FMU again",
             problem);
    model->say(model->host, CK_ERROR, "logStatusError", message);
    ck_model_close(model);
    return 0;
}

void ck_model_close(ck_model *model) {
    ck_grid_close(&model->grid);
    ck_deforming_close(&model->deforming);
    free(model->data.numbers);
    free(model->data.cells);
    model->data.numbers = NULL, model->data.cells = NULL;
}

void ck_model_reset(ck_model *model) {
    int i;
    memset(&model->state, 0, sizeof model->state);
    ck_grid_put(&model->grid, NULL);
    ck_deforming_put(&model->deforming, NULL);
    model->state.checksum = model->data.checksum;
    model->state.stop_time = HUGE_VAL;
    model->state.shown = 1;
    for (i = 0; i < model->data.contents.n_variables; i++)
        model->state.values[model->data.contents.variables[i].id] = model->data.contents.variables[i].start;
}

int ck_model_is_in(ck_model *model, int phase, const char *call) {
    static const char *const phases[] = {"instantiated", "in initialization", "stepping",
                                         "in event mode", "terminated"};
    char message[200];
    if (model->state.phase == phase) return 1;
    snprintf(message, sizeof message, "%s is for an FMU that is %s, this one is %s; reset it", call,
             phases[phase], phases[model->state.phase]);
    ck_model_fail(model, message);
    return 0;
}

const ck_variable *ck_model_variable(ck_model *model, unsigned reference, int types, const char *call) {
    const char *what = types & CK_REAL ? "a real" : types & CK_BOOLEAN ? "a boolean" : "an integer";
    char message[200];
    if (reference >= 1 && reference <= (unsigned)model->data.contents.n_variables &&
        model->data.contents.variables[reference - 1].type & types)
        return &model->data.contents.variables[reference - 1];
    snprintf(message, sizeof message,
             "%s: value reference %u is not that of %s variable; reset the FMU and keep to the "
             "variables of its model description",
             call, reference, what);
    ck_model_fail(model, message);
    return NULL;
}

static int refuse(ck_model *model, const ck_variable *port, double value, const char *expected) {
    char message[300];
    if (model->exchanges && model->state.phase == CK_STEPPING && port->causality == CK_INPUT) {
        snprintf(message, sizeof message, "%s must %s, got %.17g; take a shorter step", ck_names[port->id],
                 expected, value);
        return ck_model_discard(model, message);
    }
    snprintf(message, sizeof message, "%s must %s, got %.17g; reset the FMU, then set it so",
             ck_names[port->id], expected, value);
    return ck_model_fail(model, message);
}

int ck_model_set(ck_model *model, unsigned reference, int types, double value) {
    const ck_variable *port = ck_model_variable(model, reference, types, "set");
    char expected[100];
    if (!port) return CK_ERROR;
    if (model->state.failed) return CK_ERROR;
    if (port->causality == CK_OUTPUT)
        return refuse(model, port, value, "not be set, because it is an output");
    if (model->state.phase == CK_TERMINATED)
        return refuse(model, port, value, "not be set after the end");
    if (port->causality == CK_PARAMETER && model->state.phase >= CK_STEPPING)
        return refuse(model, port, value, "be set before initialization ends");
    if (!(port->low <= value && value <= port->high)) { /* nan is not, either */
        if (port->high < DBL_MAX)
            snprintf(expected, sizeof expected, "lie between %.9g and %.9g", port->low, port->high);
        else if (port->low > -DBL_MAX)
            snprintf(expected, sizeof expected, "be a finite number, at least %.9g", port->low);
        else
            snprintf(expected, sizeof expected, "be a finite number");
        return refuse(model, port, value, expected);
    }
    model->state.values[port->id] = value;
    if (port->id == CK_RTOL) model->state.has_rtol = 1;
    if (model->state.phase < CK_STEPPING) model->state.stale = 1;
    else if (ck_model_kind(model)->follows)
        model->state.shown = 0, model->state.driven.ahead = model->state.tip.ahead = 0.0;
    return CK_OK;
}

/* Gap at which the laws of a film end: without surface tension that of the meniscus is none. */
static double film_end(const ck_scene *scene, const ck_film *film) {
    double end = HUGE_VAL;
    int i;
    if (scene->surface_tension != 0.0) return film->end;
    for (i = 0; i < film->n_laws; i++)
        if (film->laws[i].scale != CK_SCALE_SURFACE_TENSION) end = fmin(end, film->laws[i].end);
    return end;
}

const char *ck_wrong(ck_model *model, int id, const char *must, int other, const char *unit) {
    const double *v = model->state.values;
    snprintf(model->wrong, sizeof model->wrong, "%s must %s %s = %.9g %s, got %.9g %s", ck_names[id],
             must, ck_names[other], v[other], unit, v[id], unit);
    return model->wrong;
}

/* Damping of the liquid over its viscosity, or NULL. */
static const ck_table *damping_of(const ck_film *film) {
    int i;
    for (i = 0; i < film->n_laws; i++) {
        const ck_law *law = &film->laws[i];
        if (law->rate == CK_RATE_LIQUID && law->scale == CK_SCALE_VISCOSITY) return &law->table;
    }
    return NULL;
}

/* The tensions at which the films cavitate, and that of their cavities; what is wrong with them. */
static const char *tensions(ck_model *model, double strength, double hold) {
    const double *v = model->state.values;
    ck_scene *scene = &model->scene;
    int i;
    if (hold > strength) return ck_wrong(model, CK_DP_HOLD, "not exceed", CK_DP_INCEPTION, "Pa");
    if (strength > 0.0 && v[CK_DP_CAV] > 0.0)
        return ck_wrong(model, CK_DP_INCEPTION, "be 0 beside", CK_DP_CAV, "Pa");
    if (strength > 0.0 && v[CK_TAU_LIM] > 0.0)
        return ck_wrong(model, CK_DP_INCEPTION, "be 0 beside", CK_TAU_LIM, "Pa");
    for (i = 0; i < scene->tables->n_films; i++) {
        const ck_film *film = &scene->tables->films[i];
        ck_cavity_law *law = &scene->laws[i];
        law->menisci = scene->tables->menisci, law->viscosity = scene->viscosity;
        law->rim_square = film->rim_square, law->volume = film->volume;
        law->damping = damping_of(film);
        law->grid = scene->tables->has_grid && law->damping ? &model->grid : NULL;
        law->strength = film->rim_square > 0.0 || law->grid ? strength : 0.0;
        law->drop = hold > 0.0 ? hold : strength;
    }
    return NULL;
}

/* What models of a film take from their parameters; the message says what is wrong with them. */
const char *ck_common_parameters(ck_model *model) {
    const double *v = model->state.values;
    ck_scene *scene = &model->scene;
    const char *problem;
    int i;
    memset(scene, 0, sizeof *scene);
    scene->tables = &model->data.contents.tables;
    scene->pauses = model->pauses;
    if (v[CK_H_BREAK] > 0.0 && v[CK_H_BREAK] <= v[CK_H0])
        return ck_wrong(model, CK_H_BREAK, "be 0 or exceed", CK_H0, "m");
    scene->initial_gap = v[CK_H0];
    problem = ck_liquid(model, &scene->viscosity, &scene->surface_tension);
    if (problem) return problem;
    scene->tension = v[CK_DP_CAV], scene->strength = v[CK_TAU_LIM];
    problem = tensions(model, v[CK_DP_INCEPTION], v[CK_DP_HOLD]);
    if (problem) return problem;
    for (i = 0; i < scene->tables->n_films; i++) {
        double breaks = v[CK_H_BREAK] > 0.0 ? v[CK_H_BREAK] : scene->tables->films[i].breaks;
        double end = film_end(scene, &scene->tables->films[i]);
        scene->ends[i] = end < breaks ? end : breaks;
    }
    if (scene->ends[0] <= v[CK_H0])
        return "no meniscus spans h0: lower it, or build the FMU from a scene with more liquid";
    scene->recontact = 0.0;
    for (i = 0; i < scene->tables->films[0].n_laws; i++) {
        const ck_law *law = &scene->tables->films[0].laws[i];
        if (law->release < HUGE_VAL && law->release <= v[CK_H0])
            return "h0 must be below the gap at which the solids detach";
        if (law->recontact > scene->recontact) scene->recontact = law->recontact;
    }
    return NULL;
}

int ck_step_limit(const ck_model *model) {
    double most = model->state.values[CK_MAX_STEPS];
    return most >= 1.0 && most <= 1e9 ? (int)most : 1; /* a file may say anything */
}

/* Why the forces at the start are no finite numbers. */
static const char *no_start(const ck_model *model) {
    const double *v = model->state.values;
    int has_mass = model->data.contents.model == CK_STICTION_MASS;
    const char *obstacle = NULL;
    ck_acting acting;
    if (model->data.contents.has_tables) {
        ck_act(&model->scene, 0, 0, 0, &acting);
        obstacle = ck_rheological_obstacle(&acting, v[has_mass ? CK_H0 : CK_H], v[has_mass ? CK_V0 : CK_V]);
    }
    return obstacle ? obstacle : "the forces at the start are no finite numbers";
}

/* Start from the parameters; the message says what is wrong with them. */
const char *ck_model_prepare(ck_model *model) {
    const ck_kind *kind = ck_model_kind(model);
    const char *problem = kind->apply(model);
    model->state.stale = 0;
    if (problem) return problem;
    kind->start(model);
    if (!kind->show(model)) return no_start(model);
    model->state.shown = 1;
    return NULL;
}

/* Outputs that are no continuous numbers change in event mode only, and the event a step ended for
   is applied in it. Between two events the host sees what it has seen; `latest` is what is true. */
static int holds(const ck_model *model) {
    return model->event_mode && model->state.phase == CK_STEPPING;
}

static int show(ck_model *model) {
    double seen[CK_DISCRETE];
    int fine;
    ck_events_lift(model, seen);
    fine = ck_model_kind(model)->show(model);
    ck_events_hold(model, seen);
    return fine;
}

/* Make the outputs that nobody has read yet. */
void ck_model_follow(ck_model *model) {
    ck_state *state = &model->state;
    const ck_kind *kind = ck_model_kind(model);
    if (state->stale) {
        const char *problem = NULL;
        if (!state->failed && state->phase == CK_INITIALIZATION) problem = ck_model_prepare(model);
        /* a tool may be half way through its parameters */
        if (problem) model->say(model->host, CK_WARNING, "logStatusWarning", problem);
    }
    if (state->shown || state->phase < CK_STEPPING || (state->failed && kind->follows)) return;
    state->shown = 1;
    if (show(model)) return;
    if (holds(model) && model->exchanges) state->shown = 0; /* for a shorter step of the host */
    else
        ck_model_fail(model, "the forces there are no finite numbers; reset the FMU, or go back "
                             "to an earlier state");
}

int ck_model_get(ck_model *model, unsigned reference, int types, double *value) {
    const ck_variable *port = ck_model_variable(model, reference, types, "get");
    if (!port) return CK_ERROR;
    if (model->state.stale || !model->state.shown) ck_model_follow(model);
    *value = model->state.values[port->id];
    if (model->exchanges && !model->state.shown && model->state.phase == CK_STEPPING && !model->state.failed)
        return ck_model_discard(model, "the forces there are no finite numbers; take a shorter step");
    return CK_OK;
}

/* Take the tolerance of the host for `rtol`, unless that was set; 0: there is none. */
static void take_tolerance(ck_model *model, double tolerance) {
    const ck_variable *port = NULL;
    double *rtol = &model->state.values[CK_RTOL];
    int i;
    for (i = 0; i < model->data.contents.n_variables; i++)
        if (model->data.contents.variables[i].id == CK_RTOL) port = &model->data.contents.variables[i];
    if (!port || tolerance == 0.0 || model->state.has_rtol) return;
    *rtol = ck_smaller(ck_larger(tolerance, port->low), port->high);
    if (*rtol != tolerance) {
        char message[200];
        snprintf(message, sizeof message,
                 "the tolerance of the experiment, %g, is none that rtol may have: %g is taken",
                 tolerance, *rtol);
        model->say(model->host, CK_WARNING, "logStatusWarning", message);
    }
}

int ck_model_rate(ck_model *model, unsigned reference, int order, double *value) {
    const ck_variable *port = ck_model_variable(model, reference, CK_REAL, "derivative of an output");
    const ck_kind *kind = ck_model_kind(model);
    char message[200];
    if (!port) return CK_ERROR;
    if (order == 1 && port->causality == CK_OUTPUT && kind->rate && kind->rate(model, port->id, value))
        return CK_OK;
    snprintf(message, sizeof message,
             "there is no derivative of order %d of %s; go on without it", order, ck_names[port->id]);
    return ck_model_discard(model, message);
}

int ck_model_setup(ck_model *model, double start_time, const double *stop_time,
                   const double *tolerance) {
    if (!isfinite(start_time))
        return ck_model_fail(model, "the start time must be finite [s]; reset the FMU");
    if (stop_time && !(*stop_time >= start_time))
        return ck_model_fail(model, "the stop time must not come before the start time; reset the FMU");
    if (tolerance && !(*tolerance >= 0.0 && isfinite(*tolerance)))
        return ck_model_fail(model, "the tolerance must be a finite number above 0; reset the FMU");
    model->state.time = model->state.start_time = start_time;
    model->state.stop_time = stop_time ? *stop_time : HUGE_VAL;
    if (tolerance) take_tolerance(model, *tolerance);
    return CK_OK;
}

int ck_model_initialize(ck_model *model) {
    char message[300];
    const char *problem;
    if (!ck_model_is_in(model, CK_INITIALIZATION, "exitInitializationMode")) return CK_ERROR;
    if (model->state.failed) return CK_ERROR;
    problem = ck_model_prepare(model);
    if (!problem && model->exchanges) problem = ck_model_kind(model)->exchange->obstacle(model);
    if (problem) {
        snprintf(message, sizeof message, "initialization: %s; reset the FMU, then set it so",
                 problem);
        return ck_model_fail(model, message);
    }
    model->state.phase = CK_STEPPING;
    ck_events_note(model);
    return CK_OK;
}

/* Refuse a step that ends beyond the stop time. */
static int beyond_stop(ck_model *model, double end) {
    char message[300];
    snprintf(message, sizeof message,
             "a step to t = %.17g s goes beyond the stop time of the experiment, %.17g s; take a "
             "shorter one",
             end, model->state.stop_time);
    return ck_model_discard(model, message);
}

/* A step too short to be taken is put off to the next: masters end with a step of rounding size,
   even backwards. Refused if the clock of the host stands still. */
static int put_off(ck_model *model, double time, double step) {
    char message[300];
    if (time + step != time || step <= OFF * model->state.last_step) return CK_OK;
    snprintf(message, sizeof message,
             "a step of %.9g s vanishes in the round-off of the time %.17g s; take a longer one, or "
             "start the clock at 0",
             step, time);
    return ck_model_discard(model, message);
}

int ck_model_step(ck_model *model, double time, double step) {
    ck_state *state = &model->state;
    double lag = time - state->time, last = state->last_step, off = OFF * fabs(step);
    double clock = CLOCK * fabs(state->time), nothing = ck_larger(clock, REST * last), length;
    double seen[CK_DISCRETE];
    int status;
    if (model->exchanges) {
        ck_model_fail(model, "doStep is for co-simulation, this instance is for model exchange; reset it");
        return CK_DISCARD;
    }
    if (state->failed || !ck_model_is_in(model, CK_STEPPING, "doStep")) return CK_DISCARD;
    if (!(fabs(lag) <= nothing + off && isfinite(step)) || step < -ck_larger(clock, OFF * last)) {
        char message[300];
        snprintf(message, sizeof message,
                 "a step must start at t = %.17g s, where the last one ended, and go forward, got "
                 "a start of %.17g s and a length of %.17g s; to go back set an earlier FMU state, "
                 "or reset the FMU",
                 state->time, time, step);
        ck_model_fail(model, message);
        return CK_DISCARD;
    }
    if (state->event) {
        ck_model_fail(model, "the last step ended with an event: enter event mode and update the "
                             "discrete states before the next, or instantiate without event mode");
        return CK_DISCARD;
    }
    if (time + step > state->stop_time + nothing + off) return beyond_stop(model, time + step);
    /* What was put off is done with the next step; else clocks differ by their round-off. */
    length = fabs(lag) > clock ? step + lag : step;
    if (length <= nothing) return put_off(model, time, step);
    ck_events_lift(model, seen);
    state->cut = 0;
    ck_grid_keep(&model->grid);
    ck_deforming_keep(&model->deforming);
    status = ck_model_kind(model)->step(model, time, length);
    if (status != CK_OK) ck_grid_go_back(&model->grid), ck_deforming_go_back(&model->deforming);
    ck_events_hold(model, seen);
    if (status != CK_OK) return status;
    state->time = ck_model_pends(model) || state->cut ? state->end : time + step;
    state->last_step = length, state->rate = 0.0;
    if (model->event_mode) {
        ck_model_follow(model);
        state->event = ck_events_lag(model);
    }
    return state->failed ? CK_DISCARD : CK_OK;
}

/* A field is what a state has besides `ck_state`: the liquid of the cells of a grid, or the film between bodies
   that deform. */
static int field_count(const ck_model *model) {
    return model->grid.n ? model->grid.n : model->deforming.count;
}

static const double *field_of(const ck_model *model) {
    return model->grid.n ? model->grid.liquid : model->deforming.values;
}

/* Whether a field is one of this FMU. */
static int is_field(const ck_model *model, const ck_state *state, const double *field) {
    int i, any = state->motion.cavity.phase != CK_FULL || state->memory.cavity.phase != CK_FULL;
    if (!field) return 0; /* of another size */
    for (i = 0; any && i < model->grid.n; i++)
        if (!(field[i] >= 0.0 && field[i] < HUGE_VAL)) return 0;
    for (i = 0; i < model->deforming.count; i++)
        if (!isfinite(field[i])) return 0;
    return 1;
}

int ck_model_restore(ck_model *model, const ck_state *state, const double *field) {
    int count = model->data.contents.has_tables ? model->data.contents.tables.n_films : 1;
    if (state->checksum != model->data.checksum || state->phase < CK_INSTANTIATED ||
        state->phase > CK_TERMINATED || state->motion.film < 0 || state->motion.film >= count ||
        state->memory.film < 0 || state->memory.film >= count ||
        !ck_is_cavity(&state->motion.cavity) || !ck_is_cavity(&state->memory.cavity) ||
        !is_field(model, state, field))
        return ck_model_fail(model, "the FMU state is not one of this FMU; take it from this FMU, "
                                    "and keep its bytes unchanged");
    model->state = *state;
    ck_grid_put(&model->grid, field);
    ck_deforming_put(&model->deforming, field);
    if (state->phase >= CK_STEPPING) ck_model_kind(model)->apply(model);
    ck_events_skip(model);
    return CK_OK;
}

/* Event mode ----------------------------------------------------------------------------------- */

int ck_model_pends(const ck_model *model) {
    const ck_state *state = &model->state;
    return state->motion.pending || state->memory.pending || state->driven.pending;
}

void ck_events_note(ck_model *model) {
    int i;
    for (i = 0; i < CK_DISCRETE; i++) model->state.latest[i] = model->state.values[ck_discrete[i]];
}

void ck_events_lift(ck_model *model, double seen[CK_DISCRETE]) {
    int i;
    if (!holds(model)) return;
    for (i = 0; i < CK_DISCRETE; i++) {
        seen[i] = model->state.values[ck_discrete[i]];
        model->state.values[ck_discrete[i]] = model->state.latest[i];
    }
}

void ck_events_hold(ck_model *model, const double seen[CK_DISCRETE]) {
    int i;
    if (!holds(model)) return;
    ck_events_note(model);
    for (i = 0; i < CK_DISCRETE; i++) model->state.values[ck_discrete[i]] = seen[i];
}

int ck_events_lag(const ck_model *model) {
    int lags = ck_model_pends(model), i;
    for (i = 0; i < CK_DISCRETE; i++) lags |= model->state.latest[i] != model->state.values[ck_discrete[i]];
    return lags;
}

int ck_model_update(ck_model *model) {
    int i;
    if (model->state.failed || !ck_model_is_in(model, CK_EVENT, "updateDiscreteStates"))
        return CK_ERROR;
    for (i = 0; i < CK_DISCRETE; i++) model->state.values[ck_discrete[i]] = model->state.latest[i];
    if (model->exchanges) ck_model_kind(model)->exchange->apply_events(model);
    else if (ck_model_pends(model)) ck_model_kind(model)->resolve(model);
    model->state.event = model->state.shown = 0;
    ck_model_follow(model);
    ck_events_note(model);
    return model->state.failed ? CK_ERROR : CK_OK;
}

void ck_events_skip(ck_model *model) {
    int i;
    if (model->event_mode) return;
    if (model->state.phase == CK_EVENT) model->state.phase = CK_STEPPING;
    if (!model->state.event) return;
    for (i = 0; i < CK_DISCRETE; i++) model->state.values[ck_discrete[i]] = model->state.latest[i];
    if (ck_model_pends(model)) ck_model_kind(model)->resolve(model);
    model->state.event = model->state.shown = 0;
}

/* FMU states ----------------------------------------------------------------------------------- */

/* A state that a host keeps; its field of so many numbers follows it. */
typedef struct {
    int64_t count;
    ck_state state;
} ck_saved;

/* Serialized: letters and a checksum, then the state as it lies in memory, and the field. */
#define HEAD 16u

static const char NO_STATE[] = "that is no FMU state, or it was freed; take one first";

static size_t field_size(int64_t count) { return (size_t)count * sizeof(double); }

static size_t size_of(int64_t count) { return sizeof(ck_state) + field_size(count); }

/* A state the host may keep: its own if it has one of this size, else a new one. */
static ck_saved *place_for(ck_model *model, void **state) {
    ck_saved *own = (ck_saved *)ck_handle_content(CK_STATES, *state);
    int64_t count = field_count(model);
    void *handle;
    if (own && own->count == count) return own;
    own = (ck_saved *)malloc(sizeof *own + field_size(count));
    handle = own ? ck_handle_new(CK_STATES, own) : NULL;
    if (!handle) {
        free(own);
        ck_model_fail(model, "there is no room for more FMU states; free some");
        return NULL;
    }
    free(ck_handle_free(CK_STATES, *state)); /* one of another FMU */
    *state = handle;
    own->count = count;
    return own;
}

static double *kept_of(const ck_saved *saved) { return (double *)(saved + 1); }

int ck_saved_take(ck_model *model, void **state) {
    ck_saved *own;
    if (!ck_is_place(state))
        return ck_model_fail(model, "getFMUstate: give the address of a state; reset the FMU");
    own = place_for(model, state);
    if (!own) return CK_ERROR;
    own->state = model->state;
    if (own->count) memcpy(kept_of(own), field_of(model), field_size(own->count));
    return CK_OK;
}

int ck_saved_restore(ck_model *model, const void *state) {
    const ck_saved *content = (const ck_saved *)ck_handle_content(CK_STATES, state);
    if (!content) return ck_model_fail(model, NO_STATE);
    return ck_model_restore(model, &content->state,
                            content->count == field_count(model) ? kept_of(content) : NULL);
}

int ck_saved_free(void **state) {
    int is_place = ck_is_place(state);
    if (!state) return CK_OK;
    free(ck_handle_free(CK_STATES, is_place ? *state : (void *)state));
    if (is_place) *state = NULL;
    return CK_OK;
}

int ck_saved_size(ck_model *model, const void *state, size_t *size) {
    const ck_saved *content = (const ck_saved *)ck_handle_content(CK_STATES, state);
    if (!size || !content) return ck_model_fail(model, NO_STATE);
    *size = HEAD + size_of(content->count);
    return CK_OK;
}

int ck_saved_write(ck_model *model, const void *state, void *bytes, size_t size) {
    const ck_saved *content = (const ck_saved *)ck_handle_content(CK_STATES, state);
    char *to = (char *)bytes;
    uint64_t sum;
    if (!content || !to) return ck_model_fail(model, NO_STATE);
    if (size < HEAD + size_of(content->count))
        return ck_model_fail(model, "serializeFMUstate: there is too little room");
    memcpy(to + HEAD, &content->state, sizeof content->state);
    memcpy(to + HEAD + sizeof content->state, kept_of(content), field_size(content->count));
    sum = ck_checksum(to + HEAD, size_of(content->count));
    memcpy(to, "CKSTATE1", 8);
    memcpy(to + 8, &sum, 8);
    return CK_OK;
}

int ck_saved_read(ck_model *model, const void *bytes, size_t size, void **state) {
    const char *from = (const char *)bytes;
    int64_t count = field_count(model);
    ck_saved *own;
    uint64_t sum;
    if (!from || !ck_is_place(state) || size < HEAD + size_of(count) ||
        memcmp(from, "CKSTATE1", 8) != 0)
        return ck_model_fail(model, "deSerializeFMUstate: these are no bytes of an FMU state; give those that "
                                    "serializeFMUstate wrote, unchanged");
    memcpy(&sum, from + 8, 8);
    if (sum != ck_checksum(from + HEAD, size_of(count)))
        return ck_model_fail(model, "deSerializeFMUstate: the bytes were changed; give those that "
                                    "serializeFMUstate wrote");
    own = place_for(model, state);
    if (!own) return CK_ERROR;
    memcpy(&own->state, from + HEAD, sizeof own->state);
    memcpy(kept_of(own), from + HEAD + sizeof own->state, field_size(count));
    return CK_OK;
}
