/* The element tree of a scene, in the vocabulary of Mitsuba's XML, for all file formats. The readers of XML
 * (xml/), Radiance (rad/) and models (model/) add nodes; the loader reads them. */
#pragma once

#include <aureole-render/scene.h>
#include <stdbool.h>

#include "points/base/array.h"
#include "points/base/error.h"

/* The $names of a scene: -D and <default>. */

typedef struct aur_xml_variable {
    const char *name, *value; /* in the arena */
    bool used;                /* referenced in the scene */
    bool defined;             /* defined by -D */
} aur_xml_variable;

typedef struct aur_xml_variables {
    aur_arena *arena; /* of the document */
    size_t count, capacity;
    aur_xml_variable *items;  /* longest names first; freed by the caller */
    size_t substituted_bytes; /* total growth of texts by substitution */
} aur_xml_variables;

/* Adds the definitions of -D. Errors: ARGUMENT, MEMORY. */
aur_result aur_xml_variables_define(aur_xml_variables *variables, const aur_scene_options *options,
                                    aur_error *error);
/* A <default>: ignored if the name already has a value. */
aur_result aur_xml_variables_default(aur_xml_variables *variables, const char *name, const char *value,
                                     aur_location location, aur_error *error);
/* The value of a variable; defines it as `otherwise` if it has none. *value is in the arena. Errors: MEMORY.
 */
aur_result aur_xml_variables_get(aur_xml_variables *variables, const char *name, const char *otherwise,
                                 aur_location location, const char **value, aur_error *error);
/* `text` with every $name replaced, in the arena. Errors: NAME for an undefined name, FORMAT if all
 * substitutions together are too long, MEMORY. */
aur_result aur_xml_variables_substitute(aur_xml_variables *variables, const char *text, aur_location location,
                                        char **result, aur_error *error);
/* An error for the first unused -D. */
aur_result aur_xml_variables_finish(const aur_xml_variables *variables, const char *file, aur_error *error);

typedef struct aur_xml_attribute {
    const char *name;
    const char *value;
} aur_xml_attribute;

typedef enum aur_xml_state { AUR_XML_UNBUILT, AUR_XML_BUILDING, AUR_XML_BUILT } aur_xml_state;

typedef struct aur_xml_node aur_xml_node;
struct aur_xml_node {
    const char *tag;
    aur_location location;
    size_t attribute_count, attribute_capacity;
    aur_xml_attribute *attributes;
    aur_xml_node *first_child, *last_child, *next;
    aur_xml_node *target; /* of a <ref> without an id: aur_node_refer */
    /* State of the loader: the object built from the node. */
    aur_xml_state state;
    void *object;
};

typedef struct aur_xml_id {
    const char *id;
    aur_xml_node *node;
    size_t order; /* in the files */
} aur_xml_id;

typedef struct aur_xml_tree {
    aur_arena arena; /* holds the nodes and all texts */
    aur_xml_node *root;
    size_t id_count, id_capacity;
    aur_xml_id *ids; /* sorted after all files are read */
} aur_xml_tree;

void aur_xml_tree_release(aur_xml_tree *tree);

/* --- reading */

/* NULL when absent. */
const char *aur_xml_attribute_value(const aur_xml_node *node, const char *name);

enum { AUR_XML_MOST_NAMES = 5 };

/* Attributes that an element may have; the first `required` ones are mandatory. */
typedef struct aur_xml_rule {
    const char *tag;
    size_t required;
    const char *names[AUR_XML_MOST_NAMES + 1]; /* NULL-terminated */
} aur_xml_rule;

/* Errors: NAME for an unexpected attribute, FORMAT for a missing one. */
aur_result aur_xml_check(const aur_xml_node *node, const aur_xml_rule *rule, aur_error *error);

/* A FORMAT error at the node. */
aur_result aur_xml_fail(const aur_xml_node *node, aur_error *error, const char *format, ...) AUR_PRINTF(3, 4);

/* An error for a tag that is not among the `count` expected ones. */
aur_result aur_xml_fail_tag(const aur_xml_node *node, size_t count, const char *const *names,
                            aur_error *error);

/* --- adding pieces, for the XML reader. NULL and false mean out of memory. */

/* A node outside of the tree, with room for attributes. `tag` must outlive the tree. */
aur_xml_node *aur_xml_node_create(aur_xml_tree *tree, const char *tag, aur_location location,
                                  size_t attribute_capacity);
void aur_xml_node_append(aur_xml_node *parent, aur_xml_node *node);
bool aur_xml_tree_add_id(aur_xml_tree *tree, const char *id, aur_xml_node *node);

/* --- adding complete elements, for importers */

/* State of an importer that adds nodes. After the first failure all functions do nothing and return NULL, and
 * NULL nodes are allowed: check `result` at the end. Tags and attribute names must outlive the tree. Values
 * are copied; $names in them are not replaced. */
typedef struct aur_nodes {
    aur_xml_tree *tree;
    aur_xml_variables *variables;
    aur_location location; /* of the next nodes; the file name must outlive the tree */
    aur_result result;
    aur_error *error;
} aur_nodes;

/* <tag> as the last child of `parent`; NULL: of the root. */
aur_xml_node *aur_node_add(aur_nodes *nodes, aur_xml_node *parent, const char *tag);
/* <tag type="..."> */
aur_xml_node *aur_node_object(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *type);
/* <tag name="..." value="..."> */
void aur_node_property(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *name,
                       const char *format, ...) AUR_PRINTF(5, 6);
/* The same with `count` numbers, printed with full double precision. */
void aur_node_numbers(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *name, size_t count,
                      const double *numbers);
/* Adds an attribute; `id` makes the node a target of <ref>. Numbers use a decimal point in every locale.
 * Errors: FORMAT for more than three attributes. */
void aur_node_set(aur_nodes *nodes, aur_xml_node *node, const char *name, const char *format, ...)
    AUR_PRINTF(4, 5);
void aur_node_set_numbers(aur_nodes *nodes, aur_xml_node *node, const char *name, size_t count,
                          const double *numbers);
/* <ref> to another node. */
void aur_node_refer(aur_nodes *nodes, aur_xml_node *parent, aur_xml_node *target);
/* The value of $name: from -D, an earlier <default>, or `otherwise`; NULL after a failure. */
const char *aur_node_variable(aur_nodes *nodes, const char *name, const char *otherwise);

/* --- transforming */

/* Appends a step to the transforms of shapes, light sources and cameras, for `first` and all following
 * siblings. Errors: MEMORY. */
void aur_nodes_transform(aur_nodes *nodes, aur_xml_node *first, const aur_scene_placement *placement,
                         bool z_up);

/* --- daylight */

/* Adds the sky and sun of options->sky as the last children of the root. `z_up` selects the default up axis.
 * Errors: ARGUMENT for an invalid model, date or location; MEMORY. */
aur_result aur_nodes_add_sky(aur_nodes *nodes, const aur_scene_sky *sky, bool z_up);
/* Adds a luminaire in the same way. Errors: MEMORY. */
aur_result aur_nodes_add_luminaire(aur_nodes *nodes, const aur_scene_luminaire *luminaire, bool z_up);
