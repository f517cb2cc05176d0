/* Materials of meshes as <bsdf>s. */
#pragma once

#include "render/scene/importers/model/mtl.h"
#include "render/scene/importers/model/named_files.h"
#include "render/scene/importers/nodes/node.h"

/* Replaces the names of a material's pictures by those under which they can be read, and removes the others.
 */
aur_result aur_mesh_material_find(aur_mtl_material *material, aur_named_files *named, aur_error *error);
/* What the file does not say is grey, 0.6, without highlights, or the colours of vertices. */
void aur_mesh_material_add(const aur_mtl_material *material, bool colored, aur_nodes *nodes,
                           aur_xml_node *shape);
/* Whether shapes of the material emit, and their <emitter>. */
bool aur_mesh_material_emits(const aur_mtl_material *material);
void aur_mesh_material_add_emitter(const aur_mtl_material *material, aur_nodes *nodes, aur_xml_node *shape);
