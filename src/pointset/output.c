/* From a set to the caller's buffer: ranges, capacities, layouts, floats. */
#include <math.h>

#include "pointset/set.h"

enum {
    BUFFER_LENGTH = 512,
    LEAST_PART = 128,
    PART_LENGTH = 1 << 14 /* coordinates that a first or second cache keeps until the point is whole */
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

/* A run of one coordinate as floats. */
static void fill_floats(const aur_pointset *set, aur_block block, float *out) {
    double buffer[BUFFER_LENGTH];
    const size_t stride = block.point_stride;
    const size_t count = block.count;
    const uint64_t first = block.first;
    block.data = buffer;
    block.point_stride = 1;
    for (size_t begin = 0; begin < count; begin += block.count) {
        block.first = first + begin;
        block.count = count - begin < BUFFER_LENGTH ? count - begin : BUFFER_LENGTH;
        aur_pointset_fill(set, &block);
        for (size_t i = 0; i < block.count; ++i)
            out[(begin + i) * stride] = (float)(int32_t)(buffer[i] * 0x1p24) * 0x1p-24f;
    }
}

/* Coordinates are made one after another: part by part, so that memory is passed once. */
static void fill_doubles(const aur_pointset *set, aur_block block) {
    const bool at_once = block.dimension_count == 1 || block.point_stride == 1 ||
                         (block.dimension_count == 2 && set->kind->pairs);
    const size_t room = PART_LENGTH / block.dimension_count;
    const size_t part = at_once ? block.count : room > LEAST_PART ? room : LEAST_PART;
    size_t left = block.count;
    for (; left > 0; left -= block.count) {
        block.count = left < part ? left : part;
        aur_pointset_fill(set, &block);
        block.first += block.count;
        block.data += block.count * block.point_stride;
    }
}

aur_result aur_output_check(const aur_output *output, size_t dimension, size_t count) {
    if ((output->doubles == NULL) == (output->floats == NULL) ||
        (output->layout != AUR_LAYOUT_POINTS && output->layout != AUR_LAYOUT_ARRAYS))
        return AUR_ERROR_ARGUMENT;
    if (output->layout == AUR_LAYOUT_ARRAYS && output->stride != 0 && output->stride < count)
        return AUR_ERROR_ARGUMENT;
    const size_t needed = aur_output_capacity(output->layout, dimension, count, output->stride);
    return needed == SIZE_MAX || needed > output->capacity ? AUR_ERROR_CAPACITY : AUR_OK;
}

/* Coordinates dimension .. dimension + dimension_count - 1. */
static aur_result emit(const aur_pointset *set, uint64_t seed, size_t dimension, size_t dimension_count,
                       uint64_t first, size_t count, const aur_output *output) {
    if (first > set->size || count > set->size - first)
        return AUR_ERROR_ARGUMENT;
    const aur_result result = aur_output_check(output, dimension_count, count);
    if (result != AUR_OK || count == 0 || dimension_count == 0)
        return result;
    const bool arrays = output->layout == AUR_LAYOUT_ARRAYS;
    aur_block block = {.first = first,
                       .count = count,
                       .first_dimension = dimension,
                       .dimension_count = dimension_count,
                       .point_stride = arrays ? 1 : dimension_count,
                       .coordinate_stride = !arrays               ? 1
                                            : output->stride != 0 ? output->stride
                                                                  : count,
                       .seed = seed,
                       .data = output->doubles};
    if (output->doubles != NULL) {
        fill_doubles(set, block);
        return AUR_OK;
    }
    block.dimension_count = 1;
    for (size_t d = 0; d < dimension_count; ++d) {
        block.first_dimension = dimension + d;
        fill_floats(set, block, output->floats + d * block.coordinate_stride);
    }
    return AUR_OK;
}

aur_result aur_pointset_emit(const aur_pointset *set, uint64_t seed, uint64_t first, size_t count,
                             const aur_output *output) {
    return emit(set, seed, 0, set->dimension, first, count, output);
}

aur_result aur_pointset_coordinates(const aur_pointset *pointset, size_t dimension, size_t dimension_count,
                                    uint64_t first, size_t count, const aur_output *output) {
    if (dimension > pointset->dimension || dimension_count > pointset->dimension - dimension)
        return AUR_ERROR_ARGUMENT;
    return emit(pointset, pointset->seed, dimension, dimension_count, first, count, output);
}

aur_result aur_pointset_generate(const aur_pointset *pointset, uint64_t first, size_t count,
                                 const aur_output *output) {
    return aur_pointset_emit(pointset, pointset->seed, first, count, output);
}

aur_result aur_pointset_randomize(const aur_pointset *pointset, uint64_t seed, uint64_t first, size_t count,
                                  const aur_output *output) {
    if (pointset->scramble == AUR_SCRAMBLE_NONE)
        return AUR_ERROR_UNSUPPORTED;
    return aur_pointset_emit(pointset, seed, first, count, output);
}

aur_result aur_pointset_points(const aur_pointset *pointset, uint64_t first, size_t count, size_t capacity,
                               double *points) {
    return aur_pointset_generate(pointset, first, count,
                                 &(aur_output){.capacity = capacity, .doubles = points});
}

double aur_pointset_coordinate(const aur_pointset *pointset, uint64_t index, size_t dimension) {
    if (index >= pointset->size || dimension >= pointset->dimension)
        return NAN;
    double value;
    aur_pointset_fill(pointset, &(aur_block){.first = index,
                                             .count = 1,
                                             .first_dimension = dimension,
                                             .dimension_count = 1,
                                             .point_stride = 1,
                                             .coordinate_stride = 1,
                                             .seed = pointset->seed,
                                             .data = &value});
    return value;
}
