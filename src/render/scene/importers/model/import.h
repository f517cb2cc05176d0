/* Models by assimp, in a process of its own: the program aureole-import, which stands beside the library. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/child.h"
#include "render/scene/importers/model/message.h"
#include "render/scene/importers/model/model.h"
#include "render/scene/importers/model/mtl.h"
#include "render/scene/importers/nodes/node.h"

/* Files that a model names: they are found, noted and confined as all that a scene names, under names that
 * are forgiven. What is missing is reported in one warning a kind. */

/* Names for one warning: the first ones, and how many there are. */
typedef struct aur_name_list {
    size_t count;
    char text[500];
} aur_name_list;

typedef struct aur_named_files {
    const aur_model_source *source;
    aur_name_list renamed, missing;                   /* files */
    aur_name_list missing_pictures, unknown_pictures; /* of textures */
} aur_named_files;

/* The bytes of a file, *data NULL where there is none, and the name under which it was found. Both are
 * malloc'ed, *used also after errors. Errors: OPEN for one that may not be read, MEMORY. */
aur_result aur_named_read(aur_named_files *self, const char *name, char **used, size_t *size, char **data,
                          aur_error *error);
/* The same of one that the model can do without. */
aur_result aur_named_read_part(aur_named_files *self, const char *name, char **used, size_t *size,
                               char **data, aur_error *error);
/* The name under which an image can be read, NULL for none. */
aur_result aur_named_find_picture(aur_named_files *self, const char *name, char **used, aur_error *error);
/* Whether the bytes are an image of a known format; if not, it is reported under this name. */
bool aur_named_is_picture(aur_named_files *self, const char *name, size_t size, const char *data);
void aur_named_warn(const aur_named_files *self);

/* Errors: those of a file that cannot be read or may not be (OPEN, FORMAT), of limits that it exceeds
 * (FORMAT, MEMORY), CANCELLED, and UNSUPPORTED where the program is not there. */
aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                            aur_xml_node *parent);

/* The conversation with a program that has started. Ends the child. */
aur_result aur_model_converse(aur_child *child, const aur_model_source *source, aur_model_files *files,
                              aur_nodes *nodes, aur_xml_node *parent);

/* Models that are one mesh: OBJ with its materials, PLY, STL and OFF, by the readers of shapes. */

/* Errors: FORMAT with the line, MEMORY, OPEN for a file that may not be read. */
aur_result aur_model_from_mesh(const aur_model_source *source, aur_mesh_format format, aur_model_files *files,
                               aur_nodes *nodes, aur_xml_node *parent);

/* What a model lacks of a scene: an integrator, a sensor and a film. */

/* Adds them, the sensor by the model's camera where there is one. What is not known before all of the scene
 * is there becomes source->stage. Errors: MEMORY. */
aur_result aur_model_surround(const aur_model_source *source, const aur_import_camera *camera,
                              aur_nodes *nodes, aur_xml_node *parent);

/* Materials of meshes as <bsdf>s. */

/* Replaces the names of a material's images by those under which they can be read, and removes the others.
 */
aur_result aur_mesh_material_find(aur_mtl_material *material, aur_named_files *named, aur_error *error);
/* What the file does not say is grey, 0.6, without highlights, or the colours of vertices. */
void aur_mesh_material_add(const aur_mtl_material *material, bool colored, aur_nodes *nodes,
                           aur_xml_node *shape);
/* Whether shapes of the material emit, and their <emitter>. */
bool aur_mesh_material_emits(const aur_mtl_material *material);
void aur_mesh_material_add_emitter(const aur_mtl_material *material, aur_nodes *nodes, aur_xml_node *shape);

/* Elements as the program aureole-import sends them (message.h). */

/* Adds elements to `parent` from their records. False for what are no records, and when nodes->result is not
 * AUR_OK. */
bool aur_node_records_read(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data);
