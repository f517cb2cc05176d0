#include "render/gather/strata.h"

#include <math.h>

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

aur_stratum *aur_pixel_strata_find(aur_pixel_strata *pixel, uint64_t key, bool *exists) {
    *exists = true;
    for (uint32_t i = 0; i < pixel->count; ++i)
        if (pixel->strata[i].key == key)
            return &pixel->strata[i];
    if (pixel->count == AUR_STRATUM_COUNT)
        return &pixel->strata[AUR_STRATUM_COUNT - 1];
    *exists = false;
    aur_stratum *const added = &pixel->strata[pixel->count++];
    *added = (aur_stratum){.key = key};
    return added;
}

static void add_pooled(aur_gather_pooled *sum, const aur_gather_pooled *found) {
    sum->irradiance = aur_vector_add(sum->irradiance, found->irradiance);
    sum->coefficient = aur_vector_add(sum->coefficient, found->coefficient);
    sum->position = aur_vector_add(sum->position, found->position);
    sum->normal = aur_vector_add(sum->normal, found->normal);
}

bool aur_pixel_strata_add(aur_pixel_strata *pixel, aur_stratum *stratum, const aur_gather_sums *sums,
                          size_t lane) {
    const aur_vector radiance = sums->radiance[lane];
    if (!(sums->corrected ? aur_vector_is_finite(radiance) : aur_is_radiance(radiance))) {
        ++sums->counters->invalid;
        stratum->seen -= 1.0;
        return false;
    }
    pixel->directions += sums->directions[lane];
    ++pixel->samples;
    stratum->shaded += 1.0;
    stratum->sum[0] += (double)radiance.x;
    stratum->sum[1] += (double)radiance.y;
    stratum->sum[2] += (double)radiance.z;
    for (size_t c = 0; c < 3; ++c)
        stratum->single[c] = stratum->sum[c];
    if (aur_has_lane(sums->pooled_lanes, lane)) {
        stratum->gathers += 1.0f;
        add_pooled(&stratum->pooled, &sums->pooled[lane]);
        const aur_gather_pooled *const local = &sums->pooled[lane];
        const aur_vector light = aur_vector_multiply(local->coefficient, local->irradiance);
        stratum->pool_adds[0] -= (double)light.x;
        stratum->pool_adds[1] -= (double)light.y;
        stratum->pool_adds[2] -= (double)light.z;
    }
    return true;
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

/* Pixels; no filter of ours reaches farther. */
enum { SIDE = AUR_TILE_SIZE, MOST_REACH = 2, MOST_SIDE = SIDE + 2 * MOST_REACH };

/* What a pixel's samples hit: the key of one surface, and whether there were others. */
typedef struct glance {
    uint64_t key;
    bool exists, several, light;
} glance;

/* A tile's pixels and the ring around it, as wide as the reach of edges: what each pixel sees. */
typedef struct surroundings {
    const aur_view *view;
    const aur_pixel_strata *strata; /* of the tile's pixels */
    size_t reach, side;             /* the ring's width, and the pixels of a row with it on both sides */
    glance seen[MOST_SIDE * MOST_SIDE];
} surroundings;

static void see(glance *self, uint64_t key) {
    self->several = self->several || (self->exists && key != self->key);
    self->light = self->light || (key & AUR_SURFACE_KEY_EMITS) != 0;
    self->key = key;
    self->exists = true;
}

/* Pixels, 16 at a time: what the first sample of each sees. */
static void probe_pixels(const aur_gather_plan *plan, const aur_view *view, size_t count, const size_t *x,
                         const size_t *y, glance *const *seen) {
    aur_packet packet;
    aur_camera_sample samples[AUR_PACKET_SIZE];
    aur_packet_clear(&packet);
    aur_view_samples(view, count, x, y, (const uint32_t[AUR_PACKET_SIZE]){0}, samples);
    for (size_t k = 0; k < count; ++k)
        aur_packet_set(&packet, k, &samples[k].ray);
    const uint32_t found = aur_gather_intersect(plan, AUR_EMBREE_COHERENT, &packet);
    for (size_t k = 0; k < count; ++k)
        see(seen[k], (found >> k & 1u) != 0 ? aur_gather_surface_key(plan->classes, &packet, k) : 0);
}

/* The tile's pixel at an index of the surroundings; NULL on the ring around the tile. */
static const aur_pixel_strata *tile_pixel(const surroundings *self, size_t surface_point) {
    const size_t column = surface_point % self->side, row = surface_point / self->side, reach = self->reach;
    const bool inside = column >= reach && column < SIDE + reach && row >= reach && row < SIDE + reach;
    return inside ? &self->strata[(row - reach) * SIDE + (column - reach)] : NULL;
}

/* Whether a pixel within reach has samples, so that an edge between them counts. */
static bool is_near_samples(const surroundings *self, size_t surface_point) {
    const size_t column = surface_point % self->side, row = surface_point / self->side, reach = self->reach;
    for (size_t j = row > reach ? row - reach : 0; j <= row + reach && j < self->side; ++j)
        for (size_t i = column > reach ? column - reach : 0; i <= column + reach && i < self->side; ++i) {
            const aur_pixel_strata *const other = tile_pixel(self, j * self->side + i);
            if (other != NULL && other->count > 0)
                return true;
        }
    return false;
}

/* Finds what the pixels near those with samples see. With `equal_counts`, the samples of the tile's
 * pixels provide it. Otherwise the result would depend on which neighbours have
 * samples, so one ray per pixel is traced, as on the ring. Pixels beyond the image see nothing and make no
 * edge. */
static void find_surroundings(const aur_gather_plan *plan, size_t left, size_t top, bool equal_counts,
                              surroundings *self) {
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE], count = 0;
    glance *seen[AUR_PACKET_SIZE];
    const size_t reach = self->reach, surface_points = self->side * self->side;
    for (size_t i = 0; i < surface_points; ++i) {
        const aur_pixel_strata *const local = tile_pixel(self, i);
        self->seen[i] = (glance){0};
        if (equal_counts && local != NULL && local->count > 0) {
            for (uint32_t k = 0; k < local->count; ++k)
                see(&self->seen[i], local->strata[k].key);
            continue;
        }
        const size_t column = left + i % self->side, row = top + i / self->side; /* too many by the reach */
        if (column < reach || row < reach || column >= self->view->width + reach ||
            row >= self->view->height + reach || !is_near_samples(self, i))
            continue;
        x[count] = column - reach;
        y[count] = row - reach;
        seen[count++] = &self->seen[i];
        if (count == AUR_PACKET_SIZE) {
            probe_pixels(plan, self->view, count, x, y, seen);
            count = 0;
        }
    }
    if (count > 0)
        probe_pixels(plan, self->view, count, x, y, seen);
}

/* The strongest edge among what the pixels within reach see. The pixel's samples do not count: otherwise
 * pixels that hit a small light by chance would be refined and lower their estimate, and those that missed it
 * would not raise theirs. */
static aur_gather_edge edge_at(const surroundings *self, size_t x, size_t y) {
    glance all = {0};
    const size_t across = 2 * self->reach + 1;
    for (size_t i = 0; i < across * across; ++i) {
        const glance *const other = &self->seen[(y + i / across) * self->side + x + i % across];
        if (i == across * across / 2 || !other->exists)
            continue;
        see(&all, other->key);
        all.several = all.several || other->several;
        all.light = all.light || other->light;
    }
    if (!all.several)
        return AUR_NO_EDGE;
    return all.light ? AUR_LIGHT_EDGE : AUR_PLAIN_EDGE;
}

/* With a wide filter, pixels see a little beyond their direct neighbours, with few samples there: a ring of
 * width 1 would miss edges. */
static size_t reach_of(const aur_filter *filter) {
    const float radius = -aur_filter_sample(filter, 0.0f);
    const size_t reach = (size_t)ceilf(aur_larger(radius - 0.5f, 1.0f));
    return reach < MOST_REACH ? reach : MOST_REACH;
}

static bool is_emitter_edge(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y) {
    return plan->emitter_edges != NULL && x < view->width && y < view->height &&
           plan->emitter_edges[y * view->width + x] > 0;
}

void aur_gather_find_edges(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y,
                           const aur_pixel_strata *strata, bool equal_counts,
                           aur_gather_edge edges[AUR_TILE_PIXELS]) {
    const size_t reach = reach_of(view->filter);
    surroundings all;
    all.view = view;
    all.strata = strata;
    all.reach = reach;
    all.side = SIDE + 2 * reach;
    find_surroundings(plan, x, y, equal_counts, &all);
    for (size_t pixel = 0; pixel < AUR_TILE_PIXELS; ++pixel) {
        const size_t column = pixel % SIDE, row = pixel / SIDE;
        if (strata[pixel].count == 0)
            edges[pixel] = AUR_NO_EDGE;
        else if (is_emitter_edge(plan, view, x + column, y + row))
            edges[pixel] = AUR_LIGHT_EDGE;
        else
            edges[pixel] = edge_at(&all, column, row);
    }
}
