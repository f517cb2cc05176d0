/* Elements as the program aureole-import sends them (message.h). */
#pragma once

#include "render/scene/importers/nodes/node.h"

/* Adds elements to `parent` from their records. False for what are no records, and when nodes->result is not
 * AUR_OK. */
bool aur_node_records_read(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data);
