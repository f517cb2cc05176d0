/* Checkpoints and parts of images, which share a format: read, resumed and merged. Their hashes are corrected
 * first. */
#include <aureole-render/render.h>

#include "render/film/film.h"
#include "words.h"

static const char *path_of(const char *kind) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-checkpoint-%ld.%s", (long)getpid(), kind);
    return path;
}

typedef struct room {
    aur_scene *scene;
    aur_renderer *renderer;
    aur_render *render;
} room;

/* A render of 4 x 4 pixels; shard `shard` of two, or all of it for 0. */
static room make_room(size_t shard) {
    static const char text[] = "<scene version='3.0.0'><shape type='sphere'><emitter type='area'/></shape>"
                               "<sensor type='perspective'><float name='fov' value='45'/></sensor></scene>";
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = "depth",
                                        .samples_per_pixel = 2,
                                        .threads = 1,
                                        .width = 4,
                                        .height = 4,
                                        .resumable = true,
                                        .shard = shard,
                                        .shard_count = shard > 0 ? 2 : 0};
    room built = {0};
    fuzz_require(aur_scene_load_memory("room.xml", strlen(text), text, NULL, &built.scene, NULL) == AUR_OK &&
                     aur_renderer_create(built.scene, &built.renderer, NULL) == AUR_OK &&
                     aur_render_create(built.renderer, &options, &built.render, NULL) == AUR_OK,
                 "no render");
    return built;
}

static void destroy_room(room *built) {
    aur_render_destroy(built->render);
    aur_renderer_destroy(built->renderer);
    aur_scene_destroy(built->scene);
}

/* The end of the header and its hash, as given by the header's counts. */
static size_t head_size(const uint8_t *bytes, size_t size) {
    size_t words = 2;
    for (size_t which = 0; which < 3; ++which) {
        if (8 * words > size)
            return size;
        const uint64_t count = fuzz_word_at(bytes + 8 * (words - 1));
        const uint64_t more = which == 0 ? count / 8 + (count % 8 != 0) : count;
        if (more > size / 8)
            return size;
        words += (size_t)more + 1;
    }
    return 8 * words <= size ? 8 * words : size;
}

static void require_error(aur_result result, const aur_error *error) {
    fuzz_require(error->result == result && error->message[0] != '\0', "a failure without a message");
    fuzz_require(result != AUR_ERROR_INTERNAL, "a failure of the wrong kind");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    uint8_t *const bytes = fuzz_copy(data, size);
    const size_t head = head_size(bytes, size);
    fuzz_correct_hash(bytes, head);
    fuzz_correct_hash(bytes + head, size - head);
    const char *const path = path_of("kept");
    fuzz_write_file(path, bytes, size);
    free(bytes);
    aur_checkpoint checkpoint;
    aur_error error = {0};
    aur_result result = aur_checkpoint_load(path, false, &checkpoint, &error);
    if (result != AUR_OK)
        require_error(result, &error);
    aur_checkpoint_release(&checkpoint);

    room built = make_room(0);
    result = aur_render_resume(built.render, path, &error);
    if (result != AUR_OK)
        require_error(result, &error);
    else
        fuzz_require(aur_render_step(built.render, 0, &error) == AUR_OK, "a render that does not go on");
    destroy_room(&built);

    aur_film *film = NULL;
    result = aur_render_merge_parts(1, &path, &film, &error);
    fuzz_require((result == AUR_OK) == (film != NULL), "a failure with a film, or none without");
    if (result != AUR_OK)
        require_error(result, &error);
    aur_film_destroy(film);
    unlink(path);
    return 0;
}

/* Before the first sample, after it, and a shard. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 2)
        return 0;
    room built = make_room(index == 2 ? 1 : 0);
    const char *const path = path_of("seed");
    fuzz_require((index == 0 || aur_render_step(built.render, index == 1 ? 1 : 0, NULL) == AUR_OK) &&
                     aur_render_save(built.render, path, NULL) == AUR_OK,
                 "no seed");
    destroy_room(&built);
    const size_t size = fuzz_read_file(path, capacity, data);
    unlink(path);
    return size;
}
