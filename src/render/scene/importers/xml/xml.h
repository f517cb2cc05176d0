/* Reads a scene's XML files into one tree: includes are spliced in, $names substituted, legacy names renamed.
 *
 * Rules, as in Mitsuba 3's parser: `version` is on the root; <default> gives a value unless -D does; $name is
 * replaced in every attribute, the longest name first, and \$ is a dollar. <include> nests up to 15 deep and
 * is searched from the including file; <path> adds a folder; <alias> gives an object a second id. */
#pragma once

#include <aureole-render/scene.h>
#include <stdbool.h>
#include <time.h>

#include "render/scene/importers/model/model.h"
#include "render/scene/importers/nodes/node.h"

/* A file that was read: its name in the scene, its path, and a hash of its bytes if available. Otherwise its
 * modification time before it was read. */
typedef struct aur_xml_file {
    const char *name, *path;
    struct timespec changed;
    bool hashed;
    uint64_t hash;
} aur_xml_file;

typedef struct aur_xml_document {
    aur_xml_tree tree;
    size_t folder_count, folder_capacity;
    const char **folders;        /* of <path> */
    bool from_radiance;          /* the scene includes a Radiance file: +z is up */
    aur_model_files model_files; /* files in memory: parts of models */
    aur_model_stage stage;
    size_t file_count, file_capacity;
    char *confines;      /* the folder that files are confined to, with links resolved; NULL: anywhere */
    aur_xml_file *files; /* the main file, and those of aur_xml_find_asset, once per reference */
    /* The last unsupported element found. The scene is refused after all have been found; earlier ones have
     * been reported as warnings. */
    aur_error left_out;
} aur_xml_document;

/* Reads the file at `path`, or `data` if not NULL. On failure *document needs no release. */
aur_result aur_xml_read(const char *path, size_t bytes, const char *data, const aur_scene_options *options,
                        aur_xml_document *document, aur_error *error);
void aur_xml_release(aur_xml_document *document);

/* NULL if there is none. */
aur_xml_id *aur_xml_find_id(const aur_xml_document *document, const char *id);

/* Sorts the ids and resolves aliases, after all files are read. Errors: FORMAT for a duplicate id, NAME for
 * an alias of an undefined id. */
aur_result aur_xml_settle_ids(const aur_xml_document *document, aur_error *error);

/* The path of a regular file for an asset named in `location.file`, searched in that file's folder, the
 * scene's folder, each <path> and the working folder. `found` is malloc'ed. The error lists the searched
 * folders. If one has a text HOW-TO-MAKE for the missing file, the error quotes its first line, the command
 * that generates the file. */
aur_result aur_xml_find_asset(aur_xml_document *document, aur_location location, const char *name,
                              char **found, aur_error *error);
/* The existing file name that matches `name`: itself; the same up to letter case; or, for paths of another
 * machine, the part after the last slash, in the folder of the referencing file. *used is malloc'ed, and NULL
 * if there is none. Errors: MEMORY. */
aur_result aur_xml_forgive_name(const aur_xml_document *document, aur_location location, const char *name,
                                char **used, aur_error *error);
/* Confines all later files to the folder of `path`. */
aur_result aur_xml_confine(aur_xml_document *document, const char *path, aur_error *error);
/* Records that a file is read. */
aur_result aur_xml_note_file(aur_xml_document *document, const char *name, const char *path,
                             aur_error *error);
/* The same for the folder of a <path>. */
aur_result aur_xml_find_folder(const aur_xml_document *document, aur_location location, const char *name,
                               char **found, aur_error *error);
/* A point set's text with the file it references, by file:PATH or a key `file`, resolved in the same way.
 * Other texts are copied. */
aur_result aur_xml_find_set(aur_xml_document *document, aur_location location, const char *set, char **found,
                            aur_error *error);

/* Models as scenes, or as parts of scenes. */

/* Whether a file is a model: by its extension, unless its content begins as a scene. XML in memory may be
 * named after a mesh. */
bool aur_xml_is_model(const char *path, size_t size, const char *data);
/* Whether +z is up, judging by what has been read so far. */
bool aur_xml_is_z_up(const aur_xml_document *document, const aur_scene_stage *stage);

/* Adds a model's elements to `parent`, and its parts to the document's model files. `included`: within a
 * scene that has its own camera and lights. */
aur_result aur_xml_read_model(aur_xml_document *document, const aur_scene_options *options, bool included,
                              size_t size, const char *data, aur_nodes *nodes, aur_xml_node *parent);
