/* The walk from the tree of elements to the objects of a scene, and what builds an object of each kind. */
#pragma once

#include "points/base/keys.h"
#include "points/base/parameters.h"
#include "render/image/format.h"
#include "render/scene/importers/xml/xml.h"
#include "render/scene/scene_data.h"

typedef struct aur_loader aur_loader;

/* Builds the object that the loader's `node` is; `parameters` holds its properties and nested objects. */
typedef aur_result aur_object_builder(aur_loader *self, aur_parameters *parameters, void **object);

typedef struct aur_object_kind {
    const char *tag;
    aur_object_builder *build;
    const aur_table *table; /* of its types; NULL: integrators are built later */
} aur_object_kind;

struct aur_loader {
    aur_scene *scene;
    const aur_warnings *warnings;
    size_t kind_count;
    const aur_object_kind *kinds;
    const aur_bsdf *default_bsdf; /* of shapes that name none; NULL before the first */
    const aur_bsdf *black_bsdf;   /* of lights that name none; NULL before the first */
    const aur_xml_node *top;      /* the child of <scene> that is being built */
    const aur_xml_node *node;     /* the node, that one or one inside it, whose builder runs */
    bool said_unpolarized;        /* that light is, which is said once */
    aur_image *image;             /* the last image of a texture, or NULL */
    char *image_name;
    aur_location deep_integrator; /* of one inside another that holds one itself; file NULL: none */
    size_t depth;                 /* objects that are being built, each inside the one before */
    aur_error *error;
};

/* The type of a <shape> whose inner shapes become no parameters: it goes through them itself. */
#define AUR_GROUP_PLUGIN "shapegroup"

/* The kind that a tag stands for, or NULL. */
const aur_object_kind *aur_loader_find_kind(const aur_loader *self, const char *tag);
/* Builds the object of a node, unless it has been built. */
aur_result aur_loader_build(aur_loader *self, aur_xml_node *node);
/* The object that a child is or refers to; it may not be built yet. */
aur_result aur_loader_find_target(aur_loader *self, aur_xml_node *child, aur_xml_node **target);
/* The nested object that is called by its kind, or NULL when it is absent. A texture may be given any name,
 * and a number or a string too: they are refused. */
aur_result aur_loader_nested(aur_loader *self, aur_parameters *parameters, const char *kind, void **object);
/* The same for a medium, which is called by what it is for. */
aur_result aur_loader_medium(aur_loader *self, aur_parameters *parameters, const char *name, void **medium);
/* Whether a <shape> of this type is made of others: a group or an instance. */
bool aur_is_shape_of_shapes(const char *plugin);
/* Forgets the last image. */
void aur_loader_drop_image(aur_loader *self);
/* Makes room for one more pointer in one of the scene's arrays, `array` being its address. */
aur_result aur_loader_reserve(aur_loader *self, void *array, size_t count, size_t *capacity);

aur_object_builder aur_build_bsdf, aur_build_texture, aur_build_emitter, aur_build_shape;
aur_object_builder aur_build_medium, aur_build_phase, aur_build_volume;
aur_object_builder aur_build_film, aur_build_filter, aur_build_sampler, aur_build_sensor;
aur_object_builder aur_build_integrator;

/* Property elements (<float>, <rgb>, <transform>, ...) of an object's node become its parameters. */

/* Whether a tag is a property's. */
bool aur_xml_is_property(const char *tag);

/* Adds the property that the node is. */
aur_result aur_loader_add_property(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters);

/* <transform> elements. */

/* Adds the transform that a node's steps make, one after another. */
aur_result aur_xml_add_transform(const aur_xml_node *node, aur_parameters *parameters, aur_error *error);

/* Reads three numbers from `value`, or from x, y, z; those that are not given become `missing`. */
aur_result aur_xml_read_triple(const aur_xml_node *node, double missing, double triple[3], aur_error *error);

/* Names of Mitsuba's parameters that do nothing here. */

/* A row for each kind of object, with the names that are ignored where a type of that kind does not read
 * them. A help text that begins with "of no effect" is a warning, too. */
extern const aur_table aur_ignored_table;

/* Marks what is ignored of an object's parameters as read, whatever its value is, unless `reader` has a key
 * of that name; NULL: nothing is known to read them. */
void aur_parameters_ignore(aur_parameters *parameters, const aur_row *reader, const aur_warnings *warnings);

/* Plugins of Mitsuba's that are refused by name: a row for each kind, a key for each type, whose help is the
 * reason. */
extern const aur_table aur_refused_table;

/* Errors: UNSUPPORTED, with the reason, where the parameters' plugin is one of these. */
aur_result aur_parameters_refuse(const aur_parameters *parameters, aur_error *error);

/* Rewrites forms that other elements express, in the node and all below it. */
aur_result aur_loader_rewrite(aur_nodes *nodes, aur_xml_node *node);
