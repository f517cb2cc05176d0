#include "transport/gather/strata.h"

uint64_t aur_gather_surface_key(const aur_shape_class *classes, const aur_packet *packet, size_t lane) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    const struct RTCHit16 *const hits = &packet->query.hit;
    const uint32_t shape = hits->geomID[lane];
    const aur_shape_class *const class = &classes[shape];
    const uint64_t key = (class->emits ? AUR_SURFACE_KEY_EMITS : 0) | ((uint64_t)shape * 8 + 1);
    if (class->curved)
        return key;
    const aur_vector n = {hits->Ng_x[lane], hits->Ng_y[lane], hits->Ng_z[lane]};
    const bool behind = n.x * rays->dir_x[lane] + n.y * rays->dir_y[lane] + n.z * rays->dir_z[lane] > 0.0f;
    return key + aur_vector_facing(behind ? aur_vector_scale(n, -1.0f) : n);
}

aur_stratum *aur_pixel_strata_find(aur_pixel_strata *pixel, uint64_t key, bool *known) {
    *known = true;
    for (uint32_t i = 0; i < pixel->count; ++i)
        if (pixel->strata[i].key == key)
            return &pixel->strata[i];
    if (pixel->count == AUR_STRATUM_COUNT)
        return &pixel->strata[AUR_STRATUM_COUNT - 1];
    *known = false;
    aur_stratum *const added = &pixel->strata[pixel->count++];
    *added = (aur_stratum){.key = key};
    return added;
}

static void add_pooled(aur_gather_pooled *sum, float weight, const aur_gather_pooled *found) {
    sum->irradiance = aur_vector_add_scaled(sum->irradiance, weight, found->irradiance);
    sum->coefficient = aur_vector_add_scaled(sum->coefficient, weight, found->coefficient);
    sum->position = aur_vector_add_scaled(sum->position, weight, found->position);
    sum->normal = aur_vector_add_scaled(sum->normal, weight, found->normal);
}

void aur_pixel_strata_add(aur_pixel_strata *pixel, aur_stratum *stratum, const aur_gather_sums *sums,
                          size_t lane, float sample_weight) {
    const aur_vector radiance = sums->radiance[lane];
    const double weight = (double)sample_weight;
    if (!aur_is_radiance(radiance)) {
        ++sums->counters->invalid;
        stratum->seen -= weight;
        return;
    }
    pixel->directions += sums->directions[lane];
    ++pixel->samples;
    stratum->shaded += weight;
    stratum->sum[0] += weight * (double)radiance.x;
    stratum->sum[1] += weight * (double)radiance.y;
    stratum->sum[2] += weight * (double)radiance.z;
    if (aur_has_lane(sums->pooled_lanes, lane)) {
        stratum->gathers += sample_weight;
        add_pooled(&stratum->pooled, sample_weight, &sums->pooled[lane]);
    }
}

void aur_pixel_strata_mean(const aur_pixel_strata *pixel, double mean[3]) {
    double seen = 0.0;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (uint32_t i = 0; i < pixel->count; ++i) {
        const aur_stratum *const stratum = &pixel->strata[i];
        if (stratum->shaded == 0.0)
            continue;
        seen += stratum->seen;
        for (size_t c = 0; c < 3; ++c)
            mean[c] += stratum->sum[c] * (stratum->seen / stratum->shaded);
    }
    for (size_t c = 0; c < 3; ++c)
        mean[c] = seen != 0.0 ? mean[c] / seen : 0.0;
}
