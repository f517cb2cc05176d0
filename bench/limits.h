/* Upper limits of the machine. Each uses the widest instruction set that aur_isa_available() reports;
 * Embree's kernels are limited to the same one. The comment at a limit gives its `units`: bytes, flops, pairs
 * or rays. */
#pragma once

#include "bench.h"

typedef struct bench_limit {
    const char *name;
    const char *unit; /* unit for bench_print_*, and its scale */
    double scale;
    bool (*open)(const struct bench_limit *limit, const bench_options *options, bench_work *work);
    void (*close)(bench_work *work);
    int form; /* parameter of open() */
} bench_limit;

/* open() allocates and fills the data; false after bench_fail. close() frees it. */
bool bench_limit_open(const bench_limit *limit, const bench_options *options, bench_work *work);
void bench_limit_close(const bench_limit *limit, bench_work *work);

/* Measures `subject`, which has the limit's units, against the limit and prints one line. */
bool bench_against(const bench_options *options, const char *name, const bench_work *subject,
                   const bench_limit *limit);

/* Measures two limits against each other and prints one line. */
typedef struct bench_limit_pair {
    const bench_limit *subject, *against;
} bench_limit_pair;
bool bench_limit_compare(const bench_options *options, const bench_limit_pair *pair);

/* One thread writes, reads or copies doubles. Units: bytes written, read, or written by the copy. In memory:
 * 256 MiB (16 when quick); in cache: 16 KiB. `stream` uses non-temporal stores. */
extern const bench_limit bench_limit_fill_memory;
extern const bench_limit bench_limit_fill_memory_stream;
extern const bench_limit bench_limit_fill_cache;
extern const bench_limit bench_limit_copy_memory;
extern const bench_limit bench_limit_copy_memory_stream;
extern const bench_limit bench_limit_read_memory;
extern const bench_limit bench_limit_read_cache;

/* Fused multiply-adds in registers on one thread, two flops each. */
extern const bench_limit bench_limit_fma_f32;
extern const bench_limit bench_limit_fma_f64;

/* Sum of distances |a - b| over pairs of points on the sphere in the first-level cache, with the hardware's
 * square root: three subtractions, three multiplications, two additions, root, sum. Units: pairs. */
extern const bench_limit bench_limit_pairs_f32;
extern const bench_limit bench_limit_pairs_f64;

/* Embree alone on one thread: closest hits (or any hit: `occluded`) of stored rays in a closed box of 12
 * triangles and in a room with a bumpy sphere of 500,000 triangles (5,000 when quick). `primary` rays leave
 * one point through neighboring pixels; `secondary` rays leave surfaces with a cosine distribution. `packet`:
 * packets of the SIMD width (16, 8 or 4), coherent for primary rays. Units: rays. */
extern const bench_limit bench_limit_rays_box_primary;
extern const bench_limit bench_limit_rays_box_primary_packet;
extern const bench_limit bench_limit_rays_box_secondary;
extern const bench_limit bench_limit_rays_box_secondary_packet;
extern const bench_limit bench_limit_rays_box_occluded;
extern const bench_limit bench_limit_rays_box_occluded_packet;
extern const bench_limit bench_limit_rays_bumpy_primary;
extern const bench_limit bench_limit_rays_bumpy_primary_packet;
extern const bench_limit bench_limit_rays_bumpy_secondary;
extern const bench_limit bench_limit_rays_bumpy_secondary_packet;
extern const bench_limit bench_limit_rays_bumpy_occluded;
extern const bench_limit bench_limit_rays_bumpy_occluded_packet;
