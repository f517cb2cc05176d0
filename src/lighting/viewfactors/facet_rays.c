#include "lighting/viewfactors/facet_rays.h"

#include <aureole/pointset.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/covers.h"
#include "points/base/random.h"
#include "render/trace/packet.h"

enum { DIMENSIONS = 4, LANES = AUR_PACKET_SIZE };

typedef struct ordered_point {
    uint32_t key, index;
} ordered_point;

static int compare_points(const void *left, const void *right) {
    const ordered_point *const a = left, *const b = right;
    if (a->key != b->key)
        return a->key < b->key ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

/* Interleaves the bits of x with zeros. */
static uint32_t spread_bits(uint32_t x) {
    x = (x | x << 4) & 0x0f0fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
}

/* The position on the disk along a Morton curve. */
static uint32_t direction_key(double u, double v) {
    const double radius = sqrt(u), angle = 2.0 * AUR_PI * v;
    const uint32_t x = (uint32_t)(127.5 * (1.0 + radius * cos(angle)));
    const uint32_t y = (uint32_t)(127.5 * (1.0 + radius * sin(angle)));
    return spread_bits(x) | spread_bits(y) << 1;
}

aur_result aur_facet_points(const char *set, size_t count, uint64_t seed, double *points, aur_error *error) {
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset_options_init(count, &options, NULL);
    options.dimension = DIMENSIONS;
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.seed = seed;
    aur_pointset *generator = NULL;
    aur_result result = aur_pointset_create(set, &options, &generator, error);
    if (result == AUR_ERROR_UNSUPPORTED) { /* a set without scrambling: the random shifts suffice */
        options.scramble = AUR_SCRAMBLE_NONE;
        result = aur_pointset_create(set, &options, &generator, error);
    }
    if (result == AUR_OK && aur_pointset_dimension(generator) < DIMENSIONS)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' has no four dimensions", set);
    if (result == AUR_OK)
        result = aur_pointset_points(generator, 0, count, DIMENSIONS * count, points, error);
    aur_pointset_destroy(generator);
    return result;
}

static void fill_pattern(const double *points, const ordered_point *order, aur_facet_pattern *pattern) {
    for (size_t i = 0; i < pattern->count; ++i) {
        const double *const point = &points[DIMENSIONS * order[i].index];
        const double angle = 2.0 * AUR_PI * point[1];
        pattern->squared[i] = (float)point[0];
        pattern->around[0][i] = (float)cos(angle);
        pattern->around[1][i] = (float)sin(angle);
        pattern->origins[0][i] = (float)point[2];
        pattern->origins[1][i] = (float)point[3];
    }
}

aur_result aur_facet_pattern_create(const char *set, size_t count, uint64_t seed, aur_facet_pattern *pattern,
                                    aur_error *error) {
    *pattern = (aur_facet_pattern){.count = count, .seed = seed};
    double *const points = malloc(DIMENSIONS * count * sizeof *points);
    ordered_point *const order = malloc(count * sizeof *order);
    float *const numbers = calloc(5 * count, sizeof *numbers);
    aur_result result = AUR_OK;
    if (points == NULL || order == NULL || numbers == NULL)
        result = aur_fail_memory(error);
    if (result == AUR_OK)
        result = aur_facet_points(set, count, seed, points, error);
    if (result == AUR_OK) {
        for (size_t i = 0; i < count; ++i)
            order[i] = (ordered_point){direction_key(points[DIMENSIONS * i], points[DIMENSIONS * i + 1]),
                                       (uint32_t)i};
        qsort(order, count, sizeof *order, compare_points);
        pattern->squared = numbers;
        for (size_t d = 0; d < 2; ++d) {
            pattern->origins[d] = numbers + (1 + d) * count;
            pattern->around[d] = numbers + (3 + d) * count;
        }
        fill_pattern(points, order, pattern);
    } else {
        free(numbers);
    }
    free(points);
    free(order);
    return result;
}

void aur_facet_pattern_release(aur_facet_pattern *pattern) {
    free(pattern->squared);
    *pattern = (aur_facet_pattern){0};
}

/* A patch as the origin of rays. */
typedef struct emitter {
    float corner[3], edge[2][3], normal[3], axis[2][3];
    float inset;  /* barycentric: offset of origins from the edges, where other facets begin */
    float offset; /* offset of origins from the facet */
} emitter;

/* A few rounding errors of the coordinates, relative to the height of the farthest corner over an edge. */
float aur_facet_inset(const aur_facets *facets, size_t facet) {
    double size = 0.0, longest = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const double *const a = facets->corners[facet][c], *const b = facets->corners[facet][(c + 1) % 3];
        double edge[3];
        for (int d = 0; d < 3; ++d) {
            edge[d] = b[d] - a[d];
            size = fmax(size, fabs(a[d]));
        }
        longest = fmax(longest, aur_length3(edge));
    }
    const double height = 2.0 * facets->areas[facet] / longest;
    return (float)fmin(1e-6 + 4e-7 * size / height, 0.01);
}

static void make_emitter(const aur_facets *facets, size_t patch, double turn, emitter *e) {
    double corners[3][3], x[3], y[3];
    aur_patch_corners(facets, patch, corners);
    const aur_plane plane = aur_patch_plane(facets, patch);
    aur_frame3(plane.normal, x, y);
    e->inset = aur_facet_inset(facets, aur_facet_of(facets, patch));
    e->offset = aur_facet_offset(facets, aur_facet_of(facets, patch));
    const double c = cos(2.0 * AUR_PI * turn), s = sin(2.0 * AUR_PI * turn);
    for (int d = 0; d < 3; ++d) {
        e->corner[d] = (float)corners[0][d];
        e->edge[0][d] = (float)(corners[1][d] - corners[0][d]);
        e->edge[1][d] = (float)(corners[2][d] - corners[0][d]);
        e->normal[d] = (float)plane.normal[d];
        e->axis[0][d] = (float)(c * x[d] + s * y[d]);
        e->axis[1][d] = (float)(c * y[d] - s * x[d]);
    }
}

/* x + shift modulo 1, for both in [0,1). */
static inline float shifted(float x, float shift) {
    const float sum = x + shift;
    return sum >= 1.0f ? sum - 1.0f : sum;
}

static void fill_packet(const aur_facet_pattern *pattern, const emitter *e, const float shift[3],
                        size_t first, struct RTCRay16 *rays) {
    for (size_t k = 0; k < LANES; ++k) {
        const size_t i = first + k < pattern->count ? first + k : pattern->count - 1;
        const float root = sqrtf(shifted(pattern->origins[0][i], shift[0]));
        float v = root * shifted(pattern->origins[1][i], shift[1]), u = root - v;
        u += e->inset * (1.0f - 3.0f * u);
        v += e->inset * (1.0f - 3.0f * v);
        float origin[3];
        for (int d = 0; d < 3; ++d)
            origin[d] = e->corner[d] + u * e->edge[0][d] + v * e->edge[1][d];
        const float squared = shifted(pattern->squared[i], shift[2]);
        const float sine = sqrtf(squared), cosine = sqrtf(aur_larger(1.0f - squared, 1e-12f));
        const float a = sine * pattern->around[0][i], b = sine * pattern->around[1][i];
        rays->org_x[k] = origin[0] + e->offset * e->normal[0];
        rays->org_y[k] = origin[1] + e->offset * e->normal[1];
        rays->org_z[k] = origin[2] + e->offset * e->normal[2];
        rays->dir_x[k] = a * e->axis[0][0] + b * e->axis[1][0] + cosine * e->normal[0];
        rays->dir_y[k] = a * e->axis[0][1] + b * e->axis[1][1] + cosine * e->normal[1];
        rays->dir_z[k] = a * e->axis[0][2] + b * e->axis[1][2] + cosine * e->normal[2];
        rays->tnear[k] = 0.0f;
        rays->tfar[k] = INFINITY;
    }
}

/* The target of a ray of `patch`; `hit`: the ray hits a surface in float precision. */
static uint32_t find_target(const aur_facets *facets, size_t patch, const aur_packet *packet, size_t lane,
                            bool hit) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    const struct RTCRay16 *const rays = &packet->query.ray;
    const double direction[3] = {(double)rays->dir_x[lane], (double)rays->dir_y[lane],
                                 (double)rays->dir_z[lane]};
    size_t facet = hit ? facets->first[hits->geomID[lane]] + hits->primID[lane] : SIZE_MAX;
    if (facets->cover_starts != NULL) { /* from the point on the facet, without offset */
        const aur_plane *const plane = &facets->planes[aur_facet_of(facets, patch)];
        double origin[3] = {(double)rays->org_x[lane], (double)rays->org_y[lane], (double)rays->org_z[lane]};
        const double height = aur_plane_height(plane, origin);
        for (int d = 0; d < 3; ++d)
            origin[d] -= height * plane->normal[d];
        facet = aur_facets_first_met(facets, aur_facet_of(facets, patch), origin, direction, facet);
    }
    if (facet == SIZE_MAX)
        return AUR_TARGET_SKY;
    if (facets->areas[facet] > 0.0 && aur_dot3(direction, facets->planes[facet].normal) < 0.0)
        return (uint32_t)facet;
    if (facets->patch_count > facets->count && facets->areas[facet] > 0.0)
        return (uint32_t)(facets->count + facet);
    if (facets->opposite_starts == NULL)
        return AUR_TARGET_BACK;
    const double far = (double)rays->tfar[lane];
    const double point[3] = {(double)rays->org_x[lane] + far * direction[0],
                             (double)rays->org_y[lane] + far * direction[1],
                             (double)rays->org_z[lane] + far * direction[2]};
    const size_t other = aur_facets_other_side(facets, facet, point);
    return other != SIZE_MAX ? (uint32_t)other : AUR_TARGET_BACK;
}

void aur_facet_trace(const aur_facets *facets, const aur_facet_pattern *pattern, size_t patch,
                     uint64_t randomization, const double *along, uint32_t *targets) {
    const uint64_t hash = aur_hash4(pattern->seed, UINT64_C(0x6661636574), patch, randomization);
    float shift[3];
    for (size_t d = 0; d < 3; ++d)
        shift[d] = aur_unit_float((uint32_t)(aur_hash2(hash, d) >> 32));
    emitter e;
    make_emitter(facets, patch, aur_unit_double(aur_hash2(hash, 3)), &e);
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t first = 0; first < pattern->count; first += LANES) {
        fill_packet(pattern, &e, shift, first, &packet.query.ray);
        for (size_t k = 0; along != NULL && k < LANES; ++k) {
            packet.query.ray.dir_x[k] = (float)along[0];
            packet.query.ray.dir_y[k] = (float)along[1];
            packet.query.ray.dir_z[k] = (float)along[2];
        }
        for (size_t k = 0; k < LANES; ++k)
            packet.valid[k] = first + k < pattern->count ? -1 : 0;
        const uint32_t found = aur_scene_intersect16(facets->scene, AUR_EMBREE_COHERENT, &packet);
        for (size_t k = 0; k < LANES && first + k < pattern->count; ++k)
            targets[first + k] = find_target(facets, patch, &packet, k, (found >> k & 1u) != 0);
    }
}
