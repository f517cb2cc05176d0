/* A grid of values in the unit cube, in Mitsuba's file format: "VOL", the version 3, a type (1: floats), the
 * counts along x, y and z, the number of channels (1 or 3), a bounding box of six floats, and the values, x
 * fastest and channels interleaved. All numbers are little-endian; integers have 4 bytes. */
#include <stdlib.h>
#include <string.h>

#include "points/base/file.h"
#include "render/scene/transform.h"
#include "render/scene/volume.h"

typedef enum grid_filter { FILTER_TRILINEAR, FILTER_NEAREST } grid_filter;
typedef enum grid_wrap { WRAP_CLAMP, WRAP_REPEAT, WRAP_MIRROR } grid_wrap;

typedef struct grid {
    aur_transform to_world;
    grid_filter filter;
    grid_wrap wrap;
    bool use_grid_bbox;
    int32_t size[3];
    int32_t channels;
    char *file;
    const float *values; /* offset in `file` */
} grid;

static const aur_key keys[] = {
    {AUR_KEY_READ_APART(AUR_KEY_TEXT, "filename", NULL, "a .vol file")},
    {AUR_KEY_OF_CHOICE(grid, "filter_type", filter, "trilinear", "between the middles of voxels", "trilinear",
                       "nearest")},
    {AUR_KEY_OF_CHOICE(grid, "wrap_mode", wrap, "clamp", "outside of the grid", "clamp", "repeat", "mirror")},
    {AUR_KEY_OF_BOOLEAN(grid, "use_grid_bbox", use_grid_bbox, "false",
                        "use the bounding box of the file instead of the unit cube")},
    {AUR_KEY_OF_TRANSFORM(grid, "to_world", to_world, "from the unit cube or that box to the scene")},
};

enum { HEAD = 48, MOST_ALONG = 1 << 16 };
static const size_t MOST_BYTES = (size_t)1 << 36;

static int32_t integer_at(const char *file, size_t offset) {
    int32_t value;
    memcpy(&value, file + offset, sizeof value);
    return value;
}

/* Describes what is wrong with a file, or NULL. */
static const char *check(const char *file, size_t bytes, grid *self) {
    if (bytes < HEAD || memcmp(file, "VOL", 3) != 0)
        return "not a .vol file";
    if (file[3] != 3)
        return "its version must be 3";
    if (integer_at(file, 4) != 1)
        return "its type must be 1, floats";
    size_t count = 1;
    for (size_t k = 0; k < 3; ++k) {
        self->size[k] = integer_at(file, 8 + 4 * k);
        if (self->size[k] < 1 || self->size[k] > MOST_ALONG)
            return "each side must have 1 to 65536 voxels";
        count *= (size_t)self->size[k];
    }
    self->channels = integer_at(file, 20);
    if (self->channels != 1 && self->channels != 3)
        return "it must have 1 or 3 channels";
    count *= (size_t)self->channels;
    if (count != (bytes - HEAD) / sizeof(float) || (bytes - HEAD) % sizeof(float) != 0)
        return "its size is not what its head says";
    const float *const values = (const float *)(const void *)(file + HEAD);
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(values[i]))
            return "a value is not finite";
    self->values = values;
    return NULL;
}

/* From the grid's unit cube to the scene. */
static aur_result place(const aur_parameters *parameters, grid *self, aur_volume *volume, aur_error *error) {
    aur_transform to_grid = aur_transform_identity();
    if (self->use_grid_bbox) {
        float box[6];
        memcpy(box, self->file + 24, sizeof box);
        for (size_t k = 0; k < 3; ++k) {
            to_grid.m[5 * k] = (double)box[3 + k] - (double)box[k];
            to_grid.m[4 * k + 3] = (double)box[k];
            if (!(to_grid.m[5 * k] > 0.0) || !isfinite(to_grid.m[5 * k]))
                return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                           "the box in the file is empty: leave 'use_grid_bbox' out");
        }
    }
    volume->to_world = aur_transform_multiply(&self->to_world, &to_grid);
    aur_transform to_local;
    return aur_to_world_check(parameters, &volume->to_world, &to_local, error);
}

static aur_result create(aur_parameters *parameters, aur_volume *volume, aur_error *error) {
    grid *const self = volume->data;
    const aur_parameter *const name = aur_parameters_find(parameters, "filename");
    if (name == NULL || name->text == NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs a 'filename'");
    size_t bytes;
    aur_result result = aur_file_read(name->text, MOST_BYTES, &self->file, &bytes, error);
    if (result != AUR_OK)
        return result;
    const char *const wrong = check(self->file, bytes, self);
    if (wrong != NULL)
        return aur_fail_at(error, name->location, AUR_ERROR_FORMAT, "volume 'gridvolume': '%s': %s",
                           name->text, wrong);
    volume->minimum = INFINITY;
    volume->maximum = -INFINITY;
    for (size_t i = 0; i < (bytes - HEAD) / sizeof(float); ++i) {
        volume->minimum = aur_smaller(volume->minimum, self->values[i]);
        volume->maximum = aur_larger(volume->maximum, self->values[i]);
    }
    for (size_t k = 0; k < 3; ++k)
        volume->voxels[k] = (size_t)self->size[k];
    return place(parameters, self, volume, error);
}

static void release(void *data) {
    free(((grid *)data)->file);
}

/* Clamps or wraps a voxel index that may be out of range. */
static size_t wrapped(grid_wrap wrap, int32_t index, int32_t count) {
    if (index >= 0 && index < count)
        return (size_t)index;
    if (wrap == WRAP_CLAMP)
        return index < 0 ? 0 : (size_t)(count - 1);
    const int32_t period = wrap == WRAP_REPEAT ? count : 2 * count;
    const int32_t inside = (index % period + period) % period;
    return (size_t)(inside < count ? inside : period - 1 - inside);
}

static aur_vector voxel(const grid *self, size_t x, size_t y, size_t z) {
    const size_t index = (z * (size_t)self->size[1] + y) * (size_t)self->size[0] + x;
    const float *const value = &self->values[index * (size_t)self->channels];
    return self->channels == 1 ? (aur_vector){value[0], value[0], value[0]}
                               : (aur_vector){value[0], value[1], value[2]};
}

static aur_vector mix(aur_vector a, aur_vector b, float share) {
    return aur_vector_add_scaled(a, share, aur_vector_subtract(b, a));
}

static aur_vector evaluate(const aur_volume *volume, aur_vector position) {
    const grid *const self = volume->data;
    const aur_vector local = aur_volume_local(volume, position);
    const float at[3] = {local.x, local.y, local.z};
    size_t low[3], high[3];
    float share[3];
    for (size_t k = 0; k < 3; ++k) {
        /* Clamps the position, so that the index fits an integer. */
        const float middle = self->filter == FILTER_TRILINEAR ? 0.5f : 0.0f;
        const float scaled = at[k] * (float)self->size[k] - middle;
        const float cell = floorf(aur_smaller(aur_larger(scaled, -1e6f), 1e6f));
        share[k] = aur_smaller(aur_larger(scaled - cell, 0.0f), 1.0f);
        low[k] = wrapped(self->wrap, (int32_t)cell, self->size[k]);
        high[k] = wrapped(self->wrap, (int32_t)cell + 1, self->size[k]);
    }
    if (self->filter == FILTER_NEAREST)
        return voxel(self, low[0], low[1], low[2]);
    aur_vector plane[2];
    for (size_t k = 0; k < 2; ++k) {
        const size_t z = k == 0 ? low[2] : high[2];
        const aur_vector below =
            mix(voxel(self, low[0], low[1], z), voxel(self, high[0], low[1], z), share[0]);
        const aur_vector above =
            mix(voxel(self, low[0], high[1], z), voxel(self, high[0], high[1], z), share[0]);
        plane[k] = mix(below, above, share[1]);
    }
    return mix(plane[0], plane[1], share[2]);
}

static float maximum_within(const aur_volume *volume, const float lower[3], const float upper[3]) {
    const grid *const self = volume->data;
    int32_t first[3], last[3];
    for (size_t k = 0; k < 3; ++k) {
        /* With a margin, since positions are rounded. */
        const float count = (float)self->size[k], middle = self->filter == FILTER_TRILINEAR ? 0.5f : 0.0f;
        first[k] = (int32_t)floorf(lower[k] * count - middle - 0.01f);
        last[k] = (int32_t)floorf(upper[k] * count - middle + 0.01f) + (self->filter == FILTER_TRILINEAR);
    }
    float largest = 0.0f;
    for (int32_t z = first[2]; z <= last[2]; ++z)
        for (int32_t y = first[1]; y <= last[1]; ++y)
            for (int32_t x = first[0]; x <= last[0]; ++x)
                largest =
                    aur_larger(largest, aur_vector_max(voxel(self, wrapped(self->wrap, x, self->size[0]),
                                                             wrapped(self->wrap, y, self->size[1]),
                                                             wrapped(self->wrap, z, self->size[2]))));
    return largest;
}

const aur_volume_descriptor aur_volume_gridvolume = {
    .row = {.name = "gridvolume",
            .summary = "values on a grid, from a file",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(grid),
    .create = create,
    .release = release,
    .evaluate = evaluate,
    .maximum_within = maximum_within,
};
