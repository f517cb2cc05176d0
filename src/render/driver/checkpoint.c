/* Checkpoint files of a render. */
#include "points/base/error.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

aur_result aur_render_save(const aur_render *render, const char *path, aur_error *error) {
    const char *const identity = aur_render_identity(render);
    if (identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "only a render with the option 'resumable' can be saved");
    uint64_t words[AUR_SPENT_WORDS];
    aur_render_put_spent(render, words);
    const aur_film *const film = aur_render_film(render);
    return aur_checkpoint_save(path, identity, AUR_SPENT_WORDS, words, 1, &film, error);
}

aur_result aur_render_resume(aur_render *render, const char *path, aur_error *error) {
    const char *const identity = aur_render_identity(render);
    if (identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "only a render with the option 'resumable' can be continued");
    aur_checkpoint checkpoint;
    aur_result result = aur_checkpoint_load(path, false, &checkpoint, error);
    if (result == AUR_OK)
        result = aur_render_check_kind(path, &checkpoint, error);
    if (result == AUR_OK)
        result = aur_identity_compare(path, checkpoint.identity, identity, NULL, error);
    if (result == AUR_OK)
        result = aur_fail_in(error, aur_render_merge(render, checkpoint.films[0], error), path);
    if (result == AUR_OK)
        aur_render_take_spent(render, checkpoint.words);
    aur_checkpoint_release(&checkpoint);
    return result;
}
