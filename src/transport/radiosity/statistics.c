#include "transport/radiosity/statistics.h"

#include <string.h>

#include "core/options.h"

void aur_radiosity_power(const aur_radiosity *radiosity, size_t patch, double power[3]) {
    const double scale = radiosity->paths > 0 ? radiosity->walk.quantum / (double)radiosity->paths : 0.0;
    for (size_t c = 0; c < 3; ++c) {
        aur_exact_sum sum = {0};
        for (size_t r = 0; r < radiosity->options.randomizations; ++r)
            aur_exact_merge(&sum, &radiosity->tallies[r].power[patch][c]);
        power[c] = scale * aur_exact_value(&sum);
    }
}

void aur_radiosity_power_error(const aur_radiosity *radiosity, size_t patch, double error[3]) {
    const size_t count = radiosity->options.randomizations;
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0.0, squares = 0.0;
        for (size_t r = 0; r < count; ++r) {
            const uint64_t paths = aur_radiosity_share(radiosity, r, radiosity->paths);
            const double value = radiosity->walk.quantum *
                                 aur_exact_value(&radiosity->tallies[r].power[patch][c]) / (double)paths;
            sum += value;
            squares += value * value;
        }
        const double n = (double)count;
        const bool known = count > 1 && radiosity->paths >= count;
        error[c] = known ? sqrt(fmax(0.0, squares - sum * sum / n) / (n - 1.0) / n) : NAN;
    }
}

/* --- over all patches */

/* The sum of L0 A over the lights: its length as a colour. */
static double light_measure(const aur_radiosity *radiosity) {
    double sum[3] = {0};
    for (size_t i = 0; i < radiosity->scene.triangle_count; ++i) {
        const aur_vector l = radiosity->scene.emission[i];
        sum[0] += (double)l.x * radiosity->scene.areas[i];
        sum[1] += (double)l.y * radiosity->scene.areas[i];
        sum[2] += (double)l.z * radiosity->scene.areas[i];
    }
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

static double squared_length(const double v[3]) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static double patch_area(const aur_radiosity *radiosity, size_t patch) {
    return radiosity->scene.areas[aur_radiosity_triangle_of(&radiosity->scene, patch)];
}

double aur_radiosity_standard_error(const aur_radiosity *radiosity) {
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < radiosity->scene.patch_count; ++i) {
        double error[3];
        aur_radiosity_power_error(radiosity, i, error);
        const double a = patch_area(radiosity, i);
        sum += squared_length(error) * a;
        area += a;
    }
    return sqrt(sum / area) / light_measure(radiosity);
}

double aur_radiosity_measure_change(const aur_radiosity *radiosity, double (*before)[3]) {
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < radiosity->scene.patch_count; ++i) {
        double now[3];
        aur_radiosity_power(radiosity, i, now);
        const double change[3] = {now[0] - before[i][0], now[1] - before[i][1], now[2] - before[i][2]};
        const double a = patch_area(radiosity, i);
        sum += squared_length(change) * a;
        area += a;
        for (size_t c = 0; c < 3; ++c)
            before[i][c] = now[c];
    }
    return sqrt(sum / area) / light_measure(radiosity);
}

/* --- what the caller asks for */

static double total_emitted(const aur_radiosity *radiosity) {
    double sum = 0.0;
    for (size_t i = 0; i < radiosity->scene.triangle_count; ++i) {
        const aur_vector l = radiosity->scene.emission[i];
        sum += AUR_PI * radiosity->scene.areas[i] * ((double)l.x + (double)l.y + (double)l.z);
    }
    return sum;
}

void aur_radiosity_summarize(const aur_radiosity *radiosity, aur_radiosity_description *d) {
    const aur_radiosity_scene *const scene = &radiosity->scene;
    *d = (aur_radiosity_description){.size = sizeof *d,
                                     .triangles = scene->triangle_count,
                                     .patches = scene->patch_count,
                                     .lights = radiosity->walk.light_count,
                                     .dimension = 2 * radiosity->options.bounces + 4,
                                     .area = scene->area,
                                     .paths = radiosity->paths,
                                     .coincident = radiosity->coincident,
                                     .change = radiosity->change,
                                     .emitted = total_emitted(radiosity),
                                     .error = aur_radiosity_standard_error(radiosity)};
    double last = 0.0, rest = 0.0, received = 0.0;
    for (size_t r = 0; r < radiosity->options.randomizations; ++r) {
        const aur_radiosity_tally *const tally = &radiosity->tallies[r];
        d->rays += tally->rays;
        d->lost += tally->lost;
        d->behind += tally->behind;
        d->trapped += tally->trapped;
        last += aur_exact_value(&tally->last);
        rest += aur_exact_value(&tally->rest);
        for (size_t i = 0; i < tally->patch_count; ++i)
            for (size_t c = 0; c < 3; ++c)
                received += aur_exact_value(&tally->power[i][c]);
    }
    const double missing = rest < last ? rest / (1.0 - rest / last) : INFINITY;
    d->tail = rest == 0.0 ? 0.0 : isfinite(missing) ? missing / (received + missing) : 1.0;
    for (size_t i = 0; i < scene->triangle_count; ++i)
        for (size_t side = 0; side < 2; ++side)
            d->largest_albedo =
                fmax(d->largest_albedo, (double)aur_vector_max(scene->triangles[i].albedo[side]));
}

void aur_radiosity_result(const aur_radiosity *radiosity, size_t triangle,
                          aur_radiosity_triangle_result *out) {
    const aur_radiosity_scene *const scene = &radiosity->scene;
    const aur_vector albedo = scene->triangles[triangle].albedo[0], emission = scene->emission[triangle];
    *out = (aur_radiosity_triangle_result){
        .area = scene->areas[triangle],
        .albedo = {(double)albedo.x, (double)albedo.y, (double)albedo.z},
        .emission = {(double)emission.x, (double)emission.y, (double)emission.z}};
    double error[3];
    aur_radiosity_power(radiosity, triangle, out->power);
    aur_radiosity_power_error(radiosity, triangle, error);
    for (size_t c = 0; c < 3; ++c) {
        const double share = out->area > 0.0 ? out->albedo[c] / (AUR_PI * out->area) : 0.0;
        out->radiance[c] = out->emission[c] + share * out->power[c];
        out->standard_error[c] = share * error[c];
    }
}

aur_result aur_radiosity_results(const aur_radiosity *radiosity, size_t capacity, size_t size,
                                 aur_radiosity_triangle_result *results, aur_error *error) {
    const size_t count = radiosity->scene.triangle_count;
    aur_radiosity_triangle_result row;
    if (size < sizeof row)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: a row of results has %zu bytes at least, not %zu", sizeof row, size);
    if (capacity < count)
        return aur_fail(error, AUR_ERROR_CAPACITY, "radiosity: there are %zu triangles, and room for %zu",
                        count, capacity);
    for (size_t i = 0; i < count; ++i) {
        aur_radiosity_result(radiosity, i, &row);
        unsigned char *const out = (unsigned char *)results + i * size;
        memset(out, 0, size);
        memcpy(out, &row, sizeof row);
    }
    return AUR_OK;
}

aur_result aur_radiosity_describe(const aur_radiosity *radiosity, aur_radiosity_description *description,
                                  aur_error *error) {
    aur_radiosity_description own;
    aur_radiosity_summarize(radiosity, &own);
    return aur_description_write(&own, sizeof own, sizeof own, description, "aur_radiosity_description",
                                 error);
}
