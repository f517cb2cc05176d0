/* Declarations common to the importer: assimp's scene, and the elements and files generated from it. */
#pragma once

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "points/base/error.h"
#include "render/scene/importers/model/message.h"

/* The transform of a node: row major, the last row is 0 0 0 1. */
typedef struct writer_matrix {
    double m[16];
} writer_matrix;

typedef struct gltf_buffer {
    bool loaded;
    const char *bytes; /* NULL: it cannot be read */
    size_t size;
} gltf_buffer;

/* The model file. */
typedef struct model_file {
    const char *name;
    bool is_gltf; /* references in it are URIs */
    char *bytes;  /* replaces the system's file access, or NULL */
    size_t size;
} model_file;

typedef struct writer {
    const struct aiScene *scene;
    FILE *records; /* buffer of elements: render/scene/importers/model/message.h */
    bool is_gltf;
    bool skinned;            /* meshes with bones are in world space, not in their nodes' space */
    unsigned first;          /* index of this model's first file: makes ids of several models differ */
    unsigned files;          /* of this model, so far */
    unsigned *mesh_file;     /* per mesh: its file, or NO_FILE without triangles */
    unsigned *mesh_uses;     /* number of nodes that refer to it */
    unsigned *image_file;    /* per embedded image: its file plus 1, NO_FILE, or 0: not sent yet */
    struct json_value *gltf; /* the JSON of a glTF file, or NULL */
    const char *gltf_text;   /* the text that it was parsed from */
    size_t gltf_head;        /* of a .glb: bytes before that text, else 0 */
    size_t gltf_length;      /* of a .glb: size of that text */
    size_t *gltf_materials;  /* per material of assimp: its JSON index, or SIZE_MAX */
    const char *gltf_binary; /* of a .glb: the chunk after the JSON, or NULL */
    size_t gltf_binary_size;
    struct gltf_buffer *gltf_buffers; /* buffers of the JSON that were loaded; NULL: none yet */
    struct writer_image *image_files; /* image files that were requested */
    aur_import_camera camera;
    unsigned further_cameras;
} writer;

#define NO_FILE UINT32_MAX

/* Opens <tag type="...">, or without a type for NULL; the following elements are inside until it is closed.
 */
void writer_open(writer *self, const char *tag, const char *type);
void writer_close(writer *self);
/* Adds an attribute to the element that was just opened; numbers have decimal points in every locale. */
void writer_set(writer *self, const char *name, const char *format, ...) AUR_PRINTF(3, 4);
/* <tag name="..." value="..."/> */
void writer_property(writer *self, const char *tag, const char *name, const char *format, ...)
    AUR_PRINTF(4, 5);
/* Sends a warning about the model. */
void writer_note(const char *format, ...) AUR_PRINTF(1, 2);
/* Adds a mesh's file; returns its number. */
unsigned writer_add_mesh_file(writer *self, size_t size, const void *data);
/* The same for an image; NO_FILE if it cannot be read. */
unsigned writer_add_image_file(writer *self, size_t size, const void *data);

/* Poses nodes, morph targets and skins of the first animation at that time; without `moving`, skins and
 * targets of glTF in their rest pose. */
void writer_pose(writer *self, bool moving, double seconds);
/* Writes the meshes as PLY files: positions, and normals, texture coordinates and colors if present. */
void writer_add_meshes(writer *self);
/* Writes <bsdf>s with the ids material-FIRST-i. */
void writer_put_materials(writer *self);
/* Whether the material emits, and the <emitter> inside its shapes. */
bool writer_shines(writer *self, unsigned material);
void writer_put_emitter(writer *self, unsigned material);
/* Writes shapes, lights and the first camera with the nodes' transforms. */
void writer_put_nodes(writer *self);

/* A scalar property of a material, or `otherwise`. */
float writer_number(const struct aiMaterial *material, const char *key, float otherwise);
/* A color of a material; false, with `color` unchanged, if missing. */
bool writer_color(const struct aiMaterial *material, const char *key, float color[4]);
/* The set of a mesh's texture coordinates that its material uses. */
unsigned writer_uv_set(writer *self, const struct aiMaterial *material);

/* The importer's side of render/scene/importers/model/message.h. A failed transfer ends the program, because
 * there is no other channel for an error. */

void stream_send(aur_import_kind kind, uint32_t value, size_t size, const void *data);
/* Sends two pieces as one message. */
void stream_send_two(aur_import_kind kind, size_t head_size, const void *head, size_t size, const void *data);
/* The next message, which must be of this type. *data is malloc'ed, with a terminating zero byte; returns the
 * value. */
uint32_t stream_receive(aur_import_kind kind, size_t *size, char **data);
/* Sends an error message and ends the program. */
_Noreturn void stream_fail(aur_result result, const char *format, ...) AUR_PRINTF(2, 3);
_Noreturn void stream_fail_memory(void);

/* Files that assimp opens: the library reads them. */

/* Decodes %XX in URIs of glTF. */
void files_decode_address(char *text);
/* The callbacks of aiFileIO; UserData: the model_file. */
struct aiFile *files_open(struct aiFileIO *io, const char *name, const char *mode);
void files_close(struct aiFileIO *io, struct aiFile *file);

/* Sandbox: from here on the process may only use its socket and memory. */

/* Ends with the process `parent`. Opening or growing files, and new processes or connections, are not
 * allowed. */
void confine_self(long parent);
