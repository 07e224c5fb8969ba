/* What the entry points of pages share: the model of a film or a tip, its rows, and what it said. */

#ifndef CK_PAGE_H
#define CK_PAGE_H

#include "model.h"

#define EXPORT(name) __attribute__((export_name(#name)))

enum { CK_PAGE_FAILS = -1, CK_PAGE_GOES_ON = 0, CK_PAGE_RELEASED = 1, CK_PAGE_STUCK = 2, CK_PAGE_LATE = 3 };

extern ck_model ck_page_model;

/* Note what a model says from a warning on: a `ck_say`. */
void ck_page_say(void *host, int status, const char *category, const char *message);

/* Room for numbers of a model, then the model of them; 0 if they make no sense. */
double *ck_page_room_of(ck_model *model, int count);
int ck_page_open_of(ck_model *model, int count);

/* Begin at time 0 with the parameters that are set. */
int ck_page_start_of(ck_model *model);

/* Inputs and outputs by the numbers of their names in description.h. */
int ck_page_put(ck_model *model, int id, double value);
double ck_page_read(ck_model *model, int id);

#endif
