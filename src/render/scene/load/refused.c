/* Plugins of Mitsuba that are rejected by name, with the reason. */
#include "render/scene/load/loader.h"

#include <string.h>

#define NAME(name_, why_)                                                                                    \
    { AUR_KEY_READ_APART(AUR_KEY_TEXT, name_, NULL, why_) }
#define KIND(name_)                                                                                          \
    &(const aur_row) {                                                                                       \
        .name = #name_, .summary = "types of " #name_ " that are not supported", AUR_ROW_KEYS(name_##_names) \
    }

#define OF_SAME_LIGHT "--integrator path, volpath or finalgather renders the same light"
#define INSIDE "'homogeneous' inside a shape is the medium that it approximates"
#define OF_DERIVATIVES "it is for derivatives: --integrator path renders the same image"

static const aur_key integrator_names[] = {
    NAME("stokes", "light is unpolarised here: --integrator path renders its intensity"),
    NAME("prb", OF_DERIVATIVES),
    NAME("prb_basic", OF_DERIVATIVES),
    NAME("prb_projective", OF_DERIVATIVES),
    NAME("direct_projective", "it is for derivatives: --integrator direct renders the same image"),
    NAME("prbvolpath", "it is for derivatives: --integrator volpath renders the same image"),
    NAME("volprim_rf_basic", "radiance fields are not rendered"),
    NAME("bdpt", OF_SAME_LIGHT),
    NAME("photonmapper", OF_SAME_LIGHT),
    NAME("ppm", OF_SAME_LIGHT),
    NAME("sppm", OF_SAME_LIGHT),
    NAME("pssmlt", OF_SAME_LIGHT),
    NAME("mlt", OF_SAME_LIGHT),
    NAME("erpt", OF_SAME_LIGHT),
    NAME("vpl", OF_SAME_LIGHT),
    NAME("irrcache", OF_SAME_LIGHT),
    NAME("adaptive", "--error renders to a target error"),
    NAME("multichannel", "--integrator aov writes several channels"),
    NAME("field", "--integrator aov writes positions, normals and the like"),
};
static const aur_key bsdf_names[] = {
    NAME("hair", "the curves that carry it can have any other bsdf"),
    NAME("measured", "files of measured materials are not read"),
    NAME("measured_polarized", "light is unpolarised here, and files of measured materials are not read"),
    NAME("hk", INSIDE),
    NAME("irawan", "files of woven cloth are not read"),
};
static const aur_key shape_names[] = {
    NAME("sdfgrid", "a mesh of the same surface can be rendered"),
    NAME("ellipsoids", "radiance fields are not rendered"),
    NAME("ellipsoidsmesh", "radiance fields are not rendered"),
    NAME("blender", "Blender's memory is not read: export the mesh to a file"),
    NAME("heightfield", "a mesh of the same surface can be rendered"),
    NAME("hair", "'bsplinecurve' and 'linearcurve' render fibres"),
    NAME("deformable", "an image shows one moment"),
};
static const aur_key emitter_names[] = {
    NAME("timed_sunsky", "an image shows one moment: 'sunsky' has a date and a time"),
    NAME("collimated", "a 'spot' or a 'directional' light through a hole is a beam"),
};
static const aur_key texture_names[] = {
    NAME("wireframe", "edges of meshes are not drawn"),
    NAME("curvature", "curvatures of surfaces are not computed"),
};
static const aur_key sensor_names[] = {
    NAME("perspective_rdist", "lenses do not distort: 'perspective' is the camera without it"),
    NAME("telecentric", "'orthographic' is the camera without depth of field"),
    NAME("fluencemeter", "'irradiancemeter' and 'radiancemeter' measure at surfaces and along rays"),
    NAME("distant", "'orthographic' measures parallel light"),
    NAME("distantflux", "'irradiancemeter' measures flux per area"),
    NAME("flat_sensor", "'irradiancemeter' measures flux per area"),
    NAME("spherical", "a 'batch' of six 'perspective' cameras sees all directions"),
};
static const aur_key subsurface_names[] = {
    NAME("dipole", INSIDE),
    NAME("multipole", INSIDE),
    NAME("adipole", INSIDE),
    NAME("singlescatter", INSIDE),
};
static const aur_key film_names[] = {
    NAME("specfilm", "colours are red, green and blue"),
    NAME("mfilm", "images are written as EXR, PFM, HDR, PNG or JPEG"),
};
static const aur_key phase_names[] = {
    NAME("sggx", "it needs a grid of six channels, and 'gridvolume' has 1 or 3"),
    NAME("microflake", "it needs a grid of directions, and 'gridvolume' has 1 or 3 channels"),
    NAME("kkay", "'bsplinecurve' and 'linearcurve' render fibres"),
    NAME("mixturephase", "'blendphase' mixes two phase functions"),
};
static const aur_key volume_names[] = {
    NAME("volcache", "give the volume inside it instead"),
    NAME("hgridvolume", "'gridvolume' reads one grid"),
};

static const aur_row *const rows[] = {KIND(integrator), KIND(bsdf),      KIND(shape), KIND(emitter),
                                      KIND(sensor),     KIND(film),      KIND(phase), KIND(texture),
                                      KIND(volume),     KIND(subsurface)};

const aur_table aur_refused_table = {
    .kind = "refused", .summary = "Mitsuba's plugins that are not supported", AUR_TABLE_ROWS(rows)};

aur_result aur_parameters_refuse(const aur_parameters *parameters, aur_error *error) {
    const size_t kind = aur_names_find(aur_names_of_table(&aur_refused_table), parameters->kind);
    const aur_key *const key =
        kind < aur_refused_table.count ? aur_row_find_key(rows[kind], parameters->plugin) : NULL;
    return key == NULL
               ? AUR_OK
               : aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                             "%s '%s' is not supported: %s", parameters->kind, parameters->plugin, key->help);
}
