#include <math.h>
#include <string.h>

#include "points/linear/solve.h"

/* The doubles of a register, and how many rows a tile of `subtract` has. */
#if AUR_KERNEL_WIDE && defined(__AVX512F__)
enum { LANES = 8, ROWS = 8 };
#elif AUR_KERNEL_WIDE
enum { LANES = 4, ROWS = 4 };
#else
enum { LANES = 2, ROWS = 4 };
#endif

typedef double lanes __attribute__((vector_size(8 * LANES)));

/* A tile is two registers wide; BAND rows of L stay in the cache while all their tiles are updated. */
enum {
    NARROW = AUR_CHOLESKY_NARROW,
    WIDE = AUR_CHOLESKY_WIDE,
    WIDTH = 2 * LANES,
    BAND = 32,
    GROUP = 32,
    SUMS = 16
};
_Static_assert(WIDTH <= NARROW && NARROW <= GROUP && BAND % ROWS == 0, "sizes of blocks do not fit");

static inline lanes load(const double *source) {
    lanes value;
    memcpy(&value, source, sizeof value);
    return value;
}

static inline void store(double *target, lanes value) {
    memcpy(target, &value, sizeof value);
}

/* target[r][c] -= sum of left[r][k] right[k][c] for a tile of `rows` rows and WIDTH columns. Inlined with a
 * constant number of rows, so that the tile stays in registers. */
static inline __attribute__((always_inline)) void subtract(size_t rows, size_t depth, size_t left_stride,
                                                           const double *left, const double *right,
                                                           size_t stride, double *target) {
    lanes tile[ROWS][2];
    for (size_t r = 0; r < rows; ++r) {
        tile[r][0] = load(target + r * stride);
        tile[r][1] = load(target + r * stride + LANES);
    }
    for (size_t k = 0; k < depth; ++k) {
        const lanes first = load(right + k * WIDTH), second = load(right + k * WIDTH + LANES);
        for (size_t r = 0; r < rows; ++r) {
            const double factor = left[r * left_stride + k];
            tile[r][0] -= factor * first;
            tile[r][1] -= factor * second;
        }
    }
    for (size_t r = 0; r < rows; ++r) {
        store(target + r * stride, tile[r][0]);
        store(target + r * stride + LANES, tile[r][1]);
    }
}

/* The same for one row, with only `width` columns. */
static void subtract_edge(size_t width, size_t depth, const double *left, const double *right,
                          double *target) {
    double row[WIDTH] = {0};
    memcpy(row, target, width * sizeof *row);
    subtract(1, depth, depth, left, right, WIDTH, row);
    memcpy(target, row, width * sizeof *row);
}

/* Rows `first` to `last` of the first `depth` columns, transposed, in strips of WIDTH rows; missing rows are
 * zero. */
static void pack(size_t stride, size_t depth, size_t first, size_t last, const double *a, double *packed) {
    for (size_t j = first; j < last; j += WIDTH, packed += WIDTH * depth)
        for (size_t c = 0; c < WIDTH; ++c)
            for (size_t k = 0; k < depth; ++k)
                packed[k * WIDTH + c] = j + c < last ? a[(j + c) * stride + k] : 0.0;
}

/* target[i][j] -= sum over k < depth of left[i][k] left[j][k] for i from `first` to `rows`, j from `first` to
 * i and below `last`. Entries above the diagonal are overwritten. */
typedef struct product {
    const double *left;
    size_t left_stride, depth;
    double *target;
    size_t stride, first, last, rows;
} product;

static void subtract_product(const product *p, double *packed) {
    pack(p->left_stride, p->depth, p->first, p->last, p->left, packed);
    for (size_t band = p->first; band < p->rows; band += BAND) {
        const size_t end = band + BAND < p->rows ? band + BAND : p->rows;
        for (size_t j = p->first; j < p->last && j < end; j += WIDTH) {
            const size_t width = p->last - j < WIDTH ? p->last - j : WIDTH;
            const double *const right = packed + (j - p->first) * p->depth;
            const double *const left = p->left;
            double *const target = p->target + j;
            size_t i = band;
            for (; width == WIDTH && i + ROWS <= end; i += ROWS)
                subtract(ROWS, p->depth, p->left_stride, left + i * p->left_stride, right, p->stride,
                         target + i * p->stride);
            for (; i < end; ++i)
                subtract_edge(width, p->depth, left + i * p->left_stride, right, target + i * p->stride);
        }
    }
}

/* Subtracts the contribution of the first `depth` columns from the columns up to `last` of all rows below. */
static void update(size_t stride, size_t depth, size_t last, size_t rows, double *a, double *packed) {
    const product p = {a, stride, depth, a, stride, depth, last, rows};
    subtract_product(&p, packed);
}

static void gram(size_t size, size_t depth, const double *rows, double *matrix, double *work) {
    memset(matrix, 0, size * size * sizeof *matrix);
    const size_t most = size > WIDE ? WIDE : NARROW; /* limited by the size of `work` */
    for (size_t k = 0; k < depth; k += most) {
        const product p = {rows + k, depth, depth - k < most ? depth - k : most, matrix, size, 0, size, size};
        subtract_product(&p, work);
    }
    for (size_t i = 0; i < size; ++i)
        for (size_t j = 0; j <= i; ++j)
            matrix[i * size + j] = -matrix[i * size + j];
}

/* part[k][r] = a[r][k], and back. */
static void gather(size_t stride, size_t rows, size_t columns, const double *a, double part[][GROUP]) {
    for (size_t r = 0; r < rows; ++r)
        for (size_t k = 0; k < columns; ++k)
            part[k][r] = a[r * stride + k];
}

static void scatter(size_t stride, size_t rows, size_t columns, double part[][GROUP], double *a) {
    for (size_t r = 0; r < rows; ++r)
        for (size_t k = 0; k < columns; ++k)
            a[r * stride + k] = part[k][r];
}

/* part[k][r] -= sum over m < k of top[m][k] part[m][r]. */
static inline void reduce(size_t k, double top[][GROUP], double part[][GROUP]) {
    lanes sum[GROUP / LANES];
    for (size_t v = 0; v < GROUP / LANES; ++v)
        sum[v] = load(part[k] + v * LANES);
    for (size_t m = 0; m < k; ++m)
        for (size_t v = 0; v < GROUP / LANES; ++v)
            sum[v] -= top[m][k] * load(part[m] + v * LANES);
    for (size_t v = 0; v < GROUP / LANES; ++v)
        store(part[k] + v * LANES, sum[v]);
}

/* Factors the first `columns` columns, at most NARROW, of all rows. */
static bool factor_narrow(size_t stride, size_t columns, size_t rows, double *a, double *inverse) {
    double top[NARROW][GROUP] = {{0}}, part[NARROW][GROUP] = {{0}};
    gather(stride, columns, columns, a, top);
    for (size_t k = 0; k < columns; ++k) {
        reduce(k, top, top);
        const double root = sqrt(top[k][k]);
        if (!(root > 0.0)) /* also NaN */
            return false;
        inverse[k] = 1.0 / root;
        for (size_t r = 0; r < columns; ++r)
            top[k][r] *= inverse[k];
        top[k][k] = root;
    }
    scatter(stride, columns, columns, top, a);
    for (size_t i = columns; i < rows; i += GROUP) {
        const size_t count = rows - i < GROUP ? rows - i : GROUP;
        gather(stride, count, columns, a + i * stride, part);
        for (size_t k = 0; k < columns; ++k) {
            reduce(k, top, part);
            for (size_t r = 0; r < GROUP; ++r)
                part[k][r] *= inverse[k];
        }
        scatter(stride, count, columns, part, a + i * stride);
    }
    return true;
}

static bool factor_wide(size_t stride, size_t columns, size_t rows, double *a, double *inverse,
                        double *packed) {
    for (size_t c = 0; c < columns; c += NARROW) {
        const size_t width = columns - c < NARROW ? columns - c : NARROW;
        double *const corner = a + c * stride + c;
        if (!factor_narrow(stride, width, rows - c, corner, inverse + c))
            return false;
        update(stride, width, columns - c, rows - c, corner, packed);
    }
    return true;
}

static bool factor(size_t size, double *matrix, double *inverse, double *work) {
    for (size_t c = 0; c < size; c += WIDE) {
        const size_t width = size - c < WIDE ? size - c : WIDE;
        double *const corner = matrix + c * size + c;
        if (!factor_wide(size, width, size - c, corner, inverse + c, work))
            return false;
        update(size, width, size - c, size - c, corner, work);
    }
    return true;
}

/* Sixteen running sums in a fixed order: bit-identical for all register widths. */
static double dot(size_t count, const double *a, const double *b) {
    lanes sums[SUMS / LANES] = {{0}};
    size_t j = 0;
    for (; j + SUMS <= count; j += SUMS)
        for (size_t v = 0; v < SUMS / LANES; ++v)
            sums[v] += load(a + j + v * LANES) * load(b + j + v * LANES);
    double sum[SUMS];
    memcpy(sum, sums, sizeof sum);
    for (; j < count; ++j)
        sum[j % SUMS] += a[j] * b[j];
    for (size_t half = SUMS / 2; half > 0; half /= 2)
        for (size_t v = 0; v < half; ++v)
            sum[v] += sum[v + half];
    return sum[0];
}

static void solve(size_t size, const double *matrix, const double *inverse, size_t columns, double *right) {
    for (size_t i = 0; i < size; ++i)
        for (size_t k = 0; k < columns; ++k) {
            double *const x = right + k * size;
            x[i] = (x[i] - dot(i, matrix + i * size, x)) * inverse[i];
        }
    for (size_t i = size; i-- > 0;)
        for (size_t k = 0; k < columns; ++k) {
            double *const restrict x = right + k * size;
            const double *const restrict row = matrix + i * size;
            const double value = x[i] * inverse[i];
            x[i] = value;
            for (size_t j = 0; j < i; ++j)
                x[j] -= value * row[j];
        }
}

const aur_cholesky AUR_KERNEL(aur_cholesky) = {factor, solve, gram};
