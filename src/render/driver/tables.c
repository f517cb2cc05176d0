/* The tables of libaureole-render: a line a table. */
#include <aureole-render/render.h>

#include "render/film/integrator.h"
#include "render/image/format.h"
#include "render/scene/emitter.h"
#include "render/scene/load/loader.h"
#include "render/scene/load/spectrum.h"
#include "render/scene/materials/texture.h"
#include "render/scene/medium.h"
#include "render/scene/scene.h"
#include "render/scene/sensor.h"
#include "render/scene/shape.h"

/* clang-format off */
static const aur_table *const tables[] = {
    &aur_integrator_table,
    &aur_bsdf_table,
    &aur_texture_table,
    &aur_spectrum_table,
    &aur_shape_table,
    &aur_emitter_table,
    &aur_sensor_table,
    &aur_medium_table,
    &aur_phase_table,
    &aur_volume_table,
    &aur_film_table,
    &aur_filter_table,
    &aur_sampler_table,
    &aur_ignored_table,
    &aur_refused_table,
    &aur_image_format_table,
};
/* clang-format on */

const aur_table *aur_render_table_at(size_t index) {
    return index < sizeof tables / sizeof tables[0] ? tables[index] : NULL;
}
