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
    if (!(sums->corrected ? aur_vector_is_finite(radiance) : aur_is_radiance(radiance))) {
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
        const aur_gather_pooled *const own = &sums->pooled[lane];
        const aur_vector light = aur_vector_multiply(own->coefficient, own->irradiance);
        stratum->pool_adds[0] -= weight * (double)light.x;
        stratum->pool_adds[1] -= weight * (double)light.y;
        stratum->pool_adds[2] -= weight * (double)light.z;
    }
}

/* The mean of the strata's sums, or of what pools add to them. */
static void mean_of(const aur_pixel_strata *pixel, bool added, double mean[3]) {
    double seen = 0.0;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (uint32_t i = 0; i < pixel->count; ++i) {
        const aur_stratum *const stratum = &pixel->strata[i];
        if (stratum->shaded == 0.0)
            continue;
        seen += stratum->seen;
        for (size_t c = 0; c < 3; ++c)
            mean[c] += (added ? stratum->pool_adds : stratum->sum)[c] * (stratum->seen / stratum->shaded);
    }
    for (size_t c = 0; c < 3; ++c)
        mean[c] = seen != 0.0 ? mean[c] / seen : 0.0;
}

void aur_pixel_strata_mean(const aur_pixel_strata *pixel, double mean[3]) {
    mean_of(pixel, false, mean);
}

void aur_pixel_strata_added(const aur_pixel_strata *pixel, double added[3]) {
    mean_of(pixel, true, added);
}

/* --- edges */

enum { NO_EDGE, PLAIN_EDGE, LIGHT_EDGE };

enum { SIDE = AUR_TILE_SIZE, APRON = SIDE + 2 };

/* Pixels, 16 at a time: what the first sample of each sees. */
static void look_at(const aur_gather_plan *plan, const aur_view *view, size_t count, const size_t *x,
                    const size_t *y, aur_pixel_strata *pixels, aur_counters *counters) {
    aur_packet packet;
    aur_camera_sample samples[AUR_PACKET_SIZE];
    float weights[AUR_PACKET_SIZE];
    aur_packet_clear(&packet);
    aur_view_samples(view, count, x, y, 0, samples, weights);
    for (size_t k = 0; k < count; ++k)
        aur_packet_set(&packet, k, &samples[k].ray);
    const uint32_t found = aur_gather_intersect(plan, AUR_EMBREE_COHERENT, &packet, counters);
    for (size_t k = 0; k < count; ++k) {
        const uint64_t key = (found >> k & 1u) != 0 ? aur_gather_surface_key(plan->classes, &packet, k) : 0;
        pixels[k] = (aur_pixel_strata){.count = 1, .strata = {{.key = key}}};
    }
}

/* The tile's own pixel at a place of the apron; NULL on the ring around the tile. */
static const aur_pixel_strata *own_pixel(const aur_pixel_strata *strata, size_t place) {
    const size_t column = place % APRON, row = place / APRON;
    const bool inside = column > 0 && column <= SIDE && row > 0 && row <= SIDE;
    return inside ? &strata[(row - 1) * SIDE + (column - 1)] : NULL;
}

/* Whether a pixel beside this place has samples, so that an edge between them counts. */
static bool is_beside_samples(const aur_pixel_strata *strata, size_t place) {
    const size_t column = place % APRON, row = place / APRON;
    for (size_t j = row > 0 ? row - 1 : 0; j <= row + 1 && j < APRON; ++j)
        for (size_t i = column > 0 ? column - 1 : 0; i <= column + 1 && i < APRON; ++i) {
            const aur_pixel_strata *const other = own_pixel(strata, j * APRON + i);
            if (other != NULL && other->count > 0)
                return true;
        }
    return false;
}

/* What pixels see that lie beside those with samples. The tile's own samples tell it where all of its pixels
 * have `alike` many; else what a pixel finds would depend on which of its neighbours have samples, and one
 * ray each tells it, as around the tile. What lies beyond the picture sees nothing and makes no edge. */
static void look_around(const aur_gather_plan *plan, const aur_view *view, size_t left, size_t top,
                        const aur_pixel_strata *strata, bool alike, aur_pixel_strata looked[APRON * APRON],
                        const aur_pixel_strata *at[APRON * APRON], aur_counters *counters) {
    size_t x[APRON * APRON], y[APRON * APRON], used = 0;
    for (size_t i = 0; i < APRON * APRON; ++i) {
        const size_t column = i % APRON, row = i / APRON;
        const aur_pixel_strata *const own = own_pixel(strata, i);
        at[i] = alike && own != NULL && own->count > 0 ? own : NULL;
        if (at[i] != NULL || !is_beside_samples(strata, i))
            continue;
        x[used] = left + column; /* one too many, against underflow */
        y[used] = top + row;
        if (x[used] == 0 || y[used] == 0 || x[used] > view->width || y[used] > view->height)
            continue;
        --x[used];
        --y[used];
        at[i] = &looked[used++];
    }
    for (size_t first = 0; first < used; first += AUR_PACKET_SIZE) {
        const size_t count = used - first < AUR_PACKET_SIZE ? used - first : AUR_PACKET_SIZE;
        look_at(plan, view, count, &x[first], &y[first], &looked[first], counters);
    }
}

/* The greatest edge among what the eight neighbours of a pixel have seen. What the pixel itself has seen has
 * no say: else those that met a small light by chance would look again, and keep less of it than the others
 * lack. */
static int edge_at(const aur_pixel_strata *const at[APRON * APRON], size_t x, size_t y) {
    const aur_stratum *first = NULL;
    bool several = false, light = false;
    for (size_t i = 0; i < 9; ++i) {
        const aur_pixel_strata *const other = at[(y + i / 3) * APRON + x + i % 3];
        /* Pixels beyond the picture's edge have no samples. */
        if (i == 4 || other == NULL)
            continue;
        for (uint32_t k = 0; k < other->count; ++k) {
            const aur_stratum *const stratum = &other->strata[k];
            first = first == NULL ? stratum : first;
            several = several || stratum->key != first->key;
            light = light || (stratum->key & AUR_SURFACE_KEY_EMITS) != 0;
        }
    }
    if (!several)
        return NO_EDGE;
    return light ? LIGHT_EDGE : PLAIN_EDGE;
}

void aur_gather_find_edges(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y,
                           const aur_pixel_strata *strata, bool alike, aur_gather_edges *edges,
                           aur_counters *counters) {
    aur_pixel_strata looked[APRON * APRON];
    const aur_pixel_strata *at[APRON * APRON];
    look_around(plan, view, x, y, strata, alike, looked, at, counters);
    *edges = (aur_gather_edges){0};
    for (uint32_t place = 0; place < AUR_GROUP_COUNT; ++place)
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
            const size_t pixel = aur_group_pixel(0, place, lane);
            if (strata[pixel].count == 0)
                continue;
            const int edge = edge_at(at, pixel % SIDE, pixel / SIDE);
            edges->any[place] |= (uint32_t)(edge != NO_EDGE) << lane;
            edges->lights[place] |= (uint32_t)(edge == LIGHT_EDGE) << lane;
        }
}
