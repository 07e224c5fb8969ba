/* The model behind both versions of FMI: its variables, its phases, what it refuses.

   The first failure is logged with its cure and remembered: outputs stay at their last good values
   and steps are discarded, until the host resets the model or restores an earlier state. */

#ifndef CK_MODEL_H
#define CK_MODEL_H

#include "motion.h"

#include <stdint.h>

enum { CK_REAL = 0, CK_INTEGER = 1 };
enum { CK_INPUT = 0, CK_OUTPUT = 1, CK_PARAMETER = 2 };
enum { CK_INSTANTIATED = 0, CK_INITIALIZATION = 1, CK_STEPPING = 2, CK_TERMINATED = 3 };
enum { CK_OK = 0, CK_WARNING = 1, CK_DISCARD = 2, CK_ERROR = 3 }; /* as in FMI 2 and 3 */

/* Every variable there may be; fmu/native_ports.py has the same list in the same order. */
enum {
    CK_F_EXT, CK_DF_EXT,
    CK_H, CK_V, CK_F, CK_F_M, CK_F_V, CK_J, CK_J_M, CK_W, CK_STATE, CK_LIMIT, CK_T_BREAK,
    CK_T_RELEASE, CK_F_PEAK, CK_N_BREAK, CK_N_RELEASE,
    CK_M, CK_H0, CK_V0, CK_K_S, CK_H_REL, CK_H_MIN, CK_H_BREAK, CK_ETA, CK_GAMMA, CK_DP_CAV,
    CK_TAU_LIM, CK_RTOL,
    CK_VARIABLES
};

typedef struct {
    int id, type, causality;
    double low, high, start;
} ck_port;

/* What the file of an FMU holds; the tables point into `numbers`. */
typedef struct {
    char guid[40];
    uint64_t checksum;
    int port_count;
    ck_port ports[CK_VARIABLES];
    ck_scene scene;
    double *numbers;
    int hints[CK_FILMS * (CK_LAWS + 1) * CK_PIECES];
} ck_data;

/* Everything that changes, in one piece without pointers. */
typedef struct {
    uint64_t checksum; /* of the data it belongs to */
    double values[CK_VARIABLES];
    double time, start_time, last_step, rate;
    ck_motion motion;
    int phase, failed, stale, stopped;
} ck_state;

typedef void (*ck_say)(void *host, int status, const char *category, const char *message);

typedef struct {
    ck_data data;
    ck_scene scene; /* that of the data with the parameters in */
    ck_state state;
    ck_say say;
    void *host;
} ck_model;

/* Reading the file (data.c); the message says what is wrong with it, NULL if nothing is. */
const char *ck_data_read(const char *path, ck_data *data);
uint64_t ck_checksum(const void *bytes, size_t count);

int ck_model_open(ck_model *model, const char *resources, const char *guid);
void ck_model_close(ck_model *model);
void ck_model_reset(ck_model *model);
int ck_model_fail(ck_model *model, const char *message);
int ck_model_is_in(ck_model *model, int phase, const char *call);
const ck_port *ck_model_port(ck_model *model, unsigned reference, int type, const char *call);
int ck_model_set(ck_model *model, unsigned reference, int type, double value);
int ck_model_get(ck_model *model, unsigned reference, int type, double *value);
int ck_model_setup(ck_model *model, double start_time);
int ck_model_initialize(ck_model *model);
int ck_model_step(ck_model *model, double time, double step);
int ck_model_restore(ck_model *model, const ck_state *state);
const char *ck_name(int id);

#endif
