#include "render/radiosity/solution.h"

#include <aureole/sphere.h>
#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/io.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "render/radiosity/scene.h"

/* --- making */

static aur_result check_options(const aur_radiosity_options *options, aur_error *error) {
    if (options->bounces < 1 || options->bounces > AUR_RADIOSITY_MOST_BOUNCES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "radiosity: bounces must be between 1 and %d, not %zu",
                        AUR_RADIOSITY_MOST_BOUNCES, options->bounces);
    if (options->randomizations < 1 || options->randomizations > AUR_RADIOSITY_MOST_RANDOMIZATIONS)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: randomizations must be between 1 and %d, not %zu",
                        AUR_RADIOSITY_MOST_RANDOMIZATIONS, options->randomizations);
    return AUR_OK;
}

static aur_location location_of(const aur_radiosity_scene *scene, uint32_t triangle) {
    return aur_scene_shape_location(scene->scene, scene->triangles[triangle].shape);
}

static aur_result warn_of_coincidences(aur_radiosity *radiosity, aur_error *error) {
    const aur_radiosity_scene *const scene = &radiosity->scene;
    aur_radiosity_coincidence found;
    const aur_result result = aur_radiosity_find_coincidences(scene, &found, error);
    if (result != AUR_OK)
        return result;
    radiosity->coincident = found.pairs;
    if (found.pairs == 0)
        return AUR_OK;
    const aur_location other = location_of(scene, found.triangles[1]);
    aur_warn_at(&radiosity->options.warnings, location_of(scene, found.triangles[0]),
                "radiosity: %" PRIu64
                " pairs of triangles%s lie on each other, the first of this shape and of that at "
                "%s:%zu:%zu: paths between them are lost",
                found.pairs, found.pairs >= AUR_RADIOSITY_MOST_COINCIDENCES ? " and more" : "",
                other.file != NULL ? other.file : "", other.line, other.column);
    return AUR_OK;
}

static aur_result make(aur_radiosity *created, const aur_scene *scene, aur_error *error) {
    const aur_radiosity_options *const options = &created->options;
    created->change = NAN;
    created->sequence = strdup(options->sequence != NULL ? options->sequence : "sobol");
    if (created->sequence == NULL)
        return aur_fail_memory(error);
    created->options.sequence = created->sequence;
    aur_result result =
        aur_radiosity_scene_create(scene, options->variant, &options->warnings, &created->scene, error);
    if (result == AUR_OK)
        result = aur_radiosity_walk_create(&created->scene, options, &created->walk, error);
    if (result == AUR_OK)
        result = aur_radiosity_tallies_create(options->randomizations, created->scene.patch_count,
                                              &created->tallies, error);
    return result == AUR_OK ? warn_of_coincidences(created, error) : result;
}

aur_result aur_radiosity_create(const aur_scene *scene, const aur_radiosity_options *options,
                                aur_radiosity **radiosity, aur_error *error) {
    *radiosity = NULL;
    aur_radiosity_options local = {.size = sizeof local};
    aur_radiosity_options_init(&local, NULL);
    aur_result result = aur_options_read(options, sizeof local, &local, "aur_radiosity_options", error);
    if (result == AUR_OK)
        result = check_options(&local, error);
    if (result != AUR_OK)
        return result;
    aur_radiosity *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->options = local;
    result = make(created, scene, error);
    if (result != AUR_OK) {
        aur_radiosity_destroy(created);
        return result;
    }
    *radiosity = created;
    return AUR_OK;
}

static void release_lanes(aur_radiosity *radiosity) {
    aur_radiosity_tallies_release(radiosity->lane_count * radiosity->options.randomizations,
                                  radiosity->lanes);
    radiosity->lanes = NULL;
    radiosity->lane_count = 0;
}

void aur_radiosity_destroy(aur_radiosity *radiosity) {
    if (radiosity == NULL)
        return;
    release_lanes(radiosity);
    aur_radiosity_tallies_release(radiosity->options.randomizations, radiosity->tallies);
    aur_radiosity_walk_release(&radiosity->walk);
    aur_radiosity_scene_release(&radiosity->scene);
    free(radiosity->sequence);
    free(radiosity);
}

/* --- points */

/* The points of all randomisations. */
typedef struct point_source {
    size_t count;
    aur_pointset **sets;
    uint64_t skipped; /* points left out at the beginning */
} point_source;

static void release_points(point_source *points) {
    for (size_t r = 0; points->sets != NULL && r < points->count; ++r)
        aur_pointset_destroy(points->sets[r]);
    free(points->sets);
    *points = (point_source){0};
}

static bool begins_with_zero(const aur_pointset *set) {
    for (size_t d = 0; d < aur_pointset_dimension(set); ++d)
        if (aur_pointset_coordinate(set, 0, d) != 0.0)
            return false;
    return true;
}

static aur_result make_set(const aur_radiosity *radiosity, size_t r, uint64_t count, aur_pointset **set,
                           aur_error *error) {
    const aur_radiosity_options *const options = &radiosity->options;
    const aur_pointset_options local = {
        .size = sizeof local,
        .count = count,
        .dimension = 2 * options->bounces + 4,
        .scramble = options->scramble,
        .seed = options->randomizations > 1 ? aur_hash3(options->seed, 0x72616e646f6d, r) : options->seed};
    return aur_pointset_create(radiosity->sequence, &local, set, error);
}

/* Refuses randomisations that are all the same, because the set is not scrambled: the second points of two of
 * them must differ somewhere. */
static aur_result check_randomized(const aur_radiosity *radiosity, const point_source *points,
                                   aur_error *error) {
    const uint64_t index = aur_pointset_size(points->sets[1]) > 1 ? 1 : 0;
    for (size_t d = 0; d < aur_pointset_dimension(points->sets[0]); ++d)
        if (aur_pointset_coordinate(points->sets[0], index, d) !=
            aur_pointset_coordinate(points->sets[1], index, d))
            return AUR_OK;
    return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                    "radiosity: %zu randomizations of '%s' need a scrambling: owen, digit or shift",
                    radiosity->options.randomizations, radiosity->sequence);
}

static aur_result make_points(const aur_radiosity *radiosity, uint64_t paths, point_source *points,
                              aur_error *error) {
    *points = (point_source){.count = radiosity->options.randomizations};
    points->sets = calloc(points->count, sizeof(aur_pointset *));
    if (points->sets == NULL)
        return aur_fail_memory(error);
    const uint64_t most = aur_radiosity_paths_of(radiosity, 0, paths);
    aur_result result = make_set(radiosity, 0, most, &points->sets[0], error);
    points->skipped = result == AUR_OK && begins_with_zero(points->sets[0]);
    if (points->skipped > 0) {
        aur_pointset_destroy(points->sets[0]);
        points->sets[0] = NULL;
    }
    for (size_t r = points->skipped > 0 ? 0 : 1; r < points->count && result == AUR_OK; ++r)
        result = make_set(radiosity, r, most + points->skipped, &points->sets[r], error);
    if (result == AUR_OK && radiosity->paths > 0 && !aur_set_find(radiosity->sequence)->extensible)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "radiosity: '%s' cannot be continued: its first points depend on their number",
                          radiosity->sequence);
    if (result == AUR_OK && points->count > 1)
        result = check_randomized(radiosity, points, error);
    if (result != AUR_OK)
        release_points(points);
    return result;
}

/* --- tracing */

/* A range of points of one randomisation, processed in blocks. */
typedef struct batch {
    const aur_radiosity *radiosity;
    const point_source *points;
    uint64_t begin, end; /* paths */
    size_t blocks_each;  /* of one randomisation, at most */
    size_t last;         /* this process does blocks up to here */
    atomic_size_t next;
} batch;

static aur_result run_lane(void *context, size_t lane) {
    batch *const work = context;
    const aur_radiosity *const radiosity = work->radiosity;
    const size_t count = radiosity->options.randomizations;
    for (;;) {
        const size_t item = atomic_fetch_add(&work->next, 1);
        if (item >= work->last)
            return AUR_OK;
        const size_t r = item / work->blocks_each;
        const uint64_t end = aur_radiosity_paths_of(radiosity, r, work->end);
        const uint64_t first = aur_radiosity_paths_of(radiosity, r, work->begin) +
                               item % work->blocks_each * (uint64_t)AUR_RADIOSITY_BLOCK;
        if (first >= end)
            continue;
        const uint64_t left = end - first;
        aur_radiosity_tally *const tally = &radiosity->lanes[lane * count + r];
        const uint64_t before = aur_rays_traced;
        aur_radiosity_walk_block(&radiosity->walk, work->points->sets[r], r, work->points->skipped + first,
                                 left < AUR_RADIOSITY_BLOCK ? (size_t)left : AUR_RADIOSITY_BLOCK, tally);
        tally->rays += aur_rays_traced - before;
    }
}

static aur_result prepare_lanes(aur_radiosity *radiosity, aur_error *error) {
    const size_t lanes = aur_parallel_threads(radiosity->options.threads);
    if (radiosity->lane_count == lanes)
        return AUR_OK;
    release_lanes(radiosity);
    const aur_result result = aur_radiosity_tallies_create(
        lanes * radiosity->options.randomizations, radiosity->scene.patch_count, &radiosity->lanes, error);
    radiosity->lane_count = result == AUR_OK ? lanes : 0;
    return result;
}

static size_t process_count(void) {
    return aur_io_here() != NULL ? aur_io_here()->count : 1;
}

static aur_result trace_batch(aur_radiosity *radiosity, const point_source *points, uint64_t end,
                              aur_error *error) {
    const size_t count = radiosity->options.randomizations;
    batch work = {.radiosity = radiosity, .points = points, .begin = radiosity->paths, .end = end};
    const uint64_t longest = aur_radiosity_paths_of(radiosity, 0, end) -
                             aur_radiosity_paths_of(radiosity, count - 1, radiosity->paths);
    work.blocks_each = (size_t)(longest / AUR_RADIOSITY_BLOCK + 1);
    /* Each of several processes takes a range of the blocks. */
    const aur_io *const io = aur_io_here();
    const size_t rank = io != NULL ? io->rank : 0, blocks = count * work.blocks_each;
    atomic_init(&work.next, blocks * rank / process_count());
    work.last = blocks * (rank + 1) / process_count();
    const aur_parallel_options parallel = {
        .threads = radiosity->lane_count, .what = "radiosity", .flush_denormals = true};
    aur_radiosity_tally *const lanes = radiosity->lanes;
    aur_result result = aur_parallel_for(&parallel, radiosity->lane_count, run_lane, &work, error);
    for (size_t i = count; i < radiosity->lane_count * count; ++i) {
        lanes[i % count].not_finite |= lanes[i].not_finite;
        aur_radiosity_tally_take(&lanes[i % count], &lanes[i]);
    }
    if (result == AUR_OK)
        result = aur_radiosity_tallies_share(count, lanes, error);
    bool not_finite = false;
    for (size_t i = 0; i < count; ++i)
        not_finite |= lanes[i].not_finite;
    if (not_finite) {
        release_lanes(radiosity); /* the solution stays what it was before these paths */
        return aur_fail(
            error, AUR_ERROR_FORMAT,
            "radiosity: the power of a path is not finite: a texture or material has such values");
    }
    for (size_t i = 0; i < count; ++i)
        aur_radiosity_tally_take(&radiosity->tallies[i], &lanes[i]);
    radiosity->paths = end;
    return result;
}

static void warn_of_ends(aur_radiosity *radiosity) {
    if (radiosity->warned)
        return;
    aur_radiosity_description d;
    aur_radiosity_summarize(radiosity, &d);
    const aur_warnings *const warnings = &radiosity->options.warnings;
    uint64_t cut = 0;
    for (size_t r = 0; r < radiosity->options.randomizations; ++r)
        cut += radiosity->tallies[r].cut;
    if (cut > 0)
        aur_warn_at(
            warnings, (aur_location){0},
            "radiosity: %" PRIu64
            " times a path had more than 2^20 times the power that the brightest light gives it: what "
            "is beyond that is cut off",
            cut);
    const struct {
        uint64_t count;
        const char *what;
    } ends[] = {{d.lost, d.coincident > 0 ? "left the scene: it is open, or surfaces lie on each other"
                                          : "left the scene: it is open"},
                {d.behind, "ended on the back of a one-sided surface"},
                {d.trapped, "ended between mirrors"}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; ++i)
        if (ends[i].count > 0)
            aur_warn_at(warnings, (aur_location){0},
                        "radiosity: %" PRIu64 " of %" PRIu64 " paths (%.3g %%) %s", ends[i].count, d.paths,
                        100.0 / (double)d.paths * (double)ends[i].count, ends[i].what);
    radiosity->warned = d.lost > 0 || d.behind > 0 || d.trapped > 0 || cut > 0;
}

aur_result aur_radiosity_trace(aur_radiosity *radiosity, uint64_t paths, aur_error *error) {
    enum { BLOCKS_A_BATCH = 128 };
    if (paths == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "radiosity: the number of paths must be at least 1");
    if (paths < radiosity->paths)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: there are %" PRIu64 " paths already: %" PRIu64 " are fewer",
                        radiosity->paths, paths);
    if (paths == radiosity->paths)
        return AUR_OK;
    point_source points;
    aur_result result = make_points(radiosity, paths, &points, error);
    if (result != AUR_OK)
        return result;
    result = prepare_lanes(radiosity, error);
    const aur_progress *const progress = &radiosity->options.progress;
    const uint64_t batch_paths =
        (uint64_t)AUR_RADIOSITY_BLOCK * BLOCKS_A_BATCH * radiosity->lane_count * process_count();
    while (result == AUR_OK && radiosity->paths < paths) {
        const uint64_t left = paths - radiosity->paths;
        result = trace_batch(radiosity, &points, radiosity->paths + (left < batch_paths ? left : batch_paths),
                             error);
        if (result == AUR_OK && left > batch_paths &&
            aur_progress_stops(progress, "radiosity", radiosity->paths, paths))
            result = aur_fail(error, AUR_ERROR_CANCELLED, "cancelled");
    }
    release_points(&points);
    if (result == AUR_OK)
        warn_of_ends(radiosity);
    return result;
}

aur_result aur_radiosity_options_init(aur_radiosity_options *options, aur_error *error) {
    static const aur_radiosity_options defaults = {
        .size = sizeof defaults, .bounces = 6, .randomizations = 1};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_radiosity_options", error);
}
