/* The names of the domains. */
#include <aureole/pointset.h>

#include "points/base/names.h"

static const char *const names[] = {"square", "cube", "disk", "hemisphere", "sphere", "axes", "rotations"};
enum { DOMAIN_COUNT = sizeof names / sizeof names[0] };

aur_result aur_domain_from_name(const char *name, aur_domain *domain, aur_error *error) {
    size_t index;
    const aur_result result =
        aur_names_choose(aur_names_of(DOMAIN_COUNT, names), "domain", name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *domain = (aur_domain)index;
    return result;
}

const char *aur_domain_name(aur_domain domain) {
    return (size_t)domain < DOMAIN_COUNT ? names[domain] : NULL;
}
