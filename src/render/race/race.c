#include "render/race/race.h"

#include <aureole/statistics.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "render/driver/renderer.h"
#include "render/vertex/visible_emitters.h"

enum { PIXELS = AUR_BLOCK_PIXELS, MAP_PHOTONS = 50000, RESAMPLINGS = 300, BRIEF_BLOCKS = 6 };
/* By aureole-bench race-limits, half and twice of each limit and other confidences take the same candidates;
 * twice the first blocks cost a twentieth more. */
static const aur_race_limits default_limits = {
    .first_blocks = 9, .first_part = 0.2, .part = 0.05, .confidence = 0.95};
/* The shortest time limit for which a race is worthwhile, for each replica of the image, and the shortest for
 * one of all first blocks. */
static const double LEAST_SECONDS = 0.075, LONG_SECONDS = 2.0;
static void drop(aur_race_entry *entry, const char *reason) {
    snprintf(entry->reason, sizeof entry->reason, "%.95s", reason);
}

static bool is_out(const aur_race_entry *entry) {
    return entry->reason[0] != '\0';
}

static bool is_measured(const aur_race_entry *entry, size_t blocks) {
    return !is_out(entry) && entry->blocks >= blocks && blocks > 0;
}

/* The pixels of block `b` of the order. */
static size_t pixels_of(const aur_race *race, size_t b, size_t pixels[PIXELS]) {
    return aur_blocks_pixels(&race->blocks, race->blocks.order[b], pixels);
}

/* --- rendering */

static float *values_at(const aur_race *race, const aur_race_entry *entry, size_t block, size_t pixel) {
    return entry->values + (block * PIXELS + pixel) * race->replica_count * 3;
}

static aur_result copy_values(const aur_race *race, const aur_replicas *replicas, size_t count,
                              aur_race_entry *entry, aur_error *error) {
    const size_t stride = PIXELS * replicas->count * 3;
    float *const values = realloc(entry->values, count * stride * sizeof *values);
    if (values == NULL)
        return aur_fail_memory(error);
    entry->values = values;
    memset(values + entry->blocks * stride, 0, (count - entry->blocks) * stride * sizeof *values);
    for (size_t b = entry->blocks; b < count; ++b) {
        size_t pixels[PIXELS];
        const size_t pixel_count = pixels_of(race, b, pixels);
        double light[AUR_REPLICAS_MAX * PIXELS][3];
        aur_replicas_read(replicas, (const size_t[2]){pixels[0], pixels[pixel_count - 1]}, 0, pixel_count,
                          light);
        for (size_t i = 0; i < pixel_count * replicas->count; ++i)
            for (size_t c = 0; c < 3; ++c)
                values_at(race, entry, b, 0)[3 * i + c] =
                    (float)light[i % replicas->count * pixel_count + i / replicas->count][c];
    }
    entry->blocks = count;
    return AUR_OK;
}

/* Films whose pixels share samples have separate cells, for all candidates equally. */
static bool reads_neighbours(size_t row, const aur_replicas *replicas) {
    return aur_race_rows[row].shares && aur_render_film(replicas->renders[0])->layout.cell == 0;
}

/* Sets targets for a block's pixels, and for those that are at most `border` away from it. */
static void set_targets(const aur_race *race, size_t block, size_t border, uint32_t samples,
                        uint32_t *targets) {
    size_t pixels[PIXELS];
    const size_t count = pixels_of(race, block, pixels);
    const size_t x0 = pixels[0] % race->width, x1 = pixels[count - 1] % race->width;
    const size_t y0 = pixels[0] / race->width, y1 = pixels[count - 1] / race->width;
    for (size_t j = y0 > border ? y0 - border : 0; j <= y1 + border && j < race->height; ++j)
        for (size_t i = x0 > border ? x0 - border : 0; i <= x1 + border && i < race->width; ++i)
            targets[j * race->width + i] = samples;
}

/* Renders the blocks from the candidate's current number up to `count`. */
static aur_result render_blocks(aur_race *race, size_t row, size_t count, aur_error *error) {
    aur_race_entry *const entry = &race->entries[row];
    char *const text = aur_race_integrator(row, race->path, MAP_PHOTONS, aur_race_seed(race->options));
    uint32_t *const targets = calloc(race->width * race->height, sizeof *targets);
    aur_replicas replicas = {0};
    aur_render_options local = *race->options;
    local.warnings = (aur_warnings){0};
    const uint64_t before = aur_rays_traced;
    aur_result result =
        text != NULL && targets != NULL
            ? aur_replicas_create(race->renderer, &local, text, race->replica_count, &replicas, error)
            : aur_fail_memory(error);
    const uint64_t prepared = aur_rays_traced - before;
    if (result == AUR_OK)
        race->layout = aur_render_film(replicas.renders[0])->layout;
    const bool around = result == AUR_OK && reads_neighbours(row, &replicas);
    for (size_t b = entry->blocks; b < count && result == AUR_OK; ++b)
        set_targets(race, b, around ? 1 : 0, aur_race_rows[row].samples, targets);
    size_t done;
    if (result == AUR_OK)
        result = aur_replicas_step(&replicas, targets, 0, &done, race->cancelled, error);
    if (result == AUR_OK)
        result = copy_values(race, &replicas, count, entry, error);
    aur_spent spent = race->spent;
    aur_spent_add(&spent, &replicas, prepared);
    entry->rays += (double)(spent.budget - race->spent.budget);
    entry->samples += (double)(spent.all.samples - race->spent.all.samples);
    race->spent = spent;
    aur_replicas_release(&replicas);
    free(targets);
    free(text);
    return result;
}

/* --- scores */

static void mean_of_pixel(const aur_race *race, const float *values, double mean[3]) {
    mean[0] = mean[1] = mean[2] = 0.0;
    for (size_t i = 0; i < 3 * race->replica_count; ++i)
        mean[i % 3] += (double)values[i] / (double)race->replica_count;
}

/* Over the candidates. */
static void mean_of_blocks(const aur_race *race, size_t blocks, double (*means)[3]) {
    for (size_t b = 0; b < blocks; ++b) {
        size_t pixels[PIXELS], count = 0;
        const size_t pixel_count = pixels_of(race, b, pixels);
        for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
            for (size_t p = 0; p < pixel_count && race->entries[i].blocks >= blocks; ++p, ++count) {
                double mean[3];
                mean_of_pixel(race, values_at(race, &race->entries[i], b, p), mean);
                for (size_t c = 0; c < 3; ++c)
                    means[b][c] += mean[c];
            }
        for (size_t c = 0; c < 3; ++c)
            means[b][c] /= (double)count;
    }
}

/* What the camera sees of emitters directly, R + G + B: the mean over `count` pixels of the film. Films leave
 * out what is not finite. */
static double mean_emission(aur_race *race, size_t count, const size_t *pixels) {
    const aur_scene *const scene = aur_renderer_scene(race->renderer);
    const aur_view view = {.scene = scene, .width = race->layout.width, .height = race->layout.height};
    const uint64_t before = aur_rays_traced;
    double sum = 0.0;
    for (size_t first = 0; first < count; first += PIXELS) {
        const size_t part = count - first < PIXELS ? count - first : PIXELS;
        size_t x[PIXELS], y[PIXELS];
        float emission[PIXELS];
        for (size_t k = 0; k < part; ++k) {
            x[k] = race->layout.x0 + pixels[first + k] % race->width;
            y[k] = race->layout.y0 + pixels[first + k] / race->width;
        }
        aur_emission_at_centres(&view, part, x, y, emission);
        for (size_t k = 0; k < part; ++k)
            sum += isfinite(emission[k]) ? (double)emission[k] / (double)count : 0.0;
    }
    race->spent.all.rays += aur_rays_traced - before;
    race->spent.budget += aur_rays_traced - before;
    return sum * (double)aur_camera_factor(scene);
}

/* The same over the film, by at most 65,536 pixels. */
static aur_result survey_emission(aur_race *race, aur_error *error) {
    enum { MOST_PIXELS = 1 << 16 };
    size_t step = 1, count = 0;
    while ((race->width / step + 1) * (race->height / step + 1) > MOST_PIXELS)
        ++step;
    size_t *const pixels = calloc((race->width / step + 1) * (race->height / step + 1), sizeof *pixels);
    if (pixels == NULL)
        return aur_fail_memory(error);
    for (size_t y = step / 2 < race->height ? step / 2 : 0; y < race->height; y += step)
        for (size_t x = step / 2 < race->width ? step / 2 : 0; x < race->width; x += step)
            pixels[count++] = y * race->width + x;
    race->emitted = mean_emission(race, count, pixels);
    free(pixels);
    return AUR_OK;
}

/* The image's mean relative to the blocks'. Few blocks may have more or less of visible emitters than the
 * image, which are much of its mean. Camera rays alone tell how much; a block where they see more than all
 * light has none of other light. */
static double mean_beside_blocks(aur_race *race, size_t blocks, const double (*means)[3]) {
    double mean = 0.0, others = 0.0;
    for (size_t b = 0; b < blocks; ++b) {
        size_t pixels[PIXELS];
        const size_t count = pixels_of(race, b, pixels);
        const double light = means[b][0] + means[b][1] + means[b][2];
        mean += light / (double)blocks;
        others += fmax(light - mean_emission(race, count, pixels), 0.0) / (double)blocks;
    }
    const double part = (race->emitted + others) / mean;
    return part > 0.0 && isfinite(part) ? part : 1.0;
}

/* The weights of the blocks' means in the image. The exposure of a display depends on the geometric mean,
 * which few bright pixels hardly change. */
static void weigh_blocks(aur_race *race, size_t blocks, const double (*means)[3], double (*scaled)[3],
                         aur_error_weight *weights) {
    const double part =
        race->measure == AUR_ERROR_MEASURE_DISPLAY ? 1.0 : mean_beside_blocks(race, blocks, means);
    for (size_t i = 0; i < 3 * blocks; ++i)
        scaled[i / 3][i % 3] = part * means[i / 3][i % 3];
    aur_error_weigh(race->measure, blocks, (const double(*)[3])scaled, means, weights);
}

/* The root of the mean variance of one sample over a block's pixels. */
static double root_variance(const aur_race *race, size_t row, size_t block, const aur_error_weight *weight) {
    size_t pixels[PIXELS];
    const size_t pixel_count = pixels_of(race, block, pixels);
    const double others = (double)(race->replica_count - 1);
    double sum = 0.0;
    for (size_t p = 0; p < pixel_count; ++p) {
        const float *const values = values_at(race, &race->entries[row], block, p);
        double mean[3], d[3][AUR_REPLICAS_MAX];
        mean_of_pixel(race, values, mean);
        for (size_t i = 0; i < 3 * race->replica_count; ++i)
            d[i % 3][i / 3] = (double)values[i] - mean[i % 3];
        aur_replicas_weigh(race->replica_count, (aur_weighing){race->measure, weight}, 0, mean, d);
        for (size_t i = 0; i < 3 * race->replica_count; ++i)
            sum += d[i % 3][i / 3] * d[i % 3][i / 3];
    }
    return sqrt(sum * (double)aur_race_rows[row].samples / (others * (double)pixel_count));
}

/* The row, of those with short rays, whose bias is the least of the measured ones; AUR_RACE_ROWS: none. */
static size_t least_biased(const aur_race *race, size_t blocks) {
    static const size_t rows[] = {AUR_RACE_MIDDLE, AUR_RACE_LIGHTS, AUR_RACE_SHARED};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k)
        if (race->entries[rows[k]].blocks >= blocks)
            return rows[k];
    return AUR_RACE_ROWS;
}

/* The square of the bias of a row that `other` lacks, less a standard error. All rows use one photon map. The
 * noise of different replicas is independent, so the mean of their products is the square. */
static double bias_beside(const aur_race *race, size_t row, size_t other, size_t blocks,
                          const aur_error_weight *weights) {
    const double step = 1e-3; /* differences are linear only in small errors */
    const size_t n = race->replica_count;
    aur_moments products = {.count = 0};
    for (size_t b = 0; b < blocks; ++b) {
        size_t pixels[PIXELS];
        const size_t pixel_count = pixels_of(race, b, pixels);
        double sums[AUR_REPLICAS_MAX][3] = {{0.0}}, product = 0.0;
        for (size_t p = 0; p < pixel_count; ++p) {
            const float *const values = values_at(race, &race->entries[row], b, p);
            const float *const others = values_at(race, &race->entries[other], b, p);
            double mean[3], errors[AUR_REPLICAS_MAX][3], differences[AUR_REPLICAS_MAX][3];
            mean_of_pixel(race, others, mean);
            for (size_t i = 0; i < 3 * n; ++i)
                errors[i / 3][i % 3] = step * ((double)values[i] - (double)others[i]);
            aur_error_apply(race->measure, &weights[b], mean, n, (const double(*)[3])errors, differences);
            for (size_t i = 0; i < 3 * n; ++i)
                sums[i / 3][i % 3] += differences[i / 3][i % 3] / (step * (double)pixel_count);
        }
        for (size_t r = 0; r < n; ++r)
            for (size_t q = 0; q < r; ++q)
                for (size_t c = 0; c < 3; ++c)
                    product += sums[r][c] * sums[q][c];
        aur_moments_add(&products, product / (0.5 * (double)(n * (n - 1))));
    }
    return fmax(products.mean - aur_moments_standard_error(&products), 0.0) / 3.0;
}

/* Work per sample. */
static double price(const aur_race_entry *entry, size_t row) {
    return entry->rays / entry->samples * aur_race_rows[row].price;
}

/* The part of the error's square that is left to the noise. Half of the error of gathers is left to the bias
 * of photon maps; where a row's own bias leaves next to nothing, that rules it out. */
static double noise_part(const aur_race *race, size_t row) {
    const double map = 0.5 * 0.5, least = 0.05;
    const double square = race->error * race->error;
    if (!aur_race_gathers(row))
        return 1.0;
    return fmax(1.0 - map - (square > 0.0 ? race->entries[row].bias / square : 0.0), least);
}

/* The work of a whole pattern in each pixel and replica, and of the smallest maps. */
static double least_work(const aur_race *race, size_t row) {
    const aur_race_entry *const entry = &race->entries[row];
    const double map = aur_race_gathers(row) ? aur_race_least_map(race->image_replicas) : 0.0;
    const double pixels = (double)(race->width * race->height * race->image_replicas);
    return entry->rays / entry->samples * aur_race_rows[row].pattern * pixels + map;
}

/* The work to reach the target if samples are allocated in proportion to roots of variances (Neyman 1934),
 * plus that of the photons of gathering. Without a target the error does not matter, because candidates are
 * only compared. */
static double work_of(const aur_race *race, size_t row, double mean_root) {
    const double error = race->error > 0.0 ? race->error : 1.0;
    const double work = mean_root * mean_root / (3.0 * error * error * noise_part(race, row)) *
                        price(&race->entries[row], row) * (double)(race->width * race->height);
    if (!(race->error > 0.0))
        return work;
    const double map = fmax(AUR_RACE_MAP_PART * work, aur_race_least_map(race->image_replicas));
    return fmax(work + (aur_race_gathers(row) ? map : 0.0), least_work(race, row));
}

/* Sets what each candidate needs by all of its blocks, and its roots. */
static aur_result measure(aur_race *race, size_t blocks, aur_error *error) {
    double(*const means)[3] = calloc(2 * blocks, sizeof *means);
    aur_error_weight *const weights = calloc(blocks, sizeof *weights);
    bool allocated = means != NULL && weights != NULL;
    const size_t other = least_biased(race, blocks);
    if (allocated) {
        mean_of_blocks(race, blocks, means);
        weigh_blocks(race, blocks, (const double(*)[3])means, means + blocks, weights);
    }
    for (size_t i = 0; i < AUR_RACE_ROWS && allocated; ++i) {
        double sum = 0.0;
        if (!is_measured(&race->entries[i], blocks))
            continue;
        double *const roots = realloc(race->entries[i].roots, blocks * sizeof *roots);
        allocated = roots != NULL;
        for (size_t b = 0; b < blocks && allocated; ++b)
            sum += roots[b] = root_variance(race, i, b, &weights[b]);
        race->entries[i].roots = allocated ? roots : race->entries[i].roots;
        if (aur_race_gathers(i) && i != other && other < AUR_RACE_ROWS && allocated)
            race->entries[i].bias = bias_beside(race, i, other, blocks, weights);
        race->entries[i].need = work_of(race, i, sum / (double)blocks);
    }
    free(means);
    free(weights);
    return allocated ? AUR_OK : aur_fail_memory(error);
}

static size_t best_of(const aur_race *race, size_t blocks) {
    size_t best = AUR_RACE_ROWS;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        if (is_measured(&race->entries[i], blocks) &&
            (best == AUR_RACE_ROWS || race->entries[i].need < race->entries[best].need))
            best = i;
    return best;
}

/* Drops what is worse than the best in nearly all resamplings of the blocks (bootstrap). Returns how many are
 * left. */
static size_t drop_worse(aur_race *race, size_t blocks, size_t best) {
    size_t worse[AUR_RACE_ROWS] = {0}, left = 0;
    for (size_t k = 0; k < RESAMPLINGS; ++k) {
        double sums[AUR_RACE_ROWS] = {0.0};
        for (size_t j = 0; j < blocks; ++j) {
            const size_t b = aur_hash3(UINT64_C(0x72616365), k, j) % blocks;
            for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
                sums[i] += is_measured(&race->entries[i], blocks) ? race->entries[i].roots[b] : 0.0;
        }
        const double least = work_of(race, best, sums[best] / (double)blocks);
        for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
            worse[i] +=
                is_measured(&race->entries[i], blocks) && work_of(race, i, sums[i] / (double)blocks) > least;
    }
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        if (!is_measured(&race->entries[i], blocks))
            continue;
        if (i != best && (double)worse[i] >= race->limits->confidence * RESAMPLINGS)
            drop(&race->entries[i], "dropped: more work in 95 % of resamplings");
        left += !is_out(&race->entries[i]);
    }
    return left;
}

/* --- the race */

/* The predicted work of the request: that of the best candidate, or its budget. */
static double whole_work(const aur_race *race, size_t best) {
    const double most = race->budget > 0.0 ? race->budget : INFINITY;
    if (race->error > 0.0)
        return fmin(race->entries[best].need, most);
    if (most < INFINITY)
        return most;
    const aur_render_statistics *const all = &race->spent.all;
    return race->seconds * (double)all->rays / fmax(all->prepare_seconds + all->render_seconds, 1e-9);
}

/* Without the photon map, which the first blocks pay for whatever follows. */
static double spent_work(const aur_race *race) {
    double work = 0.0;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        work += race->entries[i].rays;
    return work;
}

/* Whether a time limit leaves enough for a first pattern in each pixel. The limit may be exceeded by a half,
 * as by a round; the rate of short work is below the image's. */
static bool fits(const aur_race *race, size_t row) {
    const double growth = 1.5;
    return race->error > 0.0 || race->budget > 0.0 ||
           spent_work(race) + least_work(race, row) <= growth * whole_work(race, row);
}

/* The cost of the first rung of a row, predicted from the middle one's; a border of neighbours doubles a
 * block. */
static double first_rung(const aur_race *race, size_t row) {
    const aur_race_entry *const middle = &race->entries[AUR_RACE_MIDDLE];
    const double border = aur_race_rows[row].shares ? 2.0 : 1.0;
    return border * middle->rays * (double)aur_race_rows[row].samples /
           (double)aur_race_rows[AUR_RACE_MIDDLE].samples;
}

/* The smallest pattern, where a single one of the next larger reaches the target. */
static aur_result run_smallest(aur_race *race, size_t blocks, aur_error *error) {
    const aur_race_entry *const shared = &race->entries[AUR_RACE_SHARED];
    const aur_result result = measure(race, blocks, error);
    if (result == AUR_OK && race->error > 0.0 && is_measured(shared, blocks) &&
        shared->need <= least_work(race, AUR_RACE_SHARED))
        return render_blocks(race, AUR_RACE_FOUR, blocks, error);
    drop(&race->entries[AUR_RACE_FOUR], "not tried: only for coarse targets");
    return result;
}

/* Renders the first blocks with other rows, those most different first, while their work is small next to the
 * image's. */
static aur_result run_others(aur_race *race, size_t blocks, aur_error *error) {
    const size_t others[] = {AUR_RACE_PATH, AUR_RACE_SHARED, AUR_RACE_LONG, AUR_RACE_LIGHTS,
                             AUR_RACE_CANDIDATES};
    const double most = race->limits->first_part * whole_work(race, AUR_RACE_MIDDLE);
    /* Where a first pattern and its photons are most of the work, path tracing may need less than they do. */
    const bool path = 2.0 * least_work(race, AUR_RACE_MIDDLE) > race->entries[AUR_RACE_MIDDLE].need;
    const bool smaller = !fits(race, AUR_RACE_MIDDLE);
    const aur_scene *const scene = aur_renderer_scene(race->renderer);
    const bool has_choice = aur_scene_emitter_count(scene) > 1 || aur_scene_has_environment(scene);
    aur_result result = AUR_OK;
    for (size_t k = 0; k < sizeof others / sizeof others[0] && result == AUR_OK; ++k) {
        const size_t row = others[k];
        const bool needed = (path && row == AUR_RACE_PATH) ||
                            (smaller && (row == AUR_RACE_SHARED || row == AUR_RACE_CANDIDATES));
        if (row == AUR_RACE_SHARED && race->apart)
            drop(&race->entries[row], "not tried: denoisers keep noise that pixels share");
        else if (row == AUR_RACE_CANDIDATES && !has_choice)
            drop(&race->entries[row], "not tried: there is a single light");
        else if (needed || spent_work(race) + first_rung(race, row) <= most)
            result = render_blocks(race, row, blocks, error);
        else
            drop(&race->entries[row], "not tried: its first blocks cost more than a fifth of the image");
    }
    for (size_t row = 0; row < AUR_RACE_ROWS && result == AUR_OK; ++row)
        if (aur_race_gathers(row) && is_measured(&race->entries[row], blocks) && !fits(race, row))
            drop(&race->entries[row], "one pattern in each pixel takes longer than requested");
    return result;
}

/* Rungs of twice as many blocks each, until one candidate is left or the next rung costs too much. */
static aur_result run_rungs(aur_race *race, size_t blocks, aur_error *error) {
    for (;;) {
        aur_result result = measure(race, blocks, error);
        const size_t best = best_of(race, blocks);
        const size_t left = result == AUR_OK && best < AUR_RACE_ROWS ? drop_worse(race, blocks, best) : 0;
        double next = 0.0;
        for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
            next += is_out(&race->entries[i]) ? 0.0 : race->entries[i].rays;
        if (result != AUR_OK || left <= 1 || blocks == race->blocks.count ||
            spent_work(race) + next > race->limits->part * whole_work(race, best))
            return result;
        blocks = 2 * blocks < race->blocks.count ? 2 * blocks : race->blocks.count;
        for (size_t i = 0; i < AUR_RACE_ROWS && result == AUR_OK; ++i)
            if (!is_out(&race->entries[i]))
                result = render_blocks(race, i, blocks, error);
        if (result != AUR_OK)
            return result;
    }
}

static bool is_black(const aur_race *race, const aur_race_entry *entry) {
    for (size_t i = 0; i < entry->blocks * PIXELS * race->replica_count * 3; ++i)
        if (entry->values[i] != 0.0f)
            return false;
    return true;
}

static bool is_behind(const aur_race_entry *a, const aur_race_entry *b) {
    return is_out(a) != is_out(b) ? is_out(a) : a->need > b->need;
}

/* Sorts the measured candidates by predicted work, those not dropped first. Path tracing is always included,
 * last if it was not measured, because it has no bias. */
static void sort(aur_race *race) {
    race->order_count = 0;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        if (race->entries[i].blocks == 0)
            continue;
        size_t at = race->order_count++;
        for (; at > 0 && is_behind(&race->entries[race->order[at - 1]], &race->entries[i]); --at)
            race->order[at] = race->order[at - 1];
        race->order[at] = i;
    }
    if (race->entries[AUR_RACE_PATH].blocks == 0)
        race->order[race->order_count++] = AUR_RACE_PATH;
}

/* The middle row first, by which the work of the others is estimated. */
static aur_result run(aur_race *race, aur_error *error) {
    const bool brief = race->seconds > 0.0 && race->seconds <= LONG_SECONDS;
    const size_t first = brief ? BRIEF_BLOCKS : race->limits->first_blocks;
    const size_t blocks = race->blocks.count < first ? race->blocks.count : first;
    aur_race_entry *const middle = &race->entries[AUR_RACE_MIDDLE];
    aur_error refused = {0};
    if ((race->budget > 0.0 &&
         race->budget * AUR_RACE_MAP_PART <= aur_race_least_map(race->image_replicas)) ||
        (race->seconds > 0.0 && race->seconds <= LEAST_SECONDS * (double)race->image_replicas)) {
        drop(middle, "not tried: its photons cost more than a quarter of the request");
        return AUR_OK;
    }
    aur_result result = render_blocks(race, AUR_RACE_MIDDLE, blocks, &refused);
    if (result == AUR_ERROR_MEMORY || result == AUR_ERROR_CANCELLED) {
        if (error != NULL)
            *error = refused;
        return result;
    }
    if (result != AUR_OK) { /* final gathering is not for this scene */
        drop(middle, refused.message);
        return AUR_OK;
    }
    if (is_black(race, middle)) {
        middle->blocks = 0;
        drop(middle, "no light was found in the first blocks");
        return AUR_OK;
    }
    result = survey_emission(race, error);
    if (result == AUR_OK)
        result = measure(race, blocks, error);
    if (result == AUR_OK)
        result = run_others(race, blocks, error);
    if (result == AUR_OK)
        result = run_smallest(race, blocks, error);
    return result == AUR_OK ? run_rungs(race, blocks, error) : result;
}

aur_result aur_race_run(aur_race *race, aur_error *error) {
    race->limits = race->limits != NULL ? race->limits : &default_limits;
    aur_result result = aur_blocks_create(race->width, race->height, &race->blocks, error);
    if (result == AUR_OK)
        result = run(race, error);
    if (result == AUR_OK) {
        sort(race);
        race->work = whole_work(race, race->order[0]);
    }
    return result;
}

void aur_race_release(aur_race *race) {
    aur_blocks_release(&race->blocks);
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        free(race->entries[i].values);
        free(race->entries[i].roots);
        race->entries[i].values = NULL;
        race->entries[i].roots = NULL;
    }
}

/* Candidates see the same blocks: what these miss, gathers miss alike, and path tracing less so. Variances of
 * the logarithm of work over prediction, relative to the part that all share: between gathers, and between
 * them and path tracing. With 1 for that part, rooms of aureole-bench adaptive have .32^2 and .84^2. A third
 * allows for one gather that alone meets rare bright paths: chosen by two rooms, not measured. */
static const double BETWEEN_GATHERS = 1.0 / 3.0, TO_PATHS = 0.7;

bool aur_race_overtake(aur_race *race, size_t rank, double wrong, double most, double left) {
    const size_t row = race->order[rank];
    const double tried = (double)rank + 1.0;
    size_t best = race->order_count;
    double least = INFINITY;
    for (size_t k = rank + 1; k < race->order_count; ++k) {
        const size_t other = race->order[k];
        const bool alike = aur_race_gathers(row) == aur_race_gathers(other);
        const double shared = tried / (tried + (alike ? BETWEEN_GATHERS : TO_PATHS));
        const double need = race->entries[other].need * pow(wrong, shared);
        if (need > 0.0 && need < least) {
            least = need;
            best = k;
        }
    }
    if (!(least < left) || race->entries[race->order[best]].need > most)
        return false;
    const size_t next = race->order[best];
    memmove(&race->order[rank + 2], &race->order[rank + 1], (best - rank - 1) * sizeof *race->order);
    race->order[rank + 1] = next;
    return true;
}

size_t aur_race_next(aur_race *race, size_t rank) {
    const size_t last = race->order_count - 1;
    if (rank < last)
        return rank + 1;
    for (size_t k = 0; k < last; ++k)
        if (race->order[k] == AUR_RACE_PATH) {
            race->order[k] = race->order[last];
            race->order[last] = AUR_RACE_PATH;
        }
    return last;
}
