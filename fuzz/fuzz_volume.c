/* Volume grids: .vol files. */
#include "fuzz.h"
#include "render/scene/media/majorants.h"
#include "render/scene/vol_file.h"

static const char *input_path(void) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-volume-%ld", (long)getpid());
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_write_file(input_path(), data, size);
    const aur_location where = {.file = input_path(), .line = 1};
    /* The last byte selects the options. */
    const unsigned how = size > 0 ? data[size - 1] : 0;
    static const char *const filters[] = {"trilinear", "nearest"}, *const wraps[] = {"clamp", "repeat",
                                                                                     "mirror"};
    const char *const keys[][2] = {{"filename", input_path()},
                                   {"filter_type", filters[how % 2]},
                                   {"wrap_mode", wraps[how / 2 % 3]},
                                   {"use_grid_bbox", how / 6 % 2 == 0 ? "false" : "true"}};
    aur_parameters parameters;
    aur_error error = {0};
    fuzz_require(aur_parameters_init(&parameters, "volume", "gridvolume", where, &error) == AUR_OK,
                 "no parameters");
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i)
        fuzz_require(aur_parameters_add_text(&parameters, AUR_PARAMETER_TEXT, keys[i][0], keys[i][1], where,
                                             &error) == AUR_OK,
                     "no parameter");
    aur_volume *volume = NULL;
    const aur_result result = aur_volume_create(&parameters, &volume, &error);
    aur_parameters_release(&parameters);
    unlink(input_path());
    if (result != AUR_OK) {
        fuzz_require(volume == NULL, "a failed read left a volume");
        fuzz_require(error.message[0] != '\0' && error.file[0] != '\0',
                     "a failure without a message or a place");
        fuzz_require(result == AUR_ERROR_FORMAT || result == AUR_ERROR_MEMORY, "a failure of the wrong kind");
        return 0;
    }
    const float slack = 1e-5f * aur_larger(fabsf(volume->maximum), fabsf(volume->minimum)) + 1e-30f;
    for (int i = -20; i <= 20; ++i) {
        const aur_vector position = {0.13f * (float)i, 0.2f + 0.07f * (float)i, 1e4f * (float)(i * i * i)};
        const aur_vector value = volume->descriptor->evaluate(volume, position);
        fuzz_require(!(aur_vector_max(value) > volume->maximum + slack), "a value above the largest");
    }
    aur_majorants majorants;
    if (volume->minimum >= 0.0f && aur_majorants_create(volume, 1.0f, &majorants, &error) == AUR_OK)
        aur_majorants_release(&majorants);
    aur_volume_destroy(volume);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const int32_t sizes[][4] = {{2, 3, 4, 1}, {3, 2, 2, 3}, {9, 1, 1, 1}};
    if (index >= sizeof sizes / sizeof sizes[0])
        return 0;
    float values[64];
    for (size_t i = 0; i < 64; ++i)
        values[i] = (float)i / 7.0f;
    const int32_t *const n = sizes[index];
    size_t size;
    char *const bytes = vol_bytes(n[0], n[1], n[2], n[3], values, &size);
    fuzz_require(size <= capacity, "a seed is too long");
    memcpy(data, bytes, size);
    free(bytes);
    return size;
}
