/* An instance of FMI 3.0, and what the files of this version share. */

#ifndef CK_FMI3_OWN_H
#define CK_FMI3_OWN_H

#include "fmi3Functions.h"

#include "handles.h"
#include "host.h"
#include "model.h"

typedef struct {
    ck_model model;
    fmi3LogMessageCallback logger;
    fmi3InstanceEnvironment environment;
    int wanted; /* categories of messages */
} ck_own;

#define OWN(instance)                                                     \
    ck_own *own = (ck_own *)ck_handle_content(CK_INSTANCES, instance);    \
    if (!own) return fmi3Error

fmi3Status ck_own_fail(ck_own *own, const char *message);
fmi3Status ck_own_lacks(ck_own *own, const char *message); /* nothing changes */

#endif
