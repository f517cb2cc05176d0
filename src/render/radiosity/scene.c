#include "render/radiosity/scene.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/vertex/shading.h"

enum { LINE = 64, MEAN_POINTS = 1024 };

static aur_result allocate(aur_radiosity_scene *created, size_t shapes, aur_error *error) {
    const size_t count = created->triangle_count;
    const size_t bytes = (count * sizeof *created->triangles + LINE - 1) / LINE * LINE;
    created->triangles = aligned_alloc(LINE, bytes);
    created->areas = malloc(count * sizeof *created->areas);
    created->emission = malloc(count * sizeof *created->emission);
    created->first = malloc(shapes * sizeof *created->first);
    created->behind = malloc(count * sizeof *created->behind);
    if (created->triangles != NULL && created->areas != NULL && created->emission != NULL &&
        created->first != NULL && created->behind != NULL)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu triangles", count);
}

void aur_radiosity_scene_release(aur_radiosity_scene *scene) {
    free(scene->triangles);
    free(scene->areas);
    free(scene->emission);
    free(scene->first);
    free(scene->behind);
    *scene = (aur_radiosity_scene){0};
}

/* --- materials */

static bool is_mirror(const aur_bsdf *bsdf) {
    return bsdf->scatters[0] == AUR_SCATTERS_SPECULAR || bsdf->scatters[1] == AUR_SCATTERS_SPECULAR;
}

static aur_bsdf_point texture_at(const aur_triangle *triangle, float u, float v) {
    const aur_bsdf_point *const t = triangle->texture;
    const aur_vector color = aur_vector_add_scaled(
        aur_vector_add_scaled(aur_vector_scale(t[0].vertex_color, 1.0f - u - v), u, t[1].vertex_color), v,
        t[2].vertex_color);
    return (aur_bsdf_point){.u = t[0].u + u * (t[1].u - t[0].u) + v * (t[2].u - t[0].u),
                            .v = t[0].v + u * (t[1].v - t[0].v) + v * (t[2].v - t[0].v),
                            .vertex_color = color,
                            .position = aur_vector_add_scaled(
                                aur_vector_add_scaled(aur_vector_scale(triangle->corner[0], 1.0f - u - v), u,
                                                      triangle->corner[1]),
                                v, triangle->corner[2]),
                            .face_color = t[0].face_color};
}

/* Point i of the R2 sequence, which shares no period with a texture, folded onto the triangle. */
static aur_bsdf_point mean_point(const aur_triangle *triangle, size_t i) {
    const float u = aur_unit_float((uint32_t)(i + 1) * 3242174889u);
    const float v = aur_unit_float((uint32_t)(i + 1) * 2447445414u);
    return u + v > 1.0f ? texture_at(triangle, 1.0f - u, 1.0f - v) : texture_at(triangle, u, v);
}

/* The mean over a triangle of its albedo on a side, 1 or -1, or of what it emits where `side` is 0. */
static aur_vector mean_over(const aur_scene *scene, size_t shape, const aur_triangle *triangle, float side) {
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, shape);
    const bool emitted = side == 0.0f;
    const bool varies = emitted ? aur_scene_shape_emission_varies(scene, shape) : bsdf->textured;
    const size_t count = varies ? MEAN_POINTS : 1;
    aur_vector sum = {0};
    for (size_t i = 0; i < count; ++i) {
        const aur_bsdf_point at = mean_point(triangle, i);
        sum = aur_vector_add(sum, emitted ? aur_scene_shape_emission(scene, shape, at)
                                          : aur_bsdf_diffuse_albedo(bsdf, at, side));
    }
    return aur_vector_scale(sum, 1.0f / (float)count);
}

/* --- triangles */

static double area_of(const aur_vector edge[2]) {
    double a[3], b[3], normal[3];
    aur_vector_to_doubles(edge[0], a);
    aur_vector_to_doubles(edge[1], b);
    aur_cross3(a, b, normal);
    return 0.5 * aur_length3(normal);
}

static aur_frame frame_of(const aur_vector edge[2], uint64_t variant, size_t index) {
    aur_frame frame = aur_frame_about(aur_vector_normalize(aur_vector_cross(edge[0], edge[1])));
    if (variant == 0)
        return frame;
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)aur_hash3(variant, 0x66726d, index));
    const aur_vector x = frame.x;
    frame.x = aur_vector_add_scaled(aur_vector_scale(x, cosf(angle)), sinf(angle), frame.y);
    frame.y = aur_vector_cross(frame.z, frame.x);
    return frame;
}

static uint64_t hash_vector(uint64_t hash, aur_vector v) {
    const float values[3] = {v.x, v.y, v.z};
    uint32_t bits[3];
    memcpy(bits, values, sizeof bits);
    return aur_hash2(aur_hash2(aur_hash2(hash, bits[0]), bits[1]), bits[2]);
}

static aur_result add_shape(const aur_scene *scene, size_t shape, uint64_t variant,
                            aur_radiosity_scene *created, size_t *next, aur_error *error) {
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, shape);
    const bool mirror = is_mirror(bsdf);
    const size_t count = aur_scene_shape_triangles(scene, shape);
    created->first[shape] = (uint32_t)*next;
    for (size_t i = 0; i < count; ++i, ++*next) {
        aur_triangle corners;
        aur_scene_triangle(scene, shape, i, &corners);
        aur_radiosity_triangle *const t = &created->triangles[*next];
        *t = (aur_radiosity_triangle){.corner = corners.corner[0],
                                      .edge = {aur_vector_subtract(corners.corner[1], corners.corner[0]),
                                               aur_vector_subtract(corners.corner[2], corners.corner[0])},
                                      .back = AUR_NO_PATCH,
                                      .shape = (uint32_t)shape};
        t->frame = frame_of(t->edge, variant, *next);
        t->offset = aur_triangle_offset(corners.corner[0], corners.corner[1], corners.corner[2], t->frame.z);
        t->flags = (mirror ? AUR_RADIOSITY_MIRROR : 0u) | (bsdf->textured ? AUR_RADIOSITY_TEXTURED : 0u);
        t->albedo[0] = mean_over(scene, shape, &corners, 1.0f);
        if (bsdf->scatters_from_behind && !mirror)
            t->albedo[1] = mean_over(scene, shape, &corners, -1.0f);
        if (!aur_vector_is_zero(t->albedo[1])) {
            created->behind[created->patch_count - created->triangle_count] = (uint32_t)*next;
            t->back = (uint32_t)created->patch_count++;
        }
        created->areas[*next] = area_of(t->edge);
        created->area += created->areas[*next];
        const aur_vector emission = mean_over(scene, shape, &corners, 0.0f);
        created->emission[*next] = emission;
        if (!isfinite(created->areas[*next]) || !aur_vector_is_finite(emission))
            return aur_fail_at(error, aur_scene_shape_location(scene, shape), AUR_ERROR_FORMAT,
                               "radiosity: triangle %zu of this shape %s", i,
                               !isfinite(created->areas[*next]) ? "is too large: its area is not finite"
                                                                : "emits a radiance that is not finite");
        if (!aur_vector_is_zero(emission)) {
            t->flags |= AUR_RADIOSITY_GLOWS;
            if (aur_scene_shape_emission_varies(scene, shape))
                t->flags |= AUR_RADIOSITY_TEXTURED_LIGHT;
            created->glow_area += created->areas[*next];
        }
        for (size_t k = 0; k < 3; ++k)
            created->hash = hash_vector(created->hash, corners.corner[k]);
        created->hash = hash_vector(hash_vector(created->hash, t->albedo[0]), t->albedo[1]);
        created->hash = aur_hash2(hash_vector(created->hash, emission), t->flags);
    }
    return AUR_OK;
}

/* Warns of the part of a shape's material that radiosity ignores, and of an albedo of 1. */
static void warn_about(const aur_scene *scene, size_t shape, const aur_radiosity_scene *created,
                       const aur_warnings *warnings) {
    const aur_location location = aur_scene_shape_location(scene, shape);
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, shape);
    const unsigned kinds = bsdf->scatters[0];
    if (kinds != AUR_SCATTERS_SPECULAR && (kinds & ~(unsigned)AUR_SCATTERS_DIFFUSE) != 0)
        aur_warn_at(warnings, location,
                    "radiosity: only the diffuse part of the material '%s' is taken into account",
                    bsdf->descriptor->row.name);
    const size_t first = created->first[shape], count = aur_scene_shape_triangles(scene, shape);
    for (size_t i = first; i < first + count; ++i) {
        const float albedo = fmaxf(aur_vector_max(created->triangles[i].albedo[0]),
                                   aur_vector_max(created->triangles[i].albedo[1]));
        if (albedo < 1.0f)
            continue;
        aur_warn_at(
            warnings, location,
            "radiosity: triangle %zu of this shape has an albedo of %g: the light after the last bounce "
            "is bounded only below 1",
            i - first, (double)albedo);
        return;
    }
}

static aur_result check_light(const aur_radiosity_scene *created, aur_error *error) {
    if (aur_scene_emitter_count(created->scene) == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "radiosity: the scene has no light");
    for (size_t i = 0; i < created->triangle_count; ++i)
        if ((created->triangles[i].flags & AUR_RADIOSITY_GLOWS) != 0 && created->areas[i] > 0.0)
            return AUR_OK;
    return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                    created->glow_area > 0.0 ? "radiosity: the lights have no area"
                                             : "radiosity: the lights emit no radiance");
}

aur_result aur_radiosity_scene_create(const aur_scene *scene, uint64_t variant, const aur_warnings *warnings,
                                      aur_radiosity_scene *created, aur_error *error) {
    *created = (aur_radiosity_scene){.scene = scene, .hash = UINT64_C(0x7261646973637631)};
    aur_result result = aur_scene_refuse_media(scene, "radiosity", error);
    if (result == AUR_OK)
        result = aur_scene_check_triangles(scene, error);
    if (result != AUR_OK)
        return result;
    const size_t shapes = aur_scene_shape_count(scene);
    for (size_t i = 0; i < shapes; ++i)
        created->triangle_count += aur_scene_shape_triangles(scene, i);
    if (created->triangle_count == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "radiosity: the scene has no triangles");
    if (created->triangle_count > UINT32_MAX / 4)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "radiosity: %zu triangles are too many: the limit is %u", created->triangle_count,
                        UINT32_MAX / 4);
    created->patch_count = created->triangle_count;
    result = allocate(created, shapes, error);
    size_t next = 0;
    for (size_t i = 0; i < shapes && result == AUR_OK; ++i)
        result = add_shape(scene, i, variant, created, &next, error);
    if (result == AUR_OK)
        result = check_light(created, error);
    if (result != AUR_OK) {
        aur_radiosity_scene_release(created);
        return result;
    }
    for (size_t i = 0; i < shapes; ++i)
        warn_about(scene, i, created, warnings);
    return AUR_OK;
}

/* --- at hits */

aur_vector aur_radiosity_albedo(const aur_radiosity_scene *scene, uint32_t triangle, bool front,
                                const aur_ray *ray, const aur_hit *hit) {
    const aur_radiosity_triangle *const t = &scene->triangles[triangle];
    if ((t->flags & AUR_RADIOSITY_TEXTURED) == 0)
        return t->albedo[front ? 0 : 1];
    aur_surface surface;
    aur_scene_surface(scene->scene, ray, hit, &surface);
    return aur_bsdf_diffuse_albedo(surface.bsdf, surface.texture, front ? 1.0f : -1.0f);
}

aur_vector aur_radiosity_emitted(const aur_radiosity_scene *scene, uint32_t triangle, float u, float v) {
    const uint32_t shape = scene->triangles[triangle].shape;
    if (!aur_scene_shape_emission_varies(scene->scene, shape))
        return scene->emission[triangle];
    aur_triangle corners;
    aur_scene_triangle(scene->scene, shape, triangle - scene->first[shape], &corners);
    return aur_scene_shape_emission(scene->scene, shape, texture_at(&corners, u, v));
}

aur_radiosity_end aur_radiosity_reflect(const aur_radiosity_scene *scene, bool particle, uint64_t hash,
                                        aur_ray *ray, aur_hit *hit, aur_vector *throughput) {
    for (uint32_t hop = 0; hop < AUR_RADIOSITY_HOPS; ++hop) {
        aur_surface surface;
        aur_scene_surface(scene->scene, ray, hit, &surface);
        surface.frame = aur_frame_about(surface.geometric_normal);
        const aur_shading shading = aur_shading_at(&surface, aur_vector_scale(ray->direction, -1.0f));
        hash = aur_mix64(hash + 1);
        const float u[3] = {aur_unit_float((uint32_t)hash), aur_unit_float((uint32_t)(hash >> 32)),
                            aur_unit_float((uint32_t)aur_mix64(hash))};
        aur_bsdf_sample sample;
        if (!aur_shading_sample(&shading, u, &sample))
            return AUR_RADIOSITY_TRAPPED;
        const bool changes = particle && sample.ior_squared > 0.0f;
        *throughput = aur_vector_multiply(
            *throughput, changes ? aur_vector_scale(sample.weight, sample.ior_squared) : sample.weight);
        *ray = aur_surface_ray(&surface, sample.light);
        if (!aur_scene_intersect(scene->scene, ray, hit))
            return AUR_RADIOSITY_NONE;
        const uint32_t triangle = aur_radiosity_triangle_at(scene, hit);
        if ((scene->triangles[triangle].flags & AUR_RADIOSITY_MIRROR) == 0)
            return AUR_RADIOSITY_HIT;
    }
    return AUR_RADIOSITY_TRAPPED;
}
