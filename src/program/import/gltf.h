/* Parts of glTF that assimp drops: node transforms in double precision, and the strength of emission. */
#pragma once

#include <assimp/material.h>
#include <stddef.h>

#include "program/import/writer.h"

typedef struct json_value gltf_node;

/* Parses the JSON of the model, if possible. */
void gltf_read(writer *self, const model_file *file);
/* Determines the JSON material of each of assimp's materials, which are in the order of their first use. */
void gltf_map_materials(writer *self, const struct aiNode *node, const gltf_node *exact);
/* The node that corresponds to assimp's root; NULL if unknown. */
const gltf_node *gltf_root(const writer *self, const struct aiNode *root);
/* Child `index` of a node; the scene's root nodes if assimp has added a node above them. */
const gltf_node *gltf_child(const writer *self, const gltf_node *node, size_t index);
/* Replaces a node's transform by the same one in double precision. */
void gltf_refine(const gltf_node *node, double matrix[16]);
/* An extension of one of assimp's materials, or NULL. */
const struct json_value *gltf_extension(const writer *self, unsigned material, const char *name);
/* The primitive of mesh `index` of a node; NULL if unknown. */
const struct json_value *gltf_primitive(const writer *self, const struct aiNode *node, const gltf_node *exact,
                                        size_t index);
/* Row major: translation times rotation (a quaternion x, y, z, w) times scale (glTF 2.0, 3.5.3). */
void gltf_matrix(const double t[3], const double q[4], const double s[3], double matrix[16]);

/* Prints notes for unsupported features; ends the program if nothing of the model can be read (extensions.c).
 */
void gltf_check_extensions(const writer *self);
/* Selects the materials of a variant in the file's bytes and in the JSON; an unknown name ends the program
 * (variants.c). */
void gltf_choose_variant(writer *self, const char *name, model_file *file);

/* Values of accessors (accessor.c). */

/* The values of an accessor with `width` components, malloc'ed; NULL if it cannot be read. */
double *gltf_accessor_read(writer *self, const struct json_value *index, size_t width, size_t *count);
/* Sets positions, normals and texture coordinates that are stored as integers, for a node and its
 * descendants. */
void gltf_refine_meshes(writer *self, const struct aiNode *node, const gltf_node *exact);
/* EXT_mesh_gpu_instancing: the transforms of the copies of the node's mesh; 0: one copy. */
size_t gltf_instances(writer *self, const gltf_node *node, double (**matrices)[16]);

/* A JSON tree, for the parts of a glTF file that assimp drops. */

typedef enum json_kind { JSON_NULL, JSON_BOOLEAN, JSON_NUMBER, JSON_TEXT, JSON_ARRAY, JSON_OBJECT } json_kind;

typedef struct json_value {
    json_kind kind;
    double number;      /* 0 or 1 for a boolean */
    const char *text;   /* \u escapes are not decoded */
    const char *name;   /* of a member, else NULL */
    const char *source; /* the position in the text */
    struct json_value *first, *next;
    size_t count;              /* items of an array or members of an object */
    struct json_value **items; /* of an array */
} json_value;

/* Parses a zero-terminated text, which is modified; NULL on a syntax error or when out of memory. The tree is
 * never freed. */
json_value *json_parse(char *text);

/* These accept NULL and return NULL or `otherwise` for missing values. */
const json_value *json_member(const json_value *object, const char *name);
const json_value *json_item(const json_value *array, size_t index);
double json_number(const json_value *value, double otherwise);
const char *json_text(const json_value *value);
size_t json_size(const json_value *value, size_t otherwise);

/* Images of materials as <texture>s. */

/* A material's texture, by assimp's type and index. */
typedef struct slot {
    enum aiTextureType type;
    unsigned index;
} slot;

/* How to convert a texture's image to a <texture>. */
typedef struct texture_use {
    slot from;
    const char *name, *channel;
    bool raw;
    float factor[3], cutoff;
} texture_use;

/* Whether a readable image exists. */
bool texture_exists(writer *self, const struct aiMaterial *material, slot from);
/* Writes an existing one as a <texture>. */
void texture_put(writer *self, const struct aiMaterial *material, const texture_use *use);
/* A scalar parameter: a channel of a texture times a number, or that number. */
void texture_put_share(writer *self, const struct aiMaterial *material, const texture_use *use);
