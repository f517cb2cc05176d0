#include "trace.h"

#include <math.h>
#include <string.h>

#include "points/base/random.h"

struct RTCRayHit bench_query(const aur_ray *ray) {
    struct RTCRayHit query = {.ray = {.org_x = ray->origin.x,
                                      .org_y = ray->origin.y,
                                      .org_z = ray->origin.z,
                                      .tnear = ray->nearest,
                                      .dir_x = ray->direction.x,
                                      .dir_y = ray->direction.y,
                                      .dir_z = ray->direction.z,
                                      .tfar = ray->farthest,
                                      .mask = UINT32_MAX}};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

size_t bench_trace_single(const bench_rays *rays) {
    size_t hits = 0;
    for (size_t i = 0; i < rays->count; ++i) {
        struct RTCRayHit query = bench_query(&rays->rays[i]);
        if (rays->occluded)
            aur_embree_occluded1(rays->scene, &query.ray);
        else
            aur_embree_intersect1(rays->scene, &query);
        hits += rays->occluded ? query.ray.tfar < 0.0f : query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

size_t bench_trace_packets(const bench_rays *rays) {
    static const _Alignas(64) int valid[BENCH_PACKET_SIZE] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                              -1, -1, -1, -1, -1, -1, -1, -1};
    const size_t size = aur_embree_scene_packet_size(rays->scene);
    if (size == 0)
        return bench_trace_single(rays);
    /* A packet is an array of rows of `size` numbers, in the order of struct RTCRayHit16. */
    enum { ROWS = sizeof(struct RTCRayHit16) / sizeof(float[BENCH_PACKET_SIZE]) };
    enum { TFAR = 8, MASK = 9, GEOMETRY = 18, INSTANCE = 19 };
    _Alignas(64) float rows[ROWS * BENCH_PACKET_SIZE] = {0};
    const size_t row_bytes = size * sizeof rows[0];
    memset(rows + MASK * size, 0xff, row_bytes);
    size_t hits = 0;
    for (size_t first = 0; first < rays->count; first += size) {
        for (size_t k = 0; k < size; ++k) {
            const aur_ray *const ray = &rays->rays[first + k];
            const float numbers[TFAR + 1] = {
                ray->origin.x,    ray->origin.y,    ray->origin.z, ray->nearest, ray->direction.x,
                ray->direction.y, ray->direction.z, 0.0f,          ray->farthest};
            for (size_t row = 0; row <= TFAR; ++row)
                rows[row * size + k] = numbers[row];
        }
        memset(rows + GEOMETRY * size, 0xff, row_bytes);
        memset(rows + INSTANCE * size, 0xff, row_bytes);
        if (rays->occluded)
            aur_embree_occluded_packet(rays->scene, rays->order, size, valid, rows);
        else
            aur_embree_intersect_packet(rays->scene, rays->order, size, valid, rows);
        for (size_t k = 0; k < size; ++k) {
            uint32_t geometry;
            memcpy(&geometry, rows + GEOMETRY * size + k, sizeof geometry);
            hits += rays->occluded ? rows[TFAR * size + k] < 0.0f : geometry != RTC_INVALID_GEOMETRY_ID;
        }
    }
    return hits;
}

void bench_pixel(size_t index, size_t width, size_t *x, size_t *y) {
    const size_t block = index / BENCH_PACKET_SIZE, within = index % BENCH_PACKET_SIZE;
    *x = block % (width / 4) * 4 + within % 4;
    *y = block / (width / 4) * 4 + within / 4;
}

aur_vector bench_cosine_direction(aur_vector normal, size_t index) {
    const double u = aur_unit_double(aur_hash2(index, 0));
    const double phi = 2.0 * AUR_PI * aur_unit_double(aur_hash2(index, 1));
    const aur_vector local = {(float)(sqrt(u) * cos(phi)), (float)(sqrt(u) * sin(phi)), (float)sqrt(1.0 - u)};
    const aur_frame frame = aur_frame_about(normal);
    return aur_frame_to_world(&frame, local);
}
