#include "lighting/viewfactors/sky_slices.h"

#include <math.h>

#include "points/base/random.h"
#include "points/base/vector.h"

enum { BUCKETS = 64 };

static float shifted(float x, float shift) {
    const float sum = x + shift;
    return sum >= 1.0f ? sum - 1.0f : sum;
}

/* Azimuths are uniform for a horizontal patch and proportional to the cosine for a vertical one, like the
 * view; for others the pdf is a mixture of both. */
static void choose_direction(const aur_slice_patch *patch, double u, aur_slice_sample *sample) {
    double c, s;
    if (u < patch->upright) {
        s = 2.0 * u / patch->upright - 1.0;
        c = sqrt(fmax(1e-12, 1.0 - s * s));
    } else {
        const double angle = 2.0 * AUR_PI * (u - patch->upright) / (1.0 - patch->upright);
        c = cos(angle);
        s = sin(angle);
    }
    sample->direction[0] = (float)(c * patch->ahead[0] - s * patch->ahead[1]);
    sample->direction[1] = (float)(c * patch->ahead[1] + s * patch->ahead[0]);
    sample->weight =
        (float)(1.0 / ((1.0 - patch->upright) / (2.0 * AUR_PI) + patch->upright * fmax(0.0, c) / 2.0));
    sample->bucket = (uint32_t)(fmin(u, 1.0 - 0x1p-24) * BUCKETS);
}

/* The plane of a half plane intersects the patch in a chord. Horizons jump between planes, at vertical edges,
 * and never along a chord. So jumps are in two coordinates of the points: the azimuth, and the choice among
 * the parallel planes (`u`, proportional to the chord's length). The third coordinate, the position on the
 * chord (`w`), is smooth. */
static void choose_position(const aur_slice_patch *patch, float u, float w, aur_slice_sample *sample) {
    float across[3] = {0.0f}, along[3] = {0.0f};
    for (int k = 0; k < 2; ++k) {
        const float *const edge = patch->edge[k];
        across[k + 1] = sample->direction[0] * edge[1] - sample->direction[1] * edge[0];
        along[k + 1] = sample->direction[0] * edge[0] + sample->direction[1] * edge[1];
    }
    int low = 0, high = 0;
    for (int k = 1; k < 3; ++k) {
        low = across[k] < across[low] ? k : low;
        high = across[k] >= across[high] ? k : high;
    }
    if (low == high) /* not finite: any three corners do */
        high = (low + 1) % 3;
    const int middle = 3 - low - high;
    const float width = across[high] - across[low];
    const float peak = width > 0.0f ? (across[middle] - across[low]) / width : 0.5f;
    const bool before = u < peak;
    const float at = before ? sqrtf(u * peak) : 1.0f - sqrtf((1.0f - u) * (1.0f - peak));
    const float part = before ? at / peak : peak < 1.0f ? (1.0f - at) / (1.0f - peak) : 1.0f;
    /* Barycentric coordinates of the chord's ends: on the side from low to high, and on one of the other two.
     */
    float ends[2][3] = {{0.0f}, {0.0f}};
    ends[0][low] = 1.0f - at;
    ends[0][high] = at;
    ends[1][middle] = part;
    ends[1][before ? low : high] = 1.0f - part;
    float reach[2] = {0.0f, 0.0f};
    for (int e = 0; e < 2; ++e)
        for (int k = 1; k < 3; ++k)
            reach[e] += ends[e][k] * along[k];
    const int rear = reach[1] < reach[0];
    for (int d = 0; d < 2; ++d) {
        const float coordinate = ends[rear][d + 1] + w * (ends[!rear][d + 1] - ends[rear][d + 1]);
        sample->position[d] = coordinate + patch->inset * (1.0f - 3.0f * coordinate);
    }
}

void aur_slice_samples_draw(const aur_slice_patch *patch, size_t randomizations, size_t count,
                            const float *points, uint64_t hash, aur_slice_sample *unordered,
                            aur_slice_sample *ordered) {
    size_t starts[BUCKETS + 1] = {0}, drawn = 0;
    float shift[4];
    for (size_t d = 0; d < 4; ++d)
        shift[d] = aur_unit_float((uint32_t)(aur_hash2(hash, d) >> 32));
    for (size_t r = 0; r < randomizations; ++r)
        for (size_t i = 0; i < count; ++i) {
            const float *const point = &points[4 * drawn];
            aur_slice_sample *const one = &unordered[drawn++];
            *one = (aur_slice_sample){.randomization = (uint32_t)r, .jitter = shifted(point[3], shift[3])};
            choose_direction(patch, (double)shifted(point[0], shift[0]), one);
            choose_position(patch, shifted(point[1], shift[1]), shifted(point[2], shift[2]), one);
            ++starts[one->bucket + 1];
        }
    for (size_t b = 0; b < BUCKETS; ++b)
        starts[b + 1] += starts[b];
    for (size_t i = 0; i < drawn; ++i)
        ordered[starts[unordered[i].bucket]++] = unordered[i];
}
