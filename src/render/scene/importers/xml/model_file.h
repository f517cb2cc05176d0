/* Models as scenes, or parts of them. */
#pragma once

#include "render/scene/importers/xml/xml.h"

/* Whether a file is a model: by its name, unless it begins as a scene does, for XML in memory may go by the
 * name of a mesh that it is about. */
bool aur_xml_is_model(const char *path, size_t size, const char *data);

/* Adds a model's elements to `parent`, and its parts to the document's model files. `included`: in a scene,
 * which has a camera and lights of its own. */
aur_result aur_xml_read_model(aur_xml_document *document, const aur_scene_options *options, bool included,
                              size_t size, const char *data, aur_nodes *nodes, aur_xml_node *parent);
