/* Models by assimp, in a process of its own: the program aureole-import, which stands beside the library. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/child.h"
#include "render/scene/importers/model/message.h"
#include "render/scene/importers/model/model.h"
#include "render/scene/importers/model/mtl.h"
#include "render/scene/importers/model/named_files.h"
#include "render/scene/importers/nodes/node.h"

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

/* What a model lacks of a scene: a camera, an integrator, a film, and light. */

/* Adds a camera, the model's own or one that sees all of it, and the light that source->light asks for;
 * reports what was added. Errors: MEMORY. */
aur_result aur_model_surround(const aur_model_source *source, const aur_import_scene *scene, aur_nodes *nodes,
                              aur_xml_node *parent);

/* Materials of meshes as <bsdf>s. */

/* Replaces the names of a material's pictures by those under which they can be read, and removes the others.
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
