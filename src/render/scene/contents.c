/* Records the inputs of a scene, to determine whether two renders show the same scene. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/file.h"
#include "points/base/words.h"
#include "render/scene/scene_data.h"

/* Writes the stage options that replace parts of the scene. */
static void write_stage(const aur_scene_stage *stage, FILE *stream) {
    const double *const b = stage->background;
    if (stage->camera != NULL)
        fprintf(stream, "camera %s aspect %.17g\n", stage->camera, stage->aspect);
    if (stage->environment != NULL)
        fprintf(stream, "environment %s\n", stage->environment);
    if (stage->ground != AUR_SCENE_GROUND_AUTO)
        fprintf(stream, "ground %u\n", (unsigned)stage->ground);
    if (stage->has_time)
        fprintf(stream, "time %.17g\n", stage->time);
    if (stage->up != AUR_SCENE_UP_AUTO)
        fprintf(stream, "up %u\n", (unsigned)stage->up);
    if (stage->variant != NULL)
        fprintf(stream, "variant %s\n", stage->variant);
    if (stage->has_background)
        fprintf(stream, "background %.17g %.17g %.17g\n", b[0], b[1], b[2]);
    for (size_t i = 0; i < stage->placement_count; ++i) {
        const aur_scene_placement *const p = &stage->placements[i];
        fprintf(stream, "place %zu %.17g %.17g %.17g %.17g %.17g\n", p->file, p->position[0], p->position[1],
                p->position[2], p->turn, p->scale);
    }
}

char *aur_definitions_text(const aur_scene_options *options) {
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    for (size_t i = 0; stream != NULL && i < options->definition_count; ++i) {
        fprintf(stream, "define %s=", options->definitions[i].name);
        for (const char *c = options->definitions[i].value; *c != '\0'; ++c)
            fputc(*c == '\n' ? ' ' : *c, stream);
        fputc('\n', stream);
    }
    if (stream != NULL)
        write_stage(&options->stage, stream);
    return stream != NULL && fclose(stream) == 0 ? text : NULL;
}

static int compare_files(const void *a, const void *b) {
    const aur_xml_file *const x = a, *const y = b;
    const int order = strcmp(x->name, y->name);
    return order != 0 ? order : strcmp(x->path, y->path);
}

static aur_result write_file(const char *kind, const aur_xml_file *file, FILE *stream, aur_error *error) {
    uint64_t hash = file->hash;
    if (!file->hashed) {
        char *data;
        size_t size;
        const aur_result result = aur_file_read(file->path, SIZE_MAX / 2, &data, &size, error);
        if (result != AUR_OK)
            return result;
        hash = aur_hash_bytes(size, data);
        free(data);
        struct stat status;
        if (!aur_file_status(file->path, &status) || status.st_mtim.tv_sec != file->changed.tv_sec ||
            status.st_mtim.tv_nsec != file->changed.tv_nsec)
            return aur_fail_at(error, (aur_location){.file = file->path}, AUR_ERROR_OPEN,
                               "the file has changed since the scene was loaded: load it again");
    }
    fprintf(stream, "%s %s %016" PRIx64 "\n", kind, file->name, hash);
    return AUR_OK;
}

/* Files are sorted, so that each is hashed only once. */
static aur_result write_lines(const aur_scene *scene, FILE *stream, aur_error *error) {
    const aur_xml_document *const document = &scene->document;
    aur_result result = write_file("scene", &document->files[0], stream, error);
    const size_t count = document->file_count - 1;
    aur_xml_file *const files = malloc((count + 1) * sizeof *files);
    if (files == NULL)
        return aur_fail_memory(error);
    memcpy(files, document->files + 1, count * sizeof *files);
    qsort(files, count, sizeof *files, compare_files);
    for (size_t i = 0; result == AUR_OK && i < count; ++i)
        if (i == 0 || compare_files(&files[i - 1], &files[i]) != 0)
            result = write_file("file", &files[i], stream, error);
    free(files);
    if (result == AUR_OK)
        fputs(scene->definitions, stream);
    return result;
}

aur_result aur_scene_contents(const aur_scene *scene, char **lines, aur_error *error) {
    size_t size = 0;
    *lines = NULL;
    FILE *const stream = open_memstream(lines, &size);
    if (stream == NULL)
        return aur_fail_memory(error);
    aur_result result = write_lines(scene, stream, error);
    if (fclose(stream) != 0 && result == AUR_OK)
        result = aur_fail_memory(error);
    if (result != AUR_OK) {
        free(*lines);
        *lines = NULL;
    }
    return result;
}
