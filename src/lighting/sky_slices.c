#include "lighting/sky_slices.h"

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "lighting/box_tree.h"
#include "lighting/merged_facets.h"
#include "lighting/slice_kernel.h"

/* The half planes of a facet end in a line through one of its places, along the axis of space in which there
 * is most sky: over a city they stand upright, and what hides the sky in one is all below a slope. That makes
 * the walk through the tree short; what is found is right with any axis. Sines of elevation are divided into
 * cells, of which each is asked at one place, the same in all cells of a half plane and random: a bias of a
 * few millionths of the sky is left, because a cell has the weight of the whole of it. */

enum { BLOCK = 64, BUCKETS = 64, LANES = AUR_SLICE_LANES };

struct aur_sky_slices {
    const aur_facets *facets;
    size_t count, randomizations;
    uint64_t seed;
    float *points; /* [randomizations][count][4] */
    int axes[3];   /* which coordinates stand first, second and third */
    double sign;   /* of the third one */
    aur_slice_tree tree;
};

/* An open surface lacks area where the sky is, so that the sum of its normals by area points there. */
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
    const double slack = 4e-7 * facets->reach; /* to which floats know places */
    aur_box_tree boxes = {0};
    aur_merged_facet *merged;
    size_t count;
    aur_result result = aur_merge_facets(facets, slack, &count, &merged, error);
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
    aur_sky_slices *const made = calloc(1, sizeof *made);
    double *const points = malloc(4 * all * sizeof *points);
    aur_result result = made != NULL && points != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK) {
        *made = (aur_sky_slices){
            .facets = facets, .count = count, .randomizations = randomizations, .seed = seed};
        made->points = malloc(4 * all * sizeof *made->points);
        choose_axis(facets, made);
        result =
            made->points != NULL ? aur_facet_points(set, all, seed, points, error) : aur_fail_memory(error);
    }
    for (size_t i = 0; result == AUR_OK && i < 4 * all; ++i)
        made->points[i] = (float)points[i];
    if (result == AUR_OK)
        result = make_tree(facets, made, error);
    free(points);
    if (result != AUR_OK)
        aur_sky_slices_destroy(made);
    *slices = result == AUR_OK ? made : NULL;
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

/* A half plane before it stands in a packet. */
typedef struct sample {
    float way[2], place[2], jitter, weight;
    uint32_t randomization, bucket;
} sample;

/* A patch in turned coordinates. */
typedef struct viewer {
    aur_slice_view view;
    float corner[3], edge[2][3], inset;
    double ahead[2], upright; /* the normal's way, of unit length, and how much of it there is */
} viewer;

static void make_viewer(const aur_sky_slices *s, size_t patch, viewer *v) {
    const aur_facets *const facets = s->facets;
    const aur_plane plane = aur_patch_plane(facets, patch);
    double corners[3][3];
    aur_patch_corners(facets, patch, corners);
    for (size_t c = 0; c < 3; ++c) {
        double corner[3];
        turn(s, corners[c], corner);
        for (int d = 0; d < 3; ++d)
            *(c == 0 ? &v->corner[d] : &v->edge[c - 1][d]) =
                (float)corner[d] - (c == 0 ? 0.0f : v->corner[d]);
    }
    aur_slice_view *const view = &v->view;
    turn(s, plane.normal, view->normal);
    view->offset = plane.offset;
    view->slack = 4e-7 * facets->reach;
    v->inset = aur_facet_inset(facets, aur_facet_of(facets, patch));
    const double *const n = view->normal;
    v->upright = hypot(n[0], n[1]);
    v->ahead[0] = v->upright > 0.0 ? n[0] / v->upright : 1.0;
    v->ahead[1] = v->upright > 0.0 ? n[1] / v->upright : 0.0;
    const double lowest = n[2] >= 0.0 ? -v->upright : -1.0, highest = n[2] >= 0.0 ? 1.0 : v->upright;
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
}

static float shifted(float x, float shift) {
    const float sum = x + shift;
    return sum >= 1.0f ? sum - 1.0f : sum;
}

/* Azimuths that are uniform for a level patch and in proportion to the cosine for an upright one, as what is
 * seen in them is; a mixture of both for the others. */
static void choose_way(const viewer *v, double u, sample *made) {
    double c, s;
    if (u < v->upright) {
        s = 2.0 * u / v->upright - 1.0;
        c = sqrt(fmax(1e-12, 1.0 - s * s));
    } else {
        const double angle = 2.0 * AUR_PI * (u - v->upright) / (1.0 - v->upright);
        c = cos(angle);
        s = sin(angle);
    }
    made->way[0] = (float)(c * v->ahead[0] - s * v->ahead[1]);
    made->way[1] = (float)(c * v->ahead[1] + s * v->ahead[0]);
    made->weight = (float)(1.0 / ((1.0 - v->upright) / (2.0 * AUR_PI) + v->upright * fmax(0.0, c) / 2.0));
    made->bucket = (uint32_t)(fmin(u, 1.0 - 0x1p-24) * BUCKETS);
}

/* Samples in the order of their azimuths, so that those of a packet go through the same boxes. */
static void draw_samples(const aur_sky_slices *s, const viewer *v, size_t patch, sample *unordered,
                         sample *ordered) {
    size_t starts[BUCKETS + 1] = {0}, made = 0;
    const uint64_t hash = aur_hash3(s->seed, UINT64_C(0x736c69636573), patch);
    float shift[4];
    for (size_t d = 0; d < 4; ++d)
        shift[d] = aur_unit_float((uint32_t)(aur_hash2(hash, d) >> 32));
    for (size_t r = 0; r < s->randomizations; ++r)
        for (size_t i = 0; i < s->count; ++i) {
            const float *const point = &s->points[4 * made];
            sample *const one = &unordered[made++];
            *one = (sample){.randomization = (uint32_t)r, .jitter = shifted(point[3], shift[3])};
            choose_way(v, (double)shifted(point[0], shift[0]), one);
            const float root = sqrtf(shifted(point[1], shift[1]));
            one->place[1] = root * shifted(point[2], shift[2]);
            one->place[0] = root - one->place[1];
            for (size_t d = 0; d < 2; ++d)
                one->place[d] += v->inset * (1.0f - 3.0f * one->place[d]);
            ++starts[one->bucket + 1];
        }
    for (size_t b = 0; b < BUCKETS; ++b)
        starts[b + 1] += starts[b];
    for (size_t i = 0; i < made; ++i)
        ordered[starts[unordered[i].bucket]++] = unordered[i];
}

static void look(const aur_sky_slices *s, const viewer *v, const sample *samples, aur_slice_kernel *kernel,
                 double *wholes, double *sky) {
    const size_t count = s->count * s->randomizations;
    for (size_t r = 0; r < s->randomizations; ++r)
        wholes[r] = sky[r] = 0.0;
    for (size_t first = 0; first < count; first += LANES) {
        aur_slices packet;
        for (size_t l = 0; l < LANES; ++l) {
            const sample *const one = &samples[first + l < count ? first + l : count - 1];
            for (int d = 0; d < 3; ++d)
                packet.origin[d][l] =
                    v->corner[d] + one->place[0] * v->edge[0][d] + one->place[1] * v->edge[1][d];
            packet.way[0][l] = one->way[0];
            packet.way[1][l] = one->way[1];
            packet.jitter[l] = one->jitter;
        }
        aur_slice_parts parts;
        kernel(&s->tree, &v->view, &packet, &parts);
        for (size_t l = 0; l < LANES && first + l < count; ++l) {
            const sample *const one = &samples[first + l];
            wholes[one->randomization] += (double)one->weight * (double)parts.whole[l];
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
    sample *const samples = malloc(2 * count * sizeof *samples);
    double *const wholes = malloc(s->randomizations * sizeof *wholes);
    const bool good = samples != NULL && wholes != NULL;
    for (size_t i = BLOCK * index; good && i < facets->patch_count && i < BLOCK * (index + 1); ++i) {
        if (facets->areas[aur_facet_of(facets, i)] == 0.0)
            continue;
        viewer v;
        make_viewer(s, i, &v);
        draw_samples(s, &v, i, samples, samples + count);
        look(s, &v, samples + count, work->kernel, wholes, &work->sky[s->randomizations * i]);
    }
    free(samples);
    free(wholes);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}

aur_result aur_sky_slices_measure(const aur_sky_slices *slices, const aur_parallel_options *parallel,
                                  double *sky, aur_error *error) {
    const size_t patches = slices->facets->patch_count;
    memset(sky, 0, patches * slices->randomizations * sizeof *sky);
    measuring work = {slices, aur_slice_kernel_here(), sky};
    aur_parallel_options options = *parallel;
    options.what = "measuring the sky";
    options.flush_denormals = true;
    return aur_parallel_for(&options, (patches + BLOCK - 1) / BLOCK, measure_block, &work, error);
}
