/* The inner loops. Blocks of BLOCK points stay in registers over all degrees; sums have GROUP partial sums,
 * which are added at the end. */
#include "points/base/simd_lanes.h"
#include "points/quadrature/exact/transform.h"

enum { BLOCK = 16, GROUP = 8, CHUNK = 512, VECTORS = BLOCK / AUR_LANES, PARTS = GROUP / AUR_LANES };

static inline aur_reals load(const double *source) {
    aur_reals value;
    memcpy(&value, source, sizeof value);
    return value;
}

static inline void store(double *target, aur_reals value) {
    memcpy(target, &value, sizeof value);
}

/* Points of one chunk: cosine, sine (of m phi) and start (q_mm sin^m) follow the order m. */
typedef struct chunk {
    size_t count; /* a multiple of BLOCK, padded with 0 */
    double z[CHUNK], sine[CHUNK], first_cosine[CHUNK], first_sine[CHUNK];
    double cosine[CHUNK], azimuth_sine[CHUNK], start[CHUNK];
    double a[CHUNK], b[CHUNK]; /* weights of, or sums over, the cosine and the sine functions */
} chunk;

static void copy(double *to, size_t count, const double *from) {
    memset(to, 0, CHUNK * sizeof *to);
    memcpy(to, from, count * sizeof *to);
}

static void open_chunk(chunk *c, const aur_polar_points *points, size_t first, size_t count) {
    c->count = (count + BLOCK - 1) / BLOCK * BLOCK;
    copy(c->z, count, points->z + first);
    copy(c->sine, count, points->sine + first);
    copy(c->first_cosine, count, points->cosine + first);
    copy(c->first_sine, count, points->azimuth_sine + first);
    memset(c->azimuth_sine, 0, sizeof c->azimuth_sine);
    for (size_t i = 0; i < CHUNK; ++i)
        c->cosine[i] = c->start[i] = 1.0;
}

/* Smaller values contribute nothing to any degree, and would give denormal numbers, which are slow. */
static const double negligible = 1e-280;

/* From order m - 1 to m, whose functions start with the factor `start`. */
static void next_order(chunk *c, double start) {
    for (size_t i = 0; i < c->count; ++i) {
        const double cosine = c->cosine[i] * c->first_cosine[i] - c->azimuth_sine[i] * c->first_sine[i];
        c->azimuth_sine[i] = c->cosine[i] * c->first_sine[i] + c->azimuth_sine[i] * c->first_cosine[i];
        c->cosine[i] = cosine;
        const double next = c->start[i] * (start * c->sine[i]);
        c->start[i] = next < negligible ? 0.0 : next;
    }
}

/* The functions of one order at a block of points, degree after degree. */
typedef struct block {
    aur_reals z[VECTORS], here[VECTORS], before[VECTORS];
} block;

static inline void open_block(block *b, const aur_transform_order *o, size_t first) {
    for (size_t v = 0; v < VECTORS; ++v) {
        b->z[v] = load(o->z + first + v * AUR_LANES);
        b->here[v] = load(o->start + first + v * AUR_LANES);
        b->before[v] = (aur_reals){0};
    }
}

static inline void next_degree(block *b, const aur_basis_step *step) {
    for (size_t v = 0; v < VECTORS; ++v) {
        const aur_reals next =
            (step->scale * b->z[v] + step->shift) * b->here[v] - step->before * b->before[v];
        b->before[v] = b->here[v];
        b->here[v] = next;
    }
}

/* `kinds`: 2, or 1 where a[1] is not used. */
static inline __attribute__((always_inline)) void
analyse_block(const aur_transform_order *o, size_t first, size_t kinds, double (*restrict sums)[2 * GROUP]) {
    block b;
    open_block(&b, o, first);
    aur_reals cosine[2][VECTORS], sine[2][VECTORS];
    for (size_t i = 0; i < kinds; ++i)
        for (size_t v = 0; v < VECTORS; ++v) {
            cosine[i][v] = load(o->a[i] + first + v * AUR_LANES);
            sine[i][v] = load(o->b[i] + first + v * AUR_LANES);
        }
    for (size_t k = 0; k < o->degrees; ++k) {
        if (k > 0)
            next_degree(&b, o->steps + k);
        const aur_reals *const c = cosine[kinds > 1 ? k % 2 : 0], *const s = sine[kinds > 1 ? k % 2 : 0];
        for (size_t p = 0; p < PARTS; ++p) {
            double *const at = sums[k] + p * AUR_LANES;
            store(at, load(at) + (b.here[p] * c[p] + b.here[p + PARTS] * c[p + PARTS]));
            store(at + GROUP, load(at + GROUP) + (b.here[p] * s[p] + b.here[p + PARTS] * s[p + PARTS]));
        }
    }
}

static double add_group(const double *g) {
    return ((g[0] + g[4]) + (g[1] + g[5])) + ((g[2] + g[6]) + (g[3] + g[7]));
}

static inline __attribute__((always_inline)) void analyse_kinds(const aur_transform_order *o, size_t kinds,
                                                                double *sums, double *room) {
    double(*const groups)[2 * GROUP] = (double(*)[2 * GROUP])(void *)room;
    memset(groups, 0, o->degrees * sizeof *groups);
    for (size_t i = 0; i < o->count; i += BLOCK)
        analyse_block(o, i, kinds, groups);
    for (size_t k = 0; k < o->degrees; ++k) {
        sums[2 * k] += add_group(groups[k]);
        sums[2 * k + 1] += add_group(groups[k] + GROUP);
    }
}

static void analyse_order(const aur_transform_order *o, double *sums, double *room) {
    analyse_kinds(o, 2, sums, room);
}

static void analyse(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                    const double *weights, double *sums) {
    double *const room = sums + aur_coefficient_count(basis->degree);
    chunk c;
    double w[CHUNK];
    for (size_t at = first; at < last; at += CHUNK) {
        const size_t count = last - at < CHUNK ? last - at : CHUNK;
        open_chunk(&c, points, at, count);
        copy(w, count, weights + at);
        for (size_t m = 0; m <= basis->degree; ++m) {
            if (m > 0)
                next_order(&c, basis->start[m]);
            for (size_t i = 0; i < c.count; ++i) {
                c.a[i] = w[i] * c.cosine[i];
                c.b[i] = w[i] * c.azimuth_sine[i];
            }
            const size_t order_start = aur_basis_at(basis->degree, m);
            const aur_transform_order order = {
                basis->degree + 1 - m, basis->steps + order_start, c.count, c.z, c.start, {c.a}, {c.b}};
            analyse_kinds(&order, 1, sums + 2 * order_start, room);
        }
    }
}

static inline __attribute__((always_inline)) void synthesise_kinds(const aur_transform_order *o, size_t kinds,
                                                                   const double *coefficients) {
    for (size_t first = 0; first < o->count; first += BLOCK) {
        block b;
        open_block(&b, o, first);
        aur_reals cosine[2][VECTORS], sine[2][VECTORS];
        for (size_t v = 0; v < 2 * VECTORS; ++v)
            cosine[v / VECTORS][v % VECTORS] = sine[v / VECTORS][v % VECTORS] = (aur_reals){0};
        for (size_t k = 0; k < o->degrees; ++k) {
            if (k > 0)
                next_degree(&b, o->steps + k);
            aur_reals *const c = cosine[kinds > 1 ? k % 2 : 0], *const s = sine[kinds > 1 ? k % 2 : 0];
            for (size_t v = 0; v < VECTORS; ++v) {
                c[v] += coefficients[2 * k] * b.here[v];
                s[v] += coefficients[2 * k + 1] * b.here[v];
            }
        }
        for (size_t i = 0; i < kinds; ++i)
            for (size_t v = 0; v < VECTORS; ++v) {
                store(o->a[i] + first + v * AUR_LANES, cosine[i][v]);
                store(o->b[i] + first + v * AUR_LANES, sine[i][v]);
            }
    }
}

static void synthesise_order(const aur_transform_order *o, const double *coefficients) {
    synthesise_kinds(o, 2, coefficients);
}

static void synthesise(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                       const double *coefficients, double *values) {
    chunk c;
    double sum[CHUNK];
    for (size_t at = first; at < last; at += CHUNK) {
        const size_t count = last - at < CHUNK ? last - at : CHUNK;
        open_chunk(&c, points, at, count);
        memset(sum, 0, sizeof sum);
        for (size_t m = 0; m <= basis->degree; ++m) {
            if (m > 0)
                next_order(&c, basis->start[m]);
            const size_t order_start = aur_basis_at(basis->degree, m);
            const aur_transform_order order = {
                basis->degree + 1 - m, basis->steps + order_start, c.count, c.z, c.start, {c.a}, {c.b}};
            synthesise_kinds(&order, 1, coefficients + 2 * order_start);
            for (size_t i = 0; i < c.count; ++i)
                sum[i] += c.a[i] * c.cosine[i] + c.b[i] * c.azimuth_sine[i];
        }
        memcpy(values + at, sum, count * sizeof *values);
    }
}

/* Four rows at a time, each with the same order of its sum. */
static inline __attribute__((always_inline)) void dot_rows(size_t rows, size_t count, const double *row,
                                                           size_t stride, const double *other, size_t step,
                                                           double *sums) {
    aur_reals sum[4][PARTS];
    for (size_t r = 0; r < rows; ++r)
        for (size_t p = 0; p < PARTS; ++p)
            sum[r][p] = (aur_reals){0};
    size_t i = 0;
    for (; i + GROUP <= count; i += GROUP)
        for (size_t p = 0; p < PARTS; ++p) {
            const aur_reals x = load(row + i + p * AUR_LANES);
            for (size_t r = 0; r < rows; ++r)
                sum[r][p] += x * load(other + r * stride + i + p * AUR_LANES);
        }
    for (size_t r = 0; r < rows; ++r) {
        double parts[GROUP];
        for (size_t p = 0; p < PARTS; ++p)
            store(parts + p * AUR_LANES, sum[r][p]);
        for (size_t j = i; j < count; ++j)
            parts[j - i] += row[j] * other[r * stride + j];
        sums[r * step] = add_group(parts);
    }
}

static void dots(size_t count, const double *row, size_t row_count, size_t stride, const double *rows,
                 size_t step, double *sums) {
    size_t r = 0;
    for (; r + 4 <= row_count; r += 4)
        dot_rows(4, count, row, stride, rows + r * stride, step, sums + r * step);
    for (; r < row_count; ++r)
        dot_rows(1, count, row, stride, rows + r * stride, step, sums + r * step);
}

const aur_transform_kernel AUR_KERNEL(aur_transform_kernel) = {analyse, synthesise, analyse_order,
                                                               synthesise_order, dots};
