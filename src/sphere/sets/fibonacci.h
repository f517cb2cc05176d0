/* Spherical Fibonacci points from their index. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Point j has 1 - z = (j + offset) * step and the azimuth phase + j/Phi. */
typedef struct aur_fibonacci {
    double step, offset;
    uint64_t phase;
} aur_fibonacci;

/* Points first .. first+count-1 as x,y,z triples. */
typedef void (*aur_fibonacci_kernel)(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);

/* The kernel for this processor; all give the same bits. */
aur_fibonacci_kernel aur_fibonacci_choose_kernel(void);

/* What it chooses from: no kernel fuses a multiplication and an addition. */
void aur_fibonacci_points_portable(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);
void aur_fibonacci_points_avx2(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);
void aur_fibonacci_points_avx512(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);

/* Bytes from which on the caches cannot hold the points, so that they are streamed past them. */
enum { AUR_FIBONACCI_STREAM_BYTES = 8 << 20 };
