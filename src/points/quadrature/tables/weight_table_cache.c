#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/cache_file.h"
#include "points/quadrature/tables/weight_table.h"

static const char kind[] = "weights";

aur_result aur_weight_table_find(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                 size_t threads, const aur_progress *progress, aur_weight_table **table,
                                 aur_error *error) {
    char key[AUR_WEIGHT_TABLE_KEY_CAPACITY];
    const uint64_t build = aur_build_identity();
    const bool keeps = build != 0 && aur_weight_table_key(options, grid, build, key) == AUR_OK;
    size_t size = 0;
    void *data = keeps ? aur_cache_file_read(kind, key, &size) : NULL;
    const bool found =
        data != NULL && aur_weight_table_parse("cache", size, data, options, table, NULL) == AUR_OK;
    free(data);
    if (found)
        return AUR_OK;
    const aur_result result = aur_weight_table_build(options, grid, threads, progress, table, error);
    if (result == AUR_OK && keeps && aur_weight_table_print(*table, &size, &data, NULL) == AUR_OK) {
        aur_cache_file_write(kind, key, size, data);
        free(data);
    }
    return result;
}
