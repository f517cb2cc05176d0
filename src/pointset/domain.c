/* The names of the domains. */
#include <string.h>

#include <aureole/pointset.h>

#include "core/error.h"

static const char *const names[] = {"square", "cube", "disk", "hemisphere", "sphere"};
enum { DOMAIN_COUNT = sizeof names / sizeof names[0] };

aur_result aur_domain_from_name(const char *name, aur_domain *domain, aur_error *error) {
    for (size_t i = 0; i < DOMAIN_COUNT; ++i) {
        if (strcmp(names[i], name) == 0) {
            *domain = (aur_domain)i;
            return AUR_OK;
        }
    }
    return aur_fail(error, AUR_ERROR_NAME,
                    "unknown domain '%s': it must be square, cube, disk, hemisphere or sphere", name);
}

const char *aur_domain_name(aur_domain domain) {
    return (size_t)domain < DOMAIN_COUNT ? names[domain] : NULL;
}
