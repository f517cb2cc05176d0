/* What the parts of the importer share: the scene that assimp has read, and the XML and the files that are
 * made of it. */
#pragma once

#include <assimp/scene.h>
#include <stdarg.h>
#include <stdio.h>

#include "scene/model/model.h"

/* What a node of the tree does to coordinates: row major, the last row is 0 0 0 1. */
typedef struct writer_matrix {
    double m[16];
} writer_matrix;

typedef struct writer {
    const struct aiScene *scene;
    const aur_model_source *source;
    aur_model_files *files;
    FILE *xml;
    bool is_gltf;
    unsigned first;      /* files before this model: makes ids of several models differ */
    unsigned *mesh_file; /* of each mesh: its file, or NO_FILE where there is no triangle */
    unsigned *mesh_uses; /* how many nodes have it */
    unsigned *image_file;
    bool out_of_memory, has_light, has_sensor;
    double lower[3], upper[3]; /* of all triangles in the world */
} writer;

#define NO_FILE UINT32_MAX

/* To the XML, with decimal points under every locale. */
void writer_put(writer *self, const char *format, ...) AUR_PRINTF(2, 3);
/* A text in which XML and variables see nothing of their own. */
void writer_put_escaped(writer *self, const char *text);
/* A warning about the model. */
void writer_note(const writer *self, const char *format, ...) AUR_PRINTF(2, 3);
/* Adds a file in memory and takes `data`; its number, or NO_FILE where memory is out. */
unsigned writer_add_file(writer *self, const char *kind, unsigned index, size_t size, char *data);

/* The meshes as PLY files: positions, and what they have of normals, texture coordinates and colours. */
void writer_add_meshes(writer *self);
/* <bsdf>s with the ids material-FIRST-i. */
void writer_put_materials(writer *self);
/* Whether shapes of the material shine, and the <emitter> inside of one. */
bool writer_shines(const writer *self, unsigned material);
void writer_put_emitter(writer *self, unsigned material);
/* Shapes, lights and cameras where the nodes put them; what the scene lacks of a camera and light. */
void writer_put_nodes(writer *self);

/* A number of a material, or `otherwise`. */
float writer_number(const struct aiMaterial *material, const char *key, float otherwise);
/* A colour of a material; false, and `color` as it was, where there is none. */
bool writer_color(const struct aiMaterial *material, const char *key, float color[4]);
/* Which of a mesh's texture coordinates its material uses. */
unsigned writer_uv_set(const struct aiMaterial *material);
