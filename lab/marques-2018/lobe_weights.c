#include "lobe_weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

const char *const lab_lobe_method_names[LAB_LOBE_METHODS] = {"p/q", "MIS", "OSW", "OSWA"};

static bool is_glossy_cosine(const aur_lobe *lobe) {
    return lobe->kind != AUR_LOBE_GGX && lobe->exponent != 1.0;
}

/* The axis of a cosine lobe. */
static void find_axis(const lab_lobes *of, size_t lobe, double axis[3]) {
    const double radians = is_glossy_cosine(&of->lobes[lobe]) ? of->view_degrees * PI / 180.0 : 0.0;
    axis[0] = -sin(radians);
    axis[1] = 0.0;
    axis[2] = cos(radians);
}

/* The first `count` of `size` directions of a set for a lobe. The pattern is rotated before it is mapped to a
 * GGX lobe, which depends on azimuth. */
static aur_result draw(const lab_lobes *of, size_t lobe, const char *set, size_t size, size_t count,
                       uint64_t seed, double *xyz, aur_error *error) {
    const bool ggx = of->lobes[lobe].kind == AUR_LOBE_GGX;
    const aur_directions_options options = {.size = sizeof options,
                                            .count = size,
                                            .domain = AUR_DOMAIN_HEMISPHERE,
                                            .lobe = ggx ? (aur_lobe){.exponent = 0.0} : of->lobes[lobe],
                                            .scramble = lab_scrambling(set),
                                            .seed = seed};
    aur_directions *directions;
    aur_result result = aur_directions_create(set, &options, &directions, error);
    if (result != AUR_OK)
        return result;
    result = aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, NULL);
    aur_directions_destroy(directions);
    if (ggx)
        aur_lobe_warp(&of->lobes[lobe], count, xyz, xyz);
    double axis[3];
    find_axis(of, lobe, axis);
    for (size_t i = 0; i < count && !ggx; ++i) {
        const double x = xyz[3 * i], z = xyz[3 * i + 2];
        xyz[3 * i] = axis[2] * x + axis[0] * z;
        xyz[3 * i + 2] = axis[2] * z - axis[0] * x;
    }
    return result;
}

aur_result lab_lobes_draw(const lab_lobes *of, const char *set, size_t size, uint64_t seed, double *xyz,
                          aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t k = 0; k < of->count && result == AUR_OK; xyz += 3 * of->counts[k++])
        result = draw(of, k, set, size != 0 ? size : of->counts[k], of->counts[k], LAB_MOST_LOBES * seed + k,
                      xyz, error);
    return result;
}

/* p/q of a direction, p normalised over the upper hemisphere. */
static double ratio(const lab_lobes *of, size_t k, const double u[3]) {
    const aur_lobe *const lobe = &of->lobes[k];
    double density = 0.0;
    if (u[2] <= 0.0)
        return 0.0;
    if (lobe->kind != AUR_LOBE_GGX) /* the same shape, without the part below the horizon */
        return 2.0 * PI / (lobe->exponent + 1.0) / aur_potential_mass(of->potentials[k]);
    aur_potential_density(of->potentials[k], 1, u, &density, NULL);
    return density > 0.0 ? density / aur_lobe_pdf(lobe, u) : 0.0;
}

aur_result lab_lobes_weigh(const lab_lobes *of, lab_lobe_method how, const double *xyz, double *weights,
                           aur_error *error) {
    double solved[LAB_MOST_LOBES * LAB_MOST_SAMPLES] = {0.0};
    aur_strategy strategies[LAB_MOST_LOBES];
    const aur_potential *potentials[LAB_MOST_LOBES];
    for (size_t k = 0; k < of->count; ++k) {
        strategies[k] = (aur_strategy){.count = of->counts[k], .sampled = of->lobes[k]};
        if (of->lobes[k].kind != AUR_LOBE_GGX)
            find_axis(of, k, strategies[k].axis);
        potentials[k] = of->potentials[k];
    }
    aur_result result = AUR_OK;
    if (how == LAB_OSWA)
        result = aur_weights_solve(of->all, xyz, of->count, potentials, NULL, of->count * of->all, solved,
                                   NULL, NULL, error);
    for (size_t k = 0, first = 0; k < of->count && result == AUR_OK && how != LAB_OSWA;
         first += of->counts[k++]) {
        double *const w = solved + k * of->all;
        if (how == LAB_OSW)
            result = aur_weights_solve(of->counts[k], xyz + 3 * first, 1, &potentials[k], NULL, of->counts[k],
                                       w + first, NULL, NULL, error);
        else if (how == LAB_MIS)
            result = aur_mis_weights(AUR_MIS_BALANCE, of->count, strategies, potentials[k], of->all, xyz, w,
                                     error);
        else
            for (size_t i = first; i < first + of->counts[k]; ++i)
                w[i] = ratio(of, k, xyz + 3 * i) / (double)of->counts[k];
    }
    for (size_t i = 0; i < of->all; ++i) {
        weights[i] = 0.0;
        for (size_t k = 0; k < of->count; ++k)
            weights[i] += solved[k * of->all + i];
    }
    return result;
}

static aur_result find_reference(const lab_lobes *of, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t k = 0; k < of->count && result == AUR_OK; ++k) {
        double *const xyz = of->reference + 4 * LAB_LOBE_REFERENCE * k, *const weights =
                                                                            xyz + 3 * LAB_LOBE_REFERENCE;
        double sum = 0.0;
        result = draw(of, k, "spherical-fibonacci", LAB_LOBE_REFERENCE, LAB_LOBE_REFERENCE, 0, xyz, error);
        for (size_t i = 0; i < LAB_LOBE_REFERENCE && result == AUR_OK; ++i)
            sum += weights[i] = ratio(of, k, xyz + 3 * i);
        for (size_t i = 0; i < LAB_LOBE_REFERENCE; ++i)
            weights[i] /= sum;
    }
    return result;
}

double lab_lobes_integrate(const lab_lobes *of, const lab_light *light) {
    double sum = 0.0;
    for (size_t k = 0; k < of->count; ++k)
        for (size_t i = 0; i < LAB_LOBE_REFERENCE; ++i) {
            const double *const lobe = of->reference + 4 * LAB_LOBE_REFERENCE * k;
            sum += lobe[3 * LAB_LOBE_REFERENCE + i] * lab_radiance(light, lobe + 3 * i);
        }
    return sum;
}

aur_result lab_lobes_open(lab_lobes *of, aur_error *error) {
    of->all = 0;
    of->reference = malloc(4 * LAB_LOBE_REFERENCE * LAB_MOST_LOBES * sizeof *of->reference);
    aur_result result = of->reference == NULL ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory") : AUR_OK;
    for (size_t k = 0; k < of->count && result == AUR_OK; ++k) {
        aur_lobe *const lobe = &of->lobes[k];
        if (lobe->kind == AUR_LOBE_GGX)
            lobe->view_degrees = of->view_degrees;
        aur_density density = {.size = sizeof density,
                               .kind =
                                   lobe->kind == AUR_LOBE_GGX ? AUR_DENSITY_GGX : AUR_DENSITY_COSINE_POWER,
                               .exponent = lobe->exponent,
                               .clipped = is_glossy_cosine(lobe),
                               .alpha = lobe->alpha,
                               .view_degrees = lobe->view_degrees};
        if (lobe->kind != AUR_LOBE_GGX)
            find_axis(of, k, density.axis);
        of->counts[k] = k == 0 ? 64 : k == 1 ? 32 : 16;
        of->all += of->counts[k];
        result = aur_potential_create(&density, 1.5, &of->potentials[k], error);
    }
    return result == AUR_OK ? find_reference(of, error) : result;
}

void lab_lobes_close(lab_lobes *of) {
    for (size_t k = 0; k < LAB_MOST_LOBES; ++k) {
        aur_potential_destroy(of->potentials[k]);
        of->potentials[k] = NULL;
    }
    free(of->reference);
    of->reference = NULL;
}

void lab_lobes_rows(lab_run *run, const char *name, const char *set, bool hard, size_t count, size_t stride,
                    const double *squares) {
    const char *const light = hard ? "hard edges" : "smooth";
    double over[LAB_LOBE_METHODS];
    for (size_t m = 0; m < LAB_LOBE_METHODS; ++m) {
        const double *const of_method = squares + m * stride;
        const lab_interval found = lab_root_ratio_paired(count, of_method, squares + LAB_PLAIN * stride);
        over[m] = found.value;
        lab_row(run, (const char *const[]){name, set, light, lab_lobe_method_names[m], NULL}, 4,
                (const double[]){lab_root_mean(count, of_method).value, found.value, found.low, found.high});
    }
    lab_note(run, "%s, %s, %s: over p/q: MIS %.2f, OSW %.2f, OSWA %.2f", name, set, light, over[LAB_MIS],
             over[LAB_OSW], over[LAB_OSWA]);
}
