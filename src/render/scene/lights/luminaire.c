/* Describes a photometric file. */
#include <aureole-render/scene.h>
#include <math.h>

#include "points/base/error.h"
#include "render/scene/lights/photometry.h"

/* By the range of the planes in the file, which both formats determine by the symmetry. */
static const char *symmetry_of(const aur_photometry *photometry) {
    const double from = photometry->planes[0], to = photometry->planes[photometry->plane_count - 1];
    if (photometry->type != AUR_PHOTOMETRIC_C)
        return from == 0.0 ? "vertical plane" : "none";
    return photometry->plane_count == 1    ? "rotational"
           : from == 0.0 && to == 90.0     ? "quadrants"
           : from == 0.0 && to == 180.0    ? "plane C 0-180"
           : from == 90.0 || from == 270.0 ? "plane C 90-270"
                                           : "none";
}

aur_result aur_luminaire_describe(const char *path, size_t bytes, const void *data,
                                  aur_luminaire_description *description, aur_error *error) {
    aur_photometry photometry;
    aur_result result = data != NULL ? aur_photometry_parse(path, bytes, data, &photometry, error)
                                     : aur_photometry_read(path, &photometry, error);
    if (result != AUR_OK)
        return result;
    aur_luminaire_description d = {.size = sizeof d,
                                   .format = photometry.ies ? "IES LM-63" : "EULUMDAT",
                                   .type = photometry.type == AUR_PHOTOMETRIC_C   ? "C"
                                           : photometry.type == AUR_PHOTOMETRIC_B ? "B"
                                                                                  : "A",
                                   .symmetry = symmetry_of(&photometry),
                                   .planes = photometry.plane_count,
                                   .angles = photometry.angle_count,
                                   .lumens = aur_photometry_flux(&photometry),
                                   .lamp_lumens = photometry.lumens,
                                   .length = photometry.length,
                                   .width = photometry.width,
                                   .height = photometry.height,
                                   .round = photometry.round};
    for (size_t i = 0; i < photometry.plane_count * photometry.angle_count; ++i)
        d.peak = fmax(d.peak, (double)photometry.candela[i]);
    aur_photometry_release(&photometry);
    return aur_description_write(&d, sizeof d, description, "aur_luminaire_description", error);
}
