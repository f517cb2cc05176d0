/* Models: scenes in other formats than XML. They become elements of a tree and files in memory: meshes as PLY
 * and the images that a model holds. OBJ, PLY, STL and OFF are read here (mesh_model.c), others by the
 * library assimp in a program (src/program/import) that is started for each. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include <aureole-render/scene.h>

#include "render/scene/importers/nodes/node.h"

/* A file in memory. Elements name file i as "*i", and any ending. */
typedef struct aur_model_file {
    char *name; /* for messages */
    size_t size;
    char *data;
} aur_model_file;

/* The files of all models of a scene, in one list. */
typedef struct aur_model_files {
    size_t count, capacity;
    aur_model_file *items;
} aur_model_files;

/* What models leave to be decided when all of a scene has been read. */
typedef struct aur_model_stage {
    bool alone;  /* the scene's own file is a model */
    bool framed; /* it has a camera */
    bool z_up;
    aur_model_light light;
    aur_location location;
} aur_model_stage;

typedef struct aur_model_source {
    const char *name; /* of the model's file, without its folder */
    size_t size;
    const char *data;
    aur_model_stage *stage; /* it is the scene's own file; NULL: a part of a scene */
    const double *time;     /* of its animation, seconds; NULL: at rest */
    const char *variant;    /* of its materials; NULL: none */
    const aur_warnings *warnings;
    aur_progress progress; /* asked, while the model is read, whether to stop */
    aur_location location;
    /* Finds a file that the model names. *path: where it can be read, or NULL where there is none; *used: the
     * name under which it was found. Both are malloc'ed. Errors: OPEN for one that may not be read, MEMORY.
     */
    aur_result (*find)(void *state, const char *name, char **used, char **path, aur_error *error);
    void *state;
} aur_model_source;

/* Whether a scene's file is a model, by the end of its name. */
bool aur_model_is_name(const char *path);

/* Adds a model's elements to `parent`, and its parts to `files`. Errors: OPEN, FORMAT, MEMORY, CANCELLED;
 * UNSUPPORTED where this build cannot. */
aur_result aur_model_read(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                          aur_xml_node *parent);

/* The file that an element's `filename` stands for, or NULL. */
const aur_model_file *aur_model_find_file(const aur_model_files *files, const char *filename);
void aur_model_release_files(aur_model_files *files);
