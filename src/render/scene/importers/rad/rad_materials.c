/* Conversion of materials. All Radiance materials but glass scatter equally on both sides. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "render/scene/importers/rad/rad_reader.h"

static void add_colour(aur_rad *self, aur_xml_node *bsdf, const char *name, const double colour[3],
                       double factor) {
    const double scaled[3] = {factor * colour[0], factor * colour[1], factor * colour[2]};
    aur_node_numbers(self->nodes, bsdf, "rgb", name, 3, scaled);
}

/* A diffuse surface with reflection and transmission. */
static void add_sheet(aur_rad *self, const double reflected[3], const double through[3],
                      aur_rad_material *material) {
    aur_nodes *const nodes = self->nodes;
    const bool opaque = through[0] + through[1] + through[2] == 0.0;
    material->bsdf = aur_node_object(nodes, self->parent, "bsdf", opaque ? "twosided" : "ward");
    aur_xml_node *const bsdf =
        opaque ? aur_node_object(nodes, material->bsdf, "bsdf", "diffuse") : material->bsdf;
    add_colour(self, bsdf, opaque ? "reflectance" : "diffuse_reflectance", reflected, 1.0);
    if (opaque)
        return;
    add_colour(self, bsdf, "diffuse_transmittance", through, 1.0);
    add_colour(self, bsdf, "specular_reflectance", through, 0.0);
}

/* plastic, metal and trans: R G B specularity roughness [transmission, its specular part]. */
static aur_result add_normal(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const double *const x = item->numbers, white[3] = {1.0, 1.0, 1.0};
    const double specular = x[3], through = item->number_count > 5 ? x[5] : 0.0,
                 unscattered = item->number_count > 5 ? x[6] : 0.0;
    for (size_t i = 3; i < item->number_count; ++i)
        if (!(x[i] >= 0.0 && x[i] <= 1.0))
            return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT, "%s: %g must be from 0 to 1",
                                item->row->name, x[i]);
    if (specular == 0.0 && through == 0.0) {
        add_sheet(self, x, (const double[3]){0.0}, material);
        return self->nodes->result;
    }
    const bool smooth = x[4] * x[4] <= 1e-6; /* as FTINY in normal.c */
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const bsdf = material->bsdf = aur_node_object(nodes, self->parent, "bsdf", "ward");
    const double rest = 1.0 - specular;
    add_colour(self, bsdf, "diffuse_reflectance", x, rest * (1.0 - through));
    add_colour(self, bsdf, "specular_reflectance", item->type.text[0] == 'm' ? x : white, specular);
    add_colour(self, bsdf, "diffuse_transmittance", x, rest * through * (1.0 - unscattered));
    add_colour(self, bsdf, "specular_transmittance", x, rest * through * unscattered);
    aur_node_property(nodes, bsdf, "float", "alpha", "%.17g", smooth ? 0.0 : x[4]);
    /* As FRESTHRESH: below this specularity there is no Fresnel coat. */
    aur_node_property(nodes, bsdf, "boolean", "varnished", smooth && specular >= 0.017999 ? "true" : "false");
    return nodes->result;
}

static aur_result add_glass(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const double *const x = item->numbers;
    aur_nodes *const nodes = self->nodes;
    material->bsdf = aur_node_object(nodes, self->parent, "bsdf", "glass");
    aur_node_property(nodes, material->bsdf, "float", "int_ior", "%.17g",
                      item->number_count > 3 ? x[3] : 1.52);
    aur_node_property(nodes, material->bsdf, "float", "ext_ior", "1");
    aur_node_numbers(nodes, material->bsdf, "rgb", "transmissivity", 3, x);
    return nodes->result;
}

/* Converts the transmission per unit length to an absorbing medium; NULL if nothing is absorbed. */
static aur_result add_medium(aur_rad *self, const aur_rad_primitive *item, const double *x,
                             aur_xml_node **medium) {
    enum { DENSEST = 1000 }; /* extinction for zero transmission */
    if (!(fmin(x[0], fmin(x[1], x[2])) >= 0.0) || fmax(x[0], fmax(x[1], x[2])) > 1.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "%s: transmission must be from 0 to 1 per unit of length", item->row->name);
    *medium = NULL;
    if (x[0] * x[1] * x[2] == 1.0)
        return AUR_OK;
    if (self->scene->diffuse) {
        ++self->scene->diffuse_count;
        return AUR_OK;
    }
    double extinction[3];
    for (size_t i = 0; i < 3; ++i)
        extinction[i] = fmin(-log(x[i]), DENSEST);
    *medium = aur_node_object(self->nodes, self->parent, "medium", "homogeneous");
    aur_node_numbers(self->nodes, *medium, "rgb", "sigma_t", 3, extinction);
    aur_node_property(self->nodes, *medium, "rgb", "albedo", "0");
    return self->nodes->result;
}

/* dielectric R G B n hartmann; interface R G B n R G B n, the inner side first. */
static aur_result add_dielectric(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const double *const x = item->numbers;
    const bool two = item->number_count == 8;
    aur_result result = add_medium(self, item, x, &material->interior);
    if (result == AUR_OK && two)
        result = add_medium(self, item, x + 4, &material->exterior);
    if (result != AUR_OK)
        return result;
    material->bsdf = aur_node_object(self->nodes, self->parent, "bsdf", "dielectric");
    aur_node_property(self->nodes, material->bsdf, "float", "int_ior", "%.17g", x[3]);
    aur_node_property(self->nodes, material->bsdf, "float", "ext_ior", "%.17g", two ? x[7] : 1.0);
    return self->nodes->result;
}

/* Black when seen from behind. */
static aur_result add_mirror(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    material->bsdf = aur_node_object(self->nodes, self->parent, "bsdf", "conductor");
    aur_node_numbers(self->nodes, material->bsdf, "rgb", "specular_reflectance", 3, item->numbers);
    return self->nodes->result;
}

/* light, glow and illum. A glow of negative radius is visible but does not illuminate: it is black here. */
static aur_result add_light(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const double *const x = item->numbers;
    if (x[0] < 0.0 || x[1] < 0.0 || x[2] < 0.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT, "%.*s: radiance must not be below 0",
                            (int)item->type.length, item->type.text);
    const bool dark = item->number_count > 3 && x[3] < 0.0;
    material->emits = true;
    for (size_t i = 0; i < 3; ++i)
        material->radiance[i] = dark ? 0.0 : x[i];
    if (dark)
        aur_warn_at(self->scene->warnings, (aur_location){self->nodes->location.file, item->type.line, 0},
                    "glow: its radius is below 0: it lights nothing, and is black");
    return AUR_OK;
}

/* brightfunc with skybr of skybright.cal or perezlum.cal: the output of gensky and gendaylit. */
static aur_result add_pattern(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    static const struct {
        const char *function, *file;
        size_t numbers;
    } forms[] = {{"skybr", "skybright.cal", 7}, {"skybright", "perezlum.cal", 10}};
    for (size_t i = 0; i < 2; ++i) {
        if (item->string_count != 2 || !aur_rad_is_word(item->strings[0], forms[i].function) ||
            !aur_rad_is_word(item->strings[1], forms[i].file))
            continue;
        /* Overcast and uniform skies do not depend on the sun. */
        const size_t count = item->number_count, needs = forms[i].numbers;
        const bool even = i == 0 && count >= 3 && (item->numbers[0] == 2.0 || item->numbers[0] == 3.0);
        if (count > needs || (count < needs && !even))
            return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                                "brightfunc: %s takes %zu numbers, not %zu", forms[i].function, needs, count);
        aur_rad_sky *const sky = material->sky = aur_arena_allocate(self->scene->arena, sizeof *sky);
        if (sky == NULL)
            return aur_fail_memory(self->error);
        *sky = (aur_rad_sky){.perez = i == 1};
        memcpy(sky->numbers, item->numbers, count * sizeof *sky->numbers);
        return AUR_OK;
    }
    return aur_rad_fail(
        self, item->type.line, AUR_ERROR_UNSUPPORTED,
        "'brightfunc' is not read, only skybr of skybright.cal and skybright of perezlum.cal");
}

const aur_rad_row aur_rad_materials[] = {
    {"plastic", 5, 5, 0, true, false, add_normal},
    {"metal", 5, 5, 0, true, false, add_normal},
    {"trans", 7, 7, 0, true, false, add_normal},
    {"glass", 3, 4, 0, true, false, add_glass},
    {"dielectric", 5, 5, 0, true, false, add_dielectric},
    {"interface", 8, 8, 0, true, false, add_dielectric},
    {"mirror", 3, 3, 1, true, false, add_mirror},
    {"light", 3, 3, 0, true, true, add_light},
    {"glow", 4, 4, 0, true, true, add_light},
    {"illum", 3, 3, 1, true, true, add_light},
    {"spotlight", 7, 7, 0, true, true, aur_rad_add_spotlight},
    {"brightfunc", 0, SIZE_MAX, SIZE_MAX, true, false, add_pattern},
    {"brightdata", 0, SIZE_MAX, SIZE_MAX, true, false, aur_rad_add_distribution},
    {.name = NULL},
};

/* --- modifiers without a table row, from Radiance's manual page "rad", and their diffuse parts */

typedef enum diffuse_form {
    NO_FORM,     /* diffuse part cannot be determined */
    NO_SURFACE,  /* transmits light */
    COAT,        /* R G B specularity: as plastic */
    METAL,       /* R G B: all diffuse */
    SHEET,       /* R G B specularity u v transmission: as trans */
    SHEET_DATA,  /* R G B specularity transmission */
    TWO_COLOURS, /* diffuse R G B, specular R G B */
    SIDES,       /* R G B of the front, of the back and through */
    MIXTURE,     /* mixture of two others: the first one that is defined */
    MATRIX,      /* a BSDF file, replaced by its hemispherical means */
} diffuse_form;

static const struct {
    const char *name;
    diffuse_form form;
    size_t numbers; /* minimum count of arguments */
} modifiers[] = {{"prism1", NO_SURFACE, 0},    {"prism2", NO_SURFACE, 0},     {"plastic2", COAT, 4},
                 {"metal2", METAL, 4},         {"trans2", SHEET, 8},          {"ashik2", TWO_COLOURS, 8},
                 {"plasfunc", COAT, 4},        {"metfunc", METAL, 4},         {"transfunc", SHEET_DATA, 6},
                 {"BRTDfunc", SIDES, 9},       {"plasdata", COAT, 4},         {"metdata", METAL, 4},
                 {"transdata", SHEET_DATA, 6}, {"BSDF", MATRIX, 0},           {"aBSDF", MATRIX, 0},
                 {"WGMDfunc", NO_FORM, 0},     {"antimatter", NO_SURFACE, 0}, {"mist", NO_SURFACE, 0},
                 {"texfunc", NO_FORM, 0},      {"texdata", NO_FORM, 0},       {"colorfunc", NO_FORM, 0},
                 {"colordata", NO_FORM, 0},    {"colorpict", NO_FORM, 0},     {"colortext", NO_FORM, 0},
                 {"brighttext", NO_FORM, 0},   {"mixfunc", MIXTURE, 0},       {"mixdata", MIXTURE, 0},
                 {"mixpict", MIXTURE, 0},      {"mixtext", MIXTURE, 0},       {"spectrum", NO_FORM, 0},
                 {"specfile", NO_FORM, 0},     {"specfunc", NO_FORM, 0},      {"specdata", NO_FORM, 0},
                 {"specpict", NO_FORM, 0}};

enum { MODIFIERS = sizeof modifiers / sizeof modifiers[0] };

static size_t find_modifier(aur_rad_word type) {
    size_t i = 0;
    while (i < MODIFIERS && !aur_rad_is_word(type, modifiers[i].name))
        ++i;
    return i;
}

bool aur_rad_is_modifier(aur_rad_word type) {
    return find_modifier(type) < MODIFIERS;
}

static aur_result fail_diffuse(const aur_rad *self, const aur_rad_primitive *item) {
    return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED, "the diffuse part of '%.*s' is unknown",
                        (int)item->type.length, item->type.text);
}

/* BSDF: thickness FILE ..., or aBSDF: FILE ...; BSDF may add diffuse R G B of the front, of the back and
 * transmitted. */
static aur_result add_matrix(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const size_t at = item->type.text[0] == 'a' ? 0 : 1;
    double thickness = 0.0, reflected[3], through[3];
    aur_rad_bsdf_means means = {0.0, 0.0};
    if (item->string_count <= at || (at == 1 && !aur_rad_number(item->strings[0], &thickness)))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED, "%.*s: the name of a file expected",
                            (int)item->type.length, item->type.text);
    if (thickness != 0.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                            "BSDF: a thickness of %g means geometry inside: expected 0", thickness);
    const aur_result result = aur_rad_bsdf_read(self, item->strings[at], &means);
    if (result == AUR_ERROR_OPEN)
        return AUR_ERROR_UNSUPPORTED; /* it may be unused */
    if (result != AUR_OK)
        return result;
    ++self->scene->diffuse_count;
    const double *const x = item->numbers;
    for (size_t i = 0; i < 3; ++i) {
        const double back = item->number_count >= 6 ? x[3 + i] : 0.0;
        reflected[i] = means.reflected + (item->number_count >= 3 ? 0.5 * (x[i] + back) : 0.0);
        through[i] = means.through + (item->number_count >= 9 ? x[6 + i] : 0.0);
        /* Rounded values of a lossless sheet may sum to slightly more than 1. */
        const double sum = reflected[i] + through[i], less = sum > 1.0 ? 1.0 / sum : 1.0;
        reflected[i] *= less;
        through[i] *= less;
    }
    add_sheet(self, reflected, through, material);
    return self->nodes->result;
}

aur_result aur_rad_add_diffuse_part(aur_rad *self, const aur_rad_primitive *item,
                                    const aur_rad_material *mixed, aur_rad_material *material) {
    const size_t index = find_modifier(item->type);
    const diffuse_form form = index < MODIFIERS ? modifiers[index].form : NO_FORM;
    const double *const x = item->numbers;
    double reflected[3] = {0.0}, through[3] = {0.0};
    if (form == NO_FORM || item->number_count < modifiers[index].numbers ||
        (form == MIXTURE && mixed == NULL))
        return fail_diffuse(self, item);
    if (form == MATRIX)
        return add_matrix(self, item, material);
    ++self->scene->diffuse_count;
    if (form == MIXTURE) {
        const aur_rad_word name = material->name;
        *material = *mixed;
        material->name = name;
        return AUR_OK;
    }
    if (form == NO_SURFACE) {
        material->nothing = true;
        return AUR_OK;
    }
    for (size_t i = 0; i < 3; ++i) {
        const double passed = form == SHEET ? x[6] : form == SHEET_DATA ? x[4] : 0.0;
        const double rest = (1.0 - x[3]) * x[i];
        reflected[i] = form == METAL         ? x[i]
                       : form == TWO_COLOURS ? fmin(x[i] + x[3 + i], 1.0)
                       : form == SIDES       ? x[i]
                                             : rest * (1.0 - passed) + x[3];
        through[i] = form == SIDES ? x[6 + i] : rest * passed;
        if (form == COAT || form == METAL || form == TWO_COLOURS)
            through[i] = 0.0;
    }
    add_sheet(self, reflected, through, material);
    return self->nodes->result;
}
