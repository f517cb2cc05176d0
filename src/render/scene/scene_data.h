/* The contents of a loaded scene. */
#pragma once

#include "points/base/error.h"
#include "render/scene/emitter.h"
#include "render/scene/importers/xml/xml.h"
#include "render/scene/medium.h"
#include "render/scene/patches.h"
#include "render/scene/sensor.h"
#include "render/scene/shape.h"

typedef struct RTCDeviceTy *aur_embree_device;
typedef struct RTCSceneTy *aur_embree_scene;

/* Shapes that are visible only through instances of their group. */
typedef struct aur_shape_group {
    size_t count;
    uint32_t *shapes;
    double origin[3]; /* origin of its shapes' coordinates */
    aur_embree_scene accel;
} aur_shape_group;

typedef struct aur_instance {
    aur_location location;
    const aur_shape_group *group;
    aur_transform to_world, to_local; /* between coordinates relative to the two origins, after recentring */
} aur_instance;

/* How coplanar surfaces are treated (overlaps.h). */
typedef enum aur_overlap_rule {
    AUR_OVERLAPS_CUT,       /* the first one covers the others */
    AUR_OVERLAPS_OF_FRONTS, /* only surfaces that face the same way; back to back they form a sheet */
    AUR_OVERLAPS_STAY
} aur_overlap_rule;

/* The number of triangles cut, and the first pair: the covering and the covered one. */
typedef struct aur_scene_overlap {
    size_t count;
    uint32_t shapes[2], triangles[2];
} aur_scene_overlap;

/* The light that a part in the tree belongs to. */
typedef struct aur_light_part {
    uint32_t emitter, part;
} aur_light_part;

enum { AUR_FEW_LIGHTS = 16 };

/* Selection of lights for aur_light_sample_direct (light_choice.c). */
typedef struct aur_light_choice {
    aur_distribution emitters; /* 0 for lights in the tree, which is the last item */
    aur_light_tree tree;       /* lights with bounds; node_count 0: at most one such light */
    aur_light_part *parts;     /* of the tree's lights */
    float tree_probability;
    /* The items of `emitters` that have power and their sums, for choices by lanes; lit_count 0: many. */
    size_t lit_count;
    uint32_t lit[AUR_FEW_LIGHTS];
    double lit_sums[AUR_FEW_LIGHTS + 1];
    const aur_light_kernels *kernels;
} aur_light_choice;

/* A selected light. */
typedef struct aur_chosen_light {
    const aur_emitter *emitter;
    uint32_t part;     /* AUR_WHOLE_LIGHT: the whole light */
    float probability; /* of the selection */
} aur_chosen_light;

struct aur_scene {
    aur_xml_document document; /* owns the file names of locations */
    char *definitions;         /* from the options, one line "define NAME=VALUE" each; NULL: none */
    size_t bsdf_count, bsdf_capacity;
    aur_bsdf **bsdfs;
    size_t texture_count, texture_capacity;
    aur_texture **textures;
    struct aur_texel_pages *texel_pages; /* pages of textures, or NULL */
    size_t volume_count, volume_capacity;
    aur_volume **volumes;
    size_t phase_count, phase_capacity;
    aur_phase **phases;
    size_t medium_count, medium_capacity;
    aur_medium **media;
    size_t shape_count, shape_capacity;
    aur_shape **shapes;
    size_t group_count, group_capacity;
    aur_shape_group **groups;
    size_t instance_count, instance_capacity;
    aur_instance **instances;
    size_t emitter_count, emitter_capacity;
    aur_emitter **emitters;
    aur_distribution lights; /* emitters by power */
    aur_light_choice choice; /* for sampling a point on a light from a reference */
    size_t environment_count, environment_capacity;
    const aur_emitter **environments; /* those whose radiance_from applies to rays that hit nothing */
    double middle[3];                 /* of everything but the stage's ground, in the world */
    bool has_ground, has_background;
    float background[3]; /* RGB radiance seen by camera rays that hit nothing, instead of the environments' */
    bool has_sensor, has_integrator;
    aur_sensor sensor;
    size_t part_count, part_capacity;
    aur_sensor **parts; /* the cameras of a batch */
    aur_filter filter;
    aur_film_settings film;
    char *sampler;
    size_t samples_per_pixel;
    aur_parameters integrator;
    bool has_nested_integrator;
    aur_parameters nested_integrator; /* the nested integrator, as for `aov` */
    aur_embree_device device;
    aur_embree_scene accel;
    size_t packet_size; /* 16, 8, 4 or 0: aur_embree_packet_size */
    double origin[3];   /* of the coordinates below, and of shapes, lights and cameras */
    bool stores_points; /* keep mesh points in doubles */
    aur_overlap_rule overlap_rule;
    aur_scene_overlap overlap;
    aur_vector lower, upper;
    aur_vector center; /* of a bounding sphere of the scene */
    float radius;
};

/* As aur_scene_load or, with data, aur_scene_load_memory; but meshes keep their points in doubles, and
 * overlaps cause no warning. */
AUR_INTERNAL aur_result aur_scene_load_with_points(const char *path, size_t bytes, const char *data,
                                                   aur_overlap_rule rule, const aur_scene_options *options,
                                                   aur_scene **scene, aur_error *error);
/* Builds the objects of the document into the empty scene (loader.c). */
aur_result aur_scene_build(aur_scene *scene, const aur_scene_options *options, aur_error *error);
/* The text for scene->definitions; NULL if out of memory (contents.c). */
char *aur_definitions_text(const aur_scene_options *options);
/* One warning, with a count, per flaw of polygons and of each file's faces (flaws.c). */
void aur_scene_warn_of_faces(const aur_scene *scene, const aur_warnings *warnings);
/* Chooses the origins of the scene and of groups, and converts all coordinates; warns of shapes that are too
 * small for their distance from it (recenter.c). */
aur_result aur_scene_recenter(aur_scene *scene, const aur_warnings *warnings, aur_error *error);
/* Initialises scene->choice, and `probability` and `first_leaf` of emitters, which must be prepared. Errors:
 * MEMORY. */
aur_result aur_light_choice_create(aur_scene *scene, aur_error *error);
void aur_light_choice_release(aur_light_choice *choice);
/* The light selected by u[0], which becomes the remainder. False: none reaches the reference. */
bool aur_light_choose(const aur_scene *scene, const aur_light_reference *reference, float u[3],
                      aur_chosen_light *chosen);
/* The same for lanes, whose light and numbers it sets: the remainder, u and v. Returns the lanes that have a
 * light. `choice` is read only if aur_light_chooses. */
uint32_t aur_light_choose_lanes(const aur_scene *scene, uint32_t lanes,
                                const aur_light_references *references, const float *choice, const float *u,
                                const float *v, aur_chosen_light chosen[AUR_PACKET_SIZE],
                                float numbers[AUR_PACKET_SIZE][3]);
/* The probability of selecting the light of a surface, at a reference. */
float aur_light_choice_probability(const aur_scene *scene, const aur_light_reference *reference,
                                   const aur_surface *surface);
/* Samples the chosen light by the numbers that aur_light_choose left in u. */
bool aur_light_sample_chosen(const aur_scene *scene, const aur_chosen_light *chosen,
                             const aur_light_reference *reference, const float u[3],
                             aur_light_sample *sample);

/* Passes the shapes to Embree (render/trace/accel.c). */
aur_result aur_scene_build_accel(aur_scene *scene, size_t threads, aur_error *error);
void aur_scene_release_accel(aur_scene *scene);
