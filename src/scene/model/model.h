/* Models: scenes in other forms than XML, as glTF and OBJ, which the library assimp reads. A module
 * (src/assimp), which is loaded when a scene is a model, translates one into XML and into files in memory:
 * its meshes as PLY and the pictures that it holds. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "core/error.h"

/* A file in memory. The XML names file i as "*i", and any ending. */
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

typedef struct aur_model_source {
    const char *name; /* of the model's file, without its folder */
    bool alone;       /* it is the whole scene, and needs a camera and a light */
    const aur_warnings *warnings;
    aur_location location;
    /* Reads a file that the model names, or the model's own; false where there is none. `data` is malloc'ed.
     */
    bool (*read)(void *state, const char *name, size_t *size, char **data);
    void *state;
} aur_model_source;

/* What the module shows, by the name "aur_model_import". *xml is malloc'ed. Errors: FORMAT, MEMORY. */
typedef aur_result (*aur_model_import_function)(const aur_model_source *source, aur_model_files *files,
                                                char **xml, size_t *xml_size, aur_error *error);

/* Whether a scene's file is a model, by the end of its name. */
bool aur_model_is_name(const char *path);

/* Translates one. Errors: those of the module; UNSUPPORTED where this build has none. */
aur_result aur_model_to_xml(const aur_model_source *source, aur_model_files *files, char **xml,
                            size_t *xml_size, aur_error *error);

/* The file that an XML's `filename` stands for, or NULL. */
const aur_model_file *aur_model_find_file(const aur_model_files *files, const char *filename);
void aur_model_release_files(aur_model_files *files);
