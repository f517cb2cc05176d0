/* Words of the text, messages, and the XML that is written. */
#include <stdarg.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

aur_result aur_rad_fail(const aur_rad *self, size_t line, aur_result result, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(self->error, (aur_location){self->path, line, 0}, result, "%s", text);
}

static bool append(aur_rad *self, size_t length, const char *text) {
    if (!aur_array_reserve(&self->xml, &self->xml_capacity, self->xml_size + length + 1, 1))
        return false;
    memcpy(self->xml + self->xml_size, text, length);
    self->xml_size += length;
    return true;
}

aur_result aur_rad_put(aur_rad *self, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return length >= 0 && (size_t)length < sizeof text && append(self, (size_t)length, text)
               ? AUR_OK
               : aur_fail_memory(self->error);
}

aur_result aur_rad_put_numbers(aur_rad *self, size_t count, const double *numbers) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = aur_rad_put(self, i == 0 ? "%.17g" : " %.17g", numbers[i]);
    return result;
}

/* XML takes UTF-8 without control characters: the bytes of the character at `at`, 0 where it is none. */
static size_t character_length(const char *at, size_t most) {
    const unsigned char *const c = (const unsigned char *)at;
    const size_t length = c[0] < 0x80   ? 1
                          : c[0] < 0xc2 ? 0
                          : c[0] < 0xe0 ? 2
                          : c[0] < 0xf0 ? 3
                          : c[0] < 0xf5 ? 4
                                        : 0;
    if (length > most || c[0] < 0x20 || c[0] == 0x7f)
        return 0;
    for (size_t i = 1; i < length; ++i)
        if ((c[i] & 0xc0) != 0x80)
            return 0;
    /* Longer than need be, surrogates, beyond Unicode, and two that are no characters. */
    const bool bad = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xed && c[1] > 0x9f) ||
                     (c[0] == 0xf0 && c[1] < 0x90) || (c[0] == 0xf4 && c[1] > 0x8f) ||
                     (c[0] == 0xef && c[1] == 0xbf && c[2] > 0xbd);
    return bad ? 0 : length;
}

aur_result aur_rad_put_quoted(aur_rad *self, aur_rad_word name) {
    aur_result result = AUR_OK;
    for (size_t i = 0, length; i < name.length && result == AUR_OK; i += length) {
        const char c = name.text[i];
        length = character_length(&name.text[i], name.length - i);
        if (length == 0)
            return aur_rad_fail(self, name.line, AUR_ERROR_FORMAT,
                                "a file's name must be UTF-8 without control characters");
        if (c == '$' || c == '\\')
            result = aur_rad_put(self, "\\%c", c);
        else if (strchr("<>&\"'", c) != NULL)
            result = aur_rad_put(self, "&#%d;", (int)(unsigned char)c);
        else
            result = append(self, length, &name.text[i]) ? AUR_OK : aur_fail_memory(self->error);
    }
    return result;
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
