/* Arguments of the built-in surface generators. */
#include "render/scene/importers/rad/rad_reader.h"

aur_result aur_rad_generator_numbers(aur_rad_generator *self, const char *what, size_t count,
                                     double *numbers) {
    for (size_t i = 0; i < count; ++i, ++self->at)
        if (self->at >= self->count || !aur_rad_number(self->words[self->at], &numbers[i]))
            return aur_rad_fail(self->rad, self->words[0].line, AUR_ERROR_FORMAT, "%.*s: %s expected",
                                (int)self->words[0].length, self->words[0].text, what);
    return AUR_OK;
}

aur_result aur_rad_generator_fail(const aur_rad_generator *self) {
    const aur_rad_word word = self->words[self->at];
    return aur_rad_fail(self->rad, word.line, AUR_ERROR_UNSUPPORTED, "%.*s: '%.*s' is not read",
                        (int)self->words[0].length, self->words[0].text, (int)word.length, word.text);
}
