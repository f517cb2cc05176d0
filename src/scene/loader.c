/* From the tree of elements to the objects of a scene. An object is built when the walk meets it or when
 * something refers to it, whichever is first. */
#include <aureole/sphere.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "scene/properties.h"
#include "scene/scene_data.h"

/* Objects may stand in or refer to each other this deep; what they become is walked recursively. */
enum { DEEPEST_OBJECT = 100 };

typedef struct loader {
    aur_scene *scene;
    const aur_warnings *warnings;
    const aur_bsdf *default_bsdf; /* of shapes that name none */
    const aur_bsdf *black_bsdf;   /* of lights that name none */
    const aur_xml_node *top;      /* the child of <scene> that is being built */
    size_t depth;                 /* objects that are being built, each inside the one before */
    aur_error *error;
} loader;

/* Builds the object that a node is; `parameters` holds its properties and nested objects. */
typedef aur_result (*builder)(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object);

typedef struct object_kind {
    const char *tag;
    builder build;
} object_kind;

/* Shapes of these two types are no aur_shape. */
static const char *const group_plugin = "shapegroup";
static const char *const instance_plugin = "instance";

static const object_kind *find_kind(const char *tag);
static aur_result build_node(loader *self, aur_xml_node *node);

/* Appends to one of the scene's arrays of pointers. */
static aur_result append(loader *self, size_t *count, size_t *capacity, void ***items, void *item) {
    if (*count == *capacity) {
        const size_t larger_capacity = *capacity == 0 ? 16 : 2 * *capacity;
        void **const larger = realloc(*items, larger_capacity * sizeof *larger);
        if (larger == NULL)
            return aur_fail(self->error, AUR_ERROR_MEMORY, "out of memory");
        *items = larger;
        *capacity = larger_capacity;
    }
    (*items)[(*count)++] = item;
    return AUR_OK;
}

/* The name under which a nested object is asked for: textures have names, the rest are called by what they
 * are
 * ("bsdf", "bsdf2", ...). */
static aur_result nested_name(loader *self, const aur_xml_node *child, const char *tag,
                              const aur_parameters *parameters, char *name, size_t capacity) {
    const char *const given = aur_xml_attribute_value(child, "name");
    if (strcmp(tag, "texture") == 0) {
        if (given == NULL)
            return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT,
                               "a texture inside an object needs a 'name': what it is for");
        snprintf(name, capacity, "%s", given);
        return AUR_OK;
    }
    size_t count = 1;
    for (size_t i = 0; i < parameters->count; ++i)
        count += parameters->items[i].kind == AUR_PARAMETER_OBJECT &&
                 strcmp(parameters->items[i].object_kind, tag) == 0;
    if (count == 1)
        snprintf(name, capacity, "%s", tag);
    else
        snprintf(name, capacity, "%s%zu", tag, count);
    return AUR_OK;
}

static aur_result find_reference(loader *self, const aur_xml_node *node, aur_xml_node **target) {
    static const char *const names[] = {"id", "name"};
    const char *id;
    aur_result result = aur_xml_check_attributes(node, 2, names, self->error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "id", &id, self->error);
    if (result != AUR_OK)
        return result;
    const aur_xml_document *const document = &self->scene->document;
    const aur_xml_id *const known = aur_xml_find_id(document, id);
    if (known != NULL) {
        *target = known->node;
        return AUR_OK;
    }
    const char **const ids = malloc((document->id_count + 1) * sizeof *ids);
    for (size_t i = 0; ids != NULL && i < document->id_count; ++i)
        ids[i] = document->ids[i].id;
    const char *const nearest = ids != NULL ? aur_nearest_name(id, document->id_count, ids) : NULL;
    if (nearest != NULL)
        result = aur_fail_at(self->error, node->location, AUR_ERROR_NAME,
                             "there is no object with the id '%s'; did you mean '%s'?", id, nearest);
    else
        result = aur_fail_at(self->error, node->location, AUR_ERROR_NAME,
                             "there is no object with the id '%s'", id);
    free(ids);
    return result;
}

/* The object that a child is or refers to; it may not be built yet. */
static aur_result find_target(loader *self, aur_xml_node *child, aur_xml_node **target) {
    *target = child;
    if (strcmp(child->tag, "ref") == 0) {
        const aur_result result = find_reference(self, child, target);
        if (result != AUR_OK)
            return result;
    }
    if (find_kind((*target)->tag) == NULL)
        return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT, "<%s> is no object to refer to",
                           (*target)->tag);
    if ((*target)->state == AUR_XML_BUILDING)
        return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT,
                           "this refers to the object at %s:%zu:%zu, which contains it: a cycle",
                           (*target)->location.file, (*target)->location.line, (*target)->location.column);
    return AUR_OK;
}

static aur_result add_nested(loader *self, aur_xml_node *child, aur_parameters *parameters) {
    aur_xml_node *target;
    aur_result result = find_target(self, child, &target);
    if (result != AUR_OK)
        return result;
    /* A group may have a hundred thousand shapes: it goes through them itself. */
    if (strcmp(target->tag, "shape") == 0 && strcmp(parameters->plugin, group_plugin) == 0)
        return build_node(self, target);
    const object_kind *const kind = find_kind(target->tag);
    char name[96];
    result = nested_name(self, child, kind->tag, parameters, name, sizeof name);
    if (result == AUR_OK)
        result = build_node(self, target);
    return result != AUR_OK ? result
                            : aur_parameters_add_object(parameters, name, kind->tag, target->object,
                                                        child->location, self->error);
}

/* All that stands inside a node becomes parameters. */
static aur_result collect(loader *self, const aur_xml_node *node, aur_parameters *parameters) {
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        aur_result result;
        if (aur_xml_is_property(child->tag)) {
            result = aur_xml_add_property(child, parameters, self->error);
        } else if (strcmp(child->tag, "ref") == 0 || find_kind(child->tag) != NULL) {
            result = add_nested(self, child, parameters);
        } else {
            static const char *const names[] = {"integer", "float",      "boolean",  "string",    "point",
                                                "vector",  "rgb",        "spectrum", "transform", "ref",
                                                "bsdf",    "texture",    "emitter",  "film",      "rfilter",
                                                "sampler", "integrator", "sensor",   "shape"};
            result = aur_xml_fail_tag(child, sizeof names / sizeof names[0], names, self->error);
        }
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

static aur_result build_node(loader *self, aur_xml_node *node) {
    static const char *const names[] = {"type", "id", "name"};
    if (node->state == AUR_XML_BUILT)
        return AUR_OK;
    const char *type;
    aur_result result = aur_xml_check_attributes(node, 3, names, self->error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "type", &type, self->error);
    if (result != AUR_OK)
        return result;
    if (self->depth == DEEPEST_OBJECT)
        return aur_fail_at(self->error, node->location, AUR_ERROR_FORMAT,
                           "objects refer to each other in a chain of more than %d", DEEPEST_OBJECT);
    node->state = AUR_XML_BUILDING;
    aur_parameters parameters;
    result = aur_parameters_init(&parameters, node->tag, type, node->location, self->error);
    if (result != AUR_OK)
        return result;
    ++self->depth;
    result = collect(self, node, &parameters);
    --self->depth;
    if (result == AUR_OK)
        result = find_kind(node->tag)->build(self, node, &parameters, &node->object);
    aur_parameters_release(&parameters);
    node->state = AUR_XML_BUILT;
    return result;
}

static aur_result build_bsdf(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_bsdf *bsdf;
    aur_result result = aur_bsdf_create(parameters, &bsdf, self->error);
    if (result != AUR_OK)
        return result;
    result = append(self, &scene->bsdf_count, &scene->bsdf_capacity, (void ***)&scene->bsdfs, bsdf);
    if (result != AUR_OK)
        aur_bsdf_destroy(bsdf);
    *object = bsdf;
    return result;
}

/* A picture's `filename` becomes a path that opens. */
static aur_result resolve_filename(loader *self, aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (strcmp(item->name, "filename") != 0 || item->kind != AUR_PARAMETER_STRING)
            continue;
        char *path;
        const aur_result result =
            aur_xml_find_asset(&self->scene->document, item->location, item->text, &path, self->error);
        if (result != AUR_OK)
            return result;
        free(item->text);
        item->text = path;
    }
    return AUR_OK;
}

/* Sets that a scene names in files are looked for where its meshes are. */
static aur_result resolve_set(loader *self, aur_parameter *item) {
    char *set;
    const aur_result result =
        aur_xml_find_set(&self->scene->document, item->location, item->text, &set, self->error);
    if (result != AUR_OK)
        return result;
    free(item->text);
    item->text = set;
    return AUR_OK;
}

static aur_result build_texture(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_texture *texture;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = aur_texture_create(parameters, &texture, self->error);
    if (result != AUR_OK)
        return result;
    result =
        append(self, &scene->texture_count, &scene->texture_capacity, (void ***)&scene->textures, texture);
    if (result != AUR_OK)
        aur_texture_destroy(texture);
    *object = texture;
    return result;
}

static aur_result build_emitter(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_emitter *emitter;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = aur_emitter_create(parameters, &emitter, self->error);
    if (result != AUR_OK)
        return result;
    result =
        append(self, &scene->emitter_count, &scene->emitter_capacity, (void ***)&scene->emitters, emitter);
    if (result != AUR_OK) {
        aur_emitter_destroy(emitter);
        return result;
    }
    emitter->index = (uint32_t)(scene->emitter_count - 1);
    *object = emitter;
    return AUR_OK;
}

/* The nested object that is called by its kind, or NULL when it is absent. A texture may be given any name,
 * and a number or a string too: they are refused. */
static aur_result nested(loader *self, aur_parameters *parameters, const char *kind, void **object) {
    *object = NULL;
    const aur_parameter *const item = aur_parameters_find(parameters, kind);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, kind) != 0)
        return aur_fail_at(self->error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be a <%s>",
                           parameters->kind, parameters->plugin, kind, kind);
    *object = (void *)(uintptr_t)item->object;
    return AUR_OK;
}

/* What a shape without a bsdf is made of: grey, or black when it is a light. */
static aur_result default_bsdf(loader *self, bool light, const aur_bsdf **bsdf) {
    const aur_bsdf **const known = light ? &self->black_bsdf : &self->default_bsdf;
    *bsdf = *known;
    if (*known != NULL)
        return AUR_OK;
    aur_parameters parameters;
    aur_result result = aur_parameters_init(&parameters, "bsdf", "diffuse", (aur_location){0}, self->error);
    if (result != AUR_OK)
        return result;
    void *object = NULL;
    result = aur_parameters_add_text(&parameters, AUR_PARAMETER_FLOAT, "reflectance", light ? "0" : "0.5",
                                     (aur_location){0}, self->error);
    if (result == AUR_OK)
        result = build_bsdf(self, NULL, &parameters, &object);
    *bsdf = *known = object;
    aur_parameters_release(&parameters);
    return result;
}

static aur_result add_to_group(loader *self, aur_group *group, const aur_xml_node *child,
                               const aur_xml_node *target) {
    const char *const plugin = aur_xml_attribute_value(target, "type");
    aur_shape *const shape = target->object;
    if (strcmp(plugin, group_plugin) == 0 || strcmp(plugin, instance_plugin) == 0 || shape->grouped)
        return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT,
                           "a shapegroup takes shapes of its own, no instances or other groups");
    if (shape->emitter != AUR_NO_EMITTER)
        return aur_fail_at(self->error, child->location, AUR_ERROR_UNSUPPORTED,
                           "a shape in a shapegroup cannot be a light");
    shape->grouped = true;
    group->shapes[group->count++] = shape->index;
    return AUR_OK;
}

/* <shape type="shapegroup">: its shapes leave the scene and are seen through instances only. */
static aur_result build_group(loader *self, const aur_xml_node *node, aur_parameters *parameters,
                              void **object) {
    aur_scene *const scene = self->scene;
    aur_group *const group = calloc(1, sizeof *group);
    aur_result result = group != NULL ? append(self, &scene->group_count, &scene->group_capacity,
                                               (void ***)&scene->groups, group)
                                      : aur_fail(self->error, AUR_ERROR_MEMORY, "out of memory");
    if (result != AUR_OK) {
        free(group);
        return result;
    }
    size_t most = 0;
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next)
        ++most;
    group->shapes = malloc((most + 1) * sizeof *group->shapes);
    if (group->shapes == NULL)
        return aur_fail(self->error, AUR_ERROR_MEMORY, "out of memory");
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        aur_xml_node *target;
        if (aur_xml_is_property(child->tag))
            continue;
        result = find_target(self, child, &target);
        if (result == AUR_OK && strcmp(target->tag, "shape") == 0)
            result = add_to_group(self, group, child, target);
        if (result != AUR_OK)
            return result;
    }
    *object = group;
    if (group->count == 0)
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT, "a shapegroup needs a shape");
    return aur_parameters_finish(parameters, self->error);
}

static aur_result build_instance(loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_instance *const instance = calloc(1, sizeof *instance);
    aur_result result = instance != NULL ? append(self, &scene->instance_count, &scene->instance_capacity,
                                                  (void ***)&scene->instances, instance)
                                         : aur_fail(self->error, AUR_ERROR_MEMORY, "out of memory");
    if (result != AUR_OK) {
        free(instance);
        return result;
    }
    void *wanted;
    result = nested(self, parameters, "shape", &wanted);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < scene->group_count; ++i)
        if (scene->groups[i] == wanted)
            instance->group = scene->groups[i];
    if (instance->group == NULL)
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                           "shape 'instance' needs a reference to a shapegroup");
    result = aur_parameters_to_world(parameters, &instance->to_world, &instance->to_local, self->error);
    if (result != AUR_OK)
        return result;
    instance->location = parameters->location;
    *object = instance;
    return aur_parameters_finish(parameters, self->error);
}

static aur_result build_shape(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    if (strcmp(parameters->plugin, group_plugin) == 0)
        return build_group(self, node, parameters, object);
    if (strcmp(parameters->plugin, instance_plugin) == 0)
        return build_instance(self, parameters, object);
    aur_scene *const scene = self->scene;
    aur_shape *shape;
    void *found = NULL;
    aur_result result = nested(self, parameters, "emitter", &found);
    aur_emitter *const emitter = found;
    if (result == AUR_OK)
        result = nested(self, parameters, "bsdf", &found);
    const aur_bsdf *bsdf = found;
    if (result == AUR_OK && bsdf == NULL)
        result = default_bsdf(self, emitter != NULL, &bsdf);
    if (result == AUR_OK && emitter != NULL && !emitter->descriptor->needs_shape)
        result = aur_fail_at(self->error, emitter->location, AUR_ERROR_FORMAT,
                             "emitter '%s' cannot stand inside a shape", emitter->descriptor->name);
    if (result == AUR_OK && emitter != NULL && emitter->shape != UINT32_MAX)
        result = aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                             "the emitter of this shape already belongs to another one");
    if (result == AUR_OK)
        result = aur_shape_create(parameters, &scene->document, self->warnings, &shape, self->error);
    if (result != AUR_OK)
        return result;
    result = append(self, &scene->shape_count, &scene->shape_capacity, (void ***)&scene->shapes, shape);
    if (result != AUR_OK) {
        aur_shape_destroy(shape);
        return result;
    }
    shape->bsdf = bsdf;
    shape->index = (uint32_t)(scene->shape_count - 1);
    if (emitter != NULL) {
        emitter->shape = shape->index;
        shape->emitter = emitter->index;
    }
    *object = shape;
    return AUR_OK;
}

static aur_result build_filter(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    *object = &self->scene->filter;
    return aur_filter_create(parameters, &self->scene->filter, self->error);
}

/* Tells that a parameter is known and has no effect. */
static void warn_unused(loader *self, aur_parameters *parameters, const char *name, const char *why) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item != NULL)
        aur_warn_at(self->warnings, item->location, "%s '%s': '%s' has no effect: %s", parameters->kind,
                    parameters->plugin, name, why);
}

/* The part of the picture that is to be rendered. */
static aur_result read_crop(loader *self, aur_parameters *parameters, aur_film_settings *film) {
    const int64_t width = (int64_t)film->width, height = (int64_t)film->height;
    int64_t x = 0, y = 0, wide = -1, high = -1;
    aur_result result = aur_parameters_integer(parameters, "crop_offset_x", 0, 65535, &x, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_offset_y", 0, 65535, &y, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_width", 1, 65536, &wide, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_height", 1, 65536, &high, self->error);
    if (result != AUR_OK)
        return result;
    wide = wide < 0 ? width : wide;
    high = high < 0 ? height : high;
    if (x + wide > width || y + high > height)
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                           "film '%s': the crop of %lld x %lld at %lld, %lld is not inside %lld x %lld",
                           parameters->plugin, (long long)wide, (long long)high, (long long)x, (long long)y,
                           (long long)width, (long long)height);
    if (wide == width && high == height)
        return AUR_OK;
    film->crop_x0 = (size_t)x;
    film->crop_x1 = (size_t)(x + wide);
    film->crop_y0 = (size_t)y;
    film->crop_y1 = (size_t)(y + high);
    return AUR_OK;
}

static aur_result build_film(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    static const char *const films[] = {"hdrfilm", "ldrfilm"};
    aur_film_settings *const film = &self->scene->film;
    *object = film;
    if (strcmp(parameters->plugin, "ldrfilm") == 0)
        aur_warn_at(self->warnings, parameters->location,
                    "film 'ldrfilm' is read as 'hdrfilm': write to a .png file for 8 bits");
    else if (strcmp(parameters->plugin, "hdrfilm") != 0)
        return aur_fail_unknown_plugin(self->error, parameters, 2, films);
    int64_t width = (int64_t)film->width, height = (int64_t)film->height;
    aur_result result = aur_parameters_integer(parameters, "width", 1, 65536, &width, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "height", 1, 65536, &height, self->error);
    if (result != AUR_OK)
        return result;
    film->width = (size_t)width;
    film->height = (size_t)height;
    result = read_crop(self, parameters, film);
    if (result != AUR_OK)
        return result;
    void *filter;
    result = nested(self, parameters, "rfilter", &filter);
    if (result != AUR_OK)
        return result;
    if (filter != NULL)
        film->filter = filter;
    /* The output file's name says these. */
    aur_parameters_find(parameters, "file_format");
    aur_parameters_find(parameters, "pixel_format");
    aur_parameters_find(parameters, "component_format");
    warn_unused(self, parameters, "banner", "pictures carry none");
    warn_unused(self, parameters, "high_quality_edges", "all edges are");
    warn_unused(self, parameters, "sample_border", "samples are drawn by the filter");
    warn_unused(self, parameters, "compensate", "sums are exact enough");
    warn_unused(self, parameters, "gamma", "pictures are linear, PNG is sRGB");
    return aur_parameters_finish(parameters, self->error);
}

/* Samplers by other names, and the point sets that take their place. */
static const char *set_for_sampler(const char *plugin) {
    static const char *const others[][2] = {{"independent", "random"},
                                            {"stratified", "sobol"},
                                            {"multijitter", "sobol"},
                                            {"orthogonal", "sobol"},
                                            {"ldsampler", "sobol"}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        if (strcmp(others[i][0], plugin) == 0)
            return others[i][1];
    return plugin;
}

static aur_result check_set(const aur_parameters *parameters, const char *set, aur_error *error) {
    const char *names[128];
    size_t count = 0;
    for (; count < 128 && aur_set_at(count) != NULL; ++count) {
        names[count] = aur_set_at(count)->row.name;
        if (strcmp(names[count], set) == 0)
            return AUR_OK;
    }
    return strncmp(set, "file:", 5) == 0 ? AUR_OK : aur_fail_unknown_plugin(error, parameters, count, names);
}

static aur_result build_sampler(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    int64_t samples = (int64_t)scene->samples_per_pixel;
    aur_result result = aur_parameters_integer(parameters, "sample_count", 1, AUR_SAMPLES_PER_PIXEL_MAX,
                                               &samples, self->error);
    if (result != AUR_OK)
        return result;
    scene->samples_per_pixel = (size_t)samples;
    warn_unused(self, parameters, "seed", "give it on the command line");
    /* The rest are the set's own keys. */
    char text[1024];
    const char *const set = set_for_sampler(parameters->plugin);
    result = check_set(parameters, set, self->error);
    if (result != AUR_OK)
        return result;
    int used = snprintf(text, sizeof text, "%s", set);
    for (size_t i = 0, keys = 0; i < parameters->count && used < (int)sizeof text; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (item->used || item->text == NULL)
            continue;
        if (set != parameters->plugin) {
            if (strcmp(item->name, "jitter") != 0 && strcmp(item->name, "dimension") != 0 &&
                strcmp(item->name, "strength") != 0)
                break;
            aur_warn_at(self->warnings, item->location, "sampler '%s': '%s' has no effect: it is read as %s",
                        parameters->plugin, item->name, set);
        } else {
            used += snprintf(text + used, sizeof text - (size_t)used, "%c%s=%s", keys++ == 0 ? ':' : ',',
                             item->name, item->text);
        }
        item->used = true;
    }
    result = aur_parameters_finish(parameters, self->error);
    if (result != AUR_OK)
        return result;
    if (used >= (int)sizeof text)
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                           "the sampler's keys are too long");
    free(scene->sampler);
    scene->sampler = NULL;
    result = aur_xml_find_set(&scene->document, parameters->location, text, &scene->sampler, self->error);
    *object = scene->sampler;
    return result;
}

static aur_result build_sensor(loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    *object = &scene->sensor;
    /* Nested film and sampler have set the scene's own. */
    void *inner;
    aur_result result = nested(self, parameters, "film", &inner);
    if (result == AUR_OK)
        result = nested(self, parameters, "sampler", &inner);
    if (result != AUR_OK)
        return result;
    scene->has_sensor = true;
    warn_unused(self, parameters, "shutter_open", "nothing moves");
    warn_unused(self, parameters, "shutter_close", "nothing moves");
    return aur_sensor_create(parameters, &scene->sensor, self->error);
}

static aur_result build_integrator(loader *self, aur_xml_node *node, aur_parameters *parameters,
                                   void **object) {
    aur_scene *const scene = self->scene;
    const bool nested = node != self->top;
    bool *const has = nested ? &scene->has_nested_integrator : &scene->has_integrator;
    aur_parameters *const made = nested ? &scene->nested_integrator : &scene->integrator;
    *object = made;
    if (*has && nested)
        return aur_fail_at(self->error, node->location, AUR_ERROR_UNSUPPORTED,
                           "a second <integrator> inside another: one is the most");
    if (*has) {
        aur_warn_at(self->warnings, node->location, "a second integrator is left out");
        return AUR_OK;
    }
    *has = true;
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_result result = parameters->items[i].kind == AUR_PARAMETER_STRING
                                      ? resolve_set(self, &parameters->items[i])
                                      : AUR_OK;
        if (result != AUR_OK)
            return result;
    }
    return aur_parameters_copy(parameters, made, self->error);
}

static const object_kind kinds[] = {
    {"shape", build_shape},     {"bsdf", build_bsdf},       {"texture", build_texture},
    {"emitter", build_emitter}, {"sensor", build_sensor},   {"film", build_film},
    {"rfilter", build_filter},  {"sampler", build_sampler}, {"integrator", build_integrator},
};

static const object_kind *find_kind(const char *tag) {
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; ++i)
        if (strcmp(kinds[i].tag, tag) == 0)
            return &kinds[i];
    return NULL;
}

static aur_result build_top(loader *self, aur_xml_node *node) {
    static const char *const names[] = {"integrator", "sensor", "shape",   "bsdf", "emitter", "texture",
                                        "default",    "alias",  "include", "path", "ref"};
    static const char *const inner[] = {"film", "rfilter", "sampler"};
    for (size_t i = 0; i < 3; ++i)
        if (strcmp(node->tag, inner[i]) == 0)
            return aur_fail_at(self->error, node->location, AUR_ERROR_FORMAT,
                               "<%s> cannot stand here: it belongs inside a <%s>", node->tag,
                               i == 1 ? "film" : "sensor");
    if (find_kind(node->tag) == NULL)
        return aur_xml_fail_tag(node, sizeof names / sizeof names[0], names, self->error);
    if (strcmp(node->tag, "sensor") == 0 && self->scene->has_sensor) {
        aur_warn_at(self->warnings, node->location, "a second sensor is left out");
        return AUR_OK;
    }
    self->top = node;
    const aur_result result = build_node(self, node);
    if (result != AUR_OK || strcmp(node->tag, "emitter") != 0)
        return result;
    const aur_emitter *const emitter = node->object;
    if (!emitter->descriptor->needs_shape)
        return AUR_OK;
    return aur_fail_at(self->error, node->location, AUR_ERROR_FORMAT,
                       "emitter '%s' must stand inside a <shape>", emitter->descriptor->name);
}

aur_result aur_scene_build(aur_scene *scene, const aur_warnings *warnings, aur_error *error) {
    loader self = {.scene = scene, .warnings = warnings, .error = error};
    scene->film = (aur_film_settings){.width = 768, .height = 576, .filter = aur_filter_find("gaussian")};
    scene->samples_per_pixel = 4;
    aur_xml_node *const root = scene->document.root;
    for (aur_xml_node *node = root->first_child; node != NULL; node = node->next) {
        const aur_result result = build_top(&self, node);
        if (result != AUR_OK)
            return result;
    }
    if (!scene->has_sensor)
        return aur_fail_at(error, root->location, AUR_ERROR_FORMAT, "the scene has no <sensor>");
    if (scene->sampler == NULL && (scene->sampler = strdup("random")) == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (scene->has_integrator)
        return AUR_OK;
    return aur_parameters_init(&scene->integrator, "integrator", "path", root->location, error);
}
