#include <aureole-render/render.h>

#include "program/cli/listing.h"
#include "program/lab/gather.h"

const aur_table *cli_render_table_at(size_t index) {
    size_t count = 0;
    while (aur_render_table_at(count) != NULL)
        ++count;
    return index == count ? &lab_integrator_table : aur_render_table_at(index);
}
