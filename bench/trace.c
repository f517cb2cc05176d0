#include "trace.h"

#include <math.h>
#include <string.h>

#include "experimental.h"

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
    _Alignas(64) struct RTCRayHit16 query;
    memset(&query, 0, sizeof query);
    size_t hits = 0;
    for (size_t first = 0; first < rays->count; first += BENCH_PACKET_SIZE) {
        for (size_t k = 0; k < BENCH_PACKET_SIZE; ++k) {
            const aur_ray *const ray = &rays->rays[first + k];
            query.ray.org_x[k] = ray->origin.x;
            query.ray.org_y[k] = ray->origin.y;
            query.ray.org_z[k] = ray->origin.z;
            query.ray.tnear[k] = ray->nearest;
            query.ray.dir_x[k] = ray->direction.x;
            query.ray.dir_y[k] = ray->direction.y;
            query.ray.dir_z[k] = ray->direction.z;
            query.ray.tfar[k] = ray->farthest;
            query.ray.mask[k] = UINT32_MAX;
            query.hit.geomID[k] = query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        if (rays->occluded)
            aur_embree_occluded16(rays->scene, rays->order, valid, &query.ray);
        else
            aur_embree_intersect16(rays->scene, rays->order, valid, &query);
        for (size_t k = 0; k < BENCH_PACKET_SIZE; ++k)
            hits +=
                rays->occluded ? query.ray.tfar[k] < 0.0f : query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
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
