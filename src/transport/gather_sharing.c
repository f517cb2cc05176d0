/* Irradiance shared between the pixels of a 4 x 4 block: one joint pattern is split among them, and what they
 * gathered is pooled where they see one surface (a discontinuity buffer: Wald, Benthin, Slusallek, Keller
 * 2002). Biased where irradiance changes from pixel to pixel. */
#include "transport/final_gather.h"

/* Pixels share where their normals differ by less than 8 degrees and one lies near the other's plane. */
static const float LEAST_AGREEMENT = 0.99f;
static const float MOST_ELEVATION_SQUARED = 0.01f;

static bool share_light(const aur_stratum *a, const aur_stratum *b) {
    if (a->key != b->key || !(a->gathers > 0.0f) || !(b->gathers > 0.0f))
        return false;
    const aur_vector normal = aur_vector_normalize(a->normal), other = aur_vector_normalize(b->normal);
    if (aur_vector_dot(normal, other) < LEAST_AGREEMENT)
        return false;
    const aur_vector offset = aur_vector_subtract(aur_vector_scale(b->position, 1.0f / b->gathers),
                                                  aur_vector_scale(a->position, 1.0f / a->gathers));
    const float height = aur_vector_dot(offset, normal);
    return height * height <= MOST_ELEVATION_SQUARED * aur_vector_dot(offset, offset);
}

/* The mean irradiance of a stratum's surface over the block. */
static aur_vector pooled_irradiance(const aur_pixel_strata *strata, size_t corner, const aur_stratum *own) {
    aur_vector sum = {0};
    float gathers = 0.0f;
    for (size_t i = 0; i < AUR_PACKET_SIZE; ++i) {
        const size_t at = corner + i / AUR_GROUPS_A_SIDE * AUR_TILE_SIZE + i % AUR_GROUPS_A_SIDE;
        for (uint32_t k = 0; k < strata[at].count; ++k) {
            const aur_stratum *const other = &strata[at].strata[k];
            if (other != own && !share_light(own, other))
                continue;
            sum = aur_vector_add(sum, other->irradiance);
            gathers += other->gathers;
        }
    }
    return aur_vector_scale(sum, 1.0f / gathers);
}

void aur_gather_share_irradiance(aur_pixel_strata *strata) {
    for (size_t pixel = 0; pixel < AUR_TILE_PIXELS; ++pixel) {
        const size_t x = pixel % AUR_TILE_SIZE, y = pixel / AUR_TILE_SIZE;
        const size_t corner = y / AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE * AUR_TILE_SIZE +
                              x / AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE;
        for (uint32_t k = 0; k < strata[pixel].count; ++k) {
            aur_stratum *const own = &strata[pixel].strata[k];
            if (!(own->gathers > 0.0f))
                continue;
            const aur_vector light =
                aur_vector_multiply(own->coefficient, pooled_irradiance(strata, corner, own));
            own->sum[0] += (double)light.x;
            own->sum[1] += (double)light.y;
            own->sum[2] += (double)light.z;
        }
    }
}
