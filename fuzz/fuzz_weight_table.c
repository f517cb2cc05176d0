/* Tables of weights. The checksum of every input is corrected, so that the data before it are tested; the
 * last byte that it overwrites selects the requested table. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "points/quadrature/tables/weight_table.h"
#include "words.h"

static const char *input_path(void) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-table-%ld", (long)getpid());
    return path;
}

/* Plain, clipped, GGX, and GGX alone at several roughnesses. */
static aur_oswa_options options_of(size_t index) {
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = index == 0 ? "sobol" : NULL,
                              .count = index < 3 ? 4 : 0,
                              .mirror_count = 3,
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = index >= 2 ? (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = 0.5}
                                                        : (aur_lobe){.exponent = 20.0},
                              .clipped = index == 1};
}

static const aur_weight_table_grid grid = {sizeof(aur_weight_table_grid), 3, 1, 2};

/* A table that was read can be written and read again. */
static void require_whole(const aur_weight_table *table) {
    size_t size;
    void *printed;
    aur_error error;
    aur_weight_table *again = NULL;
    fuzz_require(aur_weight_table_print(table, &size, &printed, &error) == AUR_OK,
                 "a table that cannot be written");
    uint8_t *const copy = fuzz_copy(printed, size);
    copy[size] = 0;
    fuzz_require(aur_weight_table_parse("again", size, (char *)copy, NULL, &again, &error) == AUR_OK,
                 "a table that cannot be read again");
    aur_weight_table_destroy(again);
    free(copy);
    free(printed);
}

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
    const unsigned requested = size > 0 ? data[size - 1] % 8 : 0;
    const aur_oswa_options expected = options_of(requested % 4);
    fuzz_write_file(input_path(), (const uint8_t *)text, size);
    const aur_result result =
        aur_weight_table_load(input_path(), requested < 4 ? &expected : NULL, &table, &error);
    unlink(input_path());
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
        require_whole(table);
    }
    aur_weight_table_destroy(table);
    free(text);
    return 0;
}

/* Each table, read for any options and for the requested ones. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 7)
        return 0;
    const aur_oswa_options options = options_of(index % 4);
    aur_weight_table *table;
    aur_error error;
    fuzz_require(aur_weight_table_build(&options, &grid, 1, NULL, &table, &error) == AUR_OK, "no seed");
    fuzz_require(aur_weight_table_save(table, input_path(), &error) == AUR_OK, "a seed cannot be written");
    aur_weight_table_destroy(table);
    const size_t size = fuzz_read_file(input_path(), capacity, data);
    unlink(input_path());
    char key[AUR_WEIGHT_TABLE_KEY_CAPACITY];
    fuzz_require(aur_weight_table_key(&options, &grid, index, key) == AUR_OK, "a table without a key");
    data[size - 1] = index < 4 ? 7 : index % 4;
    return size;
}
