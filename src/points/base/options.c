#include "points/base/error.h"

#include <string.h>

static aur_result check_size(size_t size, const char *what, aur_error *error) {
    if (size != 0 && size % sizeof size == 0)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "%s: the field 'size' is %zu; set it to the struct's sizeof",
                    what, size);
}

aur_result aur_options_read(const void *given, size_t library_size, void *library, const char *what,
                            aur_error *error) {
    if (given == NULL)
        return AUR_OK;
    size_t size;
    memcpy(&size, given, sizeof size);
    const aur_result result = check_size(size, what, error);
    if (result != AUR_OK)
        return result;
    const unsigned char *const bytes = given;
    for (size_t i = library_size; i < size; ++i)
        if (bytes[i] != 0)
            return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                            "%s: byte %zu of the struct is set, but this library, %s, reads %zu bytes", what,
                            i, aur_version(), library_size);
    memcpy(library, given, size < library_size ? size : library_size);
    memcpy(library, &library_size, sizeof library_size);
    return AUR_OK;
}

aur_result aur_description_write(const void *library, size_t library_size, void *given, const char *what,
                                 aur_error *error) {
    size_t size;
    memcpy(&size, given, sizeof size);
    const aur_result result = check_size(size, what, error);
    if (result != AUR_OK)
        return result;
    memset(given, 0, size);
    memcpy(given, library, size < library_size ? size : library_size);
    memcpy(given, &size, sizeof size);
    return AUR_OK;
}
