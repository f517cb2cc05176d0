/* <transform> elements. */
#pragma once

#include "points/base/parameters.h"
#include "render/scene/importers/xml/xml.h"

/* Adds the transform that a node's steps make, one after another. */
aur_result aur_xml_add_transform(const aur_xml_node *node, aur_parameters *parameters, aur_error *error);

/* Reads three numbers from `value`, or from x, y, z; those that are not given become `missing`. */
aur_result aur_xml_read_triple(const aur_xml_node *node, double missing, double triple[3], aur_error *error);
