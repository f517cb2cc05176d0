#include "render/trace/packet.h"

#include <stddef.h>
#include <string.h>

#include "render/scene/scene_data.h"

/* --- packets of the processor's width
 *
 * Embree's packets are rows of 4 bytes per ray, one row per field: those of the rays, then those of their
 * hits. A part of a packet has the same rows, shorter. */

enum {
    NUMBER = sizeof(float),
    RAY_ROWS = sizeof(struct RTCRay16) / (AUR_PACKET_SIZE * NUMBER),
    ROWS = sizeof(struct RTCRayHit16) / (AUR_PACKET_SIZE * NUMBER),
    FARTHEST = offsetof(struct RTCRay16, tfar) / (AUR_PACKET_SIZE * NUMBER),
    MOST_OF_PART = 8
};

typedef struct packet_part {
    _Alignas(32) int valid[MOST_OF_PART];
    _Alignas(32) unsigned char rows[ROWS * MOST_OF_PART * NUMBER];
} packet_part;

/* Copies lanes first .. first + size - 1; false if none of them has a ray. */
static inline bool take_part(const aur_packet *packet, size_t first, size_t size, size_t rows,
                             packet_part *part) {
    int any = 0;
    for (size_t k = 0; k < size; ++k) {
        part->valid[k] = packet->valid[first + k];
        any |= part->valid[k];
    }
    const unsigned char *const from = (const unsigned char *)&packet->query + first * NUMBER;
    for (size_t row = 0; row < rows && any != 0; ++row)
        memcpy(part->rows + row * size * NUMBER, from + row * AUR_PACKET_SIZE * NUMBER, size * NUMBER);
    return any != 0;
}

static inline void put_row(const packet_part *part, size_t row, size_t first, size_t size,
                           aur_packet *packet) {
    memcpy((unsigned char *)&packet->query + (row * AUR_PACKET_SIZE + first) * NUMBER,
           part->rows + row * size * NUMBER, size * NUMBER);
}

static inline void intersect_parts(const aur_scene *scene, aur_embree_order order, size_t size,
                                   aur_packet *packet) {
    packet_part part;
    for (size_t first = 0; first < AUR_PACKET_SIZE; first += size) {
        if (!take_part(packet, first, size, ROWS, &part))
            continue;
        aur_embree_intersect_packet(scene->accel, order, size, part.valid, part.rows);
        put_row(&part, FARTHEST, first, size, packet);
        for (size_t row = RAY_ROWS; row < ROWS; ++row)
            put_row(&part, row, first, size, packet);
    }
}

static inline void occluded_parts(const aur_scene *scene, aur_embree_order order, size_t size,
                                  aur_packet *packet) {
    packet_part part;
    for (size_t first = 0; first < AUR_PACKET_SIZE; first += size) {
        if (!take_part(packet, first, size, RAY_ROWS, &part))
            continue;
        aur_embree_occluded_packet(scene->accel, order, size, part.valid, part.rows);
        put_row(&part, FARTHEST, first, size, packet);
    }
}

uint32_t aur_scene_intersect16(const aur_scene *scene, aur_embree_order order, aur_packet *packet) {
    struct RTCHit16 *const hits = &packet->query.hit;
    memset(hits->geomID, 0xff, sizeof hits->geomID); /* RTC_INVALID_GEOMETRY_ID */
    memset(hits->instID, 0xff, sizeof hits->instID);
    switch (scene->packet_size) {
    case 16:
        aur_embree_intersect_packet(scene->accel, order, 16, packet->valid, &packet->query);
        break;
    case 8:
        intersect_parts(scene, order, 8, packet);
        break;
    case 4:
        intersect_parts(scene, order, 4, packet);
        break;
    default:
        return aur_scene_intersect_each(scene, packet);
    }
    uint32_t found = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        found |= (uint32_t)(packet->valid[k] != 0 && hits->geomID[k] != RTC_INVALID_GEOMETRY_ID) << k;
    return found;
}

uint32_t aur_scene_intersect_each(const aur_scene *scene, aur_packet *packet) {
    struct RTCRay16 *const rays = &packet->query.ray;
    struct RTCHit16 *const hits = &packet->query.hit;
    uint32_t found = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if (packet->valid[k] == 0)
            continue;
        struct RTCRayHit one = {
            .ray = {.org_x = rays->org_x[k],
                    .org_y = rays->org_y[k],
                    .org_z = rays->org_z[k],
                    .tnear = rays->tnear[k],
                    .dir_x = rays->dir_x[k],
                    .dir_y = rays->dir_y[k],
                    .dir_z = rays->dir_z[k],
                    .tfar = rays->tfar[k],
                    .mask = UINT32_MAX},
            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}}};
        aur_embree_intersect1(scene->accel, &one);
        if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            continue;
        found |= 1u << k;
        rays->tfar[k] = one.ray.tfar;
        hits->Ng_x[k] = one.hit.Ng_x;
        hits->Ng_y[k] = one.hit.Ng_y;
        hits->Ng_z[k] = one.hit.Ng_z;
        hits->u[k] = one.hit.u;
        hits->v[k] = one.hit.v;
        hits->primID[k] = one.hit.primID;
        hits->geomID[k] = one.hit.geomID;
        hits->instID[0][k] = one.hit.instID[0];
    }
    return found;
}

aur_hit aur_packet_hit(const aur_scene *scene, const aur_packet *packet, size_t lane) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    const uint32_t id = hits->instID[0][lane];
    return (aur_hit){.distance = packet->query.ray.tfar[lane],
                     .u = hits->u[lane],
                     .v = hits->v[lane],
                     .shape = hits->geomID[lane],
                     .primitive = hits->primID[lane],
                     .instance =
                         id == RTC_INVALID_GEOMETRY_ID ? AUR_NO_INSTANCE : id - (uint32_t)scene->shape_count};
}

uint32_t aur_scene_occluded16(const aur_scene *scene, aur_embree_order order, aur_packet *packet) {
    struct RTCRay16 *const rays = &packet->query.ray;
    /* Embree 3.13's coherent occlusion test of sixteen rays reads an uninitialised variable if there are
     * instances, and may then never return: reproduced with every packet once the stack was not zero. */
    const aur_embree_order safe = scene->instance_count == 0 ? order : AUR_EMBREE_INCOHERENT;
    switch (scene->packet_size) {
    case 16:
        aur_embree_occluded_packet(scene->accel, safe, 16, packet->valid, rays);
        break;
    case 8:
        occluded_parts(scene, safe, 8, packet);
        break;
    case 4:
        occluded_parts(scene, safe, 4, packet);
        break;
    default:
        return aur_scene_occluded_each(scene, packet);
    }
    uint32_t stopped = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        stopped |= (uint32_t)(packet->valid[k] != 0 && rays->tfar[k] < 0.0f) << k;
    return stopped;
}

uint32_t aur_scene_occluded_each(const aur_scene *scene, const aur_packet *packet) {
    uint32_t stopped = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_ray ray = aur_packet_ray(packet, k);
        stopped |= (uint32_t)(packet->valid[k] != 0 && aur_scene_occluded(scene, &ray)) << k;
    }
    return stopped;
}

/* NULL for curved shapes. */
static const uint32_t *indices_of(const aur_scene *scene, const aur_packet *packet, size_t lane,
                                  const aur_mesh **mesh) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    const aur_shape *const shape = scene->shapes[hits->geomID[lane]];
    *mesh = &shape->mesh;
    return shape->curved == NULL ? &shape->mesh.indices[3 * (size_t)hits->primID[lane]] : NULL;
}

/* Three numbers may lie in two lines. */
static inline void prefetch3(const void *three) {
    __builtin_prefetch(three);
    __builtin_prefetch((const char *)three + 2 * NUMBER);
}

void aur_packet_prefetch_indices(const aur_scene *scene, const aur_packet *packet, uint32_t lanes) {
    const aur_mesh *mesh;
    for (; lanes != 0; lanes &= lanes - 1) {
        const uint32_t *const index = indices_of(scene, packet, (size_t)__builtin_ctz(lanes), &mesh);
        if (index != NULL)
            prefetch3(index);
    }
}

void aur_packet_prefetch_vertices(const aur_scene *scene, const aur_packet *packet, uint32_t lanes) {
    const aur_mesh *mesh;
    for (; lanes != 0; lanes &= lanes - 1) {
        const uint32_t *const index = indices_of(scene, packet, (size_t)__builtin_ctz(lanes), &mesh);
        for (size_t i = 0; index != NULL && i < 3; ++i) {
            prefetch3(&mesh->positions[3 * (size_t)index[i]]);
            if (mesh->normals != NULL)
                prefetch3(&mesh->normals[3 * (size_t)index[i]]);
        }
    }
}

void aur_packet_corners(const aur_scene *scene, const aur_packet *packet, uint32_t lanes,
                        aur_lane_vectors corner[3]) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    aur_vector last[3] = {{0}};
    uint32_t shape = RTC_INVALID_GEOMETRY_ID, primitive = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t lane = (size_t)__builtin_ctz(lanes);
        if (hits->geomID[lane] != shape || hits->primID[lane] != primitive) {
            shape = hits->geomID[lane];
            primitive = hits->primID[lane];
            aur_mesh_corners(&scene->shapes[shape]->mesh, primitive, last);
        }
        for (size_t i = 0; i < 3; ++i)
            aur_lane_set(&corner[i], lane, last[i]);
    }
}

aur_bsdf_point aur_packet_texture(const aur_scene *scene, const aur_packet *packet, size_t lane) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    return aur_mesh_texture(&scene->shapes[hits->geomID[lane]]->mesh, hits->primID[lane], hits->u[lane],
                            hits->v[lane]);
}
