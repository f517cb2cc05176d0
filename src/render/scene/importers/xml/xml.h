/* Reads a scene's XML files into one tree: includes are spliced in, $names substituted, legacy names renamed.
 *
 * Rules (as Mitsuba 3's parser has them): `version` stands on the root; <default> gives a value unless -D
 * does; $name is replaced in every attribute, the longest name first, and \$ is a dollar; <include> goes 15
 * deep and is looked for beside the including file; <path> adds a folder; <alias> gives an object a second
 * id. */
#pragma once

#include <aureole-render/scene.h>
#include <stdbool.h>
#include <time.h>

#include "render/scene/importers/model/model.h"
#include "render/scene/importers/nodes/node.h"

/* A file that was read: what it is called where it is named, where it was found, and a hash of its bytes, if
 * it was known at once; else when it was changed last, as known before it was read. */
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
    bool from_radiance;          /* a file of Radiance's is among the scene's: +z is up */
    aur_model_files model_files; /* in memory: parts of models */
    aur_model_stage stage;
    size_t file_count, file_capacity;
    char *confines;      /* the folder that files must lie in, without links; NULL: anywhere */
    aur_xml_file *files; /* the scene's own, and those of aur_xml_find_asset as often as they are named */
    /* The last thing that is known not to be read, for which the scene must be refused when all others have
     * been found; they have been warned of. */
    aur_error left_out;
} aur_xml_document;

/* From the file at `path`, or from `data`, where it is given. On failure *document needs no release. */
aur_result aur_xml_read(const char *path, size_t bytes, const char *data, const aur_scene_options *options,
                        aur_xml_document *document, aur_error *error);
void aur_xml_release(aur_xml_document *document);

/* NULL when there is none. */
aur_xml_id *aur_xml_find_id(const aur_xml_document *document, const char *id);

/* Sorts the ids, and gives each alias the object that it stands for, when all files are read. Errors: FORMAT
 * for an id that is given twice, NAME for an alias of none. */
aur_result aur_xml_settle_ids(const aur_xml_document *document, aur_error *error);

/* The path of a regular file under which an asset named in `location.file` can be read: beside that file,
 * beside the scene, in a <path>, or in the working folder. `found` is allocated with malloc. The error names
 * the places; where one of them has a text HOW-TO-MAKE beside the missing file, it quotes its first line, the
 * command that makes the file. */
aur_result aur_xml_find_asset(aur_xml_document *document, aur_location location, const char *name,
                              char **found, aur_error *error);
/* The name under which a file is there that `name` means: itself; the same in other letter case; or what
 * stands after the last slash, beside the file that names it, for paths of another machine. *used is
 * malloc'ed, and NULL where there is none. Errors: MEMORY. */
aur_result aur_xml_forgive_name(const aur_xml_document *document, aur_location location, const char *name,
                                char **used, aur_error *error);
/* From now on only files in the folder of `path` are found. */
aur_result aur_xml_confine(aur_xml_document *document, const char *path, aur_error *error);
/* Notes that a file is read. */
aur_result aur_xml_note_file(aur_xml_document *document, const char *name, const char *path,
                             aur_error *error);
/* The same for the folder of a <path>. */
aur_result aur_xml_find_folder(const aur_xml_document *document, aur_location location, const char *name,
                               char **found, aur_error *error);
/* A point set's text in which the file that it names, by file:PATH or a key `file`, is found in the same way.
 * Texts that name none are copied. */
aur_result aur_xml_find_set(aur_xml_document *document, aur_location location, const char *set, char **found,
                            aur_error *error);

/* Models as scenes, or parts of them. */

/* Whether a file is a model: by its name, unless it begins as a scene does, for XML in memory may go by the
 * name of a mesh that it is about. */
bool aur_xml_is_model(const char *path, size_t size, const char *data);
/* Whether +z of the scene points up, by what has been read so far. */
bool aur_xml_is_z_up(const aur_xml_document *document, const aur_scene_stage *stage);

/* Adds a model's elements to `parent`, and its parts to the document's model files. `included`: in a scene,
 * which has a camera and lights of its own. */
aur_result aur_xml_read_model(aur_xml_document *document, const aur_scene_options *options, bool included,
                              size_t size, const char *data, aur_nodes *nodes, aur_xml_node *parent);
