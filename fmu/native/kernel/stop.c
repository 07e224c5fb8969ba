/* contact-stop: rough faces that meet at an end stop, for a tool that owns the mass; motion in,
   force out.

   As fmu/slaves/contact_stop.py. The gap that was set when a step is taken is where the step ends. */

#include "model.h"

#include <math.h>
#include <stdio.h>


/* What the faces answer to the gap and the speed that are set. */
typedef struct {
    double depth, approach; /* of the bodies, and of the faces alone */
    double elastic, gain, stiffness, area, plastic;
    int branch;
} answer;

static double side(const ck_model *model) {
    return model->state.values[CK_SIDE] == CK_STOP_SIDE_ABOVE ? 1.0 : -1.0;
}

static answer look_up(const ck_model *model) {
    const double *v = model->state.values;
    const ck_faces *faces = &model->data.contents.faces;
    double largest = model->state.stopped.largest, scale = v[CK_SCALE];
    answer a;
    ck_pressed pressed;
    ck_touching touching;
    a.depth = side(model) * (v[CK_H] - v[CK_H_TOUCH]);
    a.gain = ck_larger(1.0 + v[CK_D_STOP] * side(model) * v[CK_V], 0.0);
    pressed = ck_faces_pressed(faces, a.depth, largest, v[CK_K_BODY] / scale);
    touching = ck_faces_touching(faces, &pressed, largest);
    a.approach = pressed.approach, a.branch = touching.branch;
    a.elastic = scale * pressed.force, a.stiffness = scale * pressed.slope;
    a.area = scale * touching.area, a.plastic = scale * touching.plastic;
    return a;
}

static const char *apply(ck_model *model) {
    double most = model->data.contents.faces.first.end;
    if (model->state.values[CK_D_MAX0] <= most) return NULL;
    snprintf(model->wrong, sizeof model->wrong,
             "d_max0 must not exceed %.6g m, where the tables end, got %.9g m", most,
             model->state.values[CK_D_MAX0]);
    return model->wrong;
}

/* Where the faces are, for the next step. */
static void keep(ck_stopped *now, const answer *a) {
    now->depth = ck_larger(a->depth, 0.0);
    now->damping = a->elastic * (a->gain - 1.0);
    now->beyond = a->branch == CK_BRANCH_BEYOND;
}

static void remember(ck_model *model) {
    double *v = model->state.values, largest = model->state.stopped.largest;
    const ck_faces *faces = &model->data.contents.faces;
    v[CK_D_MAX] = largest, v[CK_D_RES] = ck_faces_residual(faces, largest);
    v[CK_W] = ck_faces_dissipated(faces, largest) - ck_faces_dissipated(faces, v[CK_D_MAX0]);
    v[CK_W] *= v[CK_SCALE];
}

static void start(ck_model *model) {
    double *v = model->state.values;
    answer a;
    model->state.stopped.largest = v[CK_D_MAX0];
    v[CK_W_D] = v[CK_N_BEYOND] = 0.0;
    a = look_up(model);
    keep(&model->state.stopped, &a);
    remember(model);
}

static int show(ck_model *model) {
    double *v = model->state.values;
    answer a = look_up(model);
    double damping = a.gain > 0.0 ? a.elastic * v[CK_D_STOP] : 0.0;
    if (!isfinite(a.elastic * a.gain) || !isfinite(a.stiffness + damping) || !isfinite(a.approach))
        return 0;
    v[CK_F_EL] = a.elastic, v[CK_F] = a.elastic * a.gain, v[CK_K] = a.stiffness, v[CK_C] = damping;
    v[CK_CONTACT_AREA] = a.area, v[CK_PLASTIC_AREA] = a.plastic;
    v[CK_D] = a.approach, v[CK_STATE] = a.branch;
    return 1;
}

static void warn(ck_model *model, double approach, double time) {
    char message[400];
    snprintf(message, sizeof message,
             "the faces are pressed by %.4g m at t = %.9g s, beyond %.4g m where their tables end: "
             "the force goes on along its tangent; build the FMU with larger loads",
             approach, time, model->data.contents.faces.first.end);
    model->say(model->host, CK_WARNING, "logStatusWarning", message);
}

static int step(ck_model *model, double time, double length) {
    ck_state *state = &model->state, before = *state;
    ck_stopped *now = &state->stopped;
    double *v = state->values;
    answer a = look_up(model);
    int fine = show(model);
    keep(now, &a);
    now->largest = ck_larger(now->largest, ck_smaller(a.approach, model->data.contents.faces.first.end));
    if (now->largest > before.stopped.largest) remember(model);
    v[CK_W_D] += 0.5 * (before.stopped.damping + now->damping) * (now->depth - before.stopped.depth);
    v[CK_N_BEYOND] += now->beyond;
    state->end = time + length, state->shown = 1;
    if (!fine || !isfinite(v[CK_W_D] + v[CK_W])) {
        *state = before;
        return ck_model_discard(model, "the forces there are no finite numbers; give a gap nearer to "
                                       "h_touch, or a smaller speed");
    }
    if (now->beyond && !before.stopped.beyond) warn(model, a.approach, state->end);
    return CK_OK;
}

static void resolve(ck_model *model) { (void)model; } /* a step does not pause */

/* Slopes at the gap and the speed that are set. */
static int slope(const ck_model *model, int unknown, int known, double *found) {
    answer a = look_up(model);
    *found = 0.0;
    if (known == CK_V) { /* of the others none follows the speed */
        if (unknown == CK_F && a.gain > 0.0)
            *found = side(model) * a.elastic * model->state.values[CK_D_STOP];
        return 1;
    }
    if (known != CK_H || (unknown != CK_F && unknown != CK_F_EL)) return 0;
    *found = side(model) * a.stiffness * (unknown == CK_F ? a.gain : 1.0);
    return 1;
}

const ck_kind ck_contact_stop = {apply, start, show, step, resolve, 1, slope, NULL, NULL};
