/* Words of the text, and messages. */
#include <stdarg.h>
#include <string.h>

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

/* The word that begins at the reader's place: up to a blank or `stops`, or what stands in quotes. */
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
               ? aur_rad_fail(self, word.line, AUR_ERROR_FORMAT, "the file ends where %s must stand", what)
               : aur_rad_fail(self, word.line, AUR_ERROR_FORMAT, "%s must stand here, not '%.*s'", what,
                              word.length > 40 ? 40 : (int)word.length, word.text);
}

aur_result aur_rad_check_name(const aur_rad *self, aur_rad_word name) {
    for (size_t i = 0; i < name.length; ++i)
        if ((unsigned char)name.text[i] < 32 || name.text[i] == 127)
            return aur_rad_fail(self, name.line, AUR_ERROR_FORMAT,
                                "a file's name must not have control characters");
    return AUR_OK;
}
