/* Films. The checksum of every input is corrected, so that the data before it are tested. */
#include "render/film/film.h"
#include "words.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    uint8_t *const bytes = fuzz_copy(data, size);
    if (size % 8 == 0)
        fuzz_correct_hash(bytes, size);
    aur_film *film;
    aur_error error = {0};
    char path[64];
    snprintf(path, sizeof path, "fuzz-film-%ld", (long)getpid());
    fuzz_write_file(path, bytes, size);
    const aur_result result = aur_film_load(path, &film, &error);
    unlink(path);
    if (result != AUR_OK) {
        fuzz_require(film == NULL, "a failed read left a film");
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
    } else {
        aur_image *image = NULL;
        double rmse[4];
        fuzz_require(aur_film_develop(film, &image, NULL) == AUR_OK, "a film without an image");
        aur_image_destroy(image);
        aur_film_error(film, rmse, NULL, NULL);
        fuzz_require(aur_film_merge(film, film, NULL) == AUR_OK, "a film that is not like itself");
    }
    aur_film_destroy(film);
    free(bytes);
    return 0;
}

/* A whole image, and a shard with an additional channel. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 1)
        return 0;
    const aur_film_layout layout = {.width = 20 + index * 1000,
                                    .height = 18,
                                    .x0 = index * 16,
                                    .x1 = 19 + index,
                                    .y1 = 18,
                                    .channel_count = 3 + index};
    aur_film *film = NULL;
    fuzz_require(aur_film_create(&layout, &film, NULL) == AUR_OK, "no film");
    if (index == 1)
        film->channels[3] = (aur_film_channel){.name = "n", .kind = AUR_CHANNEL_COUNT};
    const char *const path = "seed.film";
    fuzz_require(aur_film_save(film, path, NULL) == AUR_OK, "a seed cannot be written");
    aur_film_destroy(film);
    const size_t size = fuzz_read_file(path, capacity, data);
    unlink(path);
    return size;
}
