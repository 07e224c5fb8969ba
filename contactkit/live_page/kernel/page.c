/* The kernel as a page in a browser calls it: numbers of a scene in, its curve out, no files.

   ck_page_room, then the numbers there, then ck_page_open; parameters by their value references, then
   ck_page_start, then ck_page_step until it returns no CK_PAGE_GOES_ON, or ck_page_at at any gap. Each
   of these leaves rows of numbers. What goes wrong says ck_page_said. */

#include "page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 11 + CK_MOST_LAWS, BETWEEN = 4 };

/* Fraction of a step before the event at its end, as in motion_curves.py. */
#define JUST (1.0 - 1e-6)
/* A pull that rises is followed by parabolas over this fraction of its rise time: 1e-6 of the pull. */
#define RISE (1.0 / 32.0)
#define RISEN 40.0 /* rise times after which nothing of it is left */

/* Time, gap, speed, pull, force of the film, that at rest, the viscous one, limit that acts, radius of
   the cavity, state of the film, viscous force without limits, and the force of each law. */
static double rows[BETWEEN + 1][COLUMNS];
static int n_rows;
static double force, rise_time, time_limit;
static char said[600];
ck_model ck_page_model;

void ck_page_say(void *host, int status, const char *category, const char *message) {
    (void)host, (void)category;
    if (status < CK_WARNING) return;
    strncpy(said, message, sizeof said - 1);
}

double *ck_page_room_of(ck_model *model, int count) {
    ck_model_close(model);
    memset(model, 0, sizeof *model);
    model->say = ck_page_say;
    model->data.numbers = (double *)malloc((size_t)count * sizeof(double));
    return model->data.numbers;
}

int ck_page_open_of(ck_model *model, int count) {
    const char *problem = ck_data_take(&model->data, (size_t)count);
    if (!problem) problem = ck_model_made(model);
    if (problem) ck_page_say(NULL, CK_ERROR, "", problem);
    return problem == NULL;
}

int ck_page_start_of(ck_model *model) {
    int fine = ck_model_setup(model, 0.0, NULL, NULL) == CK_OK;
    model->state.phase = CK_INITIALIZATION;
    return fine && ck_model_initialize(model) == CK_OK;
}

/* Value reference of a variable; 0 if there is none. */
static unsigned reference_of(const ck_model *model, int id) {
    const ck_contents *contents = &model->data.contents;
    int i;
    for (i = 0; i < contents->n_variables; i++)
        if (contents->variables[i].id == id) return (unsigned)i + 1;
    return 0;
}

static const int ANY = CK_REAL | CK_INTEGER | CK_ENUMERATION | CK_BOOLEAN;

int ck_page_put(ck_model *model, int id, double value) {
    return ck_model_set(model, reference_of(model, id), ANY, value) == CK_OK;
}

double ck_page_read(ck_model *model, int id) {
    unsigned reference = reference_of(model, id);
    double value = 0.0;
    if (reference) ck_model_get(model, reference, ANY, &value);
    return value;
}

EXPORT(ck_page_said) const char *ck_page_said(void) { return said; }
EXPORT(ck_page_rows) const double *ck_page_rows(void) { return &rows[0][0]; }
EXPORT(ck_page_count) int ck_page_count(void) { return n_rows; }

EXPORT(ck_page_room) double *ck_page_room(int count) { return ck_page_room_of(&ck_page_model, count); }

EXPORT(ck_page_open) int ck_page_open(int count) { return ck_page_open_of(&ck_page_model, count); }

/* A motion under a pull [N] that rises as F (1 - exp(-t/rise)), or at once, up to a time [s]. */
EXPORT(ck_page_reset) void ck_page_reset(double pull, double rise, double limit) {
    force = pull, rise_time = rise, time_limit = limit;
    said[0] = 0, n_rows = 0;
    ck_model_reset(&ck_page_model);
}

EXPORT(ck_page_set) int ck_page_set(unsigned reference, double value) {
    return ck_model_set(&ck_page_model, reference, ANY, value) == CK_OK;
}

/* Latest value of an output or a parameter. */
EXPORT(ck_page_get) double ck_page_get(unsigned reference) {
    double value = NAN;
    ck_model_get(&ck_page_model, reference, ANY, &value);
    return value;
}

static double risen(double time) { return rise_time > 0.0 ? -force * expm1(-time / rise_time) : force; }

/* Force of each law; limits leave of the forces of the liquid what is not free. */
static void laws_of(const ck_acting *acting, const ck_motion *motion, const ck_forces *found, double *row) {
    double log_gap = log(motion->gap), by_gap;
    int i;
    for (i = 0; i < CK_MOST_LAWS; i++) row[i] = 0.0;
    for (i = 0; acting->any && i < acting->film->n_laws; i++) {
        const ck_law *law = &acting->film->laws[i];
        if (!acting->acts[i]) continue;
        row[i] = found->viscous - found->free * motion->speed;
        if (law->rate == CK_RATE_LIQUID) continue;
        row[i] = ck_table_at(&law->table, motion->gap, log_gap, &by_gap);
        if (law->scale == CK_SCALE_SURFACE_TENSION) row[i] *= acting->surface_tension;
        if (law->scale == CK_SCALE_VISCOSITY) row[i] *= acting->viscosity;
        if (law->rate == CK_RATE_PER_SPEED) row[i] *= motion->speed;
    }
}

static void row_of(const ck_motion *motion) {
    double *row = rows[n_rows++];
    ck_acting acting;
    ck_forces found;
    ck_spot spot;
    ck_act(&ck_page_model.scene, motion->film, motion->broken, motion->detached, &acting);
    ck_forces_of(&acting, motion, &found, &spot);
    row[0] = motion->time, row[1] = motion->gap, row[2] = motion->speed, row[3] = risen(motion->time);
    row[4] = found.fixed + found.viscous, row[5] = found.fixed, row[6] = found.viscous;
    row[7] = found.limit, row[8] = sqrt(spot.edge);
    row[9] = ck_status(&ck_page_model.scene, motion, &acting, &found, row[3]);
    row[10] = found.resistance * motion->speed;
    laws_of(&acting, motion, &found, row + 11);
}

EXPORT(ck_page_start) int ck_page_start(void) {
    int fine = ck_page_start_of(&ck_page_model);
    if (fine) row_of(&ck_page_model.state.motion);
    return fine;
}

/* The pull from a time on, as a parabola through three points of its rise; until when it holds. */
static double pull_from(double time, ck_pull *pull) {
    double length = RISE * rise_time, first = risen(time), middle, last;
    pull->force = first, pull->time = time, pull->rate = pull->bend = 0.0;
    if (!(rise_time > 0.0) || time >= RISEN * rise_time) return time_limit;
    middle = risen(time + 0.5 * length), last = risen(time + length);
    pull->rate = (4.0 * middle - 3.0 * first - last) / length;
    pull->bend = 2.0 * (first - 2.0 * middle + last) / (length * length);
    return fmin(time + length, time_limit);
}

/* Whether the pull, once risen, can never open the gap from here; as in simulate.py. */
static int is_stuck(const ck_motion *motion) {
    const ck_scene *scene = &ck_page_model.scene;
    ck_acting acting;
    double held;
    ck_act(scene, motion->film, motion->broken, motion->detached, &acting);
    if (!acting.any || motion->steps < 1 || motion->time < RISEN * rise_time) return 0;
    held = ck_fixed_force(&acting, motion->gap) + scene->stiffness * (motion->gap - scene->initial_gap);
    return risen(motion->time) <= held && motion->speed <= 0.0 && motion->gap <= scene->initial_gap;
}

/* Rows between two steps, so that lines follow the curve: parts of the step, solved again. */
static void rows_between(const ck_motion *before, const ck_pull *pull, double length) {
    static const double parts[BETWEEN] = {0.25, 0.5, 0.75, JUST};
    int i;
    for (i = 0; i < BETWEEN; i++) {
        ck_motion part = *before;
        double time = before->time + parts[i] * length;
        if (!(time > before->time)) continue;
        ck_grid_keep(&ck_page_model.grid);
        if (ck_advance(&ck_page_model.scene, &part, pull, time - before->time) == CK_DONE) row_of(&part);
        ck_grid_go_back(&ck_page_model.grid);
    }
}

/* One internal step of the motion, with rows up to its end. */
EXPORT(ck_page_step) int ck_page_step(void) {
    ck_motion *now = &ck_page_model.state.motion, before = *now, after;
    ck_pull pull;
    double end = pull_from(now->time, &pull);
    n_rows = 0;
    if (now->time >= time_limit) return CK_PAGE_LATE;
    if (is_stuck(now)) return CK_PAGE_STUCK;
    ck_grid_keep(&ck_page_model.grid);
    if (ck_internal_step(&ck_page_model.scene, now, &pull, end) != CK_DONE || !isfinite(now->gap + now->speed)) {
        *now = before;
        ck_grid_go_back(&ck_page_model.grid);
        ck_page_say(NULL, CK_ERROR, "", "no step of time can be taken from here");
        return CK_PAGE_FAILS;
    }
    ck_page_model.state.shown = 0;
    after = *now;
    if (!ck_page_model.grid.n) rows_between(&before, &pull, after.time - before.time);
    row_of(now);
    return now->releases ? CK_PAGE_RELEASED : CK_PAGE_GOES_ON;
}

/* Forces at a gap and a speed, of bodies that are opened once: a row. */
EXPORT(ck_page_at) int ck_page_at(double gap, double speed) {
    ck_motion motion = ck_page_model.state.motion;
    ck_acting acting;
    ck_act(&ck_page_model.scene, 0, 0, 0, &acting);
    motion.time = 0.0, motion.gap = gap, motion.speed = speed;
    motion.broken = gap > acting.end, motion.detached = gap > acting.release;
    n_rows = 0;
    row_of(&motion);
    return isfinite(rows[0][4]);
}

/* Gap at which the film breaks, or the laws end [m]. */
EXPORT(ck_page_end) double ck_page_end(void) {
    ck_acting acting;
    ck_act(&ck_page_model.scene, 0, 0, 0, &acting);
    return acting.end;
}

/* Peak of the force and its time; time and speed of the release; -1 before; time of the rupture. */
EXPORT(ck_page_numbers) int ck_page_numbers(void) {
    const ck_motion *motion = &ck_page_model.state.motion;
    rows[0][0] = motion->peak_force, rows[0][1] = motion->peak_time;
    rows[0][2] = motion->releases ? motion->release_time : -1.0;
    rows[0][3] = motion->releases ? motion->release_speed : 0.0;
    rows[0][4] = motion->breaks ? motion->break_time : -1.0;
    rows[0][5] = motion->work, rows[0][6] = motion->viscous_impulse, rows[0][7] = motion->fixed_impulse;
    rows[0][8] = (double)motion->steps, rows[0][9] = motion->inceptions ? motion->inception_time : -1.0;
    n_rows = 1;
    return (int)motion->steps;
}
