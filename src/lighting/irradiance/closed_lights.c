#include "lighting/irradiance/sensor_trace.h"

#include <stdlib.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/scene/scene_data.h"
#include "render/vertex/vertex.h"

enum { MOST_POLYGONS = 256, MOST_CORNERS = 4, PILOT = 128 /* number of points on all emitters together */ };

struct aur_closed_light {
    uint32_t emitter;
    double radiance[3];
    /* Points on the emitter are sampled by the solid angle under which it is seen, so their contributions are
     * similar at any distance. */
    bool by_angle;
    double centre[3], radius;                  /* bounding sphere */
    size_t first, polygon_count, corner_count; /* corners[first] ... of each polygon, with corner_count
                                                * corners */
};

static bool is_closed(const aur_scene *scene, const aur_emitter *emitter) {
    if (!aur_emitter_glows(emitter) || emitter->radiance.texture != NULL)
        return false;
    const aur_shape *const shape = scene->shapes[emitter->shape];
    return shape->curved == NULL && !shape->grouped;
}

static size_t polygons_of(const aur_shape *shape) {
    return shape->parallelogram ? 1 : shape->mesh.triangle_count;
}

static void set_sphere(aur_closed_light *light, const double (*corners)[3]) {
    const size_t count = light->polygon_count * light->corner_count;
    for (size_t i = 0; i < count; ++i)
        for (size_t d = 0; d < 3; ++d)
            light->centre[d] += corners[i][d] / (double)count;
    for (size_t i = 0; i < count; ++i) {
        const double way[3] = {corners[i][0] - light->centre[0], corners[i][1] - light->centre[1],
                               corners[i][2] - light->centre[2]};
        light->radius = fmax(light->radius, aur_length3(way));
    }
}

/* The corners of a parallelogram in order, from those of its first triangle; reversed if it is flipped. */
static uint32_t vertex_of(const aur_shape *shape, size_t polygon, size_t corner) {
    const uint32_t *const indices = shape->mesh.indices;
    if (!shape->parallelogram)
        return indices[3 * polygon + corner];
    size_t origin = 0;
    while (indices[origin] != 0)
        ++origin;
    return (uint32_t)(indices[(origin + 1) % 3] == 1 ? corner : (4 - corner) % 4);
}

static void fill(const aur_shape *shape, const aur_emitter *emitter, size_t first, double (*corners)[3],
                 aur_closed_light *light) {
    *light = (aur_closed_light){.emitter = emitter->index,
                                .first = first,
                                .polygon_count = polygons_of(shape),
                                .corner_count = shape->parallelogram ? 4 : 3};
    aur_vector_to_doubles(emitter->radiance.constant, light->radiance);
    for (size_t i = 0; i < light->polygon_count; ++i)
        for (size_t k = 0; k < light->corner_count; ++k)
            aur_vector_to_doubles(aur_mesh_position(&shape->mesh, vertex_of(shape, i, k)),
                                  corners[first + i * light->corner_count + k]);
    set_sphere(light, (const double(*)[3])(corners + first));
    const double(*const c)[3] = (const double(*)[3])(corners + first);
    double x[3], y[3];
    for (size_t d = 0; d < 3; ++d) {
        x[d] = c[1][d] - c[0][d];
        y[d] = c[light->corner_count - 1][d] - c[0][d];
    }
    light->by_angle = shape->parallelogram && fabs(aur_dot3(x, y)) < 1e-4 * aur_length3(x) * aur_length3(y);
}

aur_result aur_closed_lights_create(const aur_scene *scene, aur_closed_lights *lights, aur_error *error) {
    *lights = (aur_closed_lights){.emitter_count = scene->emitter_count};
    size_t count = 0, polygons = 0;
    for (size_t i = 0; i < scene->emitter_count && polygons <= MOST_POLYGONS; ++i)
        if (is_closed(scene, scene->emitters[i])) {
            polygons += polygons_of(scene->shapes[scene->emitters[i]->shape]);
            ++count;
        }
    if (count == 0 || polygons > MOST_POLYGONS)
        return AUR_OK;
    lights->lights = malloc(count * sizeof *lights->lights);
    lights->corners = malloc(polygons * MOST_CORNERS * sizeof *lights->corners);
    if (lights->lights == NULL || lights->corners == NULL) {
        aur_closed_lights_release(lights);
        return aur_fail_memory(error);
    }
    size_t first = 0;
    for (size_t i = 0; i < scene->emitter_count; ++i) {
        if (!is_closed(scene, scene->emitters[i]))
            continue;
        aur_closed_light *const light = &lights->lights[lights->count++];
        fill(scene->shapes[scene->emitters[i]->shape], scene->emitters[i], first, lights->corners, light);
        first += light->polygon_count * light->corner_count;
    }
    return AUR_OK;
}

void aur_closed_lights_release(aur_closed_lights *lights) {
    free(lights->lights);
    free(lights->corners);
    *lights = (aur_closed_lights){0};
}

/* The cosine-weighted integral over the solid angle of a polygon seen from its front: half the sum over edges
 * of the angle under which the edge is seen times the cosine between the sensor's normal and the normal of
 * the plane through the edge and the sensor. */
static double projected_angle(size_t count, const double (*corners)[3], const double position[3],
                              const double normal[3]) {
    double moved[MOST_CORNERS][3], cut[MOST_CORNERS + 1][3];
    aur_plane facing;
    for (size_t i = 0; i < count; ++i)
        for (size_t d = 0; d < 3; ++d)
            moved[i][d] = corners[i][d] - position[d];
    if (!(aur_polygon_plane(count, (const double(*)[3])moved, &facing) > 0.0) || !(facing.offset < 0.0))
        return 0.0; /* the origin, where the sensor is, is behind the polygon or in its plane */
    const aur_plane horizon = {{normal[0], normal[1], normal[2]}, 0.0};
    const size_t clipped = aur_polygon_clip(count, (const double(*)[3])moved, &horizon, cut);
    double sum = 0.0;
    for (size_t i = 0; i < clipped; ++i) {
        const double *const a = cut[i], *const b = cut[(i + 1) % clipped];
        double cross[3];
        aur_cross3(a, b, cross);
        const double size = aur_length3(cross);
        if (size > 0.0)
            sum += atan2(size, aur_dot3(a, b)) * aur_dot3(normal, cross) / size;
    }
    return 0.5 * fabs(sum);
}

/* The visible fraction of the emitter's points, weighted by their contributions. */
static double pilot(const aur_scene *scene, const aur_closed_light *light, size_t points,
                    const double normal[3], aur_vector from, uint64_t hash) {
    const aur_emitter *const emitter = scene->emitters[light->emitter];
    const aur_vector up = {(float)normal[0], (float)normal[1], (float)normal[2]};
    double all = 0.0, seen = 0.0;
    for (size_t i = 0; i < points; ++i) {
        aur_light_query query = {.reference = {from, up}, .part = AUR_WHOLE_LIGHT};
        aur_light_sample drawn;
        aur_draw_units(&hash, query.u);
        if (!emitter->descriptor->sample(emitter, &query, &drawn))
            continue;
        const float cosine = aur_vector_dot(up, drawn.direction);
        if (!(cosine > 0.0f) || !(drawn.pdf > 0.0f))
            continue;
        const aur_ray ray = aur_ray_between(from, drawn.position);
        const double brings = (double)(cosine / drawn.pdf);
        all += brings;
        seen += aur_scene_occluded(scene, &ray) ? 0.0 : brings;
    }
    return all > 0.0 ? seen / all : 0.0;
}

void aur_closed_lights_at(const aur_scene *scene, const aur_closed_lights *lights, const double position[3],
                          const double normal[3], aur_vector from, uint64_t hash, float *shares,
                          double direct[3]) {
    for (size_t i = 0; i < lights->emitter_count; ++i)
        shares[i] = AUR_LIGHT_OPEN;
    const size_t most = lights->count > 0 ? PILOT / lights->count : 0;
    const size_t points = most < 2 ? 2 : most > 16 ? 16 : most;
    for (size_t i = 0; i < lights->count; ++i) {
        const aur_closed_light *const light = &lights->lights[i];
        const double way[3] = {light->centre[0] - position[0], light->centre[1] - position[1],
                               light->centre[2] - position[2]};
        const double share = pilot(scene, light, points, normal, from, aur_hash3(hash, 0x70696c6f74, i));
        /* Points sampled by area on a near emitter have few with large contributions, so occlusion could be
         * missed. */
        if (!light->by_angle && aur_length3(way) < 2.0 * light->radius && share < 1.0)
            continue;
        double angle = 0.0;
        for (size_t k = 0; k < light->polygon_count; ++k)
            angle += projected_angle(
                light->corner_count,
                (const double(*)[3])(lights->corners + light->first + k * light->corner_count), position,
                normal);
        shares[light->emitter] = (float)share;
        for (size_t c = 0; c < 3; ++c)
            direct[c] += share * angle * light->radiance[c];
    }
}
