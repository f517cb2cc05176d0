#include "transport/radiosity/picture_gather.h"

#include <stdlib.h>

#include "core/random.h"
#include "scene/packet.h"
#include "transport/radiosity/statistics.h"

static aur_result make_pattern(const aur_rule_options *rule, aur_radiosity_gather *gather, aur_error *error) {
    const size_t count = (size_t)rule->points->count;
    double *const numbers = malloc(4 * count * sizeof *numbers);
    gather->x = malloc(4 * count * sizeof *gather->x);
    aur_result result = AUR_OK;
    if (numbers == NULL || gather->x == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu directions", count);
    if (result == AUR_OK)
        result = aur_rule_make(rule, 3 * count, numbers, numbers + 3 * count, error);
    gather->count = count;
    gather->y = gather->x + count;
    gather->z = gather->y + count;
    gather->weights = gather->z + count;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        gather->x[i] = (float)numbers[3 * i];
        gather->y[i] = (float)numbers[3 * i + 1];
        /* A ray along the surface would meet the surface itself. */
        gather->z[i] = fmaxf((float)numbers[3 * i + 2], 1e-6f);
        gather->weights[i] = (float)numbers[3 * count + i];
    }
    free(numbers);
    return result;
}

aur_result aur_radiosity_gather_create(const aur_radiosity *radiosity, const aur_rule_options *rule,
                                       aur_radiosity_gather *gather, aur_error *error) {
    const aur_radiosity_scene *const scene = &radiosity->scene;
    *gather = (aur_radiosity_gather){.scene = scene};
    gather->exitance = malloc(scene->patch_count * sizeof *gather->exitance);
    aur_result result = gather->exitance != NULL ? make_pattern(rule, gather, error) : aur_fail_memory(error);
    if (result != AUR_OK) {
        aur_radiosity_gather_release(gather);
        return result;
    }
    for (size_t i = 0; i < scene->patch_count; ++i) {
        double power[3];
        aur_radiosity_power(radiosity, i, power);
        const double area = scene->areas[aur_radiosity_triangle_of(scene, i)];
        const double scale = area > 0.0 ? 1.0 / (AUR_PI * area) : 0.0;
        gather->exitance[i] =
            (aur_vector){(float)(scale * power[0]), (float)(scale * power[1]), (float)(scale * power[2])};
    }
    return AUR_OK;
}

void aur_radiosity_gather_release(aur_radiosity_gather *gather) {
    free(gather->exitance);
    free(gather->x);
    *gather = (aur_radiosity_gather){0};
}

/* The radiance that the solution has where a gather ray ends, which mirrors may lead on. */
static aur_vector radiance_at(const aur_radiosity_gather *gather, aur_ray ray, aur_hit hit, uint64_t hash,
                              uint64_t *rays) {
    const aur_radiosity_scene *const scene = gather->scene;
    aur_vector throughput = {1.0f, 1.0f, 1.0f};
    uint32_t index = aur_radiosity_triangle_at(scene, &hit);
    const bool reflected = (scene->triangles[index].flags & AUR_RADIOSITY_MIRROR) != 0;
    if (reflected) {
        if (aur_radiosity_reflect(scene, false, hash, &ray, &hit, &throughput, rays) != AUR_RADIOSITY_MET)
            return (aur_vector){0};
        index = aur_radiosity_triangle_at(scene, &hit);
    }
    const aur_radiosity_triangle *const met = &scene->triangles[index];
    const bool front = aur_vector_dot(ray.direction, met->frame.z) < 0.0f;
    const uint32_t patch = front ? index : met->back;
    if (patch == AUR_NO_PATCH)
        return (aur_vector){0};
    const aur_vector albedo = aur_radiosity_albedo(scene, index, front, &ray, &hit);
    aur_vector radiance = aur_vector_multiply(albedo, gather->exitance[patch]);
    /* Direct light is drawn from lights that are seen without mirrors, so what a mirror shows of a light is
     * added here. */
    if (reflected && front)
        radiance = aur_vector_add(radiance, aur_radiosity_emitted(scene, index, hit.u, hit.v));
    return aur_vector_multiply(throughput, radiance);
}

aur_vector aur_radiosity_gather_at(const aur_radiosity_gather *gather, const aur_radiosity_place *place,
                                   uint64_t hash, uint64_t *rays) {
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)(hash >> 32));
    const float cosine = cosf(angle), sine = sinf(angle);
    const aur_frame frame = aur_frame_about(place->normal);
    aur_packet packet;
    aur_packet_clear(&packet);
    aur_vector sum = {0};
    for (size_t first = 0; first < gather->count; first += AUR_PACKET_SIZE) {
        aur_ray made[AUR_PACKET_SIZE];
        const size_t left = gather->count - first, lanes = left < AUR_PACKET_SIZE ? left : AUR_PACKET_SIZE;
        for (size_t k = 0; k < lanes; ++k) {
            const float x = gather->x[first + k], y = gather->y[first + k];
            const aur_vector local = {cosine * x - sine * y, sine * x + cosine * y, gather->z[first + k]};
            made[k] = aur_radiosity_leave(gather->scene, place, aur_frame_to_world(&frame, local));
            aur_packet_set(&packet, k, &made[k]);
        }
        for (size_t k = lanes; k < AUR_PACKET_SIZE; ++k)
            packet.valid[k] = 0;
        *rays += lanes;
        const uint32_t met = aur_scene_intersect16(gather->scene->scene, AUR_EMBREE_INCOHERENT, &packet);
        for (size_t k = 0; k < lanes; ++k) {
            if ((met >> k & 1u) == 0)
                continue;
            const aur_hit hit = aur_packet_hit(gather->scene->scene, &packet, k);
            const aur_vector radiance = radiance_at(gather, made[k], hit, aur_hash2(hash, first + k), rays);
            sum = aur_vector_add_scaled(sum, gather->weights[first + k], radiance);
        }
    }
    return sum;
}
