#include "render/radiosity/solution.h"

#include <stddef.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/vector3d.h"

void aur_radiosity_power(const aur_radiosity *radiosity, size_t patch, double power[3]) {
    const double scale = radiosity->paths > 0 ? radiosity->walk.quantum / (double)radiosity->paths : 0.0;
    for (size_t c = 0; c < 3; ++c) {
        aur_exact_sum sum = {0};
        for (size_t r = 0; r < radiosity->options.randomizations; ++r)
            aur_exact_merge(&sum, &radiosity->tallies[r].power[patch][c]);
        power[c] = scale * aur_exact_value(&sum);
    }
}

aur_vector aur_radiosity_exitance(const aur_radiosity *radiosity, size_t patch) {
    double power[3];
    aur_radiosity_power(radiosity, patch, power);
    const double area = radiosity->scene.areas[aur_radiosity_triangle_of(&radiosity->scene, patch)];
    const double scale = area > 0.0 ? 1.0 / (AUR_PI * area) : 0.0;
    return (aur_vector){(float)(scale * power[0]), (float)(scale * power[1]), (float)(scale * power[2])};
}

void aur_radiosity_power_error(const aur_radiosity *radiosity, size_t patch, double error[3]) {
    const size_t count = radiosity->options.randomizations;
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0.0, squares = 0.0;
        for (size_t r = 0; r < count; ++r) {
            const uint64_t paths = aur_radiosity_paths_of(radiosity, r, radiosity->paths);
            const double value = radiosity->walk.quantum *
                                 aur_exact_value(&radiosity->tallies[r].power[patch][c]) / (double)paths;
            sum += value;
            squares += value * value;
        }
        const double n = (double)count;
        const bool estimated = count > 1 && radiosity->paths >= count;
        error[c] = estimated ? sqrt(fmax(0.0, squares - sum * sum / n) / (n - 1.0) / n) : NAN;
    }
}

/* --- over all patches */

/* The sum of L0 A over the lights. */
static void sum_emission(const aur_radiosity *radiosity, double sum[3]) {
    sum[0] = sum[1] = sum[2] = 0.0;
    for (size_t i = 0; i < radiosity->scene.triangle_count; ++i) {
        double radiance[3];
        aur_vector_to_doubles(radiosity->scene.emission[i], radiance);
        for (size_t c = 0; c < 3; ++c)
            sum[c] += radiance[c] * radiosity->scene.areas[i];
    }
}

static double patch_area(const aur_radiosity *radiosity, size_t patch) {
    return radiosity->scene.areas[aur_radiosity_triangle_of(&radiosity->scene, patch)];
}

/* The root mean square deviation of powers, relative to the power of the lights: the unit of epsilon. */
static double relative_deviation(const aur_radiosity *radiosity, double (*before)[3]) {
    double sum = 0.0, area = 0.0, lights[3];
    for (size_t i = 0; i < radiosity->scene.patch_count; ++i) {
        double deviation[3], now[3];
        if (before == NULL)
            aur_radiosity_power_error(radiosity, i, deviation);
        else
            aur_radiosity_power(radiosity, i, now);
        for (size_t c = 0; c < 3 && before != NULL; ++c) {
            deviation[c] = now[c] - before[i][c];
            before[i][c] = now[c];
        }
        const double a = patch_area(radiosity, i);
        sum += aur_dot3(deviation, deviation) * a;
        area += a;
    }
    sum_emission(radiosity, lights);
    return sqrt(sum / area) / aur_length3(lights);
}

double aur_radiosity_standard_error(const aur_radiosity *radiosity) {
    return relative_deviation(radiosity, NULL);
}

double aur_radiosity_measure_change(const aur_radiosity *radiosity, double (*before)[3]) {
    return relative_deviation(radiosity, before);
}

/* --- results for the caller */

void aur_radiosity_summarize(const aur_radiosity *radiosity, aur_radiosity_description *d) {
    const aur_radiosity_scene *const scene = &radiosity->scene;
    double lights[3];
    sum_emission(radiosity, lights);
    *d = (aur_radiosity_description){.size = sizeof *d,
                                     .triangles = scene->triangle_count,
                                     .patches = scene->patch_count,
                                     .lights = radiosity->walk.light_count,
                                     .dimension = 2 * radiosity->options.bounces + 4,
                                     .area = scene->area,
                                     .paths = radiosity->paths,
                                     .coincident = radiosity->coincident,
                                     .change = radiosity->change,
                                     .emitted = AUR_PI * (lights[0] + lights[1] + lights[2]),
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
    double error[3];
    *out = (aur_radiosity_triangle_result){.area = scene->areas[triangle]};
    aur_vector_to_doubles(scene->triangles[triangle].albedo[0], out->albedo);
    aur_vector_to_doubles(scene->emission[triangle], out->emission);
    aur_radiosity_power(radiosity, triangle, out->power);
    aur_radiosity_power_error(radiosity, triangle, error);
    for (size_t c = 0; c < 3; ++c) {
        const double scale = out->area > 0.0 ? out->albedo[c] / (AUR_PI * out->area) : 0.0;
        out->radiance[c] = out->emission[c] + scale * out->power[c];
        out->standard_error[c] = scale * error[c];
    }
}

aur_result aur_radiosity_get_results(const aur_radiosity *radiosity, size_t capacity, size_t size,
                                     aur_radiosity_triangle_result *results, aur_error *error) {
    const size_t count = radiosity->scene.triangle_count;
    aur_radiosity_triangle_result row;
    /* The last field of version 0.1: the struct of an older program ends there. */
    const size_t first_size =
        offsetof(aur_radiosity_triangle_result, standard_error) + sizeof row.standard_error;
    if (size < first_size)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: a row of results has %zu bytes at least, not %zu", first_size, size);
    if (capacity < count)
        return aur_fail(error, AUR_ERROR_CAPACITY, "radiosity: there are %zu triangles, and room for %zu",
                        count, capacity);
    for (size_t i = 0; i < count; ++i) {
        aur_radiosity_result(radiosity, i, &row);
        unsigned char *const out = (unsigned char *)results + i * size;
        memset(out, 0, size);
        memcpy(out, &row, size < sizeof row ? size : sizeof row);
    }
    return AUR_OK;
}

aur_result aur_radiosity_get_description(const aur_radiosity *radiosity,
                                         aur_radiosity_description *description, aur_error *error) {
    aur_radiosity_description filled;
    aur_radiosity_summarize(radiosity, &filled);
    return aur_description_write(&filled, sizeof filled, description, "aur_radiosity_description", error);
}
