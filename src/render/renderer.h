/* What rooms above, and other files of this one, know of a renderer and of its renders. */
#pragma once

#include <aureole/render.h>

#include "film/checkpoint.h"

const aur_scene *aur_renderer_scene(const aur_renderer *renderer);

/* What a render with these options is of, a line "KEY VALUE" each (film/checkpoint.h). The text is allocated
 * with malloc. Errors: OPEN when a file of the scene is gone, MEMORY. */
aur_result aur_render_identify(const aur_scene *scene, const aur_render_options *options, char **identity,
                               aur_error *error);
/* NULL for a render that is not resumable. */
const char *aur_render_identity(const aur_render *render);

/* What renders, as its keys have made it. */
const struct aur_integrator *aur_render_integrator(const aur_render *render);

/* Time that the render has taken, added to that of its own, and as words of a file. */
void aur_render_add_seconds(aur_render *render, double prepare, double steps, double cpu);
enum { AUR_SECONDS_WORDS = 3 };
void aur_render_put_seconds(const aur_render *render, uint64_t words[AUR_SECONDS_WORDS]);
void aur_render_take_seconds(aur_render *render, const uint64_t words[AUR_SECONDS_WORDS]);

/* Whether a checkpoint is of one render (parts.c). Errors: ARGUMENT. */
aur_result aur_render_check_kind(const char *path, const aur_checkpoint *checkpoint, aur_error *error);
