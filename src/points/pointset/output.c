/* From a set to the caller's buffer: ranges, capacities, layouts, floats. */
#include <inttypes.h>
#include <math.h>

#include "points/pointset/runs.h"
#include "points/pointset/set.h"

enum {
    BUFFER_LENGTH = 512,
    PART_LENGTH = 1 << 12, /* coordinates that fit the first-level cache until their points are complete */
    LEAST_PART = 128,
    LEAST_PAIRS = 48,      /* fewer do not use the vector kernels */
    STREAM_BYTES = 4 << 20 /* larger outputs bypass the caches */
};

size_t aur_output_capacity(aur_layout layout, size_t dimension, size_t count, size_t stride) {
    if (dimension == 0 || count == 0)
        return 0;
    if (layout == AUR_LAYOUT_POINTS)
        return count > SIZE_MAX / dimension ? SIZE_MAX : count * dimension;
    if (stride == 0)
        stride = count;
    if (stride < count || (dimension > 1 && stride > (SIZE_MAX - count) / (dimension - 1)))
        return SIZE_MAX;
    return (dimension - 1) * stride + count;
}

void aur_output_put(const aur_output *output, aur_strides strides, size_t first, size_t count,
                    const double *values) {
    if (output->doubles != NULL) {
        double *const out = output->doubles + first * strides.point;
        for (size_t i = 0; i < count; ++i)
            out[i * strides.point] = values[i];
        return;
    }
    float *const out = output->floats + first * strides.point;
    for (size_t i = 0; i < count; ++i)
        out[i * strides.point] = (float)(int32_t)(values[i] * 0x1p24) * 0x1p-24f;
}

size_t aur_output_stream_start(size_t count, const double *points) {
    enum { POINT_BYTES = 2 * sizeof *points };
    const size_t beyond = (uintptr_t)points % 64;
    if (count <= STREAM_BYTES / POINT_BYTES || beyond % POINT_BYTES != 0)
        return SIZE_MAX;
    return beyond == 0 ? 0 : (64 - beyond) / POINT_BYTES;
}

/* A run of one coordinate as floats. */
static void fill_floats(const aur_pointset *set, aur_block block, float *out, size_t stride) {
    double buffer[BUFFER_LENGTH];
    const size_t count = block.count;
    const uint64_t first = block.first;
    const aur_output output = {.floats = out};
    block.data = buffer;
    for (size_t begin = 0; begin < count; begin += block.count) {
        block.first = first + begin;
        block.count = count - begin < BUFFER_LENGTH ? count - begin : BUFFER_LENGTH;
        aur_pointset_fill(set, &block);
        aur_output_put(&output, (aur_strides){stride, 1}, begin, block.count, buffer);
    }
}

/* Points of two coordinates. */
static void fill_pairs(const aur_pointset *set, aur_block block) {
    double buffer[PART_LENGTH];
    const size_t start = aur_output_stream_start(block.count, block.data);
    double *out = block.data;
    const size_t all = block.count;
    block.data = buffer;
    block.coordinate_stride = PART_LENGTH / 2;
    for (size_t done = 0; done < all; done += block.count) {
        const size_t most = done < start && start < PART_LENGTH / 2 ? start - done : PART_LENGTH / 2;
        block.count = all - done < most ? all - done : most;
        aur_pointset_fill(set, &block);
        aur_runs(SIZE_MAX)->pairs(block.count, buffer, buffer + PART_LENGTH / 2, done >= start, out);
        block.first += block.count;
        out += 2 * block.count;
    }
    aur_runs(SIZE_MAX)->end_stream();
}

/* Points of any number of coordinates, computed one coordinate after another, in parts. */
static void fill_points(const aur_pointset *set, aur_block block) {
    double buffer[PART_LENGTH];
    double *const out = block.data;
    const aur_block all = block;
    const size_t room = PART_LENGTH / all.dimension_count;
    const size_t part = room > LEAST_PART ? room : LEAST_PART;
    const size_t width = PART_LENGTH / part;
    block.data = buffer;
    block.coordinate_stride = part;
    for (size_t begin = 0; begin < all.count; begin += part) {
        block.first = all.first + begin;
        block.count = all.count - begin < part ? all.count - begin : part;
        for (size_t d = 0; d < all.dimension_count; d += width) {
            block.first_dimension = all.first_dimension + d;
            block.dimension_count = all.dimension_count - d < width ? all.dimension_count - d : width;
            aur_pointset_fill(set, &block);
            for (size_t i = 0; i < block.count; ++i)
                for (size_t k = 0; k < block.dimension_count; ++k)
                    out[(begin + i) * all.dimension_count + d + k] = buffer[k * part + i];
        }
    }
}

static void fill_doubles(const aur_pointset *set, const aur_block *block, size_t point_stride) {
    const bool shifted =
        set->scramble == AUR_SCRAMBLE_SHIFT || set->scramble == AUR_SCRAMBLE_ROTATE || set->fold;
    const bool whole = set->kind->fill_pairs != NULL && block->first_dimension == 0 && !shifted &&
                       block->count >= LEAST_PAIRS;
    if (point_stride == 1)
        aur_pointset_fill(set, block);
    else if (block->dimension_count != 2)
        fill_points(set, *block);
    else if (!whole || !set->kind->fill_pairs(set, block))
        fill_pairs(set, *block);
}

aur_result aur_check_range(uint64_t size, uint64_t first, uint64_t count, aur_error *error) {
    if (first <= size && count <= size - first)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT,
                    "a set of %" PRIu64 " points has no points %" PRIu64 " to %" PRIu64, size, first,
                    first + (count > 0 ? count - 1 : 0));
}

aur_result aur_output_open(const aur_output *output, size_t dimension, size_t count, aur_strides *strides,
                           aur_error *error) {
    const bool arrays = output->layout == AUR_LAYOUT_ARRAYS;
    if ((output->doubles == NULL) == (output->floats == NULL))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an output has either doubles or floats");
    if (!arrays && output->layout != AUR_LAYOUT_POINTS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%d is not a layout", (int)output->layout);
    if (arrays && output->stride != 0 && output->stride < count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a stride of %zu is too short for %zu points",
                        output->stride, count);
    const size_t needed = aur_output_capacity(output->layout, dimension, count, output->stride);
    if (needed == SIZE_MAX || needed > output->capacity)
        return aur_fail(error, AUR_ERROR_CAPACITY,
                        "%zu points of %zu coordinates do not fit into %zu elements", count, dimension,
                        output->capacity);
    *strides =
        arrays ? (aur_strides){1, output->stride != 0 ? output->stride : count} : (aur_strides){dimension, 1};
    return AUR_OK;
}

/* Coordinates dimension .. dimension + dimension_count - 1. */
static aur_result emit(const aur_pointset *set, uint64_t seed, size_t dimension, size_t dimension_count,
                       uint64_t first, size_t count, const aur_output *output, aur_error *error) {
    aur_strides strides;
    aur_result result = aur_check_range(set->size, first, count, error);
    if (result == AUR_OK)
        result = aur_output_open(output, dimension_count, count, &strides, error);
    if (result != AUR_OK || count == 0 || dimension_count == 0)
        return result;
    aur_block block = {.first = first,
                       .count = count,
                       .first_dimension = dimension,
                       .dimension_count = dimension_count,
                       .coordinate_stride = strides.coordinate,
                       .seed = seed,
                       .data = output->doubles};
    if (output->doubles != NULL) {
        fill_doubles(set, &block, strides.point);
        return AUR_OK;
    }
    block.dimension_count = 1;
    for (size_t d = 0; d < dimension_count; ++d) {
        block.first_dimension = dimension + d;
        fill_floats(set, block, output->floats + d * strides.coordinate, strides.point);
    }
    return AUR_OK;
}

aur_result aur_pointset_emit(const aur_pointset *set, uint64_t seed, uint64_t first, size_t count,
                             const aur_output *output, aur_error *error) {
    return emit(set, seed, 0, set->dimension, first, count, output, error);
}

aur_result aur_pointset_coordinates(const aur_pointset *pointset, size_t dimension, size_t dimension_count,
                                    uint64_t first, size_t count, const aur_output *output,
                                    aur_error *error) {
    if (dimension > pointset->dimension || dimension_count > pointset->dimension - dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a set of %zu dimensions has no %zu of them from dimension %zu on",
                        pointset->dimension, dimension_count, dimension);
    return emit(pointset, pointset->seed, dimension, dimension_count, first, count, output, error);
}

aur_result aur_pointset_randomize(const aur_pointset *pointset, uint64_t seed, uint64_t first, size_t count,
                                  const aur_output *output, aur_error *error) {
    if (pointset->scramble == AUR_SCRAMBLE_NONE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a set that is not scrambled has no other scramblings");
    return aur_pointset_emit(pointset, seed, first, count, output, error);
}

aur_result aur_pointset_points(const aur_pointset *pointset, uint64_t first, size_t count, size_t capacity,
                               double *points, aur_error *error) {
    return aur_pointset_emit(pointset, pointset->seed, first, count,
                             &(aur_output){.capacity = capacity, .doubles = points}, error);
}

double aur_pointset_coordinate(const aur_pointset *pointset, uint64_t index, size_t dimension) {
    if (index >= pointset->size || dimension >= pointset->dimension)
        return NAN;
    double value;
    aur_pointset_fill(pointset, &(aur_block){.first = index,
                                             .count = 1,
                                             .first_dimension = dimension,
                                             .dimension_count = 1,
                                             .coordinate_stride = 1,
                                             .seed = pointset->seed,
                                             .data = &value});
    return value;
}
