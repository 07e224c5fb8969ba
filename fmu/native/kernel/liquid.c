/* The liquid at the temperature that is set: viscosity and surface tension by the laws of the scene.

   Lagrange's cubic through the four nearest of equally spaced logarithms, as
   contactkit/liquids/temperature_table.py, whose error there is measured. */

#include "model.h"

#include <math.h>
#include <stdio.h>

static double at(const double *logs, int count, double place) {
    int first = (int)place - 1;
    const double *y;
    double t;
    if (first < 0) first = 0;
    if (first > count - 4) first = count - 4;
    y = logs + first, t = place - first;
    return exp(-y[0] * (t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0 + y[1] * t * (t - 2.0) * (t - 3.0) / 2.0 -
               y[2] * t * (t - 1.0) * (t - 3.0) / 2.0 + y[3] * t * (t - 1.0) * (t - 2.0) / 6.0);
}

/* Its start value, if the FMU has the variable and another value was set. */
static const double *start_if_set(const ck_model *model, int id) {
    const ck_contents *c = &model->data.contents;
    int i;
    for (i = 0; i < c->n_variables; i++)
        if (c->variables[i].id == id)
            return c->variables[i].start == model->state.values[id] ? NULL : &c->variables[i].start;
    return NULL;
}

const char *ck_liquid(ck_model *model, double *viscosity, double *surface_tension) {
    static const int properties[] = {CK_ETA, CK_GAMMA};
    const double *v = model->state.values;
    const ck_liquid_table *table = &model->data.contents.liquid;
    double place;
    int i;
    *viscosity = v[CK_ETA], *surface_tension = v[CK_GAMMA];
    if (!model->data.contents.has_liquid || !start_if_set(model, CK_T)) return NULL;
    for (i = 0; i < 2; i++) {
        const double *start = start_if_set(model, properties[i]);
        if (!start) continue;
        snprintf(model->wrong, sizeof model->wrong,
                 "%s must stay at its start value %.9g beside T = %.9g K, from which it follows, got %.9g",
                 ck_names[properties[i]], *start, v[CK_T], v[properties[i]]);
        return model->wrong;
    }
    place = (v[CK_T] - table->low) / (table->high - table->low) * (table->n_nodes - 1);
    if (*viscosity > 0.0) *viscosity = at(table->viscosity, table->n_nodes, place);
    if (*surface_tension > 0.0) *surface_tension = at(table->surface_tension, table->n_nodes, place);
    return NULL;
}
