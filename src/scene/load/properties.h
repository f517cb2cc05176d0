/* Property elements (<float>, <rgb>, <transform>, ...) of an object's node become its parameters. */
#pragma once

#include "core/parameters.h"
#include "scene/xml/xml.h"

/* Whether a tag is a property's. */
bool aur_xml_is_property(const char *tag);

/* Adds the property that the node is. */
aur_result aur_xml_add_property(const aur_xml_node *node, aur_parameters *parameters, aur_error *error);

/* An error for a tag that is none of the `count` known here. */
aur_result aur_xml_fail_tag(const aur_xml_node *node, size_t count, const char *const *names,
                            aur_error *error);
