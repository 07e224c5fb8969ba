/* Directional derivatives: exact where the tables are, differences elsewhere.

   While stepping, no output of stiction-mass follows an input. Of stiction-force, F, F_m and F_v
   by gap and speed are read off the tables; c, k and H_stable, slopes themselves, are differences.
   Those of valve-drive and contact-stop by gap and speed follow from their laws; of deforming-force that of
   F over the last step is solved along with it. Before the first step outputs follow
   the parameters too, through all that is prepared from them: differences. Nothing here is
   remembered as a failure. */

#include "model.h"

#include <math.h>
#include <stdio.h>

/* Of a value, by which it is moved: of a central difference the cube root of round-off, where what the
   third derivative leaves (1e-10) and what cancels (1e-11) are alike. */
#define STEP 1e-5

static int refuse(ck_model *model, int unknown, int known, const char *why) {
    char message[300];
    snprintf(message, sizeof message, "getDirectionalDerivative: of %s by %s: %s", ck_names[unknown],
             ck_names[known], why);
    model->say(model->host, CK_ERROR, "logStatusError", message);
    return CK_ERROR;
}

/* An output with one value moved; 0 where that value cannot be. */
static int moved(ck_model *model, int unknown, const ck_variable *known, double at, double *found) {
    ck_state saved = model->state;
    int fine = known->low <= at && at <= known->high;
    model->state.values[known->id] = at;
    if (fine && saved.phase == CK_INITIALIZATION) fine = ck_model_prepare(model) == NULL;
    else if (fine) fine = ck_model_kind(model)->show(model);
    *found = model->state.values[unknown];
    model->state = saved;
    return fine;
}

static int difference(ck_model *model, int unknown, const ck_variable *known, double *slope) {
    double at = model->state.values[known->id], step = STEP * (at != 0.0 ? fabs(at) : 1.0);
    double up, down, high = at + step, low = at - step;
    if (!moved(model, unknown, known, high, &up)) {
        high = at;
        if (!moved(model, unknown, known, high, &up)) return 0;
    }
    if (!moved(model, unknown, known, low, &down)) {
        low = at;
        if (low == high || !moved(model, unknown, known, low, &down)) return 0;
    }
    *slope = (up - down) / (high - low);
    return isfinite(*slope);
}

/* Slope of one output by one value. */
static int one(ck_model *model, int unknown, const ck_variable *known, double *slope) {
    const ck_kind *kind = ck_model_kind(model);
    int starts = model->state.phase == CK_INITIALIZATION, id = known->id, done;
    *slope = 0.0;
    if (model->exchanges && (ck_exchange_has_state(model, id) || ck_exchange_has_state(model, unknown))) {
        *slope = unknown == id; /* a state follows itself alone, and nothing else follows it */
        return CK_OK;
    }
    if (known->causality == CK_OUTPUT) return refuse(model, unknown, id, "that is an output, too");
    if (known->causality == CK_PARAMETER && !starts)
        return refuse(model, unknown, id, "a parameter does not change any more");
    if (known->causality == CK_INPUT && kind->slope && kind->slope(model, unknown, id, slope)) return CK_OK;
    if (known->causality == CK_INPUT && !kind->follows) return CK_OK;
    if (unknown == CK_U && id >= CK_T_DELAY && id <= CK_T_BOOST && id != CK_U_BOOST)
        return refuse(model, unknown, id, "the voltage jumps in time, which has no slope");
    if ((id == CK_H_BREAK || id == CK_DP_CAV || id == CK_DP_INCEPTION || id == CK_DP_HOLD ||
         id == CK_TAU_LIM || id == CK_B_SAT) &&
        model->state.values[id] == 0.0)
        return refuse(model, unknown, id, "0 stands for none there, which has no slope");
    done = difference(model, unknown, known, slope);
    if (starts) kind->apply(model); /* back to the parameters that are set */
    return done ? CK_OK : refuse(model, unknown, id, "there is no difference to take; correct the "
                                                     "parameters first");
}

int ck_model_derivative(ck_model *model, const unsigned unknown[], size_t n,
                        const unsigned known[], size_t m, const double seed[], double value[]) {
    static const char call[] = "getDirectionalDerivative";
    size_t i, k;
    if (model->state.failed) return CK_ERROR;
    ck_model_follow(model);
    for (i = 0; i < n; i++) {
        const ck_variable *of = ck_model_variable(model, unknown[i], CK_REAL, call), *by;
        double sum = 0.0, slope;
        if (!of) return CK_ERROR;
        for (k = 0; k < m; k++) {
            if (!(by = ck_model_variable(model, known[k], CK_REAL, call))) return CK_ERROR;
            if (of->causality != CK_OUTPUT) return refuse(model, of->id, by->id, "the first is no output");
            if (one(model, of->id, by, &slope) != CK_OK) return CK_ERROR;
            sum += seed[k] * slope;
        }
        value[i] = sum;
    }
    return CK_OK;
}
