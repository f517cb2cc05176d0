/* All kinds of objects, and the traversal of the children of <scene>. */
#include <string.h>

#include "render/scene/load/loader.h"
#include "render/scene/load/spectrum.h"
#include "render/scene/load/stage.h"

static const aur_object_kind kinds[] = {
    {"shape", aur_build_shape, &aur_shape_table},       {"bsdf", aur_build_bsdf, &aur_bsdf_table},
    {"texture", aur_build_texture, &aur_texture_table}, {"emitter", aur_build_emitter, &aur_emitter_table},
    {"sensor", aur_build_sensor, &aur_sensor_table},    {"film", aur_build_film, &aur_film_table},
    {"rfilter", aur_build_filter, &aur_filter_table},   {"sampler", aur_build_sampler, &aur_sampler_table},
    {"integrator", aur_build_integrator, NULL},         {"medium", aur_build_medium, &aur_medium_table},
    {"phase", aur_build_phase, &aur_phase_table},       {"volume", aur_build_volume, &aur_volume_table},
};

/* Whether a child of <scene> is part of another object: it is built when that refers to it. */
static bool is_part(const aur_xml_node *node) {
    static const char *const parts[] = {"film", "rfilter", "sampler"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        if (strcmp(node->tag, parts[i]) == 0)
            return true;
    return false;
}

/* Whether it is built only if referenced: files with many materials for few objects use no memory for the
 * others or their textures. */
static bool is_built_on_demand(const aur_xml_node *node) {
    static const char *const tags[] = {"bsdf", "texture", "volume"};
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; ++i)
        if (strcmp(node->tag, tags[i]) == 0)
            return aur_xml_attribute_value(node, "id") != NULL;
    return false;
}

static aur_result build_top(aur_loader *self, aur_xml_node *node) {
    static const char *const names[] = {"integrator", "sensor",  "shape",  "bsdf",    "emitter", "texture",
                                        "film",       "default", "alias",  "include", "path",    "ref",
                                        "rfilter",    "sampler", "medium", "phase",   "volume"};
    if (is_part(node))
        return aur_xml_attribute_value(node, "id") != NULL
                   ? AUR_OK
                   : aur_xml_fail(
                         node, self->error,
                         "<%s> is not allowed here: it belongs inside a <%s>, or needs an 'id' by which "
                         "one refers to it",
                         node->tag, strcmp(node->tag, "rfilter") == 0 ? "film" : "sensor");
    if (is_built_on_demand(node))
        return AUR_OK;
    if (aur_loader_find_kind(self, node->tag) == NULL)
        return aur_xml_fail_tag(node, sizeof names / sizeof names[0], names, self->error);
    if (strcmp(node->tag, "sensor") == 0 && self->scene->has_sensor) {
        aur_warn_at(self->warnings, node->location, "a second sensor is left out");
        return AUR_OK;
    }
    self->top = node;
    return aur_loader_build(self, node);
}

/* A condition that depends on the whole scene: whether another object refers to a child of <scene>. */
static aur_result check_top(aur_loader *self, const aur_xml_node *node) {
    if (is_part(node) && node->state == AUR_XML_UNBUILT)
        aur_warn_at(self->warnings, node->location, "this <%s> is left out: no object refers to it",
                    node->tag);
    if (strcmp(node->tag, "emitter") != 0)
        return AUR_OK;
    const aur_emitter *const emitter = node->object;
    if (emitter == NULL || !emitter->descriptor->needs_shape || emitter->shape != UINT32_MAX)
        return AUR_OK;
    return aur_xml_fail(node, self->error,
                        "emitter '%s' must be inside a <shape>, or a shape must refer to it",
                        emitter->descriptor->row.name);
}

/* The table of an element's possible types, or NULL if its type is not from a table: a sampler may be a file.
 * Films and filters are checked only in the scene's sensor. Those of sensors in a `batch`, and unreferenced
 * ones at scene level, are ignored. */
static const aur_table *table_of(const aur_xml_node *node, const char *plugin, size_t depth) {
    const char *const tag = node->tag;
    const bool elsewhere = (strcmp(tag, "film") == 0 && depth != 1) ||
                           (strcmp(tag, "rfilter") == 0 && depth != 2) || strcmp(tag, "sampler") == 0 ||
                           (strcmp(tag, "shape") == 0 && aur_is_shape_of_shapes(plugin));
    if (strcmp(tag, "spectrum") == 0)
        return &aur_spectrum_table;
    for (size_t i = 0; !elsewhere && i < sizeof kinds / sizeof kinds[0]; ++i)
        if (strcmp(tag, kinds[i].tag) == 0)
            return kinds[i].table;
    return NULL;
}

/* The error for an element of unknown type. */
static aur_result check_type(const aur_xml_node *node, size_t depth, aur_error *error) {
    const char *const plugin = aur_xml_attribute_value(node, "type");
    const aur_table *const table = plugin != NULL ? table_of(node, plugin, depth) : NULL;
    if (table == NULL && (plugin == NULL || strcmp(node->tag, "subsurface") != 0))
        return AUR_OK;
    aur_parameters parameters;
    const aur_row *row;
    aur_result result = aur_parameters_init(&parameters, node->tag, plugin, node->location, error);
    if (result != AUR_OK)
        return result;
    result = aur_parameters_refuse(&parameters, error);
    if (result == AUR_OK && table != NULL)
        result = aur_table_find(table, &parameters, &row, error);
    aur_parameters_release(&parameters);
    return result;
}

/* Finds all elements of unknown type before anything is built: the last one is the error, and the others are
 * warnings before it. */
static void refuse_unknown(const aur_loader *self, const aur_xml_node *node, size_t depth, aur_error *last) {
    bool has_sensor = false;
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        const bool sensor = strcmp(child->tag, "sensor") == 0;
        if (sensor && has_sensor && depth == 0)
            continue;
        has_sensor = has_sensor || sensor;
        aur_error error = {0};
        if (check_type(child, depth, &error) != AUR_OK) {
            aur_warn_error(self->warnings, last);
            *last = error;
        }
        refuse_unknown(self, child, depth + 1, last);
    }
}

/* All children of <scene> from `node` on. */
static aur_result build_all(aur_loader *self, const aur_scene_stage *stage, aur_xml_node *node) {
    aur_result result = AUR_OK;
    for (; result == AUR_OK && node != NULL; node = node->next)
        if (!aur_stage_replaces(stage, node))
            result = build_top(self, node);
    return result;
}

/* The sensor that a view places in a scene without one. */
static aur_result add_sensor(aur_loader *self, aur_nodes *nodes, const aur_scene_stage *stage) {
    const aur_xml_node *const last = nodes->tree->root->last_child;
    aur_stage_add_sensor(nodes, stage);
    return nodes->result == AUR_OK ? build_all(self, stage, last->next) : nodes->result;
}

aur_result aur_scene_build(aur_scene *scene, const aur_scene_options *options, aur_error *error) {
    aur_loader self = {.scene = scene,
                       .warnings = &options->warnings,
                       .kind_count = sizeof kinds / sizeof kinds[0],
                       .kinds = kinds,
                       .error = error};
    scene->film = (aur_film_settings){.width = 768, .height = 576, .filter = aur_filter_find("gaussian")};
    scene->samples_per_pixel = 4;
    aur_xml_node *const root = scene->document.tree.root;
    aur_error *const left_out = &scene->document.left_out;
    aur_nodes nodes = {.tree = &scene->document.tree, .error = error};
    aur_result result = aur_loader_rewrite(&nodes, root);
    if (result != AUR_OK)
        return result;
    refuse_unknown(&self, root, 0, left_out);
    if (left_out->result != AUR_OK)
        return aur_fail_at(error, (aur_location){left_out->file, left_out->line, left_out->column},
                           left_out->result, "%s", left_out->message);
    const aur_scene_stage *const stage = &options->stage;
    result = build_all(&self, stage, root->first_child);
    if (result == AUR_OK && scene->shape_count > 0)
        result = add_sensor(&self, &nodes, stage);
    aur_xml_node *const last = root->last_child;
    if (result == AUR_OK)
        result = aur_stage_set(&self, options);
    if (result == AUR_OK)
        result = build_all(&self, &(aur_scene_stage){0}, last != NULL ? last->next : root->first_child);
    aur_loader_drop_image(&self);
    for (const aur_xml_node *node = root->first_child; result == AUR_OK && node != NULL; node = node->next)
        result = check_top(&self, node);
    if (result != AUR_OK)
        return result;
    if (scene->sampler == NULL && (scene->sampler = strdup("random")) == NULL)
        return aur_fail_memory(error);
    if (scene->has_integrator)
        return AUR_OK;
    return aur_parameters_init(&scene->integrator, "integrator", "path", root->location, error);
}
