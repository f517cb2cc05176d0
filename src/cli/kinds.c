#include "cli/kinds.h"

#include <aureole/render.h>
#include <string.h>

const aur_table *cli_table_at(size_t index) {
    size_t count = 0;
    while (aur_table_at(count) != NULL)
        ++count;
    return index < count ? aur_table_at(index) : aur_render_table_at(index - count);
}

const aur_table *cli_find_table(const char *kind) {
    for (size_t i = 0; cli_table_at(i) != NULL; ++i)
        if (strcmp(cli_table_at(i)->kind, kind) == 0)
            return cli_table_at(i);
    return NULL;
}
