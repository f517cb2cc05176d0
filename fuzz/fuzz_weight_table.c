/* Tables of weights. The check sum of every input is made right, so that what stands before it is what is
 * tried. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "quadrature/tables/weight_table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *const text = malloc(size + 1);
    if (text == NULL)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    if (size >= 8) {
        const uint64_t sum = aur_weight_table_check_sum(text, size - 8);
        for (unsigned k = 0; k < 8; ++k)
            text[size - 8 + k] = (char)(sum >> 8 * k);
    }
    aur_weight_table *table;
    aur_error error = {0};
    const aur_result result = aur_weight_table_parse("input", size, text, NULL, &table, &error);
    if (result != AUR_OK) {
        fuzz_require(table == NULL, "a failed read left a table");
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
    } else {
        float *const weights = malloc(table->size * sizeof *weights);
        fuzz_require(weights != NULL, "no memory");
        const double angles[] = {0.0, 0.8, 1.5707963267948966, -1.0, 9.0, (double)NAN};
        for (size_t i = 0; i < sizeof angles / sizeof angles[0]; ++i)
            aur_weight_table_look_up(table, i % 2, table->rotation_count - 1, angles[i], 0.0, table->size,
                                     weights, NULL);
        free(weights);
    }
    aur_weight_table_destroy(table);
    free(text);
    return 0;
}

/* Plain, clipped, GGX, and GGX alone at several roughnesses. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 3)
        return 0;
    const aur_oswa_options options = {.size = sizeof(aur_oswa_options),
                                      .set = index == 0 ? "sobol" : NULL,
                                      .count = index < 3 ? 4 : 0,
                                      .mirror_count = 3,
                                      .lobe = {.exponent = 1.0},
                                      .mirror_lobe = index >= 2
                                                         ? (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = 0.5}
                                                         : (aur_lobe){.exponent = 20.0},
                                      .clipped = index == 1};
    aur_weight_table *table;
    aur_error error;
    fuzz_require(aur_weight_table_build(&options,
                                        &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 3, 1, 2}, 1,
                                        NULL, &table, &error) == AUR_OK,
                 "no seed");
    const char *const path = "seed.table";
    fuzz_require(aur_weight_table_save(table, path, &error) == AUR_OK, "a seed cannot be written");
    aur_weight_table_destroy(table);
    const size_t size = fuzz_read_file(path, capacity, data);
    unlink(path);
    return size;
}
