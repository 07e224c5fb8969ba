/* Nanoseconds that a step of a native stiction-mass takes in a host in C, and what it did in them;
   or of a native valve-drive, whose gap PULL then is, and which has no film to evaluate.

   native_speed FOLDER_OF_RESOURCES GUID PULL STEP COUNT ROUNDS

   The kernel is linked to it, so that its counters can be read. Each round is a motion of COUNT
   steps from the start; printed are nanoseconds of doStep, and of set, doStep and get, both the
   best of all rounds; then internal steps, iterations and evaluations of the forces per step (one
   of them by the get), and the gap at the end. */

#define _POSIX_C_SOURCE 200809L
#include "fmi2Functions.h"
#include "motion.h"
#include "model.h"
#include "host.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static long evaluations;

void __real_ck_forces_at(const ck_acting *a, double gap, double speed, ck_forces *found);
void __wrap_ck_forces_at(const ck_acting *a, double gap, double speed, ck_forces *found);
void __wrap_ck_forces_at(const ck_acting *a, double gap, double speed, ck_forces *found) {
    evaluations++;
    __real_ck_forces_at(a, gap, speed, found);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static double go(fmi2Component c, double pull, double step, long count, int exchanges) {
    const fmi2ValueReference in = 1, out = 3;
    fmi2Real gap;
    double begin;
    long i;
    fmi2Reset(c);
    fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
    fmi2EnterInitializationMode(c);
    fmi2ExitInitializationMode(c);
    fmi2SetReal(c, &in, 1, &pull);
    evaluations = 0;
    begin = now();
    for (i = 0; i < count; i++) {
        if (exchanges) fmi2SetReal(c, &in, 1, &pull);
        if (fmi2DoStep(c, (double)i * step, step, fmi2True) != fmi2OK) exit(3);
        if (exchanges) fmi2GetReal(c, &out, 1, &gap);
    }
    return (now() - begin) / (double)count;
}

int main(int count, char **words) {
    fmi2Component c;
    const ck_model *model;
    double best[2] = {1e300, 1e300}, pull, step;
    long steps, i, k;
    if (count != 7) return 2;
    pull = atof(words[3]), step = atof(words[4]), steps = atol(words[5]);
    c = fmi2Instantiate("one", fmi2CoSimulation, words[2], words[1], NULL, 0, 0);
    if (!c) return 2;
    model = (const ck_model *)ck_handle_content(CK_INSTANCES, c);
    for (i = 0; i < atol(words[6]); i++)
        for (k = 0; k < 2; k++) {
            double one = go(c, pull, step, steps, (int)k);
            if (one < best[k]) best[k] = one;
        }
    printf("%.1f %.1f %.4f %.4f %.4f %.17g\n", best[0], best[1],
           (double)model->state.motion.steps / (double)steps,
           (double)model->state.motion.iterations / (double)steps,
           (double)evaluations / (double)steps, model->state.motion.gap);
    fmi2FreeInstance(c);
    return 0;
}
