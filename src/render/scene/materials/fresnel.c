#include "render/scene/materials/fresnel.h"

#include <math.h>
#include <string.h>

#include "points/base/text.h"

float aur_fresnel_dielectric(float cosine, float ior, float *refracted) {
    const float ratio = cosine >= 0.0f ? ior : 1.0f / ior; /* of the other side over this side */
    const float here = fabsf(cosine);
    const float there_squared = 1.0f - (1.0f - here * here) / (ratio * ratio);
    *refracted = 0.0f;
    if (!(there_squared > 0.0f))
        return 1.0f;
    const float there = sqrtf(there_squared);
    const float perpendicular = (here - ratio * there) / (here + ratio * there);
    const float parallel = (ratio * here - there) / (ratio * here + there);
    *refracted = cosine >= 0.0f ? -there : there;
    return 0.5f * (perpendicular * perpendicular + parallel * parallel);
}

static float conductor(float cosine, float eta, float k) {
    const float cosine2 = cosine * cosine;
    const float sine2 = 1.0f - cosine2;
    const float real = eta * eta - k * k - sine2;
    const float size = sqrtf(fmaxf(real * real + 4.0f * eta * eta * k * k, 0.0f));
    const float a = sqrtf(fmaxf(0.5f * (size + real), 0.0f));
    const float first = size + cosine2, second = 2.0f * a * cosine;
    const float perpendicular = (first - second) / fmaxf(first + second, 1e-30f);
    const float third = size * cosine2 + sine2 * sine2, fourth = second * sine2;
    const float parallel = perpendicular * (third - fourth) / fmaxf(third + fourth, 1e-30f);
    return 0.5f * (perpendicular + parallel);
}

aur_vector aur_fresnel_conductor(float cosine, aur_vector eta, aur_vector k) {
    return (aur_vector){conductor(cosine, eta.x, k.x), conductor(cosine, eta.y, k.y),
                        conductor(cosine, eta.z, k.z)};
}

float aur_fresnel_diffuse(float ior) {
    /* Midpoint rule in c^2 = t for the integral of F(sqrt t) dt, in two parts if there is total reflection
     * below an angle. */
    enum { STEPS = 4096 };
    const double from = ior < 1.0f ? 1.0 - (double)ior * (double)ior : 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < STEPS; ++i) {
        /* squared steps, since F is steep at the lower end */
        const double x = ((double)i + 0.5) / STEPS;
        const double t = from + (1.0 - from) * x * x;
        float refracted;
        sum += 2.0 * x * (double)aur_fresnel_dielectric((float)sqrt(t), ior, &refracted);
    }
    return (float)(from + (1.0 - from) * sum / STEPS);
}

/* Indices of common substances at 589 nm. */
static const struct {
    const char *name;
    double ior;
} substances[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.575},       {"diamond", 2.419},
};

enum { SUBSTANCE_COUNT = sizeof substances / sizeof substances[0] };

static aur_result fail_name(const aur_parameters *parameters, const aur_parameter *item, size_t count,
                            const char *const *names, aur_error *error) {
    const char *const nearest = item->text != NULL ? aur_nearest_name(item->text, count, names) : NULL;
    return aur_fail_at(error, item->location, AUR_ERROR_NAME, "%s '%s': '%s' is unknown: '%s'%s%s%s",
                       parameters->kind, parameters->plugin, item->name,
                       item->text != NULL ? item->text : "an object",
                       nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                       nearest != NULL ? "'?" : "");
}

typedef struct indices {
    double inside, outside;
} indices;

/* Their parameters if given by numbers. */
static const aur_key numbers[] = {
    {AUR_KEY_OF_REAL(indices, "int_ior", inside, 0.1, 100.0, NULL, NULL)},
    {AUR_KEY_OF_REAL(indices, "ext_ior", outside, 0.1, 100.0, NULL, NULL)},
    {AUR_KEY_OF_REAL(indices, "ext_eta", outside, 0.1, 100.0, NULL, NULL)},
};

static aur_result read_ior(aur_parameters *parameters, const aur_key *key, indices *both, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, key->name);
    if (item == NULL)
        return AUR_OK;
    double number;
    if (item->text == NULL || item->kind == AUR_PARAMETER_FLOAT || item->kind == AUR_PARAMETER_INTEGER ||
        aur_parse_double(item->text, &number))
        return aur_keys_read(1, key, parameters, both, error);
    const char *names[SUBSTANCE_COUNT];
    for (size_t i = 0; i < SUBSTANCE_COUNT; ++i) {
        names[i] = substances[i].name;
        if (strcmp(names[i], item->text) == 0) {
            *(double *)((char *)both + key->offset) = substances[i].ior;
            return AUR_OK;
        }
    }
    return fail_name(parameters, item, SUBSTANCE_COUNT, names, error);
}

static double ior_of(const char *name) {
    for (size_t i = 0; i < SUBSTANCE_COUNT; ++i)
        if (strcmp(substances[i].name, name) == 0)
            return substances[i].ior;
    return 1.0;
}

aur_result aur_parameters_ior(aur_parameters *parameters, const char *inside, float *ior, aur_error *error) {
    indices both = {ior_of(inside), ior_of("air")};
    aur_result result = read_ior(parameters, &numbers[0], &both, error);
    if (result == AUR_OK)
        result = read_ior(parameters, &numbers[1], &both, error);
    *ior = (float)(both.inside / both.outside);
    return result;
}

/* Complex indices for red, green and blue, by the CIE observer from measured spectra (Mitsuba's data, from
 * SOPRA and Palik's handbook). */
static const struct {
    const char *name;
    aur_vector eta, k;
} metals[] = {
    {"a-C", {2.94405f, 2.22714f, 1.96816f}, {0.88746f, 0.79930f, 0.81529f}},
    {"Ag", {0.15528f, 0.11673f, 0.13839f}, {4.82835f, 3.12222f, 2.14690f}},
    {"Al", {1.65750f, 0.88040f, 0.52124f}, {9.22381f, 6.26950f, 4.83700f}},
    {"Au", {0.14304f, 0.37531f, 1.44205f}, {3.98300f, 2.38556f, 1.60336f}},
    {"Be", {4.18501f, 3.18503f, 2.78406f}, {3.83547f, 3.01012f, 2.86899f}},
    {"Cr", {4.36967f, 2.91651f, 1.65490f}, {5.20655f, 4.23131f, 3.75470f}},
    {"Cu", {0.20101f, 0.92375f, 1.10222f}, {3.91326f, 2.45305f, 2.14209f}},
    {"Cu2O", {3.55177f, 2.94987f, 2.75188f}, {0.11421f, 0.19390f, 0.60613f}},
    {"CuO", {3.24754f, 2.44781f, 2.21022f}, {0.52109f, 0.57003f, 0.72218f}},
    {"Hg", {2.39894f, 1.44003f, 0.90957f}, {6.32759f, 4.37192f, 3.42176f}},
    {"HgTe", {4.77904f, 3.23120f, 2.65990f}, {1.63161f, 1.58081f, 1.72929f}},
    {"Ir", {3.08630f, 2.08219f, 1.61791f}, {5.59215f, 4.06709f, 3.26731f}},
    {"K", {0.06404f, 0.04641f, 0.03818f}, {2.10420f, 1.34894f, 0.91313f}},
    {"Li", {0.26579f, 0.19562f, 0.22095f}, {3.54016f, 2.31112f, 1.66861f}},
    {"Mo", {4.48397f, 3.52513f, 2.77631f}, {4.11144f, 3.42083f, 3.15061f}},
    {"Nb", {3.42007f, 2.79009f, 2.39563f}, {3.44139f, 2.73767f, 2.57975f}},
    {"Rh", {2.58579f, 1.86022f, 1.55426f}, {6.78226f, 4.70299f, 3.97607f}},
    {"Ta", {2.06272f, 2.39294f, 2.62793f}, {2.40836f, 1.74149f, 1.94703f}},
    {"TiC", {3.70053f, 2.83742f, 2.58229f}, {3.26564f, 2.35159f, 2.17279f}},
    {"TiN", {1.64845f, 1.15052f, 1.37982f}, {3.36833f, 1.94350f, 1.10207f}},
    {"VC", {3.65757f, 2.75274f, 2.53267f}, {3.06830f, 2.19869f, 1.96319f}},
    {"VN", {2.86560f, 2.11919f, 1.94009f}, {3.03221f, 2.05612f, 1.61631f}},
    {"W", {4.37082f, 3.30025f, 2.99841f}, {3.50064f, 2.60487f, 2.27323f}},
};

enum { METAL_COUNT = sizeof metals / sizeof metals[0] };

static aur_result find_metal(aur_parameters *parameters, aur_metal *metal, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, "material");
    const bool has_eta = aur_parameters_find(parameters, "eta") != NULL;
    const bool has_k = aur_parameters_find(parameters, "k") != NULL;
    metal->perfect = item == NULL && !has_eta && !has_k;
    if (item != NULL && (has_eta || has_k))
        return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                           "bsdf '%s': give 'material' or 'eta' and 'k'", parameters->plugin);
    if (item == NULL)
        return has_eta == has_k ? AUR_OK
                                : aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                                              "bsdf '%s': 'eta' and 'k' go together", parameters->plugin);
    const char *names[METAL_COUNT + 1];
    for (size_t i = 0; i < METAL_COUNT; ++i) {
        names[i] = metals[i].name;
        if (item->text != NULL && strcmp(names[i], item->text) == 0) {
            metal->eta = metals[i].eta;
            metal->k = metals[i].k;
            return AUR_OK;
        }
    }
    names[METAL_COUNT] = "none";
    if (item->text == NULL || strcmp(item->text, "none") != 0)
        return fail_name(parameters, item, METAL_COUNT + 1, names, error);
    metal->perfect = true;
    return AUR_OK;
}

aur_result aur_metal_complete(aur_parameters *parameters, aur_metal *metal, aur_error *error) {
    indices both = {1.0, 1.0};
    aur_result result = read_ior(parameters, &numbers[2], &both, error);
    if (result == AUR_OK)
        result = find_metal(parameters, metal, error);
    metal->eta = aur_vector_scale(metal->eta, (float)(1.0 / both.outside));
    metal->k = aur_vector_scale(metal->k, (float)(1.0 / both.outside));
    return result;
}
