/* The release case of an FMU in a plain host in C: is there any Python in its process?

   host_release LIBRARY RESOURCES GUID FORCE STEP END [TIME EVERY]

   prints the time of release, and how many libraries of Python the process has mapped; before that,
   if asked, gap, speed and force after every so many steps. The pull rises within a time.
   Compiled with FMI=2 or FMI=3; value references are those of stiction-mass. On Windows it is
   linked with host_windows.c, see there. */

#define _POSIX_C_SOURCE 200809L
#ifdef _WIN32
#include <windows.h>
#define dlopen(path, flags) ((void *)LoadLibraryA(path))
#define dlsym(from, name) ((void *)(size_t)GetProcAddress((HMODULE)(from), name))
#define dlerror() "the library cannot be loaded"
#else
#include <dlfcn.h>
#endif
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
#define THREE
#else
#include "fmi3FunctionTypes.h"
#define REAL(verb) "fmi3" verb "Float64"
typedef fmi3SetFloat64TYPE setter;
typedef fmi3GetFloat64TYPE getter;
#define SIZE , 1
#define THREE , 3
#endif
#define QUOTE2(x) #x
#define QUOTE(x) QUOTE2(x)

enum { F_EXT = 1, H = 3, V = 4, F = 5, T_RELEASE = 14 };

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

/* The rising pull of a magnet, in the middle of a step. */
static double pull_of(double force, double rise, double time) {
    return rise > 0.0 ? -force * expm1(-time / rise) : force;
}

int main(int count, char **words) {
    const unsigned pull = F_EXT, release = T_RELEASE, state[] = {H, V, F};
    double force, time, step_size, rise, found[3];
    setter *set;
    getter *get;
    int (*leave)(void *);
    void (*done)(void *);
    void *c;
    long i, n, every;
    if (count != 7 && count != 9) return 2;
    library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 2;
    *(void **)&set = find(REAL("Set")), *(void **)&get = find(REAL("Get"));
    *(void **)&leave = find("fmi" QUOTE(FMI) "ExitInitializationMode");
    *(void **)&done = find("fmi" QUOTE(FMI) "FreeInstance");
    c = start(words[3], words[2]);
    step_size = atof(words[5]);
    rise = count > 7 ? atof(words[7]) : 0.0, every = count > 7 ? atol(words[8]) : 0;
    force = pull_of(atof(words[4]), rise, 0.5 * step_size);
    check(set(c, &pull, 1, &force SIZE), "set");
    check(leave(c), "leave initialization");
    n = lround(atof(words[6]) / step_size);
    for (i = 0; i < n; i++) {
        force = pull_of(atof(words[4]), rise, ((double)i + 0.5) * step_size);
        if (rise > 0.0) check(set(c, &pull, 1, &force SIZE), "set");
        check(step(c, (double)i * step_size, step_size), "step");
        if (every == 0 || (i + 1) % every) continue;
        check(get(c, state, 3, found THREE), "get");
        printf("%.17g %.17g %.17g\n", found[0], found[1], found[2]);
    }
    check(get(c, &release, 1, &time SIZE), "get");
    printf("%.17g %d\n", time, pythons());
    done(c);
    return 0;
}
