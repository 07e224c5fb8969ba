/* The file that an FMU brings: which variables it has, and the tables of its film, and of the faces of
   a drive, a stop or the site of tips. It is called film.bin in all of them.

   Written by fmu/native/data.py: 8 letters, a checksum and a count of 8 bytes each, 40 letters of
   the GUID, then that many doubles; little-endian. Nothing in it is trusted. */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#endif

#define MOST_NUMBERS 20000000u

/* FNV-1a, 64 bits. */
uint64_t ck_checksum(const void *bytes, size_t count) {
    const unsigned char *byte = (const unsigned char *)bytes;
    uint64_t hash = 14695981039346656037u;
    size_t i;
    for (i = 0; i < count; i++) hash = (hash ^ byte[i]) * 1099511628211u;
    return hash;
}

typedef struct {
    const double *next, *end;
    int fine;
    int *hints;     /* of the pieces still to come */
    ck_cell *cells; /* of these, too */
} stream;

static double number(stream *s) {
    if (s->next >= s->end) s->fine = 0;
    return s->fine ? *s->next++ : 0.0;
}

/* A whole number within bounds. */
static int whole(stream *s, int low, int high) {
    double value = number(s);
    if (!(value >= low && value <= high) || value != floor(value)) {
        s->fine = 0;
        return low;
    }
    return (int)value;
}

static double positive(stream *s) {
    double value = number(s);
    if (!(value > 0.0)) s->fine = 0;
    return value;
}

static const double *column(stream *s, int count, int ascends) {
    const double *first = s->next;
    int i;
    if (!s->fine || s->end - s->next < count) {
        s->fine = 0;
        return NULL;
    }
    for (i = 0; i < count; i++)
        if (!isfinite(first[i]) || (ascends && i > 0 && !(first[i] > first[i - 1]))) s->fine = 0;
    s->next += count;
    return first;
}

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

static void read_table(stream *s, ck_table *table) {
    const double *x, *y, *slope, *curve;
    int i, k, nodes;
    table->stays = whole(s, 0, 1);
    table->count = whole(s, 1, CK_PIECES);
    for (i = 0; s->fine && i < table->count; i++) {
        ck_piece *piece = &table->pieces[i];
        piece->low = positive(s);
        piece->high = positive(s);
        piece->end = positive(s);
        piece->log_end = log(piece->end);
        piece->folds = whole(s, 0, 1);
        piece->power = whole(s, 0, 8);
        nodes = whole(s, 2, 1000000);
        piece->hint = s->hints++;
        x = column(s, nodes, 1);
        y = column(s, nodes, 0);
        slope = column(s, nodes, 0);
        curve = column(s, nodes, 0);
        if (!s->fine) return;
        piece->count = nodes - 1;
        piece->cells = s->cells;
        for (k = 0; k < piece->count; k++)
            fill(s->cells++, x[k], x[k + 1], &y[k], &slope[k], &curve[k]);
        if (!(piece->low < piece->high) || (i > 0 && piece->low != table->pieces[i - 1].high))
            s->fine = 0;
    }
}

static void read_film(stream *s, ck_film *film) {
    int i, k;
    film->end = positive(s);
    film->breaks = positive(s);
    film->full_gap = number(s);
    film->count = whole(s, 1, CK_LAWS);
    for (i = 0; s->fine && i < film->count; i++) {
        ck_law *law = &film->laws[i];
        law->scale = whole(s, CK_FIXED, CK_VISCOSITY);
        law->rate = whole(s, CK_STATIC, CK_LIQUID);
        law->needs_film = whole(s, 0, 1);
        law->end = positive(s);
        law->release = positive(s);
        law->recontact = number(s);
        law->kink_count = whole(s, 0, CK_KINKS);
        for (k = 0; s->fine && k < law->kink_count; k++) law->kinks[k] = positive(s);
        read_table(s, &law->table);
    }
    read_table(s, &film->shape);
    film->rim_square = number(s);
    film->volume = number(s);
    if (!(film->rim_square >= 0.0 && film->volume >= 0.0)) s->fine = 0;
}

static void read_ports(stream *s, ck_data *data) {
    int i;
    data->kind = whole(s, CK_STICTION_MASS, CK_TIP_CONTACT);
    data->port_count = whole(s, 1, CK_VARIABLES);
    for (i = 0; s->fine && i < data->port_count; i++) {
        ck_port *port = &data->ports[i];
        port->id = whole(s, 0, CK_VARIABLES - 1);
        port->type = whole(s, CK_REAL, CK_BOOLEAN);
        if (port->type & (port->type - 1)) s->fine = 0; /* one bit */
        port->causality = whole(s, CK_INPUT, CK_PARAMETER);
        port->low = number(s);
        port->high = number(s);
        port->start = number(s);
        if (!(port->low <= port->high) || !isfinite(port->start)) s->fine = 0;
        if (port->causality != CK_OUTPUT && !(port->start >= port->low && port->start <= port->high))
            s->fine = 0;
    }
}

static void read_curve(stream *s, ck_curve *curve, int is_log) {
    curve->count = whole(s, 2, 1000000);
    curve->x = column(s, curve->count, 1);
    curve->y = column(s, curve->count, 0);
    curve->slope = column(s, curve->count, 0);
    if (!s->fine || !is_log) return;
    curve->begin = exp(curve->x[0]), curve->end = exp(curve->x[curve->count - 1]);
    curve->low = exp(curve->y[0]), curve->high = exp(curve->y[curve->count - 1]);
}

static void read_faces(stream *s, ck_faces *faces) {
    int i;
    faces->is_there = whole(s, 0, 1);
    if (!faces->is_there) return;
    faces->limit = number(s);
    faces->count = whole(s, 0, CK_UNLOADING_CURVES);
    read_curve(s, &faces->first, 1);
    if (faces->count) read_curve(s, &faces->residual, 0);
    for (i = 0; s->fine && i < faces->count; i++) {
        faces->ends[i] = positive(s);
        read_curve(s, &faces->unloading[i], 1);
    }
}

/* What a stop has besides, and the site of tips, if it deforms: areas, and the work that is dissipated. */
static void read_stop(stream *s, ck_faces *faces) {
    int i;
    read_faces(s, faces);
    if (!faces->is_there) return;
    read_curve(s, &faces->area, 1);
    read_curve(s, &faces->plastic, 0);
    if (faces->count) read_curve(s, &faces->dissipated, 0);
    for (i = 0; s->fine && i < faces->count; i++) read_curve(s, &faces->areas[i], 1);
}

static void read_scene(stream *s, ck_scene *scene) {
    int i;
    scene->is_sphere = whole(s, 0, 1);
    scene->sphere_radius = positive(s);
    scene->menisci = positive(s);
    scene->reynolds = whole(s, 0, 1);
    scene->rewetting = number(s);
    scene->film_count = whole(s, 1, CK_FILMS);
    for (i = 0; s->fine && i < scene->film_count; i++) read_film(s, &scene->films[i]);
}

static FILE *open_file(const char *path) {
#ifdef _WIN32
    wchar_t wide[1024]; /* the path is UTF-8, whatever the code page of the host */
    if (!MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 1024)) return NULL;
    return _wfopen(wide, L"rb");
#else
    return fopen(path, "rb");
#endif
}

static const char *read_numbers(FILE *file, ck_data *data, uint64_t *count) {
    char magic[8];
    uint64_t head[2];
    if (fread(magic, 1, 8, file) != 8 || memcmp(magic, "CKFILM06", 8) != 0)
        return "it is no file of this FMU";
    if (fread(head, 8, 2, file) != 2 || fread(data->guid, 1, 40, file) != 40)
        return "it is cut short";
    data->guid[39] = 0;
    data->checksum = head[0];
    *count = head[1];
    if (*count == 0 || *count > MOST_NUMBERS) return "its length is wrong";
    data->numbers = (double *)malloc((size_t)*count * sizeof(double));
    if (!data->numbers) return "there is no memory for it";
    if (fread(data->numbers, sizeof(double), (size_t)*count, file) != *count)
        return "it is cut short";
    if (ck_checksum(data->numbers, (size_t)*count * sizeof(double)) != data->checksum)
        return "it was changed after the FMU was built";
    return NULL;
}

/* Read a file; what was allocated stays in `data` for `ck_model_close`, whatever happens. */
const char *ck_data_read(const char *path, ck_data *data) {
    FILE *file = open_file(path);
    uint64_t count = 0;
    const char *problem;
    stream s;
    memset(data, 0, sizeof *data);
    if (!file) return "it cannot be opened";
    problem = read_numbers(file, data, &count);
    fclose(file);
    if (problem) return problem;
    s.next = data->numbers, s.end = data->numbers + count, s.fine = 1;
    s.hints = data->hints;
    read_ports(&s, data);
    if (data->kind == CK_VALVE_DRIVE) {
        read_faces(&s, &data->faces);
    } else if (data->kind == CK_CONTACT_STOP) {
        read_stop(&s, &data->faces);
        if (!data->faces.is_there) s.fine = 0;
    } else { /* a node of a table has four numbers, and there are fewer cells than nodes */
        data->cells = s.cells = (ck_cell *)malloc((size_t)(count / 4 + 1) * sizeof(ck_cell));
        if (!s.cells) return "there is no memory for it";
        read_scene(&s, &data->scene);
        if (data->kind == CK_TIP_CONTACT) read_stop(&s, &data->faces);
    }
    return s.fine && s.next == s.end ? NULL : "what it says makes no sense";
}
