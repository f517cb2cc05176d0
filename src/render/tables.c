/* The tables of libaureole-render: a line a table. */
#include <aureole/render.h>

#include "transport/integrator.h"

static const aur_table *const tables[] = {
    &aur_integrator_table,
};

const aur_table *aur_render_table_at(size_t index) {
    return index < sizeof tables / sizeof tables[0] ? tables[index] : NULL;
}
