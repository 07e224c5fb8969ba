/* The file that an FMU brings: which variables it has, and the tables of its film, and of the faces of
   a drive, a stop or the site of tips. It is called film.bin in all of them.

   Written by fmu/native/data.py: 8 letters that stand for the order of what follows, a checksum and a
   count of 8 bytes each, 40 letters of the GUID, then that many doubles; little-endian. Which member
   of which record a number is, says description.c. Nothing in the file is trusted. */

#include "model.h"
#include "reader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#endif

#define MOST_NUMBERS 20000000u /* 160 MB; tables in use have some 10 000 numbers */

/* FNV-1a, 64 bits. */
uint64_t ck_checksum(const void *bytes, size_t count) {
    const unsigned char *byte = (const unsigned char *)bytes;
    uint64_t hash = 14695981039346656037u;
    size_t i;
    for (i = 0; i < count; i++) hash = (hash ^ byte[i]) * 1099511628211u;
    return hash;
}

double ck_read_real(ck_reader *r, double low, double high) {
    double value = r->next < r->end ? *r->next : 0.0;
    if (r->next == r->end || !(value >= low && value <= high)) r->fine = 0; /* nor is nan */
    return r->fine ? *r->next++ : low;
}

int ck_read_whole(ck_reader *r, int low, int high) {
    double value = ck_read_real(r, low, high);
    if (value != floor(value)) r->fine = 0;
    return r->fine ? (int)value : low;
}

int ck_read_nodes(ck_reader *r) { return ck_read_whole(r, 2, CK_MOST_NODES); }

const double *ck_read_column(ck_reader *r, int count, int ascends) {
    const double *first = r->next;
    int i;
    if (!r->fine || r->end - r->next < count) {
        r->fine = 0;
        return NULL;
    }
    for (i = 0; i < count; i++)
        if (!isfinite(first[i]) || (ascends && i > 0 && !(first[i] > first[i - 1]))) r->fine = 0;
    r->next += count;
    return first;
}

/* Made once, when the file is read: an evaluation is then one polynomial of a cell in cache lines next to
   each other, not six numbers of two nodes in four columns. */
/* Powers of the fraction t of the distance from one node to the next; b, c slope and curvature times
   width and its square. */
static void fill(ck_cell *cell, double x0, double x1, const double y[2], const double slope[2],
                 const double curve[2]) {
    double w = x1 - x0, rise = y[1] - y[0], b0 = slope[0] * w, b1 = slope[1] * w;
    double c0 = curve[0] * w * w, c1 = curve[1] * w * w;
    cell->x = x0, cell->per_width = 1.0 / w;
    cell->c[0] = y[0], cell->c[1] = b0, cell->c[2] = 0.5 * c0;
    cell->c[3] = 10.0 * rise - 6.0 * b0 - 4.0 * b1 - 1.5 * c0 + 0.5 * c1;
    cell->c[4] = -15.0 * rise + 8.0 * b0 + 7.0 * b1 + 1.5 * c0 - c1;
    cell->c[5] = 6.0 * rise - 3.0 * (b0 + b1) - 0.5 * (c0 - c1);
}

void ck_made_piece(ck_reader *r, ck_piece *made) {
    int k;
    if (!(made->low < made->high)) r->fine = 0;
    made->log_end = log(made->high);
    made->hint = r->hints++;
    made->cells = r->cells;
    for (k = 0; k + 1 < made->n_nodes; k++)
        fill(r->cells++, made->x[k], made->x[k + 1], &made->y[k], &made->slope[k], &made->curve[k]);
}

void ck_made_table(ck_reader *r, ck_table *made) {
    int i;
    for (i = 1; i < made->n_pieces; i++)
        if (made->pieces[i].low != made->pieces[i - 1].high) r->fine = 0;
}

/* A cubic goes through four nodes. */
void ck_made_liquid_table(ck_reader *r, ck_liquid_table *made) {
    if (made->n_nodes < 4 || !(made->low < made->high)) r->fine = 0;
}

/* There is a coefficient for each pair of knots. */
void ck_made_ratio(ck_reader *r, ck_ratio *made) {
    if (made->n_nodes != made->gaps * made->speeds || !(made->end > made->first_speed)) r->fine = 0;
}

void ck_made_variable(ck_reader *r, ck_variable *made) {
    int fits = made->start >= made->low && made->start <= made->high;
    if (made->type & (made->type - 1)) r->fine = 0; /* one bit */
    if (!(made->low <= made->high) || !isfinite(made->start)) r->fine = 0;
    if (made->causality != CK_OUTPUT && !fits) r->fine = 0;
}

/* There are losses where there is an unloading curve. */
void ck_made_faces(ck_reader *r, ck_faces *made) {
    int yields = made->n_unloading > 0;
    if (made->has_residual != yields || made->has_dissipated != yields) r->fine = 0;
}

static int suits(const ck_contents *c) {
    int faces = ck_has_faces[c->model];
    return c->has_tables == ck_has_film[c->model] && (faces < 0 || c->has_faces == faces) &&
           c->has_bodies == ck_deforms[c->model];
}

/* Read the head and the numbers of a file. */
static const char *read_numbers(ck_read *read, void *from, ck_data *data, uint64_t *count) {
    char magic[8];
    uint64_t head[2];
    if (!read(from, magic, 8) || memcmp(magic, CK_LAYOUT, 8) != 0) return "it is no file of this FMU";
    if (!read(from, head, sizeof head) || !read(from, data->guid, 40)) return "it is cut short";
    data->guid[39] = 0;
    data->checksum = head[0];
    *count = head[1];
    if (*count == 0 || *count > MOST_NUMBERS) return "its length is wrong";
    data->numbers = (double *)malloc((size_t)*count * sizeof(double));
    if (!data->numbers) return "there is no memory for it";
    if (!read(from, data->numbers, (size_t)*count * sizeof(double))) return "it is cut short";
    if (ck_checksum(data->numbers, (size_t)*count * sizeof(double)) != data->checksum)
        return "it was changed after the FMU was built";
    return NULL;
}

/* Make records of `numbers`, which are `data`'s own; the message says what is wrong with them. */
const char *ck_data_take(ck_data *data, size_t count) {
    ck_reader r;
    /* a node of a table has four numbers, and there are fewer cells than nodes */
    data->cells = (ck_cell *)malloc((count / 4 + 1) * sizeof(ck_cell));
    if (!data->cells) return "there is no memory for it";
    r.next = data->numbers, r.end = data->numbers + count, r.fine = 1;
    r.hints = data->hints, r.cells = data->cells;
    ck_read_contents(&r, &data->contents);
    return r.fine && r.next == r.end && suits(&data->contents) ? NULL : "what it says makes no sense";
}

/* Read what a function hands out; what was allocated stays in `data` for `ck_model_close`, whatever
   happens. */
const char *ck_data_from(ck_read *read, void *from, ck_data *data) {
    uint64_t count = 0;
    const char *problem;
    memset(data, 0, sizeof *data);
    problem = read_numbers(read, from, data, &count);
    return problem ? problem : ck_data_take(data, (size_t)count);
}

#ifndef CK_COMPONENT /* a WebAssembly component asks its host: fmi3wasm.c */
static FILE *open_file(const char *path) {
#ifdef _WIN32
    wchar_t wide[1024]; /* the path is UTF-8, whatever the code page of the host */
    if (!MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 1024)) return NULL;
    return _wfopen(wide, L"rb");
#else
    return fopen(path, "rb");
#endif
}

static int read_file(void *file, void *to, size_t size) {
    return fread(to, 1, size, (FILE *)file) == size;
}

const char *ck_data_read(const char *path, ck_data *data) {
    FILE *file = open_file(path);
    const char *problem;
    memset(data, 0, sizeof *data);
    if (!file) return "it cannot be opened";
    problem = ck_data_from(read_file, file, data);
    fclose(file);
    return problem;
}
#endif
