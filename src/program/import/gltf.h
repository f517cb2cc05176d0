/* What assimp leaves out of glTF: digits of nodes beyond those of floats, and the strength of emission. */
#pragma once

#include <assimp/material.h>
#include <stddef.h>

#include "program/import/writer.h"

typedef struct json_value gltf_node;

/* Reads the JSON of the model, if it can be read. */
void gltf_read(writer *self, const model_file *file);
/* Notes which material of the JSON each of assimp's is: those stand in the order of their first use. */
void gltf_map_materials(writer *self, const struct aiNode *node, const gltf_node *exact);
/* The node that assimp's root stands for; NULL where that is not known. */
const gltf_node *gltf_root(const writer *self, const struct aiNode *root);
/* Child `index` of a node; all of them at the roots of the scene where assimp has put a node above these. */
const gltf_node *gltf_child(const writer *self, const gltf_node *node, size_t index);
/* Replaces what a node does to coordinates by the same in double precision. */
void gltf_refine(const gltf_node *node, double matrix[16]);
/* An extension of one of assimp's materials, or NULL. */
const struct json_value *gltf_extension(const writer *self, unsigned material, const char *name);
/* The primitive that mesh `index` of a node was made of; NULL where that is not known. */
const struct json_value *gltf_primitive(const writer *self, const struct aiNode *node, const gltf_node *exact,
                                        size_t index);
/* Row major: translation times rotation (a quaternion x, y, z, w) times scale (glTF 2.0, 3.5.3). */
void gltf_matrix(const double t[3], const double q[4], const double s[3], double matrix[16]);

/* Notes what the model has that is not read; ends the program if nothing of the model can be (extensions.c).
 */
void gltf_check_extensions(const writer *self);
/* Gives primitives their materials in a variant, in the file's bytes and in the JSON; an unknown name ends
 * the program (variants.c). */
void gltf_choose_variant(writer *self, const char *name, model_file *file);

/* Numbers of accessors (accessor.c). */

/* The values of an accessor with `width` components, malloc'ed; NULL where there is none that can be read. */
double *gltf_accessor_read(writer *self, const struct json_value *index, size_t width, size_t *count);
/* Sets positions, normals and texture coordinates that are stored as integers, of a node and those below. */
void gltf_refine_meshes(writer *self, const struct aiNode *node, const gltf_node *exact);
/* EXT_mesh_gpu_instancing: what places each copy of the node's mesh; 0: it is there once. */
size_t gltf_instances(writer *self, const gltf_node *node, double (**matrices)[16]);

/* JSON as a tree: what assimp leaves out of a glTF file is looked up in it. */

typedef enum json_kind { JSON_NULL, JSON_BOOLEAN, JSON_NUMBER, JSON_TEXT, JSON_ARRAY, JSON_OBJECT } json_kind;

typedef struct json_value {
    json_kind kind;
    double number;      /* of a boolean 0 or 1 */
    const char *text;   /* with escapes of more than one letter as they are */
    const char *name;   /* of a member, else NULL */
    const char *source; /* where it begins in the text */
    struct json_value *first, *next;
    size_t count;              /* of an array's items or an object's members */
    struct json_value **items; /* of an array */
} json_value;

/* Of a text that a zero byte ends, which is changed; NULL where it is no JSON or memory is out. The tree
 * stays until the process ends. */
json_value *json_parse(char *text);

/* These take NULL and give NULL, or `otherwise`, where there is no such thing. */
const json_value *json_member(const json_value *object, const char *name);
const json_value *json_item(const json_value *array, size_t index);
double json_number(const json_value *value, double otherwise);
const char *json_text(const json_value *value);
size_t json_size(const json_value *value, size_t otherwise);

/* Images of materials as <texture>s. */

/* A material's texture, by assimp's kind and number. */
typedef struct slot {
    enum aiTextureType type;
    unsigned index;
} slot;

/* How a texture's image becomes a <texture>. */
typedef struct picture_use {
    slot from;
    const char *name, *channel;
    bool raw;
    float factor[3], cutoff;
} picture_use;

/* Whether there is one that can be read. */
bool picture_exists(writer *self, const struct aiMaterial *material, slot from);
/* As a <texture>; there must be one. */
void picture_put(writer *self, const struct aiMaterial *material, const picture_use *use);
/* A share of the surface's light: a channel of a texture times a number, or that number. */
void picture_put_share(writer *self, const struct aiMaterial *material, const picture_use *use);
