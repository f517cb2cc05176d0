/* Words of the text, and messages. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/file.h"
#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

aur_result aur_rad_fail(const aur_rad *self, size_t line, aur_result result, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(self->error, (aur_location){self->nodes->location.file, line, 0}, result, "%s", text);
}

bool aur_rad_is_word(aur_rad_word word, const char *text) {
    return strlen(text) == word.length && memcmp(word.text, text, word.length) == 0;
}

/* The word at the reader's position: up to a blank or one of `stops`, or a quoted string. */
static void take_word(aur_rad *self, const char *stops, aur_rad_word *word) {
    const char quote = self->at < self->end && (*self->at == '"' || *self->at == '\'') ? *self->at : '\0';
    const char *end = self->at + 1;
    while (quote != '\0' && end < self->end && *end != quote && *end != '\n')
        ++end;
    if (quote != '\0' && end < self->end && *end == quote) {
        *word = (aur_rad_word){self->at + 1, (size_t)(end - self->at - 1), self->line};
        self->at = end + 1;
        return;
    }
    *word = (aur_rad_word){self->at, 0, self->line};
    while (self->at < self->end && !aur_is_space(*self->at) &&
           (*self->at == '\0' || strchr(stops, *self->at) == NULL))
        ++self->at;
    word->length = (size_t)(self->at - word->text);
}

bool aur_rad_next_word(aur_rad *self, aur_rad_word *word) {
    for (; self->at < self->end; ++self->at) {
        if (*self->at == '#')
            while (self->at + 1 < self->end && self->at[1] != '\n')
                ++self->at;
        else if (*self->at == '\n')
            ++self->line;
        else if (!aur_is_space(*self->at))
            break;
    }
    const char *const start = self->at;
    take_word(self, "", word);
    return self->at > start;
}

bool aur_rad_next_of_line(aur_rad *self, aur_rad_word *word) {
    for (; self->at < self->end; ++self->at) {
        const char *const after = self->at + 1;
        const bool joins = *self->at == '\\' && after < self->end && *after == '\n';
        if (joins) {
            ++self->at;
            ++self->line;
        } else if (*self->at == '\n' || !aur_is_space(*self->at)) {
            break;
        }
    }
    *word = (aur_rad_word){self->at, 0, self->line};
    if (self->at == self->end || *self->at == '\n' || *self->at == '#')
        return false;
    if (*self->at != '|') {
        take_word(self, "|", word);
        return true;
    }
    ++self->at;
    word->length = 1;
    return true;
}

bool aur_rad_number(aur_rad_word word, double *number) {
    return word.length > 0 &&
           aur_read_double(word.text, AUR_NUMBER_FINITE, number) == word.text + word.length;
}

aur_result aur_rad_fail_end(const aur_rad *self, const char *what, aur_rad_word word) {
    return word.length == 0
               ? aur_rad_fail(self, word.line, AUR_ERROR_FORMAT, "the file ends, but %s must follow", what)
               : aur_rad_fail(self, word.line, AUR_ERROR_FORMAT, "expected %s here, not '%.*s'", what,
                              word.length > 40 ? 40 : (int)word.length, word.text);
}

aur_result aur_rad_check_name(const aur_rad *self, aur_rad_word name) {
    for (size_t i = 0; i < name.length; ++i)
        if ((unsigned char)name.text[i] < 32 || name.text[i] == 127)
            return aur_rad_fail(self, name.line, AUR_ERROR_FORMAT,
                                "a file's name must not have control characters");
    return AUR_OK;
}

aur_result aur_rad_read_file(aur_rad *self, aur_rad_word name, char **text, size_t *size) {
    enum { LARGEST = 1 << 28 };
    aur_rad_scene *const scene = self->scene;
    const aur_location location = {self->nodes->location.file, name.line, 0};
    char *path = NULL;
    *text = NULL;
    aur_result result = aur_rad_check_name(self, name);
    const char *const copy = result == AUR_OK ? aur_arena_copy(scene->arena, name.text, name.length) : NULL;
    if (result == AUR_OK && copy == NULL)
        result = aur_fail_memory(self->error);
    if (result == AUR_OK && scene->find == NULL)
        result = aur_rad_fail(self, name.line, AUR_ERROR_OPEN, "cannot find '%s'", copy);
    else if (result == AUR_OK)
        result = scene->find(scene->context, location, copy, &path, self->error);
    if (result == AUR_OK)
        result = aur_file_read(path, LARGEST, text, size, self->error);
    free(path);
    char *const longer = result == AUR_OK ? realloc(*text, *size + 1) : NULL;
    if (longer == NULL) {
        free(*text);
        *text = NULL;
        return result == AUR_OK ? aur_fail_memory(self->error) : result;
    }
    longer[*size] = '\0';
    *text = longer;
    return AUR_OK;
}
