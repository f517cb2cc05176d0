/* Every format of images: by content when reading, by name when writing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <aureole/text.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "render/image/format.h"

#define FORMAT_OF(name) &aur_image_format_##name,
static const aur_image_format *const formats[] = {AUR_IMAGE_FORMATS(FORMAT_OF)};

#define ROW_OF(name) &aur_image_format_##name.row,
static const aur_row *const rows[] = {AUR_IMAGE_FORMATS(ROW_OF)};

enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

const aur_table aur_image_format_table = {
    .kind = "image", .summary = "image formats, by extension", AUR_TABLE_ROWS(rows)};

static const aur_image_format *recognize(const aur_image_source *source) {
    for (size_t i = 0; i < FORMAT_COUNT; ++i)
        if (formats[i]->recognize(source))
            return formats[i];
    return NULL;
}

const char *aur_image_format_of(size_t size, const void *data) {
    const aur_image_format *const format = recognize(&(aur_image_source){.size = size, .data = data});
    return format != NULL ? format->name : NULL;
}

aur_result aur_image_read_memory_coded(const char *name, size_t size, const void *data, aur_image **image,
                                       aur_error *error) {
    *image = NULL;
    const aur_image_source source = {.name = name, .size = size, .data = data};
    const aur_image_format *const format = recognize(&source);
    if (format == NULL) {
        char list[128];
        aur_names_list(aur_names_of_table(&aur_image_format_table), sizeof list, list);
        return aur_fail_at(error, (aur_location){.file = name}, AUR_ERROR_FORMAT,
                           size == 0 ? "is empty, not an image" : "is not a readable image: %s", list);
    }
    const aur_result result = format->read(&source, image, error);
    if (result != AUR_OK) {
        aur_image_destroy(*image);
        *image = NULL;
    }
    return aur_fail_in(error, result, name);
}

aur_result aur_image_read_coded(const char *path, aur_image **image, aur_error *error) {
    *image = NULL;
    const size_t limit = (size_t)1 << 34;
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, limit, &data, &size, error);
    if (result != AUR_OK)
        return result;
    result = aur_image_read_memory_coded(path, size, data, image, error);
    free(data);
    return result;
}

static aur_result expand(const char *name, aur_result result, aur_image **image, aur_error *error) {
    if (result != AUR_OK)
        return result;
    result = aur_fail_in(error, aur_image_expand(*image, error), name);
    if (result != AUR_OK) {
        aur_image_destroy(*image);
        *image = NULL;
    }
    return result;
}

aur_result aur_image_read_memory(const char *name, size_t size, const void *data, aur_image **image,
                                 aur_error *error) {
    return expand(name, aur_image_read_memory_coded(name, size, data, image, error), image, error);
}

aur_result aur_image_read(const char *path, aur_image **image, aur_error *error) {
    return expand(path, aur_image_read_coded(path, image, error), image, error);
}

aur_result aur_image_find_writer(const char *path, const char *format, const aur_row **row,
                                 aur_error *error) {
    *row = NULL;
    const char *extension = format;
    if (extension == NULL) {
        const char *const slash = strrchr(path, '/');
        const char *const dot = strrchr(slash != NULL ? slash : path, '.');
        extension = strcmp(path, "-") == 0 ? "exr" : dot != NULL ? dot + 1 : "";
    }
    const char *names[FORMAT_COUNT];
    size_t count = 0;
    for (size_t i = 0; i < FORMAT_COUNT; ++i) {
        if (formats[i]->write == NULL)
            continue;
        if (strcasecmp(extension, formats[i]->row.name) == 0) {
            *row = &formats[i]->row;
            return AUR_OK;
        }
        names[count++] = formats[i]->row.name;
    }
    char list[128];
    aur_list_names(count - 1, names, sizeof list, list);
    if (extension[0] == '\0')
        return aur_fail(error, AUR_ERROR_NAME, "'%s' has no extension: expected %s or %s", path, list,
                        names[count - 1]);
    return aur_fail(error, AUR_ERROR_NAME, "unknown image format of '%s': expected %s or %s", extension, list,
                    names[count - 1]);
}

static aur_result write_image(const char *path, const aur_image *image,
                              const aur_image_write_options *options, aur_error *error) {
    aur_image_target target = {.name = path, .options = {.size = sizeof target.options}};
    aur_image_write_options *const settings = &target.options;
    aur_result result =
        aur_options_read(options, sizeof *settings, settings, "aur_image_write_options", error);
    if (result != AUR_OK)
        return result;
    if (!isfinite(settings->exposure) || (size_t)settings->tone >= AUR_TONE_COUNT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "cannot write an image with exposure %g and tone curve %d",
                        (double)settings->exposure, (int)settings->tone);
    const aur_row *row;
    result = aur_image_find_writer(path, settings->format, &row, error);
    if (result != AUR_OK)
        return result;
    const aur_image_format *const format = (const aur_image_format *)row;
    if (!format->every_channel)
        result = aur_image_require_color(path, image, target.channels, error);
    aur_file_writer writer = {0};
    if (result == AUR_OK)
        result = aur_file_open(path, &writer, error);
    target.stream = writer.stream;
    if (result == AUR_OK)
        result = format->write(&target, image, error);
    if (result == AUR_OK)
        return aur_file_commit(&writer, error);
    aur_file_abandon(&writer);
    return result;
}

aur_result aur_image_write(const char *path, const aur_image *image, const aur_image_write_options *options,
                           aur_error *error) {
    return aur_fail_in(error, write_image(path, image, options, error), path);
}

aur_result aur_image_write_options_init(aur_image_write_options *options, aur_error *error) {
    static const aur_image_write_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_image_write_options", error);
}
