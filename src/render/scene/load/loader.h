/* Traversal of the element tree, and the functions that build objects of each kind. */
#pragma once

#include "points/base/keys.h"
#include "points/base/parameters.h"
#include "render/image/format.h"
#include "render/scene/importers/xml/xml.h"
#include "render/scene/scene_data.h"

typedef struct aur_loader aur_loader;

/* Builds the object for the loader's `node`; `parameters` holds its properties and nested objects. */
typedef aur_result aur_object_builder(aur_loader *self, aur_parameters *parameters, void **object);

typedef struct aur_object_kind {
    const char *tag;
    aur_object_builder *build;
    const aur_table *table; /* table of its types; NULL: integrators are built later */
} aur_object_kind;

struct aur_loader {
    aur_scene *scene;
    const aur_warnings *warnings;
    size_t kind_count;
    const aur_object_kind *kinds;
    const aur_bsdf *default_bsdf; /* default material of shapes; NULL before the first use */
    const aur_bsdf *black_bsdf;   /* default material of lights; NULL before the first use */
    const aur_xml_node *top;      /* the child of <scene> being built */
    const aur_xml_node *node;     /* the node whose builder runs: that child or a descendant */
    bool said_unpolarized;        /* warned that light is unpolarised */
    aur_image *image;             /* the last texture image, or NULL */
    char *image_name;
    aur_location deep_integrator; /* of one nested twice or more; file NULL: none */
    size_t depth;                 /* nesting of objects being built */
    aur_error *error;
};

/* The type of a <shape> that iterates over its nested shapes itself. */
#define AUR_GROUP_PLUGIN "shapegroup"

/* The kind for a tag, or NULL. */
const aur_object_kind *aur_loader_find_kind(const aur_loader *self, const char *tag);
/* Builds the object of a node, unless it has been built. */
aur_result aur_loader_build(aur_loader *self, aur_xml_node *node);
/* The object that a child is or refers to; it may not be built yet. */
aur_result aur_loader_find_target(aur_loader *self, aur_xml_node *child, aur_xml_node **target);
/* The nested object named after its kind, or NULL if absent. A texture may be passed under any name, also
 * where a number or a string is required: these are rejected. */
aur_result aur_loader_nested(aur_loader *self, aur_parameters *parameters, const char *kind, void **object);
/* The same for a medium, which is named by its role. */
aur_result aur_loader_medium(aur_loader *self, aur_parameters *parameters, const char *name, void **medium);
/* Whether a <shape> of this type contains others: a group or an instance. */
bool aur_is_shape_of_shapes(const char *plugin);
/* Releases the cached image. */
void aur_loader_drop_image(aur_loader *self);
/* Reserves space for one more pointer in an array of the scene; `array` is the array's address. */
aur_result aur_loader_reserve(aur_loader *self, void *array, size_t count, size_t *capacity);

aur_object_builder aur_build_bsdf, aur_build_texture, aur_build_emitter, aur_build_shape;
aur_object_builder aur_build_medium, aur_build_phase, aur_build_volume;
aur_object_builder aur_build_film, aur_build_filter, aur_build_sampler, aur_build_sensor;
aur_object_builder aur_build_integrator;

/* Property elements (<float>, <rgb>, <transform>, ...) of an object's node become its parameters. */

/* Whether a tag is a property. */
bool aur_xml_is_property(const char *tag);

/* Adds the property for the node. */
aur_result aur_loader_add_property(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters);

/* <transform> elements. */

/* Adds the transform composed of a node's steps in order. */
aur_result aur_xml_add_transform(const aur_xml_node *node, aur_parameters *parameters, aur_error *error);

/* Parses three numbers from `value`, or from x, y, z; absent ones are `missing`. */
aur_result aur_xml_read_triple(const aur_xml_node *node, double missing, double triple[3], aur_error *error);

/* Parameters of Mitsuba that are ignored. */

/* A row for each kind of object, with names that are ignored unless the object's type reads them. A help text
 * that begins with "of no effect" is also a warning. */
extern const aur_table aur_ignored_table;

/* Marks ignored parameters of an object as read, whatever their values, unless `reader` has a parameter of
 * that name. NULL: the type's parameters are not available. */
void aur_parameters_ignore(aur_parameters *parameters, const aur_row *reader, const aur_warnings *warnings);

/* Plugins of Mitsuba that are rejected by name: a row for each kind and a key for each type, whose help is
 * the reason. */
extern const aur_table aur_refused_table;

/* Errors: UNSUPPORTED, with the reason, if the plugin is one of these. */
aur_result aur_parameters_refuse(const aur_parameters *parameters, aur_error *error);

/* Rewrites elements with an equivalent in other elements, in the node and its descendants. */
aur_result aur_loader_rewrite(aur_nodes *nodes, aur_xml_node *node);
