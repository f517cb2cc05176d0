/* What rooms above, and other files of this one, know of a renderer and of its renders. */
#pragma once

#include <aureole-render/render.h>

#include "render/film/checkpoint.h"

const aur_scene *aur_renderer_scene(const aur_renderer *renderer);
struct aur_cache *aur_renderer_cache(const aur_renderer *renderer);

/* What a render with these options is of, a line "KEY VALUE" each (render/film/checkpoint.h). The text is
 * allocated with malloc. Errors: OPEN when a file of the scene is gone, MEMORY. */
aur_result aur_render_identify(const aur_scene *scene, const aur_render_options *options, char **identity,
                               aur_error *error);
/* NULL for a render that is not resumable. */
const char *aur_render_identity(const aur_render *render);

/* What renders, as its keys have made it. */
const struct aur_integrator *aur_render_integrator(const aur_render *render);

/* What the render has taken, but for what its film counts, as words of a file, and added to its own. */
enum { AUR_SPENT_WORDS = 4 };
void aur_render_put_spent(const aur_render *render, uint64_t words[AUR_SPENT_WORDS]);
void aur_render_take_spent(aur_render *render, const uint64_t words[AUR_SPENT_WORDS]);

/* Whether a checkpoint is of one render (parts.c). Errors: ARGUMENT. */
aur_result aur_render_check_kind(const char *path, const aur_checkpoint *checkpoint, aur_error *error);
