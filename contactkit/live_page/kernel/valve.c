/* The valve of a fuel injector as a page calls it: valve-drive and stiction-mass, coupled step by step
   as fmu/master/injector.py couples these FMUs, by Gauss-Seidel with the film last.

   The mass is the model of page.c, opened and set there; the drive is opened and set here. Then
   ck_valve_start, then ck_valve_run until it returns no CK_PAGE_GOES_ON. */

#include "page.h"

#include <math.h>

enum { VALVE_COLUMNS = 13, MOST_ROWS = 64 };

/* Time, gap, speed, pull that is left for the film, force of the film, that at rest, the viscous one,
   forces of magnet, spring and stop, current, radius of the cavity, state of the film. */
static double rows[MOST_ROWS][VALVE_COLUMNS];
static int n_rows;
static ck_model drive;
static double begun; /* steps so far */

EXPORT(ck_valve_rows) const double *ck_valve_rows(void) { return &rows[0][0]; }
EXPORT(ck_valve_count) int ck_valve_count(void) { return n_rows; }
EXPORT(ck_valve_room) double *ck_valve_room(int count) { return ck_page_room_of(&drive, count); }
EXPORT(ck_valve_open) int ck_valve_open(int count) { return ck_page_open_of(&drive, count); }
EXPORT(ck_valve_reset) void ck_valve_reset(void) { ck_model_reset(&drive); }

EXPORT(ck_valve_set) int ck_valve_set(unsigned reference, double value) {
    return ck_model_set(&drive, reference, CK_REAL | CK_INTEGER, value) == CK_OK;
}

static void row_at(double time) {
    static const int of_mass[] = {CK_H, CK_V, CK_F, CK_F_M, CK_F_V, CK_R_CAV, CK_STATE};
    static const int at_mass[] = {1, 2, 4, 5, 6, 11, 12};
    static const int of_drive[] = {CK_F_EXT, CK_F_MAG, CK_F_SPRING, CK_F_STOP, CK_I};
    static const int at_drive[] = {3, 7, 8, 9, 10};
    double *row = rows[n_rows++];
    int i;
    row[0] = time;
    for (i = 0; i < 7; i++) row[at_mass[i]] = ck_page_read(&ck_page_model, of_mass[i]);
    for (i = 0; i < 5; i++) row[at_drive[i]] = ck_page_read(&drive, of_drive[i]);
}

/* The drive at the gap and the speed of the mass; the pull there. */
static int follow(double *pull) {
    int fine = ck_page_put(&drive, CK_H, ck_page_read(&ck_page_model, CK_H));
    fine = fine && ck_page_put(&drive, CK_V, ck_page_read(&ck_page_model, CK_V));
    *pull = ck_page_read(&drive, CK_F_EXT);
    return fine;
}

/* Longest step with which the stop can be coupled to the mass; as _longest of the master. */
EXPORT(ck_valve_longest) double ck_valve_longest(void) {
    return 2.0 * sqrt(ck_page_read(&ck_page_model, CK_M) / ck_page_read(&drive, CK_K_STOP));
}

EXPORT(ck_valve_start) int ck_valve_start(void) {
    double pull;
    begun = 0.0, n_rows = 0;
    if (!ck_page_start_of(&ck_page_model) || !ck_page_start_of(&drive) || !follow(&pull)) return 0;
    row_at(0.0);
    return 1;
}

/* One communication step: the drive goes on at the speed of the gap, the mass under the straight line
   that its pull was. */
static int step(double time, double length) {
    double pull;
    int fine = follow(&pull) && ck_model_step(&drive, time, length) == CK_OK;
    fine = fine && ck_page_put(&ck_page_model, CK_F_EXT, pull);
    fine = fine && ck_page_put(&ck_page_model, CK_DF_EXT, ck_page_read(&drive, CK_DF_EXT));
    return fine && ck_model_step(&ck_page_model, time, length) == CK_OK && follow(&pull);
}

/* Steps of a length up to an end, or to the first release; rows of some of them. */
EXPORT(ck_valve_run) int ck_valve_run(double length, double end, int until_release) {
    const ck_motion *motion = &ck_page_model.state.motion;
    n_rows = 0;
    while (n_rows < MOST_ROWS) {
        double time = begun * length;
        if (time >= end - 0.5 * length) return CK_PAGE_LATE;
        if (!step(time, length)) return CK_PAGE_FAILS;
        begun += 1.0;
        row_at(begun * length);
        if (until_release && motion->releases) return CK_PAGE_RELEASED;
    }
    return CK_PAGE_GOES_ON;
}
