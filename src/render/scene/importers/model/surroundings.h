/* What a model lacks of a scene: a camera, an integrator, a film, and light. */
#pragma once

#include <stdio.h>

#include "render/scene/importers/model/message.h"
#include "render/scene/importers/model/model.h"

/* Writes the XML of a camera, the model's own or one that sees all of it, and of the light that
 * source->light asks for; reports what was added. */
void aur_model_surround(const aur_model_source *source, const aur_import_scene *scene, FILE *xml);
