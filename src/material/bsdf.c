#include "material/bsdf.h"

#include <stdlib.h>
#include <string.h>

extern const aur_bsdf_descriptor aur_bsdf_diffuse;
extern const aur_bsdf_descriptor aur_bsdf_phong;
extern const aur_bsdf_descriptor aur_bsdf_phong_lobe;
extern const aur_bsdf_descriptor aur_bsdf_twosided;
extern const aur_bsdf_descriptor aur_bsdf_conductor;
extern const aur_bsdf_descriptor aur_bsdf_roughconductor;
extern const aur_bsdf_descriptor aur_bsdf_dielectric;
extern const aur_bsdf_descriptor aur_bsdf_thindielectric;
extern const aur_bsdf_descriptor aur_bsdf_roughdielectric;
extern const aur_bsdf_descriptor aur_bsdf_plastic;
extern const aur_bsdf_descriptor aur_bsdf_roughplastic;
extern const aur_bsdf_descriptor aur_bsdf_mask;

static const aur_bsdf_descriptor *const table[] = {
    &aur_bsdf_diffuse,         &aur_bsdf_twosided,       &aur_bsdf_phong,        &aur_bsdf_phong_lobe,
    &aur_bsdf_conductor,       &aur_bsdf_roughconductor, &aur_bsdf_dielectric,   &aur_bsdf_thindielectric,
    &aur_bsdf_roughdielectric, &aur_bsdf_plastic,        &aur_bsdf_roughplastic, &aur_bsdf_mask,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

const aur_bsdf_descriptor *aur_bsdf_descriptor_at(size_t index) {
    return index < TABLE_SIZE ? table[index] : NULL;
}

static aur_result find_descriptor(const aur_parameters *parameters, const aur_bsdf_descriptor **descriptor,
                                  aur_error *error) {
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0) {
            *descriptor = table[i];
            return AUR_OK;
        }
    }
    return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
}

static bool is_textured(const aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind != AUR_PARAMETER_OBJECT)
            continue;
        if (strcmp(item->object_kind, "bsdf") != 0 || ((const aur_bsdf *)item->object)->textured)
            return true;
    }
    return false;
}

aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error) {
    *bsdf = NULL;
    const aur_bsdf_descriptor *descriptor = NULL;
    aur_result result = find_descriptor(parameters, &descriptor, error);
    if (result != AUR_OK)
        return result;
    aur_bsdf *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    made->descriptor = descriptor;
    result = descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    made->textured = is_textured(parameters);
    if (result != AUR_OK) {
        aur_bsdf_destroy(made);
        return result;
    }
    *bsdf = made;
    return AUR_OK;
}

void aur_bsdf_destroy(aur_bsdf *bsdf) {
    if (bsdf == NULL)
        return;
    if (bsdf->data != NULL)
        bsdf->descriptor->release(bsdf);
    free(bsdf);
}

aur_vector aur_bsdf_evaluate_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                     aur_vector light) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return descriptor->sampled != NULL ? descriptor->sampled->evaluate(bsdf, point, view, light)
                                       : descriptor->evaluate(bsdf, point, view, light);
}

float aur_bsdf_pdf_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return descriptor->sampled != NULL ? descriptor->sampled->pdf(bsdf, point, view, light)
                                       : descriptor->pdf(bsdf, point, view, light);
}

bool aur_bsdf_sample_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                             aur_bsdf_sample *sample) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return (descriptor->sampled != NULL ? descriptor->sampled->sample(bsdf, point, view, u, sample)
                                        : descriptor->sample(bsdf, point, view, u, sample)) &&
           !sample->specular;
}

aur_vector aur_bsdf_evaluate_none(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                  aur_vector light) {
    (void)bsdf;
    (void)point;
    (void)view;
    (void)light;
    return (aur_vector){0};
}

float aur_bsdf_pdf_none(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    (void)bsdf;
    (void)point;
    (void)view;
    (void)light;
    return 0.0f;
}

aur_vector aur_bsdf_albedo_none(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    (void)bsdf;
    (void)point;
    (void)side;
    return (aur_vector){0};
}

void aur_bsdf_release_data(aur_bsdf *bsdf) {
    free(bsdf->data);
    bsdf->data = NULL;
}

aur_result aur_bsdf_allocate(const aur_parameters *parameters, aur_bsdf *bsdf, size_t size,
                             aur_error *error) {
    bsdf->data = calloc(1, size);
    if (bsdf->data == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    return AUR_OK;
}

aur_result aur_parameters_nested_bsdf(aur_parameters *parameters, const char *name, const aur_bsdf **bsdf,
                                      aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, "bsdf") != 0)
        return aur_fail_at(error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be a bsdf",
                           parameters->kind, parameters->plugin, name);
    *bsdf = item->object;
    return AUR_OK;
}
