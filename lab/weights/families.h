/* Functions whose integrals have closed forms, of every kind that integration to a tolerance meets. */
#ifndef LAB_WEIGHTS_FAMILIES_H
#define LAB_WEIGHTS_FAMILIES_H

#include <aureole/integrate.h>

typedef struct lab_family {
    const char *name;
    aur_domain domain;
    size_t dimension; /* of the cube */
    double exponent;  /* of the cosine, on the hemisphere */
    double a, b;      /* what the function is made with */
    double (*value)(const struct lab_family *family, const double *point);
    double (*integral)(const struct lab_family *family);
    double tolerance; /* a tenth of it is the other one */
    bool infinite;    /* its variance */
    double peak;      /* degrees about the axis, or the exponent of a singularity below 0; 0: not declared */
} lab_family;

extern const double lab_family_axis[3];

size_t lab_family_count(void);
const lab_family *lab_family_at(size_t index);

/* An aur_integrand whose `user` is a lab_family. */
aur_result lab_family_evaluate(void *user, size_t count, const double *points, const double *along,
                               double *values, aur_error *error);

#endif
