/* The stage: scene surroundings from options, and defaults for models without a camera or light source. */
#include "render/scene/load/stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"
#include "points/base/vector3d.h"

/* Direction of the sun in an environment "sky": degrees to the left of the camera, and elevation. With these
 * scales a white surface in the sun has radiance of about 1. */
static const double SUN_AZIMUTH = -55.0, SUN_ELEVATION = 38.0, SKY_SCALE = 3.0;
/* The ground of the sky extends to the horizon. */
static const double WIDE = 3.0, ENDLESS = 1000.0;

typedef struct stage {
    aur_loader *loader;
    const aur_scene_stage *options;
    const aur_model_stage *model;
    aur_nodes nodes;
    aur_stage_axes axes;
    double ground; /* half the ground's side over the scene's diagonal; 0: no ground */
} stage;

void aur_stage_add_sensor(aur_nodes *nodes, const aur_scene_stage *options) {
    bool has_sensor = false;
    for (const aur_xml_node *node = nodes->tree->root->first_child; node != NULL; node = node->next)
        has_sensor = has_sensor || strcmp(node->tag, "sensor") == 0;
    if (options->camera != NULL && !has_sensor && strncmp(options->camera, "-v", 2) != 0)
        aur_node_object(nodes, nodes->tree->root, "sensor", "perspective");
}

bool aur_stage_replaces(const aur_scene_stage *options, const aur_xml_node *node) {
    const char *const type = aur_xml_attribute_value(node, "type");
    if (options->environment == NULL || strcmp(node->tag, "emitter") != 0 || type == NULL)
        return false;
    for (size_t i = 0; i < aur_emitter_table.count; ++i) {
        const aur_row *const row = aur_emitter_table.rows[i];
        if (strcmp(row->name, type) == 0)
            return ((const aur_emitter_descriptor *)row)->is_far;
    }
    return false;
}

/* --- helpers */

/* Adds a file in memory (NULL: out of memory), and its name as "*i.pfm". */
static void add_file(stage *self, aur_xml_node *parent, size_t size, char *data) {
    aur_model_files *const files = &self->loader->scene->document.model_files;
    char *const name = data != NULL ? strdup("studio") : NULL;
    if (name == NULL ||
        !aur_array_reserve(&files->items, &files->capacity, files->count + 1, sizeof *files->items)) {
        free(name);
        free(data);
        self->nodes.result = aur_fail_memory(self->nodes.error);
        return;
    }
    files->items[files->count++] = (aur_model_file){name, size, data};
    aur_node_property(&self->nodes, parent, "string", "filename", "*%zu.pfm", files->count - 1);
}

/* to_world from columns; the last may be NULL: the origin. */
static void add_to_world(stage *self, aur_xml_node *parent, const double *x, const double *y, const double *z,
                         const double *position) {
    double m[16] = {[15] = 1.0};
    for (size_t d = 0; d < 3; ++d) {
        m[4 * d] = x[d];
        m[4 * d + 1] = y[d];
        m[4 * d + 2] = z[d];
        m[4 * d + 3] = position != NULL ? position[d] : 0.0;
    }
    aur_xml_node *const to_world = aur_node_add(&self->nodes, parent, "transform");
    aur_node_set(&self->nodes, to_world, "name", "to_world");
    aur_node_set_numbers(&self->nodes, aur_node_add(&self->nodes, to_world, "matrix"), "value", 16, m);
}

/* --- environments */

/* Corrects the power estimate of distant lights, which is over the whole scene's cross section. The ground
 * increases that, but not the part that shows details: without the weight, a model's luminaires would get
 * almost no samples. */
static void add_weight(stage *self, aur_xml_node *emitter) {
    const double wider = 2.0 * sqrt(2.0) * self->ground; /* scene radius with the ground over that without */
    if (wider > 1.0)
        aur_node_property(&self->nodes, emitter, "float", "sampling_weight", "%.9g", 1.0 / (wider * wider));
}

static void add_studio(stage *self) {
    size_t size = 0;
    char *const lights = aur_studio_lights(&size);
    aur_xml_node *const emitter = aur_node_object(&self->nodes, self->nodes.tree->root, "emitter", "envmap");
    add_file(self, emitter, size, lights);
    add_weight(self, emitter);
    add_to_world(self, emitter, self->axes.right, self->axes.up, self->axes.toward, NULL);
}

static aur_result add_sky(stage *self, const char *text) {
    double turbidity = 3.0;
    if (*text == ':' && (!aur_parse_double(text + 1, &turbidity) || turbidity < 1.0 || turbidity > 10.0))
        return aur_fail(self->nodes.error, AUR_ERROR_ARGUMENT,
                        "--environment: expected sky:TURBIDITY from 1 (clear) to 10 (hazy), not 'sky%s'",
                        text);
    const double a = SUN_AZIMUTH * AUR_PI / 180.0, e = SUN_ELEVATION * AUR_PI / 180.0;
    const aur_stage_axes *const axes = &self->axes;
    double sun[3], away[3];
    for (size_t d = 0; d < 3; ++d) {
        sun[d] = cos(e) * (sin(a) * axes->right[d] + cos(a) * axes->toward[d]) + sin(e) * axes->up[d];
        away[d] = -axes->toward[d];
    }
    aur_xml_node *const emitter = aur_node_object(&self->nodes, self->nodes.tree->root, "emitter", "sunsky");
    aur_node_property(&self->nodes, emitter, "float", "turbidity", "%.17g", turbidity);
    aur_node_property(&self->nodes, emitter, "float", "sky_scale", "%.17g", SKY_SCALE);
    aur_node_property(&self->nodes, emitter, "float", "sun_scale", "%.17g", SKY_SCALE);
    aur_node_numbers(&self->nodes, emitter, "vector", "sun_direction", 3, sun);
    add_weight(self, emitter);
    add_to_world(self, emitter, axes->right, away, axes->up, NULL);
    return self->nodes.result;
}

/* "sky" or "sky:TURBIDITY". */
static bool is_sky(const char *name) {
    return strncmp(name, "sky", 3) == 0 && (name[3] == '\0' || name[3] == ':');
}

/* An image file, identified by a dot in the name. */
static aur_result fail_unknown(const char *name, aur_error *error) {
    static const char *const names[] = {"studio", "sky", "sky:TURBIDITY", "none", "FILE.hdr", "FILE.exr"};
    size_t index;
    return aur_names_choose(aur_names_of(sizeof names / sizeof names[0], names), "environment", name,
                            (aur_location){.file = "--environment"}, &index, error);
}

static aur_result add_environment(stage *self, const char *name) {
    if (strcmp(name, "studio") == 0) {
        add_studio(self);
    } else if (is_sky(name)) {
        return add_sky(self, name + 3);
    } else if (strcmp(name, "none") != 0) {
        if (strpbrk(name, "./") == NULL)
            return fail_unknown(name, self->nodes.error);
        aur_xml_node *const emitter =
            aur_node_object(&self->nodes, self->nodes.tree->root, "emitter", "envmap");
        aur_node_property(&self->nodes, emitter, "string", "filename", "%s", name);
        const double *const up = self->axes.up, forward[3] = {0.0, -up[2], up[1]};
        add_to_world(self, emitter, (const double[3]){1.0, 0.0, 0.0}, up, forward, NULL);
    }
    return self->nodes.result;
}

/* --- the ground */

/* A square at the height of the lowest point, below the centre of the scene. It fades out at its edges, or
 * extends to the horizon. */
static void add_ground(stage *self, const double lower[3], const double upper[3]) {
    const bool endless = self->ground > WIDE;
    const aur_stage_axes *const axes = &self->axes;
    const size_t up = axes->up[2] > 0.5 ? 2 : 1;
    double position[3], squared = 0.0, right[3], away[3];
    for (size_t d = 0; d < 3; ++d) {
        position[d] = d == up ? lower[d] : 0.5 * lower[d] + 0.5 * upper[d];
        squared += (upper[d] - lower[d]) * (upper[d] - lower[d]);
    }
    const double half = self->ground * sqrt(squared);
    position[up] -= 1e-4 * sqrt(squared); /* below surfaces that lie flat on it, so that they stay visible */
    for (size_t d = 0; d < 3; ++d) {
        right[d] = half * axes->right[d];
        away[d] = -half * axes->toward[d];
    }
    aur_nodes *const nodes = &self->nodes;
    aur_xml_node *const shape = aur_node_object(nodes, nodes->tree->root, "shape", "rectangle");
    add_to_world(self, shape, right, away, axes->up, position);
    aur_xml_node *bsdf = shape;
    if (!endless) {
        size_t size = 0;
        char *const fade = aur_studio_fade(&size);
        bsdf = aur_node_object(nodes, shape, "bsdf", "mask");
        aur_xml_node *const opacity = aur_node_object(nodes, bsdf, "texture", "bitmap");
        aur_node_set(nodes, opacity, "name", "opacity");
        add_file(self, opacity, size, fade);
        aur_node_property(nodes, opacity, "boolean", "raw", "true");
        aur_node_property(nodes, opacity, "string", "wrap_mode", "clamp");
    }
    aur_node_property(nodes, aur_node_object(nodes, bsdf, "bsdf", "diffuse"), "rgb", "reflectance", "%.17g",
                      endless ? 0.3 : AUR_STUDIO_FLOOR);
}

/* --- decisions */

/* Whether the scene has a light source other than emitting surfaces. */
static bool has_light(const aur_scene *scene) {
    for (size_t i = 0; i < scene->emitter_count; ++i)
        if (!scene->emitters[i]->descriptor->needs_shape)
            return true;
    return false;
}

/* The environment of a model: "studio" if it has surfaces but no light source. */
static const char *environment_of(const stage *self) {
    const aur_model_stage *const model = self->model;
    const aur_scene *const scene = self->loader->scene;
    if (self->options->environment != NULL || !model->alone || model->light == AUR_MODEL_LIGHT_NONE ||
        scene->shape_count == 0)
        return self->options->environment;
    if (has_light(scene))
        return model->light == AUR_MODEL_LIGHT_ALWAYS ? "studio" : NULL;
    aur_warn_at(self->loader->warnings, model->location,
                "this model has no light source%s: it is lit as in a studio (--environment)",
                scene->emitter_count > 0 ? " but surfaces that emit" : "");
    return "studio";
}

static aur_result set_camera(stage *self) {
    aur_scene *const scene = self->loader->scene;
    const char *camera = self->options->camera;
    const bool added = camera == NULL && self->model->alone && !self->model->framed;
    /* A view of Radiance (-vp ...) has placed the sensor already. */
    if (!scene->has_sensor || (camera == NULL && !added) || (camera != NULL && strncmp(camera, "-v", 2) == 0))
        return AUR_OK;
    if (added && scene->shape_count == 0)
        return aur_fail_at(self->nodes.error, self->model->location, AUR_ERROR_FORMAT,
                           "this model has no surface");
    camera = added ? "corner" : camera;
    const double aspect = self->options->aspect > 0.0
                              ? self->options->aspect
                              : (double)scene->film.width / (double)scene->film.height;
    const aur_result result =
        aur_stage_set_camera(scene, camera, aspect, self->model->z_up, self->nodes.error);
    if (result == AUR_OK && added)
        aur_warn_at(self->loader->warnings, self->model->location,
                    "this model has no camera: it is seen from (%.9g, %.9g, %.9g) (--camera)",
                    scene->sensor.position[0], scene->sensor.position[1], scene->sensor.position[2]);
    return result;
}

static bool is_above(const aur_scene *scene, const double lower[3], const double up[3]) {
    return !scene->has_sensor || aur_dot3(scene->sensor.position, up) > aur_dot3(lower, up);
}

aur_result aur_stage_set(aur_loader *loader, const aur_scene_options *options) {
    aur_scene *const scene = loader->scene;
    aur_xml_document *const document = &scene->document;
    stage self = {.loader = loader, .options = &options->stage, .model = &document->stage};
    const bool z_up = aur_xml_is_z_up(document, &options->stage);
    self.nodes =
        (aur_nodes){.tree = &document->tree, .location = {.file = "--environment"}, .error = loader->error};
    document->stage.z_up = z_up;
    aur_result result = set_camera(&self);
    if (result != AUR_OK)
        return result;
    const char *const environment = environment_of(&self);
    const bool studio = environment != NULL && strcmp(environment, "studio") == 0;
    const bool sky = environment != NULL && is_sky(environment);
    const aur_scene_ground ground = self.options->ground;
    self.axes = aur_stage_axes_of(scene, z_up);
    double lower[3], upper[3];
    const bool there = aur_stage_bounds(scene, lower, upper);
    for (size_t d = 0; d < 3 && there; ++d)
        scene->middle[d] = 0.5 * lower[d] + 0.5 * upper[d];
    if (there && is_above(scene, lower, self.axes.up) &&
        (ground == AUR_SCENE_GROUND_SHADOW || (ground == AUR_SCENE_GROUND_AUTO && (studio || sky))))
        self.ground = sky ? ENDLESS : WIDE;
    if (environment != NULL)
        result = add_environment(&self, environment);
    scene->has_ground = result == AUR_OK && self.ground > 0.0;
    if (scene->has_ground)
        add_ground(&self, lower, upper);
    scene->has_background = self.options->has_background || studio;
    for (size_t d = 0; d < 3; ++d)
        scene->background[d] =
            self.options->has_background ? (float)self.options->background[d] : (float)AUR_STUDIO_WHITE;
    return result == AUR_OK ? self.nodes.result : result;
}
