#include "lighting/viewfactors/sky_slices.h"

#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/covers.h"
#include "lighting/viewfactors/slice_kernel.h"
#include "points/base/random.h"

/* The half planes of a facet share an edge line through one of its points, parallel to the coordinate axis
 * with the most sky. Over a city they are vertical, and all occluders in one are below a slope. This makes
 * the tree traversal short; the result is correct for any axis. Sines of elevation are divided into cells.
 * Each cell is tested at one jittered position, the same in all cells of a half plane. A bias of a few
 * millionths of the sky remains, because the whole cell is counted. */

enum { BLOCK = 64, LANES = AUR_SLICE_LANES };

struct aur_sky_slices {
    const aur_facets *facets;
    size_t count, randomizations;
    uint64_t seed;
    float *points; /* [randomizations][count][4] */
    int axes[3];   /* axis permutation */
    double sign;   /* sign of the third axis */
    aur_slice_tree tree;
};

/* The sum of area-weighted normals of an open surface points to its opening, the sky. */
static void choose_axis(const aur_facets *facets, aur_sky_slices *s) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < facets->count; ++i)
        for (int d = 0; d < 3; ++d)
            sum[d] += facets->areas[i] * facets->planes[i].normal[d];
    int axis = 2;
    for (int d = 0; d < 2; ++d)
        if (fabs(sum[d]) > fabs(sum[axis]) * (1.0 + 1e-9))
            axis = d;
    for (int d = 0; d < 3; ++d)
        s->axes[d] = (axis + 1 + d) % 3;
    s->sign = sum[axis] < 0.0 ? -1.0 : 1.0;
}

static void turn(const aur_sky_slices *s, const double from[3], double to[3]) {
    for (int d = 0; d < 3; ++d)
        to[d] = d == 2 ? s->sign * from[s->axes[d]] : from[s->axes[d]];
}

static void turn_polygons(const aur_sky_slices *s, const aur_merged_facet *merged, const aur_box_tree *boxes,
                          size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const aur_merged_facet *const from = &merged[boxes->items[i]];
        s->tree.polygons[i].count = (uint32_t)from->count;
        for (size_t c = 0; c < from->count; ++c) {
            double corner[3];
            turn(s, from->corners[c], corner);
            for (int d = 0; d < 3; ++d)
                s->tree.polygons[i].corners[c][d] = (float)corner[d];
        }
    }
}

static void turn_nodes(const aur_sky_slices *s, const aur_box_tree *boxes, double slack) {
    for (size_t i = 0; i < boxes->node_count; ++i) {
        const aur_box_node *const box = &boxes->nodes[i];
        aur_slice_node *const node = &s->tree.nodes[i];
        *node = (aur_slice_node){.first = box->first, .count = box->count, .skip = box->skip};
        double a[3], b[3];
        turn(s, box->lower, a);
        turn(s, box->upper, b);
        for (int d = 0; d < 3; ++d) {
            node->lower[d] = (float)(fmin(a[d], b[d]) - slack);
            node->upper[d] = (float)(fmax(a[d], b[d]) + slack);
        }
    }
}

static aur_result make_tree(const aur_facets *facets, aur_sky_slices *s, aur_error *error) {
    const double slack =
        4e-7 * fmax(facets->reach[0],
                    fmax(facets->reach[1],
                         facets->reach[2])); /* larger than float rounding errors: boxes may be too wide */
    aur_box_tree boxes = {0};
    aur_merged_facet *merged;
    size_t count;
    aur_result result = aur_merge_facets(facets, &count, &merged, error);
    aur_box *const items = malloc((count + 1) * sizeof *items);
    s->tree.leaf = AUR_BOX_LEAF;
    s->tree.nodes = malloc(2 * (count + 1) * sizeof *s->tree.nodes);
    s->tree.polygons = malloc((count + 1) * sizeof *s->tree.polygons);
    if (result == AUR_OK && (items == NULL || s->tree.nodes == NULL || s->tree.polygons == NULL))
        result = aur_fail_memory(error);
    for (size_t i = 0; result == AUR_OK && i < count; ++i)
        items[i] = aur_box_of(merged[i].count, (const double(*)[3])merged[i].corners);
    if (result == AUR_OK)
        result = aur_box_tree_create(count, items, &boxes, error);
    if (result == AUR_OK) {
        turn_nodes(s, &boxes, slack);
        turn_polygons(s, merged, &boxes, count);
    }
    aur_box_tree_release(&boxes);
    free(items);
    free(merged);
    return result;
}

aur_result aur_sky_slices_create(const aur_facets *facets, const char *set, size_t count,
                                 size_t randomizations, uint64_t seed, aur_sky_slices **slices,
                                 aur_error *error) {
    const size_t all = count * randomizations;
    aur_sky_slices *const created = calloc(1, sizeof *created);
    double *const points = malloc(4 * all * sizeof *points);
    aur_result result = created != NULL && points != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK) {
        *created = (aur_sky_slices){
            .facets = facets, .count = count, .randomizations = randomizations, .seed = seed};
        created->points = malloc(4 * all * sizeof *created->points);
        choose_axis(facets, created);
        result = created->points != NULL ? aur_facet_points(set, all, seed, points, error)
                                         : aur_fail_memory(error);
    }
    for (size_t i = 0; result == AUR_OK && i < 4 * all; ++i)
        created->points[i] = (float)points[i];
    if (result == AUR_OK)
        result = make_tree(facets, created, error);
    free(points);
    if (result != AUR_OK)
        aur_sky_slices_destroy(created);
    *slices = result == AUR_OK ? created : NULL;
    return result;
}

void aur_sky_slices_destroy(aur_sky_slices *slices) {
    if (slices == NULL)
        return;
    free(slices->points);
    free(slices->tree.nodes);
    free(slices->tree.polygons);
    free(slices);
}

typedef struct viewer {
    aur_slice_view view;
    aur_slice_patch patch;
} viewer;

static aur_slice_word sum_word(const float rising[32], const float level[32]) {
    double sums[2] = {0.0, 0.0};
    aur_slice_word word = {.lowest_rising = rising[0],
                           .highest_rising = rising[0],
                           .lowest_level = level[0],
                           .highest_level = level[0]};
    for (int k = 0; k < 32; ++k) {
        sums[0] += (double)rising[k];
        sums[1] += (double)level[k];
        word.lowest_rising = fminf(word.lowest_rising, rising[k]);
        word.highest_rising = fmaxf(word.highest_rising, rising[k]);
        word.lowest_level = fminf(word.lowest_level, level[k]);
        word.highest_level = fmaxf(word.highest_level, level[k]);
    }
    word.rising = (float)sums[0];
    word.level = (float)sums[1];
    return word;
}

static void make_viewer(const aur_sky_slices *s, size_t patch, viewer *v) {
    const aur_facets *const facets = s->facets;
    const aur_plane plane = aur_patch_plane(facets, patch);
    aur_slice_patch *const p = &v->patch;
    double corners[3][3];
    aur_patch_corners(facets, patch, corners);
    for (size_t c = 0; c < 3; ++c) {
        double corner[3];
        turn(s, corners[c], corner);
        for (int d = 0; d < 3; ++d)
            *(c == 0 ? &p->corner[d] : &p->edge[c - 1][d]) =
                (float)corner[d] - (c == 0 ? 0.0f : p->corner[d]);
    }
    aur_slice_view *const view = &v->view;
    turn(s, plane.normal, view->normal);
    view->offset = plane.offset;
    view->slack = (double)aur_facet_offset(facets, aur_facet_of(facets, patch)); /* nearer ones are covers */
    p->inset = aur_facet_inset(facets, aur_facet_of(facets, patch));
    const double *const n = view->normal;
    p->upright = hypot(n[0], n[1]);
    p->ahead[0] = p->upright > 0.0 ? n[0] / p->upright : 1.0;
    p->ahead[1] = p->upright > 0.0 ? n[1] / p->upright : 0.0;
    const double lowest = n[2] >= 0.0 ? -p->upright : -1.0, highest = n[2] >= 0.0 ? 1.0 : p->upright;
    const double width = (highest - lowest) / AUR_SLICE_CELLS;
    view->lowest = (float)lowest;
    view->width = (float)width;
    double before = 0.0;
    for (int k = 0; k <= AUR_SLICE_CELLS; ++k) {
        const double x = fmin(fmax(lowest + k * width, -1.0), 1.0);
        const double integral = 0.5 * (x * sqrt(1.0 - x * x) + asin(x)); /* of sqrt(1 - x^2) */
        if (k > 0) {
            view->rising[k - 1] = (float)((x - 0.5 * width) * width);
            view->level[k - 1] = (float)(integral - before);
        }
        before = integral;
    }
    for (int w = 0; w < AUR_SLICE_WORDS; ++w)
        view->words[w] = sum_word(&view->rising[32 * w], &view->level[32 * w]);
}

/* Whether a facet that float rays cannot separate covers the point: then no sky is seen from there. */
static bool is_covered(const aur_facets *facets, size_t patch, const float position[2]) {
    const size_t facet = aur_facet_of(facets, patch);
    if (facets->cover_starts == NULL || facets->cover_starts[facet] == facets->cover_starts[facet + 1])
        return false;
    double corners[3][3], origin[3];
    aur_patch_corners(facets, patch, corners);
    for (int d = 0; d < 3; ++d)
        origin[d] = corners[0][d] + (double)position[0] * (corners[1][d] - corners[0][d]) +
                    (double)position[1] * (corners[2][d] - corners[0][d]);
    return aur_facets_first_met(facets, facet, origin, aur_patch_plane(facets, patch).normal, SIZE_MAX) !=
           SIZE_MAX;
}

static void trace_slices(const aur_sky_slices *s, size_t patch_index, const viewer *v,
                         const aur_slice_sample *samples, aur_slice_kernel *kernel, double *wholes,
                         double *sky) {
    const size_t count = s->count * s->randomizations;
    const aur_slice_patch *const patch = &v->patch;
    for (size_t r = 0; r < s->randomizations; ++r)
        wholes[r] = sky[r] = 0.0;
    for (size_t first = 0; first < count; first += LANES) {
        aur_slices packet;
        for (size_t l = 0; l < LANES; ++l) {
            const aur_slice_sample *const one = &samples[first + l < count ? first + l : count - 1];
            for (int d = 0; d < 3; ++d)
                packet.origin[d][l] = patch->corner[d] + one->position[0] * patch->edge[0][d] +
                                      one->position[1] * patch->edge[1][d];
            packet.way[0][l] = one->direction[0];
            packet.way[1][l] = one->direction[1];
            packet.jitter[l] = one->jitter;
        }
        aur_slice_parts parts;
        kernel(&s->tree, &v->view, &packet, &parts);
        for (size_t l = 0; l < LANES && first + l < count; ++l) {
            const aur_slice_sample *const one = &samples[first + l];
            wholes[one->randomization] += (double)one->weight * (double)parts.whole[l];
            if (!is_covered(s->facets, patch_index, one->position))
                sky[one->randomization] += (double)one->weight * (double)parts.sky[l];
        }
    }
    for (size_t r = 0; r < s->randomizations; ++r)
        sky[r] = wholes[r] > 0.0 ? sky[r] / wholes[r] : 0.0;
}

typedef struct measuring {
    const aur_sky_slices *slices;
    aur_slice_kernel *kernel;
    double *sky;
} measuring;

static aur_result measure_block(void *context, size_t index) {
    const measuring *const work = context;
    const aur_sky_slices *const s = work->slices;
    const aur_facets *const facets = s->facets;
    const size_t count = s->count * s->randomizations;
    aur_slice_sample *const samples = malloc(2 * count * sizeof *samples);
    double *const wholes = malloc(s->randomizations * sizeof *wholes);
    const bool good = samples != NULL && wholes != NULL;
    for (size_t i = BLOCK * index; good && i < facets->patch_count && i < BLOCK * (index + 1); ++i) {
        if (facets->areas[aur_facet_of(facets, i)] == 0.0)
            continue;
        viewer v;
        make_viewer(s, i, &v);
        aur_slice_samples_draw(&v.patch, s->randomizations, s->count, s->points,
                               aur_hash3(s->seed, UINT64_C(0x736c69636573), i), samples, samples + count);
        trace_slices(s, i, &v, samples + count, work->kernel, wholes, &work->sky[s->randomizations * i]);
    }
    free(samples);
    free(wholes);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}

aur_result aur_sky_slices_measure(const aur_sky_slices *slices, const aur_parallel_options *parallel,
                                  double *sky, aur_error *error) {
    const size_t patches = slices->facets->patch_count;
    memset(sky, 0, patches * slices->randomizations * sizeof *sky);
    measuring work = {slices, AUR_KERNEL_HERE(aur_slice_kernel), sky};
    aur_parallel_options options = *parallel;
    options.what = "measuring the sky";
    options.flush_denormals = true;
    const aur_result result =
        aur_parallel_for(&options, (patches + BLOCK - 1) / BLOCK, measure_block, &work, error);
    if (result == AUR_OK)
        aur_net_spread_settle(patches, slices->randomizations, sky);
    return result;
}
