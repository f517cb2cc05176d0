/* What a model lacks of a scene: a camera, an integrator, a film, and light. */
#pragma once

#include "render/scene/importers/model/message.h"
#include "render/scene/importers/model/model.h"

/* Adds a camera, the model's own or one that sees all of it, and the light that source->light asks for;
 * reports what was added. Errors: MEMORY. */
aur_result aur_model_surround(const aur_model_source *source, const aur_import_scene *scene, aur_nodes *nodes,
                              aur_xml_node *parent);
