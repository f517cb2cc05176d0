/* What the parts of the importer share: the scene that assimp has read, and the elements and the files that
 * are made of it. */
#pragma once

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "points/base/error.h"
#include "render/scene/importers/model/message.h"

/* What a node of the tree does to coordinates: row major, the last row is 0 0 0 1. */
typedef struct writer_matrix {
    double m[16];
} writer_matrix;

typedef struct gltf_buffer {
    bool loaded;
    const char *bytes; /* NULL: it cannot be read */
    size_t size;
} gltf_buffer;

/* The model's own file. */
typedef struct model_file {
    const char *name;
    bool is_gltf; /* its names of others are addresses */
    char *bytes;  /* in place of those that the library has, or NULL */
    size_t size;
} model_file;

typedef struct writer {
    const struct aiScene *scene;
    FILE *records; /* of elements: render/scene/importers/model/message.h */
    bool is_gltf;
    bool skinned;        /* meshes with bones are in the world, wherever their nodes are */
    unsigned first;      /* files before this model: makes ids of several models differ */
    unsigned files;      /* of this model, so far */
    unsigned *mesh_file; /* of each mesh: its file, or NO_FILE where there is no triangle */
    unsigned *mesh_uses; /* how many nodes have it */
    unsigned
        *image_file; /* of each image that the model holds: its file plus 1, NO_FILE, or 0: not sent yet */
    struct json_value *gltf; /* the JSON of a glTF file, or NULL */
    const char *gltf_text;   /* what it was read from */
    size_t gltf_head;        /* of a .glb: the bytes before that text, else 0 */
    size_t gltf_length;      /* of a .glb: the bytes of that text */
    size_t *gltf_materials;  /* of each material of assimp: its number in the JSON, or SIZE_MAX */
    const char *gltf_binary; /* of a .glb: the chunk behind the JSON, or NULL */
    size_t gltf_binary_size;
    struct gltf_buffer *gltf_buffers; /* those of the JSON's list that were needed; NULL: none yet */
    struct writer_picture *pictures;  /* beside the model, that were asked for */
    aur_import_camera camera;
    unsigned further_cameras;
} writer;

#define NO_FILE UINT32_MAX

/* <tag type="...">, or without a type where that is NULL; what follows is inside of it until it is closed. */
void writer_open(writer *self, const char *tag, const char *type);
void writer_close(writer *self);
/* One more attribute of the element that was just opened; numbers have decimal points under every locale. */
void writer_set(writer *self, const char *name, const char *format, ...) AUR_PRINTF(3, 4);
/* <tag name="..." value="..."/> */
void writer_property(writer *self, const char *tag, const char *name, const char *format, ...)
    AUR_PRINTF(4, 5);
/* A warning about the model. */
void writer_note(const char *format, ...) AUR_PRINTF(1, 2);
/* Adds a mesh's file; its number. */
unsigned writer_add_mesh_file(writer *self, size_t size, const void *data);
/* The same of an image; NO_FILE for one that cannot be read. */
unsigned writer_add_picture_file(writer *self, size_t size, const void *data);

/* Puts nodes, morph targets and skins of the first animation where they are at that time; without `moving`,
 * skins and targets of glTF as they are at rest. */
void writer_pose(writer *self, bool moving, double seconds);
/* The meshes as PLY files: positions, and what they have of normals, texture coordinates and colours. */
void writer_add_meshes(writer *self);
/* <bsdf>s with the ids material-FIRST-i. */
void writer_put_materials(writer *self);
/* Whether shapes of the material shine, and the <emitter> inside of one. */
bool writer_shines(writer *self, unsigned material);
void writer_put_emitter(writer *self, unsigned material);
/* Shapes, lights and the first camera, where the nodes put them. */
void writer_put_nodes(writer *self);

/* A number of a material, or `otherwise`. */
float writer_number(const struct aiMaterial *material, const char *key, float otherwise);
/* A colour of a material; false, and `color` as it was, where there is none. */
bool writer_color(const struct aiMaterial *material, const char *key, float color[4]);
/* Which of a mesh's texture coordinates its material uses. */
unsigned writer_uv_set(writer *self, const struct aiMaterial *material);

/* The program's side of render/scene/importers/model/message.h. What cannot be sent or received ends the
 * program: nobody is there to be told. */

void stream_send(aur_import_kind kind, uint32_t value, size_t size, const void *data);
/* In two pieces, one after the other. */
void stream_send_two(aur_import_kind kind, size_t head_size, const void *head, size_t size, const void *data);
/* The next message, of this kind. *data is malloc'ed, with a zero byte after it; returns the value. */
uint32_t stream_receive(aur_import_kind kind, size_t *size, char **data);
/* Sends what has gone wrong, and ends the program. */
_Noreturn void stream_fail(aur_result result, const char *format, ...) AUR_PRINTF(2, 3);
_Noreturn void stream_fail_memory(void);

/* Files that assimp opens: the library reads them. */

/* Replaces %XX by the bytes that are meant, in names of glTF. */
void files_decode_address(char *text);
/* As aiFileIO has them; UserData: the model_file. */
struct aiFile *files_open(struct aiFileIO *io, const char *name, const char *mode);
void files_close(struct aiFileIO *io, struct aiFile *file);

/* What the process may do from here on: read and write its socket, and take memory. */

/* Ends with the process `parent`. No file can be opened or grow, and no process or connection made. */
void confine_self(long parent);
