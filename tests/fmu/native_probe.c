/* Forces of the kernel at gaps and speeds read from standard input, one pair to a line:

   native_probe FOLDER_OF_RESOURCES VISCOSITY SURFACE_TENSION TENSION STRENGTH */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int count, char **words) {
    static ck_data data;
    static ck_scene scene;
    ck_acting acting;
    double gap, speed;
    char path[1000];
    const char *problem;
    if (count != 6) return 2;
    snprintf(path, sizeof path, "%s/film.bin", words[1]);
    problem = ck_data_read(path, &data);
    if (problem) {
        fprintf(stderr, "%s\n", problem);
        free(data.numbers);
        return 1;
    }
    scene.tables = &data.contents.tables;
    scene.viscosity = atof(words[2]), scene.surface_tension = atof(words[3]);
    scene.tension = atof(words[4]), scene.strength = atof(words[5]);
    scene.initial_gap = 1.0;
    scene.ends[0] = scene.tables->films[0].end;
    ck_act(&scene, 0, 0, 0, &acting);
    while (scanf("%lf %lf", &gap, &speed) == 2) {
        ck_forces f;
        ck_forces_at(&acting, gap, speed, &f);
        printf("%.17g %.17g %.17g %.17g %.17g %d\n", f.fixed, f.fixed_by_gap, f.viscous,
               f.viscous_by_gap, f.viscous_by_speed, f.limit);
    }
    free(data.numbers);
    return 0;
}
