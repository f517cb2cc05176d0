/* The same points from three instruction sets, bit for bit: no kernel fuses a multiplication and an addition.
 */
#pragma once

#include "sphere/sets/fibonacci.h"

void aur_fibonacci_points_portable(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);
void aur_fibonacci_points_avx2(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);
void aur_fibonacci_points_avx512(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);

/* Bytes from which on the caches cannot hold the points, so that they are streamed past them. */
enum { AUR_FIBONACCI_STREAM_BYTES = 8 << 20 };
