/* The liquid of a film on a grid: its cells at the stages of a step, and its force. */

#include "grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a grid may have: some 120 cells across a face. A factor that fills in more than this is none of
   a grid whose cells were put in order; eight of them take 100 MB. */
#define MOST_CELLS 16384
#define MOST_FILL 1000000
#define FULL 1e-12       /* fraction of a gap that a full cell may lack: round-off */
#define WITHIN 1e-12     /* of the pressure of the cavity, at which a cell has one */
#define REFORMED 1e-9    /* as _FILLED, _SAME, _INNER and _PER_STEP of face/cavity.py */
#define SAME 1e-3
#define INNER 0.64
#define PER_STEP 0.1

extern const double ck_nodes[3];

/* Opening ------------------------------------------------------------------------------------------ */

static void *room(ck_grid_film *film, size_t count, size_t size) {
    void *block = film->n_blocks < CK_GRID_BLOCKS ? calloc(count ? count : 1, size) : NULL;
    if (block) film->blocks[film->n_blocks++] = block;
    return block;
}

static double *numbers(ck_grid_film *film, int count) {
    return (double *)room(film, (size_t)count, sizeof(double));
}

static int *integers(ck_grid_film *film, int count) {
    return (int *)room(film, (size_t)count, sizeof(int));
}

static unsigned char *set(ck_grid_film *film) {
    return (unsigned char *)room(film, (size_t)film->n, 1);
}

/* A number of the file as that of a cell; -1 if it is none. */
static int cell_of(double number, int n) {
    return number >= 0.0 && number < n && number == floor(number) ? (int)number : -1;
}

/* Both ends of a side, the lower number first; 0 if there is no such side. */
static int ends(ck_grid_film *film, int i, double one, double other, double geometry) {
    int a = cell_of(one, film->n), b = cell_of(other, film->n);
    if (a < 0 || b < 0 || a == b || !(geometry > 0.0)) return 0;
    film->low[i] = a < b ? a : b, film->high[i] = a < b ? b : a;
    return 1;
}

static int read_sides(ck_grid_film *film) {
    const ck_grid *g = film->record;
    int i, k;
    for (i = 0; i < film->n_inner; i++)
        if (!ends(film, i, g->sides.one[i], g->sides.other[i], g->sides.geometry[i])) return 0;
    for (; i < film->n_sides; i++) {
        k = i - film->n_inner;
        if (!ends(film, i, g->pockets.cell[k], g->pockets.pocket[k], g->pockets.geometry[k])) return 0;
        if (!(g->pockets.excess[k] >= 0.0 && g->pockets.excess[k] <= 1.0)) return 0;
        film->cell[k] = (int)g->pockets.cell[k], film->pocket[k] = (int)g->pockets.pocket[k];
    }
    return 1;
}

static int has_sense(const ck_cells *cells) {
    int i, any = 0;
    for (i = 0; i < cells->n_nodes; i++) {
        if (!(cells->area[i] > 0.0 && cells->extra[i] >= 0.0 && cells->rim[i] >= 0.0)) return 0;
        if (!(cells->excess[i] >= 0.0 && cells->excess[i] <= 4.0)) return 0; /* of four sides */
        any |= cells->rim[i] > 0.0;
    }
    return any;
}

/* Neighbours before each cell. */
static void list_neighbours(ck_grid_film *film) {
    ck_pattern *p = &film->pattern;
    int i;
    for (i = 0; i < film->n_sides; i++) p->first[film->high[i] + 1]++;
    for (i = 0; i < film->n; i++) p->first[i + 1] += p->first[i];
    for (i = film->n_sides - 1; i >= 0; i--) {
        int place = p->first[film->high[i]] + p->column_start[film->high[i]]++;
        p->beside[place] = film->low[i], p->side[place] = i;
    }
}

static int get_vectors(ck_grid_film *film) {
    double **vectors[] = {&film->diagonal, &film->liquid,  &film->kept,     &film->next,
                          &film->fraction, &film->deficit, &film->storage,  &film->pressure,
                          &film->voids,    &film->work,    &film->slope};
    unsigned char **sets[] = {&film->full,  &film->last,      &film->new,      &film->begin,
                              &film->stages[0], &film->stages[1], &film->stages[2]};
    size_t i;
    int fine = 1;
    for (i = 0; i < sizeof vectors / sizeof *vectors; i++)
        fine &= (*vectors[i] = numbers(film, film->n)) != NULL;
    for (i = 0; i < sizeof sets / sizeof *sets; i++) fine &= (*sets[i] = set(film)) != NULL;
    return fine;
}

static int get_pattern(ck_grid_film *film) {
    ck_pattern *p = &film->pattern;
    p->n = film->n;
    film->sides = numbers(film, film->n_sides);
    film->low = integers(film, film->n_sides), film->high = integers(film, film->n_sides);
    film->cell = integers(film, film->n_sides), film->pocket = integers(film, film->n_sides);
    p->first = integers(film, film->n + 1), p->row_start = integers(film, film->n + 1);
    p->column_start = integers(film, film->n + 1);
    p->beside = integers(film, film->n_sides), p->side = integers(film, film->n_sides);
    return film->sides && film->low && film->high && film->cell && film->pocket && p->first &&
           p->row_start && p->column_start && p->beside && p->side;
}

static int get_factors(ck_grid_film *film) {
    int i, fine = 1;
    for (i = 0; i < CK_FACTORS; i++) {
        ck_factor *one = &film->factors[i];
        one->count = integers(film, film->n), one->place = integers(film, film->pattern.fill);
        one->value = numbers(film, film->pattern.fill), one->pivot = numbers(film, film->n);
        one->full = set(film);
        fine &= one->count && one->place && one->value && one->pivot && one->full;
    }
    return fine;
}

const char *ck_grid_open(ck_grid_film *film, const ck_grid *record) {
    static const char none[] = "there is no memory for it";
    int *parent, *mark, i;
    film->record = record, film->n = record->cells.n_nodes;
    film->n_inner = record->sides.n_nodes;
    film->n_sides = film->n_inner + (record->has_pockets ? record->pockets.n_nodes : 0);
    if (film->n > MOST_CELLS || film->n_sides > 4 * MOST_CELLS || !has_sense(&record->cells))
        return "its grid makes no sense";
    for (film->is_even = 1, i = 0; i < film->n; i++) film->is_even &= record->cells.relief[i] == 0.0;
    if (!get_vectors(film) || !get_pattern(film)) return none;
    if (!read_sides(film)) return "its grid makes no sense";
    list_neighbours(film);
    parent = integers(film, film->n), mark = integers(film, film->n);
    if (!parent || !mark) return none;
    film->pattern.fill = ck_fill_of(&film->pattern, parent, mark, MOST_FILL);
    if (film->pattern.fill > MOST_FILL) return "its grid makes no sense";
    film->pattern.row = integers(film, film->pattern.fill);
    if (!film->pattern.row || !get_factors(film)) return none;
    ck_pattern_rows(&film->pattern, parent, mark, film->factors[0].place);
    memset(film->last, 1, (size_t)film->n);
    /* Every cell has a way to a rim, or there is no pressure. */
    return ck_grid_factor(film, 1.0, film->last) ? NULL : "its grid makes no sense";
}

void ck_grid_close(ck_grid_film *film) {
    int i;
    for (i = 0; i < film->n_blocks; i++) free(film->blocks[i]);
    memset(film, 0, sizeof *film);
}

/* Liquid ------------------------------------------------------------------------------------------- */

static double height(const ck_grid_film *film, int i, double gap) {
    return gap + film->record->cells.relief[i];
}

static void copy(const ck_grid_film *film, double *to, const double *from) {
    memcpy(to, from, (size_t)film->n * sizeof(double));
}

void ck_grid_keep(ck_grid_film *film) {
    if (film->n) copy(film, film->kept, film->liquid);
}

void ck_grid_go_back(ck_grid_film *film) {
    if (film->n) ck_grid_put(film, film->kept);
}

void ck_grid_put(ck_grid_film *film, const double *liquid) {
    if (!film->n) return;
    if (liquid) copy(film, film->liquid, liquid);
    else memset(film->liquid, 0, (size_t)film->n * sizeof(double));
    film->stamp++;
    memset(film->last, 1, (size_t)film->n);
}

/* The liquid fills a gap. */
void ck_grid_fill(ck_grid_film *film, double gap) {
    int i;
    for (i = 0; i < film->n; i++) film->liquid[i] = height(film, i, gap);
    film->stamp++;
    memset(film->last, 1, (size_t)film->n);
}

/* Volume of the gap. */
double ck_grid_volume(const ck_grid_film *film, double gap) {
    double total = 0.0;
    int i;
    for (i = 0; i < film->n; i++) total += film->record->cells.area[i] * height(film, i, gap);
    return total;
}

static int is_open(const ck_grid_film *film, double gap) {
    int i;
    for (i = 0; i < film->n; i++)
        if (!(height(film, i, gap) > 0.0)) return 0;
    return gap > 0.0;
}

/* Whether the sides of full cells at the rim take up what lies between them and where the flux is taken. */
static void take_excess(ck_grid_film *film, const double *growth, const unsigned char *full) {
    const ck_grid *g = film->record;
    int i, k;
    for (i = 0; i < film->n; i++)
        if (full[i]) film->deficit[i] -= g->cells.excess[i] * growth[i];
    for (k = 0; k < film->n_sides - film->n_inner; k++) {
        int cell = film->cell[k], pocket = film->pocket[k];
        double gain = full[cell] && full[pocket] ? g->pockets.excess[k] * growth[cell] : 0.0;
        film->deficit[cell] -= gain, film->deficit[pocket] += gain;
    }
}

/* Fractions of liquid after a step from one gap to another, in place, by backward Euler; the void. */
static int flow_on(ck_grid_film *film, ck_grid_liquid liquid, double start, double end, double dt,
                   double *found) {
    const ck_cells *cells = &film->record->cells;
    ck_obstacle p = {end, -liquid.drop * end * end * end / (12.0 * liquid.viscosity), film->deficit,
                     film->storage, NULL};
    int i;
    if (!(dt > 0.0) || !is_open(film, end)) return 0;
    for (i = 0; i < film->n; i++) {
        double now = height(film, i, end), was = film->fraction[i] * height(film, i, start);
        double extra = cells->extra[i];
        film->full[i] = film->fraction[i] >= 1.0 - FULL;
        film->slope[i] = cells->area[i] * (now - was) / dt;
        film->storage[i] = (cells->area[i] * now + extra) / dt;
        film->deficit[i] = film->slope[i] + extra / dt * (1.0 - film->fraction[i]);
    }
    take_excess(film, film->slope, film->full);
    if (end > start)
        for (i = 0; i < film->n; i++) film->full[i] &= film->last[i];
    if (!ck_obstacle_solve(film, &p, film->full)) return 0;
    for (*found = 0.0, i = 0; i < film->n; i++) {
        double gone = film->full[i] ? 0.0 : fmax(film->voids[i], 0.0);
        film->fraction[i] = 1.0 - gone;
        *found += cells->area[i] * height(film, i, end) * gone;
    }
    return 1;
}

static void begin(ck_grid_film *film, double gap) {
    int i;
    for (i = 0; i < film->n; i++) film->fraction[i] = fmin(film->liquid[i] / height(film, i, gap), 1.0);
}

/* Whether the step found last is this one: an iteration for a motion moves its gaps little at the end. */
static int is_known(const ck_grid_film *film, double start, double dt, const double gaps[3]) {
    double moves = 0.0, way = 0.0;
    int i;
    if (film->of != film->stamp || film->start != start || film->dt != dt || !film->dt) return 0;
    for (i = 0; i < 3; i++) {
        moves = fmax(moves, fabs(gaps[i] - film->gaps[i]));
        way = fmax(way, fabs(gaps[i] - start));
    }
    return moves <= SAME * way;
}

/* Error that shrinks with the step as that of Radau's method does, of second order in each step. */
static double as_of_the_method(const ck_grid_film *film, double missed) {
    double enough = PER_STEP * film->record->rtol, ratio = missed / enough;
    return enough * ratio * ratio;
}

int ck_grid_step(ck_grid_film *film, ck_grid_liquid liquid, double start, double dt,
                 const double gaps[3]) {
    double from = start, time = 0.0, whole;
    int i, k;
    if (is_known(film, start, dt, gaps)) return 1;
    film->dt = 0.0;
    if (!is_open(film, start)) return 0;
    begin(film, start);
    for (i = 0; i < 3; i++) {
        if (!flow_on(film, liquid, from, gaps[i], dt * (ck_nodes[i] - time), &film->hollow[i])) return 0;
        for (k = 0; k < film->n; k++) film->stages[i][k] = film->fraction[k] >= 1.0 - FULL;
        from = gaps[i], time = ck_nodes[i];
    }
    copy(film, film->next, film->fraction);
    begin(film, start);
    if (!flow_on(film, liquid, start, gaps[2], dt, &whole)) return 0;
    film->error = as_of_the_method(
        film, INNER * fabs(film->hollow[2] - whole) / ck_grid_volume(film, gaps[2]));
    film->of = film->stamp, film->start = start, film->dt = dt;
    memcpy(film->gaps, gaps, sizeof film->gaps);
    return 1;
}

/* The last iteration may have moved the faces a little: full cells stay full. */
double ck_grid_after(ck_grid_film *film, double gap) {
    double empty = 0.0;
    int i;
    for (i = 0; i < film->n; i++) {
        double now = height(film, i, gap), fraction = film->next[i];
        film->liquid[i] = fraction >= 1.0 ? now : fraction * height(film, i, film->gaps[2]);
        empty += film->record->cells.area[i] * fmax(now - film->liquid[i], 0.0);
    }
    film->stamp++;
    return empty > REFORMED * ck_grid_volume(film, gap) ? empty : 0.0;
}

double ck_grid_onset(const ck_grid_film *film, double gap) {
    const ck_onset *o = &film->record->onset;
    double x = log(gap + o->depth), t;
    int low = 0, high = o->n_nodes - 1;
    if (!(x > o->place[low])) return exp(o->ratio[low]);
    if (x >= o->place[high]) return exp(o->ratio[high]);
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (o->place[middle] <= x) low = middle;
        else high = middle;
    }
    t = (x - o->place[low]) / (o->place[high] - o->place[low]);
    return exp(o->ratio[low] + t * (o->ratio[high] - o->ratio[low]));
}

/* Force -------------------------------------------------------------------------------------------- */

static double cube(double x) { return x * x * x; }

/* How the flow out of each cell of a pressure that stays follows the gap. */
static void flow_by_gap(const ck_grid_film *film, double gap, double *out) {
    const ck_grid *g = film->record;
    const double *q = film->pressure;
    int i, k;
    for (i = 0; i < film->n; i++) {
        double h = height(film, i, gap);
        out[i] = g->cells.rim[i] * 3.0 * cube(h / gap) / h * q[i];
    }
    for (i = 0; i < film->n_sides; i++) {
        int low = film->low[i], high = film->high[i];
        double slope, through;
        k = i - film->n_inner;
        if (k < 0) {
            double ha = height(film, low, gap), hb = height(film, high, gap);
            double a = cube(ha / gap), b = cube(hb / gap), sum = a + b;
            slope = g->sides.geometry[i] * 6.0 * a * b * (b / ha + a / hb) / (sum * sum);
        } else {
            slope = 3.0 * film->sides[i] / height(film, film->cell[k], gap);
        }
        through = slope * (q[low] - q[high]);
        out[low] += through, out[high] -= through;
    }
}

/* Force of a film with some of its cells full, and where its cavity is then. */
static int force_of(ck_grid_film *film, ck_grid_liquid liquid, const unsigned char *may_fill,
                    double gap, double speed, ck_grid_force *found) {
    const ck_cells *cells = &film->record->cells;
    double conduct = gap * gap * gap / (12.0 * liquid.viscosity), *weight = film->storage;
    double *speeds = film->fraction;
    ck_obstacle p = {gap, -liquid.drop * conduct, film->deficit, cells->area, may_fill};
    const ck_factor *factor;
    int i;
    memset(found, 0, sizeof *found);
    if (!is_open(film, gap)) return 0;
    for (i = 0; i < film->n; i++) {
        film->deficit[i] = cells->area[i];
        film->last[i] &= may_fill[i];
    }
    take_excess(film, cells->area, may_fill);
    copy(film, speeds, film->deficit); /* of a unit speed */
    for (i = 0; i < film->n; i++) film->deficit[i] *= speed;
    if (!ck_obstacle_solve(film, &p, film->last)) return 0;
    for (i = 0; i < film->n; i++) {
        found->force -= cells->area[i] * film->pressure[i] / conduct;
        found->area += film->pressure[i] <= p.floor * (1.0 - WITHIN) ? cells->area[i] : 0.0;
        weight[i] = film->last[i] ? cells->area[i] : 0.0;
    }
    /* What all cells feel of the flow into one of them: as the matrix is symmetric, one solution for
       both slopes. */
    factor = ck_grid_factor(film, gap, film->last);
    if (!factor) return 0;
    ck_factor_solve(&film->pattern, factor, weight);
    flow_by_gap(film, gap, film->slope);
    for (i = 0; i < film->n; i++) {
        found->by_speed += weight[i] * speeds[i] / conduct;
        found->by_gap += weight[i] * film->slope[i] / conduct;
    }
    found->by_speed = fmax(found->by_speed, 0.0);
    return isfinite(found->force + found->by_gap + found->by_speed);
}

int ck_grid_held(ck_grid_film *film, ck_grid_liquid liquid, double from, double gap, double speed,
                 ck_grid_force *found) {
    int i;
    for (i = 0; i < film->n; i++)
        film->begin[i] = !(from > 0.0) || film->liquid[i] >= height(film, i, from) * (1.0 - FULL);
    return force_of(film, liquid, film->begin, gap, speed, found);
}

int ck_grid_at_stage(ck_grid_film *film, ck_grid_liquid liquid, int stage, double gap, double speed,
                     ck_grid_force *found) {
    return force_of(film, liquid, film->stages[stage], gap, speed, found);
}
