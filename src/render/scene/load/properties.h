/* Property elements (<float>, <rgb>, <transform>, ...) of an object's node become its parameters. */
#pragma once

#include "render/scene/load/loader.h"

/* Whether a tag is a property's. */
bool aur_xml_is_property(const char *tag);

/* Adds the property that the node is. */
aur_result aur_loader_add_property(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters);
