/* EXR: written files are read back; files of OpenEXR in all variants are read. */
#include "foreign.h"
#include "test_images.h"

static void test_float_round_trip_is_exact(void **state) {
    (void)state;
    /* Around the 16 lines of a ZIP chunk. The first chunk of 64 x 33 x 7 has the same length before and after
     * compression, which OpenEXR alone gets wrong up to 3.4. */
    static const size_t sizes[][3] = {{1, 1, 1}, {3, 15, 3}, {17, 16, 4}, {64, 33, 7}, {5, 100, 2}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        aur_image *const image = random_image(sizes[i][0], sizes[i][1], sizes[i][2]);
        /* Already in the order in which a file is read: colour first, then layers by name. */
        static const char *const names[] = {"R", "G", "B", "A", "depth", "albedo.R", "albedo.G"};
        for (size_t c = 0; c < image->channel_count && sizes[i][2] > 2; ++c)
            strcpy(image->channel_names[c], names[c]);
        image->data[0] = -1e-40f; /* a denormal */
        const char *const path = scratch(0, "float.exr");
        write_image(path, image, NULL);
        aur_image *const back = read_image(path);
        assert_same_image(image, back);
        aur_image_destroy(back);
        aur_image_destroy(image);
        remove(path);
    }
}

static void test_infinity_and_nan_survive(void **state) {
    (void)state;
    aur_image *const image = random_image(3, 1, 1);
    image->data[0] = INFINITY;
    image->data[1] = -INFINITY;
    image->data[2] = NAN;
    for (int half = 0; half < 2; ++half) {
        const char *const path = scratch(0, "special.exr");
        write_image(path, image,
                    &(aur_image_write_options){.size = sizeof(aur_image_write_options), .half = half});
        aur_image *const back = read_image(path);
        assert_true(back->data[0] == INFINITY);
        assert_true(back->data[1] == -INFINITY);
        assert_true(isnan(back->data[2]));
        aur_image_destroy(back);
        remove(path);
    }
    aur_image_destroy(image);
}

/* A half has 11 significant bits: rounding to nearest is within 2^-12 of the value for normal numbers. */
static void test_half_is_within_its_precision(void **state) {
    (void)state;
    aur_image *const image = random_image(101, 37, 3);
    image->data[0] = 1e6f;   /* beyond the largest half */
    image->data[1] = -1e38f; /* and below the least */
    image->data[2] = 0.0f;
    const char *const path = scratch(0, "half.exr");
    write_image(path, image,
                &(aur_image_write_options){.size = sizeof(aur_image_write_options), .half = true});
    aur_image *const back = read_image(path);
    assert_true(back->data[0] == 65504.0f);
    assert_true(back->data[1] == -65504.0f);
    assert_true(back->data[2] == 0.0f);
    for (size_t i = 3; i < 101 * 37 * 3; ++i) {
        const double bound = fmax(fabs((double)image->data[i]) * 0x1p-11, 0x1p-25);
        assert_near((double)back->data[i], (double)image->data[i], bound);
    }
    aur_image_destroy(back);
    aur_image_destroy(image);
    remove(path);
}

static void test_same_image_same_bytes(void **state) {
    (void)state;
    aur_image *const image = random_image(70, 40, 3);
    for (int half = 0; half < 2; ++half) {
        const aur_image_write_options options = {.size = sizeof options, .half = half};
        size_t size_a, size_b;
        write_image(scratch(0, "a.exr"), image, &options);
        write_image(scratch(1, "another-name.exr"), image, &options);
        unsigned char *const a = read_bytes(scratch(0, "a.exr"), &size_a);
        unsigned char *const b = read_bytes(scratch(1, "another-name.exr"), &size_b);
        assert_int_equal(size_a, size_b);
        assert_memory_equal(a, b, size_a);
        free(a);
        free(b);
    }
    remove(scratch(0, "a.exr"));
    remove(scratch(1, "another-name.exr"));
    aur_image_destroy(image);
}

static void test_names_are_checked(void **state) {
    (void)state;
    aur_error error;
    aur_image *const image = random_image(2, 2, 5);
    assert_int_equal(aur_image_write(scratch(0, "x.exr"), image, NULL, &error), AUR_ERROR_ARGUMENT);
    for (size_t c = 0; c < 5; ++c)
        strcpy(image->channel_names[c], "same");
    assert_int_equal(aur_image_write(scratch(0, "x.exr"), image, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "same"));
    assert_int_equal(access(scratch(0, "x.exr"), F_OK), -1);
    aur_image_destroy(image);
}

/* The largest error of the half channels relative to the largest value; the other types must be exact. */
static double foreign_error(const aur_image *image) {
    static const char *const order[] = {"R", "B", "depth.Z", "id.number"};
    static const size_t source[] = {2, 0, 3, 1};
    double worst = 0.0;
    assert_int_equal(image->channel_count, 4);
    for (size_t c = 0; c < 4; ++c) {
        assert_string_equal(image->channel_names[c], order[c]);
        for (size_t i = 0; i < image->width * image->height; ++i) {
            const double expected = foreign_value(source[c], i % image->width, i / image->width);
            const double error = fabs((double)image->data[i * 4 + c] - expected);
            if (foreign_types[source[c]] == EXR_PIXEL_HALF)
                worst = fmax(worst, error / 128.0);
            else
                assert_true(error == 0.0);
        }
    }
    return worst;
}

static void test_every_storage_and_compression(void **state) {
    (void)state;
    static const exr_compression_t compressions[] = {
        EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,   EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
        EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24, EXR_COMPRESSION_B44,  EXR_COMPRESSION_B44A};
    const size_t lossless = 6;
    for (size_t i = 0; i < sizeof compressions / sizeof compressions[0]; ++i) {
        for (int tiled = 0; tiled < 2; ++tiled) {
            const foreign_file file = {.storage = tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
                                       .compression = compressions[i],
                                       .width = 61,
                                       .height = 47,
                                       .left = tiled ? 0 : -5,
                                       .top = tiled ? 0 : 9,
                                       .tile = 16};
            const char *const path = scratch(0, "foreign.exr");
            write_foreign(path, &file);
            aur_image *const image = read_image(path);
            assert_int_equal(image->width, 61);
            assert_int_equal(image->height, 47);
            assert_true(foreign_error(image) <= (i < lossless ? 0.0 : 0.05));
            aur_image_destroy(image);
            remove(path);
        }
    }
}

static void test_what_cannot_be_read_says_so(void **state) {
    (void)state;
    aur_image *image;
    aur_error error;

    /* A compression that OpenEXR 3.1's C library lacks: DWAA, named in the header of another file. */
    aur_image *const written = random_image(8, 8, 3);
    memset(written->data, 0, 8 * 8 * 3 * sizeof(float)); /* so that chunks are compressed */
    write_image(scratch(0, "dwaa.exr"), written, NULL);
    aur_image_destroy(written);
    size_t size;
    unsigned char *const bytes = read_bytes(scratch(0, "dwaa.exr"), &size);
    remove(scratch(0, "dwaa.exr"));
    static const char attribute[] = "compression\0compression\0\1\0\0";
    size_t at = 0;
    while (at + sizeof attribute < size && memcmp(bytes + at, attribute, sizeof attribute) != 0)
        ++at;
    assert_int_equal(bytes[at + sizeof attribute], EXR_COMPRESSION_ZIP);
    bytes[at + sizeof attribute] = EXR_COMPRESSION_DWAA;
    const aur_result result = aur_image_read_memory("dwaa.exr", size, bytes, &image, &error);
    assert_true(result == AUR_ERROR_UNSUPPORTED || result == AUR_ERROR_FORMAT); /* FORMAT: once it is there */
    assert_null(image);
    free(bytes);
}

/* The header states 10,000,000 x 8, which is still one chunk, and the data are those of 8 x 8. */
static void test_header_that_lies(void **state) {
    (void)state;
    aur_image *const written = random_image(8, 8, 3);
    write_image(scratch(0, "lie.exr"), written, NULL);
    aur_image_destroy(written);
    size_t size;
    unsigned char *const bytes = read_bytes(scratch(0, "lie.exr"), &size);
    remove(scratch(0, "lie.exr"));
    static const char attribute[] = "dataWindow\0box2i\0\x10\0\0";
    size_t at = 0;
    while (at + sizeof attribute + 16 < size && memcmp(bytes + at, attribute, sizeof attribute) != 0)
        ++at;
    const int32_t window[4] = {0, 0, 9999999, 7};
    memcpy(bytes + at + sizeof attribute, window, sizeof window);
    aur_image *image;
    aur_error error;
    assert_int_equal(aur_image_read_memory("lie.exr", size, bytes, &image, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "80000000 pixels"));
    assert_null(image);
    /* the row's bytes overflow int32_t, in which OpenEXR computes strides */
    const int32_t wide[4] = {0, 0, 178956970, 0};
    memcpy(bytes + at + sizeof attribute, wide, sizeof wide);
    assert_int_equal(aur_image_read_memory("lie.exr", size, bytes, &image, &error), AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "rows of 178956971 pixels with 3 channels are too long for EXR"));
    free(bytes);
}

/* OpenEXR accepts names of up to 31 bytes unless longer ones are enabled, and once hung in its error handler.
 */
static void test_long_names(void **state) {
    (void)state;
    aur_image *const image = random_image(3, 2, 5);
    for (size_t c = 0; c < 5; ++c) {
        memset(image->channel_names[c], 'n', 51 * (c + 1) - 1);
        image->channel_names[c][51 * (c + 1) - 1] = '\0';
    }
    write_image(scratch(0, "names.exr"), image, NULL);
    aur_image *const back = read_image(scratch(0, "names.exr"));
    assert_same_image(image, back);
    remove(scratch(0, "names.exr"));
    aur_image_destroy(back);
    aur_image_destroy(image);
}

static void test_every_truncation_is_an_error(void **state) {
    (void)state;
    aur_image *const image = random_image(20, 40, 3);
    const char *const path = scratch(0, "cut.exr");
    write_image(path, image, NULL);
    size_t size;
    unsigned char *const bytes = read_bytes(path, &size);
    remove(path);
    for (size_t length = 0; length < size; length += length < 700 ? 1 : 37) {
        unsigned char *const exact = malloc(length > 0 ? length : 1); /* so that reading past it is seen */
        memcpy(exact, bytes, length);
        aur_image *read;
        aur_error error;
        assert_int_not_equal(aur_image_read_memory("cut.exr", length, exact, &read, &error), AUR_OK);
        assert_string_equal(error.file, "cut.exr");
        assert_null(read);
        free(exact);
    }
    free(bytes);
    aur_image_destroy(image);
}

static void test_shared_images(void **state) {
    (void)state;
    static const struct {
        const char *path;
        size_t width, height;
    } files[] = {{AUR_SOURCE_DIR "/../shared/scenes/cornell-box/TungstenRender.exr", 1024, 1024},
                 {AUR_SOURCE_DIR "/../shared/scenes/veach-mis/TungstenRender.exr", 1280, 720}};
    for (size_t i = 0; i < 2; ++i) {
        if (access(files[i].path, R_OK) != 0) {
            print_message("skipped: %s is not there\n", files[i].path);
            continue;
        }
        aur_image *const image = read_image(files[i].path);
        assert_int_equal(image->width, files[i].width);
        assert_int_equal(image->height, files[i].height);
        assert_int_equal(image->channel_count, 3);
        assert_string_equal(image->channel_names[0], "R");
        double mean[4];
        aur_error error;
        assert_success(aur_image_mean(image, mean, &error), &error);
        if (i == 0) { /* published figures for this image, to their digits */
            assert_near(mean[0], 0.1962, 1e-4);
            assert_near(mean[1], 0.1275, 1e-4);
            assert_near(mean[2], 0.0361, 1e-4);
        }
        aur_image_destroy(image);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_float_round_trip_is_exact),
        cmocka_unit_test(test_infinity_and_nan_survive),
        cmocka_unit_test(test_half_is_within_its_precision),
        cmocka_unit_test(test_same_image_same_bytes),
        cmocka_unit_test(test_names_are_checked),
        cmocka_unit_test(test_every_storage_and_compression),
        cmocka_unit_test(test_what_cannot_be_read_says_so),
        cmocka_unit_test(test_header_that_lies),
        cmocka_unit_test(test_every_truncation_is_an_error),
        cmocka_unit_test(test_long_names),
        cmocka_unit_test(test_shared_images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
