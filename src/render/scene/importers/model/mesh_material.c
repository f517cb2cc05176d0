#include "render/scene/importers/model/mesh_material.h"

#include <math.h>
#include <stdlib.h>

#include "render/scene/importers/model/xml_text.h"

static double or_else(double value, double otherwise) {
    return isnan(value) ? otherwise : value;
}

static double share(double value) {
    return fmin(fmax(value, 0.0), 1.0);
}

aur_result aur_mesh_material_find(aur_mtl_material *material, aur_named_files *named, aur_error *error) {
    for (size_t i = 0; i < AUR_MTL_MAP_COUNT; ++i) {
        aur_mtl_picture *const picture = &material->pictures[i];
        char *used = NULL;
        const aur_result result =
            picture->name != NULL ? aur_named_find_picture(named, picture->name, &used, error) : AUR_OK;
        if (result != AUR_OK) {
            free(used);
            return result;
        }
        free(picture->name);
        picture->name = used;
    }
    return AUR_OK;
}

static bool has(const aur_mtl_material *material, aur_mtl_map map) {
    return material->pictures[map].name != NULL;
}

/* How a picture becomes a <texture>. */
typedef struct use {
    aur_mtl_map map;
    const char *name, *channel;
    bool raw;
    double factor[3];
} use;

static void put_texture(const aur_mtl_material *material, const use *how, FILE *xml) {
    const aur_mtl_picture *const picture = &material->pictures[how->map];
    aur_model_put(xml, "<texture type=\"bitmap\" name=\"%s\"><string name=\"filename\" value=\"", how->name);
    aur_model_put_escaped(xml, picture->name);
    aur_model_put(
        xml,
        "\"/><boolean name=\"raw\" value=\"%s\"/><string name=\"channel\" value=\"%s\"/>"
        "<string name=\"wrap_mode\" value=\"%s\"/><vector name=\"factor\" value=\"%.9g %.9g %.9g\"/>"
        "</texture>\n",
        how->raw ? "true" : "false", how->channel, picture->clamped ? "clamp" : "repeat", how->factor[0],
        how->factor[1], how->factor[2]);
}

/* A share of the light: by its picture, times a factor, or a number. */
static void put_share(const aur_mtl_material *material, aur_mtl_map map, const char *name,
                      const char *channel, double value, FILE *xml) {
    const use one = {map, name, channel, true, {value, value, value}};
    if (has(material, map))
        put_texture(material, &one, xml);
    else
        aur_model_put(xml, "<float name=\"%s\" value=\"%.9g\"/>\n", name, value);
}

static void put_base_color(const aur_mtl_material *material, bool colored, FILE *xml) {
    use base = {AUR_MTL_DIFFUSE, "base_color", "rgb", false, {0}};
    for (size_t i = 0; i < 3; ++i)
        base.factor[i] = share(or_else(material->diffuse[i], 0.6));
    if (has(material, AUR_MTL_DIFFUSE)) {
        /* Many files have a texture with a black colour, or no colour. */
        const bool none =
            isnan(material->diffuse[0]) || !(base.factor[0] + base.factor[1] + base.factor[2] > 0);
        for (size_t i = 0; i < 3 && none; ++i)
            base.factor[i] = 1.0;
        put_texture(material, &base, xml);
    } else if (colored) {
        aur_model_put(xml, "<texture type=\"mesh_attribute\" name=\"base_color\"><string name=\"name\" "
                           "value=\"vertex_color\"/></texture>\n");
    } else {
        aur_model_put(xml, "<rgb name=\"base_color\" value=\"%.9g %.9g %.9g\"/>\n", base.factor[0],
                      base.factor[1], base.factor[2]);
    }
}

/* Blinn's exponent, where a material has no roughness: alpha^2 = 2 / (n + 2), and alpha is its square. */
static double roughness_of(const aur_mtl_material *material) {
    const double exponent = or_else(material->shininess, 0.0);
    return share(or_else(material->roughness, exponent > 0.0 ? pow(2.0 / (exponent + 2.0), 0.25) : 1.0));
}

static bool has_highlight(const aur_mtl_material *material) {
    const double *const s = material->specular;
    if (or_else(material->metal, 0.0) > 0.0 || has(material, AUR_MTL_METAL))
        return true;
    return isnan(s[0]) ? !isnan(material->roughness) : s[0] + s[1] + s[2] > 0.0;
}

void aur_mesh_material_put(const aur_mtl_material *material, bool colored, FILE *xml) {
    const double opacity = share(or_else(material->opacity, 1.0));
    const bool masked = opacity < 1.0 || has(material, AUR_MTL_OPACITY), bent = has(material, AUR_MTL_NORMAL);
    const use normals = {AUR_MTL_NORMAL, "normalmap", "rgb", true, {1.0, 1.0, 1.0}};
    if (masked) {
        aur_model_put(xml, "<bsdf type=\"mask\">");
        put_share(material, AUR_MTL_OPACITY, "opacity", "rgb", opacity, xml);
    }
    aur_model_put(xml, "<bsdf type=\"twosided\">%s", bent ? "<bsdf type=\"normalmap\">" : "");
    if (bent)
        put_texture(material, &normals, xml);
    aur_model_put(xml, "<bsdf type=\"principled\">");
    put_base_color(material, colored, xml);
    put_share(material, AUR_MTL_ROUGHNESS, "roughness", "red", roughness_of(material), xml);
    put_share(material, AUR_MTL_METAL, "metallic", "red",
              share(or_else(material->metal, has(material, AUR_MTL_METAL) ? 1.0 : 0.0)), xml);
    if (!has_highlight(material))
        aur_model_put(xml, "<float name=\"specular\" value=\"0\"/>");
    aur_model_put(xml, "</bsdf></bsdf>%s%s\n", bent ? "</bsdf>" : "", masked ? "</bsdf>" : "");
}

bool aur_mesh_material_emits(const aur_mtl_material *material) {
    const double *const e = material->emission;
    return isnan(e[0]) ? has(material, AUR_MTL_EMISSION) : e[0] + e[1] + e[2] > 0.0;
}

void aur_mesh_material_put_emitter(const aur_mtl_material *material, FILE *xml) {
    use radiance = {AUR_MTL_EMISSION, "radiance", "rgb", false, {0}};
    for (size_t i = 0; i < 3; ++i)
        radiance.factor[i] = or_else(material->emission[i], 1.0);
    aur_model_put(xml, "<emitter type=\"area\">");
    if (has(material, AUR_MTL_EMISSION))
        put_texture(material, &radiance, xml);
    else
        aur_model_put(xml, "<rgb name=\"radiance\" value=\"%.9g %.9g %.9g\"/>", radiance.factor[0],
                      radiance.factor[1], radiance.factor[2]);
    aur_model_put(xml, "</emitter>");
}
