/* Test functions with closed-form integrals, of all kinds that integration to a tolerance may meet. */
#ifndef LAB_WEIGHTS_FAMILIES_H
#define LAB_WEIGHTS_FAMILIES_H

#include <aureole/integrate.h>

typedef struct lab_family {
    const char *name;
    aur_domain domain;
    size_t dimension; /* of the cube */
    double exponent;  /* of the cosine weight, on the hemisphere */
    double a, b;      /* parameters of the function */
    double (*value)(const struct lab_family *family, const double *point);
    double (*integral)(const struct lab_family *family);
    double tolerance; /* of the first target; the second is a tenth of it */
    bool infinite;    /* infinite variance */
    double peak;      /* degrees about the axis, or the exponent of a singularity if negative; 0: not declared
                       */
} lab_family;

extern const double lab_family_axis[3];

size_t lab_family_count(void);
const lab_family *lab_family_at(size_t index);

/* An aur_integrand whose `user` is a lab_family. */
aur_result lab_family_evaluate(void *user, size_t count, const double *points, const double *along,
                               double *values, aur_error *error);

#endif
