/* The release case of an FMU in a plain host in C: is there any Python in its process?

   host_release LIBRARY RESOURCES GUID FORCE STEP END    prints the time of release, and how many
                                                         libraries of Python the process has mapped

   Compiled with FMI=2 or FMI=3; value references are those of stiction-mass. */

#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if FMI == 2
#include "fmi2FunctionTypes.h"
#define REAL(verb) "fmi2" verb "Real"
typedef fmi2SetRealTYPE setter;
typedef fmi2GetRealTYPE getter;
#define SIZE
#else
#include "fmi3FunctionTypes.h"
#define REAL(verb) "fmi3" verb "Float64"
typedef fmi3SetFloat64TYPE setter;
typedef fmi3GetFloat64TYPE getter;
#define SIZE , 1
#endif
#define TEXT2(x) #x
#define TEXT(x) TEXT2(x)

enum { F_EXT = 1, T_RELEASE = 14 };

static void *library;

static void *find(const char *name) {
    void *found = dlsym(library, name);
    if (!found) fprintf(stderr, "there is no %s\n", name), exit(3);
    return found;
}

static void check(int status, const char *what) {
    if (status) fprintf(stderr, "%s: status %d\n", what, status), exit(4);
}

#if FMI == 2
static void hear(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status,
                 fmi2String category, fmi2String message, ...) {
    (void)e, (void)name, (void)status;
    fprintf(stderr, "%s: %s\n", category ? category : "", message);
}

static const fmi2CallbackFunctions CALLBACKS = {hear, calloc, free, NULL, NULL};

static void *start(const char *guid, const char *folder) {
    fmi2InstantiateTYPE *instantiate;
    fmi2SetupExperimentTYPE *setup;
    fmi2EnterInitializationModeTYPE *enter;
    void *c;
    *(void **)&instantiate = find("fmi2Instantiate");
    *(void **)&setup = find("fmi2SetupExperiment");
    *(void **)&enter = find("fmi2EnterInitializationMode");
    c = instantiate("one", fmi2CoSimulation, guid, folder, &CALLBACKS, fmi2False, fmi2True);
    if (!c) exit(5);
    check(setup(c, 0, 0.0, 0.0, 0, 0.0), "setup");
    check(enter(c), "enter");
    return c;
}

static int step(void *c, double time, double length) {
    fmi2DoStepTYPE *go;
    *(void **)&go = find("fmi2DoStep");
    return go(c, time, length, fmi2True);
}
#else
static void hear(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category,
                 fmi3String message) {
    (void)e, (void)status;
    fprintf(stderr, "%s: %s\n", category ? category : "", message);
}

static void *start(const char *guid, const char *folder) {
    fmi3InstantiateCoSimulationTYPE *instantiate;
    fmi3EnterInitializationModeTYPE *enter;
    void *c;
    *(void **)&instantiate = find("fmi3InstantiateCoSimulation");
    *(void **)&enter = find("fmi3EnterInitializationMode");
    c = instantiate("one", guid, folder, false, true, false, false, NULL, 0, NULL, hear, NULL);
    if (!c) exit(5);
    check(enter(c, false, 0.0, 0.0, false, 0.0), "enter");
    return c;
}

static int step(void *c, double time, double length) {
    fmi3DoStepTYPE *go;
    bool event, end, early;
    double last;
    *(void **)&go = find("fmi3DoStep");
    return go(c, time, length, true, &event, &end, &early, &last);
}
#endif

static int pythons(void) {
    char line[5000];
    int found = 0;
    FILE *maps = fopen("/proc/self/maps", "r");
    if (!maps) return -1;
    while (fgets(line, sizeof line, maps)) found += strstr(line, "/libpython") != NULL;
    fclose(maps);
    return found;
}

int main(int count, char **words) {
    const unsigned pull = F_EXT, release = T_RELEASE;
    double force, time;
    setter *set;
    getter *get;
    int (*leave)(void *);
    void (*done)(void *);
    void *c;
    long i, n;
    if (count != 7) return 2;
    library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 2;
    *(void **)&set = find(REAL("Set")), *(void **)&get = find(REAL("Get"));
    *(void **)&leave = find("fmi" TEXT(FMI) "ExitInitializationMode");
    *(void **)&done = find("fmi" TEXT(FMI) "FreeInstance");
    c = start(words[3], words[2]);
    force = atof(words[4]);
    check(set(c, &pull, 1, &force SIZE), "set");
    check(leave(c), "leave initialization");
    n = lround(atof(words[6]) / atof(words[5]));
    for (i = 0; i < n; i++) check(step(c, (double)i * atof(words[5]), atof(words[5])), "step");
    check(get(c, &release, 1, &time SIZE), "get");
    printf("%.17g %d\n", time, pythons());
    done(c);
    return 0;
}
