#include "image/format.h"

#include <string.h>

bool aur_image_begins(const aur_image_source *source, const char *bytes, size_t count) {
    return source->size >= count && memcmp(source->data, bytes, count) == 0;
}

void aur_image_put_bytes(void *stream, void *bytes, int count) {
    fwrite(bytes, 1, (size_t)count, stream);
}

aur_result aur_image_fail_encode(const aur_image_target *target, aur_error *error) {
    return aur_fail_at(error, (aur_location){.file = target->name}, AUR_ERROR_MEMORY,
                       "cannot encode the picture: out of memory");
}
