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
    *word = (aur_rad_word){self->at, 0, self->line};
    while (self->at < self->end && !aur_is_space(*self->at))
        ++self->at;
    word->length = (size_t)(self->at - word->text);
    return word->length > 0;
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
