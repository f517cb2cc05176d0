/* What a render is of, as lines of text. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/words.h"
#include "render/driver/renderer.h"

/* Files that a command-line text names, such as a set's: any piece of it that is an existing file, except
 * output files. */
static aur_result write_named_files(const char *text, FILE *stream, aur_error *error) {
    static const char *const written[] = {"save=", "ply="};
    while (text != NULL && *text != '\0') {
        const size_t length = strcspn(text, ",:=()");
        char piece[AUR_ERROR_FILE_CAPACITY];
        bool output = false;
        for (size_t i = 0; i < 2; ++i)
            output = output || strncmp(text, written[i], strlen(written[i])) == 0;
        snprintf(piece, sizeof piece, "%.*s", (int)length, text);
        struct stat status;
        if (!output && length > 0 && aur_file_status(piece, &status) && S_ISREG(status.st_mode)) {
            char *data;
            size_t size;
            const aur_result result = aur_file_read(piece, SIZE_MAX / 2, &data, &size, error);
            if (result != AUR_OK)
                return result;
            fprintf(stream, "file %s %016" PRIx64 "\n", piece, aur_hash_bytes(size, data));
            free(data);
        }
        text += length + (text[length] != '\0');
        if (output) /* what is written there is not read */
            text += strcspn(text, ",)");
    }
    return AUR_OK;
}

static aur_result write_identity(const aur_scene *scene, const aur_render_options *o, FILE *stream,
                                 aur_error *error) {
    char *contents;
    aur_result result = aur_scene_contents(scene, &contents, error);
    if (result != AUR_OK)
        return result;
    char tracer[AUR_SCENE_TRACER_CAPACITY];
    aur_scene_describe_tracer(scene, sizeof tracer, tracer);
    fprintf(stream,
            "version %s\nseed %" PRIu64 "\nintegrator %s\nsampler %s\nfilter %s\nsamples_per_pixel %zu\n"
            "picture %zu x %zu\ncrop %zu,%zu,%zu,%zu\nrays %s\n",
            aur_version(), o->seed, o->integrator != NULL ? o->integrator : "of the scene", o->sampler,
            o->filter != NULL ? o->filter : "of the scene", o->samples_per_pixel, o->width, o->height,
            o->crop_x0, o->crop_x1, o->crop_y0, o->crop_y1, tracer);
    if (o->clamp != 0.0)
        fprintf(stream, "clamp %.9g\n", o->clamp);
    if (o->shard_count != 0)
        fprintf(stream, "shard %zu/%zu\n", o->shard, o->shard_count);
    fputs(contents, stream);
    free(contents);
    const char *const texts[] = {o->integrator, o->sampler};
    for (size_t i = 0; result == AUR_OK && i < 2; ++i)
        result = write_named_files(texts[i], stream, error);
    return result;
}

aur_result aur_render_identify(const aur_scene *scene, const aur_render_options *options, char **identity,
                               aur_error *error) {
    aur_render_options local = *options;
    const aur_filter *filter;
    size_t size = 0;
    *identity = NULL;
    aur_result result = aur_render_options_complete(scene, &local, &filter, error);
    if (result != AUR_OK)
        return result;
    FILE *const stream = open_memstream(identity, &size);
    if (stream == NULL)
        return aur_fail_memory(error);
    result = write_identity(scene, &local, stream, error);
    if (fclose(stream) != 0 && result == AUR_OK)
        result = aur_fail_memory(error);
    return result;
}
