/* A film on a grid, told what to do from standard input, one order to a line:

   native_grid FOLDER_OF_RESOURCES VISCOSITY DROP

   f GAP                    the liquid fills a gap
   h FROM GAP SPEED         force, its slopes by gap and speed, area of the cavity
   s START DT GAP GAP GAP   voids at the stages, error; what a whole step gains of liquid, and lets in
   k GAP                    keep the liquid after that step: the void */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ck_data data;
static ck_grid_film film;

/* Liquid that the whole step has gained, and what has come over the rim. */
static void balance(double start, double end, double dt, double *gained, double *inflow) {
    const ck_cells *c = &data.contents.tables.grid.cells;
    int i;
    *gained = *inflow = 0.0;
    for (i = 0; i < film.n; i++) {
        double h0 = start + c->relief[i], h1 = end + c->relief[i], ratio = h1 / end;
        double was = fmin(film.liquid[i] / h0, 1.0), now = film.fraction[i];
        double growth = c->area[i] * (h1 - was * h0) / dt;
        *gained += now * (c->area[i] * h1 + c->extra[i]) - was * (c->area[i] * h0 + c->extra[i]);
        *inflow -= dt * c->rim[i] * ratio * ratio * ratio * film.pressure[i];
        if (was >= 1.0 - 1e-12) *inflow += dt * c->excess[i] * growth;
    }
}

int main(int count, char **words) {
    char path[1000], order;
    const char *problem;
    ck_grid_liquid liquid;
    ck_grid_force f;
    double a, b, c, gaps[3];
    if (count != 4) return 2;
    liquid.viscosity = atof(words[2]), liquid.drop = atof(words[3]);
    snprintf(path, sizeof path, "%s/film.bin", words[1]);
    problem = ck_data_read(path, &data);
    if (!problem) problem = ck_grid_open(&film, &data.contents.tables.grid);
    if (problem) printf("%s\n", problem);
    while (!problem && scanf(" %c", &order) == 1) {
        int fine = 1;
        if (order == 'f' && scanf("%lf", &a) == 1) {
            ck_grid_fill(&film, a);
            printf("%d\n", film.n);
        } else if (order == 'h' && scanf("%lf %lf %lf", &a, &b, &c) == 3) {
            fine = ck_grid_held(&film, liquid, a, b, c, &f);
            printf("%.17g %.17g %.17g %.17g\n", f.force, f.by_gap, f.by_speed, f.area);
        } else if (order == 's' &&
                   scanf("%lf %lf %lf %lf %lf", &a, &b, &gaps[0], &gaps[1], &gaps[2]) == 5) {
            double gained, inflow;
            fine = ck_grid_step(&film, liquid, a, b, gaps);
            balance(a, gaps[2], b, &gained, &inflow);
            printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", film.hollow[0], film.hollow[1],
                   film.hollow[2], film.error, gained, inflow);
        } else if (order == 'k' && scanf("%lf", &a) == 1) {
            printf("%.17g\n", ck_grid_after(&film, a));
        } else {
            fine = 0;
        }
        if (!fine) problem = "no solution";
    }
    ck_grid_close(&film);
    free(data.numbers), free(data.cells);
    return problem != NULL;
}
