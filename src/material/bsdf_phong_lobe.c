/* The Phong lobe of final gathering: BSDF * cos = k_d / pi (u . n) + k_s (m + 1) / (2 pi) (u . u_r)^m, so
 * that k_s is the reflectance of the whole lobe (Marques 2013, section 5). Not reciprocal. */
#include "material/phong.h"
#include "material/sampling.h"

/* The factor of k_s (u . u_r)^m. */
static float scale_of(const aur_bsdf *bsdf) {
    const aur_phong *const self = bsdf->data;
    return (self->exponent + 1.0f) / (2.0f * AUR_PI_F);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light) {
    (void)part;
    const aur_phong *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return (aur_vector){0};
    const aur_phong_point at = aur_phong_at(bsdf, point);
    const float cosine = aur_vector_dot(aur_mirror(view), light);
    const float lobe = cosine > 0.0f ? scale_of(bsdf) * powf(cosine, self->exponent) : 0.0f;
    return aur_vector_add_scaled(aur_vector_scale(at.diffuse, light.z / AUR_PI_F), lobe, at.specular);
}

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    return aur_phong_create(parameters, bsdf, false, error);
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    aur_phong_weigh(bsdf, point, view, scale_of(bsdf), lobes);
}

const aur_bsdf_descriptor aur_bsdf_phong_lobe = {
    "phong_lobe",     "diffuse part and a pure cos^m lobe about the mirror direction; not reciprocal",
    "Marques 2013",   sizeof(aur_phong),
    create,           weigh,
    evaluate,         aur_phong_pdf,
    aur_phong_sample, aur_phong_diffuse_albedo,
};
