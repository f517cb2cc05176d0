#include "points/sphere/sets/reference.h"

#include "points/base/error.h"

aur_result aur_reference_find(const char *set, size_t size, const aur_reference *references,
                              const aur_native_request *request, const aur_reference **found,
                              aur_error *error) {
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' fills the whole sphere, not a cap", set);
    size_t above = 0;
    while (above < size && references[above].count < request->count)
        ++above;
    if (above < size && references[above].count == request->count) {
        *found = references + above;
        return AUR_OK;
    }
    const unsigned most = references[size - 1].count;
    if (above == 0 || above == size)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has from %u to %u points, not %llu", set,
                        (unsigned)references[0].count, most, (unsigned long long)request->count);
    return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %u or %u points, not %llu", set,
                    (unsigned)references[above - 1].count, (unsigned)references[above].count,
                    (unsigned long long)request->count);
}
