#include "render/scene/importers/model/import.h"

#include <math.h>
#include <stdlib.h>

static double or_else(double value, double otherwise) {
    return isnan(value) ? otherwise : value;
}

static double share(double value) {
    return fmin(fmax(value, 0.0), 1.0);
}

aur_result aur_mesh_material_find(aur_mtl_material *material, aur_named_files *named, aur_error *error) {
    for (size_t i = 0; i < AUR_MTL_MAP_COUNT; ++i) {
        aur_mtl_image *const image = &material->images[i];
        char *used = NULL;
        const aur_result result =
            image->name != NULL ? aur_named_find_image(named, image->name, &used, error) : AUR_OK;
        if (result != AUR_OK) {
            free(used);
            return result;
        }
        free(image->name);
        image->name = used;
    }
    return AUR_OK;
}

static bool has(const aur_mtl_material *material, aur_mtl_map map) {
    return material->images[map].name != NULL;
}

/* How an image is converted to a <texture>. */
typedef struct use {
    aur_mtl_map map;
    const char *name, *channel;
    bool raw;
    double factor[3];
} use;

static void add_texture(aur_nodes *nodes, aur_xml_node *parent, const aur_mtl_material *material,
                        const use *how) {
    const aur_mtl_image *const image = &material->images[how->map];
    aur_xml_node *const texture = aur_node_object(nodes, parent, "texture", "bitmap");
    aur_node_set(nodes, texture, "name", "%s", how->name);
    aur_node_property(nodes, texture, "string", "filename", "%s", image->name);
    aur_node_property(nodes, texture, "boolean", "raw", "%s", how->raw ? "true" : "false");
    aur_node_property(nodes, texture, "string", "channel", "%s", how->channel);
    aur_node_property(nodes, texture, "string", "wrap_mode", "%s", image->clamped ? "clamp" : "repeat");
    aur_node_property(nodes, texture, "vector", "factor", "%.9g %.9g %.9g", how->factor[0], how->factor[1],
                      how->factor[2]);
}

/* A colour: an image times a factor, or a constant. */
static void add_color(aur_nodes *nodes, aur_xml_node *parent, const aur_mtl_material *material,
                      const use *how) {
    if (has(material, how->map))
        add_texture(nodes, parent, material, how);
    else
        aur_node_property(nodes, parent, "rgb", how->name, "%.9g %.9g %.9g", how->factor[0], how->factor[1],
                          how->factor[2]);
}

/* A weight in [0, 1]: an image times a factor, or a number. */
static void add_share(aur_nodes *nodes, aur_xml_node *parent, const aur_mtl_material *material,
                      const use *how) {
    if (has(material, how->map))
        add_texture(nodes, parent, material, how);
    else
        aur_node_property(nodes, parent, "float", how->name, "%.9g", how->factor[0]);
}

static void add_base_color(aur_nodes *nodes, aur_xml_node *parent, const aur_mtl_material *material,
                           bool colored) {
    use base = {AUR_MTL_DIFFUSE, "base_color", "rgb", false, {0}};
    const bool textured = has(material, AUR_MTL_DIFFUSE);
    for (size_t i = 0; i < 3; ++i)
        base.factor[i] = share(or_else(material->diffuse[i], 0.6));
    if (!textured && colored) {
        aur_xml_node *const texture = aur_node_object(nodes, parent, "texture", "mesh_attribute");
        aur_node_set(nodes, texture, "name", "base_color");
        aur_node_property(nodes, texture, "string", "name", "vertex_color");
        return;
    }
    /* Many files have a texture together with a black or missing colour. */
    const bool none = isnan(material->diffuse[0]) || !(base.factor[0] + base.factor[1] + base.factor[2] > 0);
    for (size_t i = 0; i < 3 && textured && none; ++i)
        base.factor[i] = 1.0;
    add_color(nodes, parent, material, &base);
}

/* Converts Blinn's exponent if a material has no roughness: alpha^2 = 2 / (n + 2), and alpha is the roughness
 * squared. */
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

void aur_mesh_material_add(const aur_mtl_material *material, bool colored, aur_nodes *nodes,
                           aur_xml_node *shape) {
    const double opacity = share(or_else(material->opacity, 1.0)), rough = roughness_of(material);
    const double metal = share(or_else(material->metal, has(material, AUR_MTL_METAL) ? 1.0 : 0.0));
    aur_xml_node *bsdf = shape;
    if (opacity < 1.0 || has(material, AUR_MTL_OPACITY)) {
        bsdf = aur_node_object(nodes, bsdf, "bsdf", "mask");
        add_share(nodes, bsdf, material,
                  &(use){AUR_MTL_OPACITY, "opacity", "rgb", true, {opacity, opacity, opacity}});
    }
    bsdf = aur_node_object(nodes, bsdf, "bsdf", "twosided");
    if (has(material, AUR_MTL_NORMAL)) {
        bsdf = aur_node_object(nodes, bsdf, "bsdf", "normalmap");
        add_texture(nodes, bsdf, material, &(use){AUR_MTL_NORMAL, "normalmap", "rgb", true, {1.0, 1.0, 1.0}});
    }
    bsdf = aur_node_object(nodes, bsdf, "bsdf", "principled");
    add_base_color(nodes, bsdf, material, colored);
    add_share(nodes, bsdf, material,
              &(use){AUR_MTL_ROUGHNESS, "roughness", "red", true, {rough, rough, rough}});
    add_share(nodes, bsdf, material, &(use){AUR_MTL_METAL, "metallic", "red", true, {metal, metal, metal}});
    if (!has_highlight(material))
        aur_node_property(nodes, bsdf, "float", "specular", "0");
}

bool aur_mesh_material_emits(const aur_mtl_material *material) {
    const double *const e = material->emission;
    return isnan(e[0]) ? has(material, AUR_MTL_EMISSION) : e[0] + e[1] + e[2] > 0.0;
}

void aur_mesh_material_add_emitter(const aur_mtl_material *material, aur_nodes *nodes, aur_xml_node *shape) {
    use radiance = {AUR_MTL_EMISSION, "radiance", "rgb", false, {0}};
    for (size_t i = 0; i < 3; ++i)
        radiance.factor[i] = or_else(material->emission[i], 1.0);
    add_color(nodes, aur_node_object(nodes, shape, "emitter", "area"), material, &radiance);
}
