/* Models by assimp, in a process of its own: the program aureole-import, which stands beside the library. */
#pragma once

#include "render/scene/importers/model/child.h"
#include "render/scene/importers/model/model.h"

/* Errors: those of a file that cannot be read or may not be (OPEN, FORMAT), of limits that it exceeds
 * (FORMAT, MEMORY), CANCELLED, and UNSUPPORTED where the program is not there. */
aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                            aur_xml_node *parent);

/* The conversation with a program that has started. Ends the child. */
aur_result aur_model_converse(aur_child *child, const aur_model_source *source, aur_model_files *files,
                              aur_nodes *nodes, aur_xml_node *parent);
