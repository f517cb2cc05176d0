/* Integrands registered by modules and programs, global to the process. */
#include <string.h>

#include "program/lab/run.h"

enum { MOST_INTEGRANDS = 256 };

static const lab_named_integrand *integrands[MOST_INTEGRANDS];
static size_t integrand_count;

const lab_named_integrand *lab_find_integrand(const char *name) {
    for (size_t i = integrand_count; i-- > 0;) /* the last registration wins */
        if (strcmp(integrands[i]->name, name) == 0)
            return integrands[i];
    return NULL;
}

aur_result lab_add_integrand(const lab_named_integrand *integrand, aur_error *error) {
    if (integrand->name == NULL || integrand->evaluate == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an integrand must have a name and a function");
    if (integrand_count == MOST_INTEGRANDS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "at most %d integrands can be added", MOST_INTEGRANDS);
    integrands[integrand_count++] = integrand;
    return AUR_OK;
}
