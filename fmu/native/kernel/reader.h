/* Numbers of a file, taken one by one (data.c); the order in which they are taken is in description.c. */

#ifndef CK_READER_H
#define CK_READER_H

#include "film.h"

/* `fine` is 0 from the first number on that is missing or out of range; then nothing is taken. */
struct ck_reader {
    const double *next, *end;
    int fine;
    int *hints;     /* of the pieces still to come */
    ck_cell *cells; /* of these, too */
};

double ck_read_real(ck_reader *r, double low, double high);
int ck_read_whole(ck_reader *r, int low, int high);
int ck_read_nodes(ck_reader *r); /* how many there are */
const double *ck_read_column(ck_reader *r, int count, int ascends);

#endif
