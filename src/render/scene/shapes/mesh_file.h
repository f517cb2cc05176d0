/* Code shared by shapes that are read from files, mostly meshes. */
#pragma once

#include "render/scene/importers/meshes/text_scanner.h"
#include "render/scene/shape.h"

/* The whole file, terminated by a zero byte. */
typedef struct aur_shape_file {
    const char *path;
    size_t size;
    const char *data;
    char *read_path, *read_data; /* for closing; NULL: memory of a model */
} aur_shape_file;

/* Finds and reads the file of the parameter "filename", in the search path or in a model. */
aur_result aur_shape_file_open(const aur_shape_input *input, const char *filename, aur_shape_file *file,
                               aur_error *error);
void aur_shape_file_close(aur_shape_file *file);

/* A file being read. */
struct aur_mesh_file {
    aur_scanner scanner; /* at the file's first byte; `line` is for errors, 0: none */
    const char *path;
    bool face_normals, flip_v; /* as the parameters give them; the file may also request flat triangles */
    uint64_t shape_index;
    aur_error *error;
};

typedef struct aur_mesh_file_keys {
    const char *filename;
    bool face_normals, flip_v;
    double crease_angle;
    uint64_t shape_index;
} aur_mesh_file_keys;

/* Table rows shared by these shapes, for aur_mesh_file_keys. */
#define AUR_MESH_FILE_KEYS                                                                                   \
    {AUR_KEY_OF_TEXT(aur_mesh_file_keys, "filename", filename, NULL,                                         \
                     "file, relative to the scene; required")},                                              \
        {AUR_KEY_OF_BOOLEAN(aur_mesh_file_keys, "face_normals", face_normals, "false",                       \
                            "flat shading: ignore normals of the file")},                                    \
    {                                                                                                        \
        AUR_KEY_OF_REAL(aur_mesh_file_keys, "crease_angle", crease_angle, 0.0, 180.0, "180",                 \
                        "edges of more than this angle in degrees stay sharp, in files without normals")     \
    }

/* The `create` of shapes with a `read_file`. */
aur_result aur_mesh_file_create(const aur_shape_input *input, aur_shape *shape, aur_error *error);

/* A FORMAT error at the file's line. */
aur_result aur_mesh_file_fail(const aur_mesh_file *file, const char *format, ...) AUR_PRINTF(2, 3);
