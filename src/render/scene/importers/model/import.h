/* Models read by assimp in a separate process: the program aureole-import, installed next to the library. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/child.h"
#include "render/scene/importers/model/message.h"
#include "render/scene/importers/model/model.h"
#include "render/scene/importers/model/mtl.h"
#include "render/scene/importers/nodes/node.h"

/* Files referenced by a model. They are resolved, recorded and confined like all files of a scene, with
 * tolerant matching of names. Missing files are reported in one warning per kind. */

/* Names for one warning: the first few, and the total count. */
typedef struct aur_name_list {
    size_t count;
    char text[500];
} aur_name_list;

typedef struct aur_named_files {
    const aur_model_source *source;
    aur_name_list renamed, missing;               /* missing files */
    aur_name_list missing_images, unknown_images; /* missing texture images */
} aur_named_files;

/* The bytes of a file, *data NULL if not found, and its resolved name. Both are malloc'ed, *used also after
 * errors. Errors: OPEN if access is not allowed, MEMORY. */
aur_result aur_named_read(aur_named_files *self, const char *name, char **used, size_t *size, char **data,
                          aur_error *error);
/* The same for an optional file. */
aur_result aur_named_read_part(aur_named_files *self, const char *name, char **used, size_t *size,
                               char **data, aur_error *error);
/* The name under which an image can be read, or NULL. */
aur_result aur_named_find_image(aur_named_files *self, const char *name, char **used, aur_error *error);
/* Whether the bytes are an image of a supported format; if not, reports it under this name. */
bool aur_named_is_image(aur_named_files *self, const char *name, size_t size, const char *data);
void aur_named_warn(const aur_named_files *self);

/* Errors: OPEN or FORMAT of a file that cannot or may not be read; FORMAT or MEMORY for exceeded limits;
 * CANCELLED; UNSUPPORTED if the program is not installed. */
aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                            aur_xml_node *parent);

/* Runs the protocol with a program that has started. Ends the child. */
aur_result aur_model_converse(aur_child *child, const aur_model_source *source, aur_model_files *files,
                              aur_nodes *nodes, aur_xml_node *parent);

/* Models that are a single mesh: OBJ with its materials, PLY, STL and OFF, read by the readers of shapes. */

/* Errors: FORMAT with the line; MEMORY; OPEN if access is not allowed. */
aur_result aur_model_from_mesh(const aur_model_source *source, aur_mesh_format format, aur_model_files *files,
                               aur_nodes *nodes, aur_xml_node *parent);

/* Adds what a model has no data for: integrator, sensor and film. */

/* Adds them, with the sensor from the model's camera if it has one. Settings that depend on the complete
 * scene are stored in source->stage. Errors: MEMORY. */
aur_result aur_model_surround(const aur_model_source *source, const aur_import_camera *camera,
                              aur_nodes *nodes, aur_xml_node *parent);

/* Converts mesh materials to <bsdf> elements. */

/* Replaces the names of a material's images by their resolved names; removes images that cannot be read. */
aur_result aur_mesh_material_find(aur_mtl_material *material, aur_named_files *named, aur_error *error);
/* Defaults: grey 0.6 without highlights, or the vertex colours. */
void aur_mesh_material_add(const aur_mtl_material *material, bool colored, aur_nodes *nodes,
                           aur_xml_node *shape);
/* Whether the material emits, and its <emitter>. */
bool aur_mesh_material_emits(const aur_mtl_material *material);
void aur_mesh_material_add_emitter(const aur_mtl_material *material, aur_nodes *nodes, aur_xml_node *shape);

/* Decoding of scene elements sent by aureole-import (message.h). */

/* Adds elements to `parent` from their records. False for malformed records, and if nodes->result is not
 * AUR_OK. */
bool aur_node_records_read(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data);
