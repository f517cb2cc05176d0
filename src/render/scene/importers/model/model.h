/* Models: scenes in formats other than XML. They become elements of the tree, and files in memory: PLY meshes
 * and embedded images. OBJ, PLY, STL and OFF are read here (mesh_model.c); other formats by assimp in a
 * separate process per model (src/program/import). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include <aureole-render/scene.h>

#include "render/scene/importers/nodes/node.h"

/* A file in memory. Elements refer to file i as "*i" plus any extension. */
typedef struct aur_model_file {
    char *name; /* for messages */
    size_t size;
    char *data;
} aur_model_file;

/* Files of all models of a scene. */
typedef struct aur_model_files {
    size_t count, capacity;
    aur_model_file *items;
} aur_model_files;

/* Settings of models that depend on the complete scene. */
typedef struct aur_model_stage {
    bool alone;  /* the scene's main file is a model */
    bool framed; /* the model has a camera */
    bool z_up;
    aur_model_light light;
    aur_location location;
} aur_model_stage;

typedef struct aur_model_source {
    const char *name; /* the model's file name, without its folder */
    size_t size;
    const char *data;
    aur_model_stage *stage; /* for the scene's main file; NULL: a model within a scene */
    const double *time;     /* animation time in seconds; NULL: at rest */
    const char *variant;    /* material variant; NULL: none */
    const aur_warnings *warnings;
    aur_progress progress; /* called while the model is read; returns whether to stop */
    aur_location location;
    /* Finds a file that the model references. *path: where it can be read, or NULL if not found; *used: its
     * resolved name. Both are malloc'ed. Errors: OPEN if access is not allowed, MEMORY. */
    aur_result (*find)(void *state, const char *name, char **used, char **path, aur_error *error);
    void *state;
} aur_model_source;

/* Whether a scene file is a model, by its extension. */
bool aur_model_is_name(const char *path);

/* Adds a model's elements to `parent`, and its parts to `files`. Errors: OPEN, FORMAT, MEMORY, CANCELLED;
 * UNSUPPORTED if this build lacks the format. */
aur_result aur_model_read(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                          aur_xml_node *parent);

/* The file in memory that an element's `filename` refers to, or NULL. */
const aur_model_file *aur_model_find_file(const aur_model_files *files, const char *filename);
void aur_model_release_files(aur_model_files *files);
