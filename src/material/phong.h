/* What the two BSDFs named after Phong share: parameters, and drawing from a diffuse and a cos^m lobe. */
#ifndef AUR_MATERIAL_PHONG_H
#define AUR_MATERIAL_PHONG_H

#include "material/texture.h"

typedef struct aur_phong {
    aur_color diffuse, specular;
    float exponent;
} aur_phong;

/* Both reflectances and the exponent at one point. */
typedef struct aur_phong_point {
    aur_vector diffuse, specular;
    float specular_probability;
} aur_phong_point;

aur_result aur_phong_create(aur_parameters *parameters, aur_bsdf *bsdf, bool times_cosine, aur_error *error);
aur_phong_point aur_phong_at(const aur_bsdf *bsdf, aur_bsdf_point point);
float aur_phong_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                    aur_vector light);
/* Draws by aur_phong_pdf; the weight comes from the BSDF's own `evaluate`. */
bool aur_phong_sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                      const float u[3], aur_bsdf_sample *drawn);
/* `scale` times the specular reflectance is the factor of the lobe about the mirrored view direction. */
void aur_phong_weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, float scale,
                     aur_bsdf_lobe *lobes);
aur_vector aur_phong_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side);

#endif
