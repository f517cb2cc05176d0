/* Models that are one mesh: OBJ with its materials, PLY, STL and OFF, by the readers of shapes. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/model.h"

/* Errors: FORMAT with the line, MEMORY, OPEN for a file that may not be read. */
aur_result aur_model_from_mesh(const aur_model_source *source, aur_mesh_format format, aur_model_files *files,
                               aur_nodes *nodes, aur_xml_node *parent);
