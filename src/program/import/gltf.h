/* What assimp leaves out of glTF: digits of nodes beyond those of floats, and the strength of emission. */
#pragma once

#include "program/import/writer.h"

typedef struct json_value gltf_node;

/* Reads the JSON of the model, which assimp has read before, if it can be read. */
void gltf_read(writer *self, const char *name);
/* The node that assimp's root stands for; NULL where that is not known. */
const gltf_node *gltf_root(const writer *self, const struct aiNode *root);
/* Child `index` of a node; all of them at the roots of the scene where assimp has put a node above these. */
const gltf_node *gltf_child(const writer *self, const gltf_node *node, size_t index);
/* Replaces what a node does to coordinates by the same in double precision. */
void gltf_refine(const gltf_node *node, double matrix[16]);
/* KHR_materials_emissive_strength of a material, or 1. */
float gltf_emissive_strength(const writer *self, unsigned material);
