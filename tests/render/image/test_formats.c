/* PFM, HDR, PNG and JPEG: known bytes, round trips, and inconsistent files. */
#include <png.h>
#include <stb_image.h>
#include <stb_image_write.h>

#include "render/image/format.h"
#include "test_images.h"

static void assert_read_fails(const char *what, size_t size, const void *data, aur_result expected) {
    aur_image *image;
    aur_error error;
    unsigned char *const exact = malloc(size > 0 ? size : 1); /* so that reading past it is seen */
    memcpy(exact, data, size);
    const aur_result result = aur_image_read_memory(what, size, exact, &image, &error);
    free(exact);
    if (result != expected)
        print_error("%s: %s: %s\n", what, aur_result_string(result), result == AUR_OK ? "" : error.message);
    assert_int_equal(result, expected);
    assert_string_equal(error.file, what);
    assert_null(image);
}

static void test_pfm_bytes(void **state) {
    (void)state;
    /* 1.0f = 3f800000, 2.0f = 40000000; the bottom row is first. */
    static const char big[] = "Pf\n1 2\n1.0\n\x3f\x80\x00\x00\x40\x00\x00\x00";
    static const char little[] = "Pf 1\t2\r\n-1\n\x00\x00\x80\x3f\x00\x00\x00\x40";
    static const struct {
        const char *bytes;
        size_t size;
    } files[] = {{big, sizeof big - 1}, {little, sizeof little - 1}};
    for (size_t i = 0; i < 2; ++i) {
        aur_image *image;
        aur_error error;
        /* "\r\n" ends the word with one white space; the second one belongs to the next. */
        assert_success(aur_image_read_memory("x", files[i].size, files[i].bytes, &image, &error), &error);
        assert_int_equal(image->height, 2);
        assert_true(image->data[0] == 2.0f && image->data[1] == 1.0f);
        assert_string_equal(image->channel_names[0], "Y");
        aur_image_destroy(image);
    }
}

static void test_pfm_round_trip_is_exact(void **state) {
    (void)state;
    for (size_t channel_count = 1; channel_count <= 3; channel_count += 2) {
        aur_image *const image = random_image(7, 5, channel_count);
        image->data[0] = INFINITY;
        write_image(scratch(0, "x.pfm"), image, NULL);
        aur_image *const back = read_image(scratch(0, "x.pfm"));
        assert_same_image(image, back);
        aur_image_destroy(back);
        aur_image_destroy(image);
    }
    remove(scratch(0, "x.pfm"));
}

static void test_pfm_that_lies(void **state) {
    (void)state;
    static const char *const files[] = {
        "PF\n",
        "PF\n2",
        "PF\n2 2",
        "PF\n2 2\n1.0",
        "PF\n2 2\n1.0\n123",
        "PF\n-2 2\n1.0\n123456789012",
        "PF\n0 2\n1.0\n123456789012",
        "PF\n4294967295 4294967295\n1.0\n1234",
        "PF\n99999999999 1\n1.0\n1234",
        "PF\n1 1\n0\n123456789012",
        "PF\n1 1\nnan\n123456789012",
        "PF\n1 1\ninf\n123456789012",
        "PF\n1 1\n1.0x\n123456789012",
        "PF\n111111111111111111111111111111111111111111111111 1\n1.0\n123456789012",
        "PF\n30000 30000\n1.0\n123456789012",
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i)
        assert_read_fails(files[i], strlen(files[i]), files[i], AUR_ERROR_FORMAT);
}

/* RGBE has 8 bits for the largest channel: half a step is 1/512 of a power of two, at most 1/256 of the
 * channel. Zero, negative, NaN and infinite radiance are converted to representable values. */
static void test_hdr_round_trip(void **state) {
    (void)state;
    aur_image *const image = random_image(40, 30, 3);
    for (size_t i = 0; i < 9; ++i)
        image->data[i] = (float[]){0, -1, NAN, INFINITY, 0, 0, 255.9f, 255.9f, 0.1f}[i];
    write_image(scratch(0, "x.hdr"), image, NULL);
    aur_image *const back = read_image(scratch(0, "x.hdr"));
    assert_int_equal(back->width, 40);
    assert_int_equal(back->height, 30);
    assert_int_equal(back->channel_count, 3);
    for (size_t i = 0; i < 3; ++i)
        assert_true(back->data[i] == 0.0f);
    assert_true(back->data[3] == 255.0f / 256.0f * 0x1p127f);
    assert_near((double)back->data[6], 255.9, 0.5);
    double bias = 0.0;
    for (size_t p = 3; p < 40 * 30; ++p) {
        const float *const rgb = image->data + 3 * p;
        const float largest = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
        for (size_t c = 0; c < 3; ++c) {
            assert_near((double)back->data[3 * p + c], (double)rgb[c], (double)largest / 256.0);
            bias += (double)(back->data[3 * p + c] - rgb[c]);
        }
    }
    /* Rounding is unbiased: 3591 errors, each uniform within half a step of at most 1/64, have a standard
     * deviation below 1/64/sqrt(12)/sqrt(3591) = 7.5e-5 in the mean. Cutting off would be 2e-3 at least. */
    assert_near(bias / 3591.0, 0.0, 4e-4);
    aur_image_destroy(back);
    aur_image_destroy(image);
    remove(scratch(0, "x.hdr"));
}

/* All 256 values of PNG come back through linear light. */
static void test_png_round_trip(void **state) {
    (void)state;
    unsigned char values[256 * 3];
    for (size_t i = 0; i < sizeof values; ++i)
        values[i] = (unsigned char)(i < 256 ? i : (i * 7919) % 256);
    for (int count = 1; count <= 3; count += 2) {
        assert_true(stbi_write_png(scratch(0, "in.png"), 16, 16, count, values, 16 * count));
        aur_image *const image = read_image(scratch(0, "in.png"));
        assert_int_equal(image->channel_count, count);
        write_image(scratch(1, "out.png"), image, NULL);
        aur_image *const back = read_image(scratch(1, "out.png"));
        assert_same_image(image, back);
        /* stb, which reads nothing here, finds the same bytes. */
        int size[3];
        unsigned char *const out = stbi_load(scratch(1, "out.png"), &size[0], &size[1], &size[2], 0);
        assert_non_null(out);
        assert_true(size[0] == 16 && size[1] == 16 && size[2] == count);
        assert_memory_equal(out, values, 256 * (size_t)count);
        stbi_image_free(out);
        aur_image_destroy(back);
        aur_image_destroy(image);
    }
    remove(scratch(0, "in.png"));
    remove(scratch(1, "out.png"));
}

/* A smooth image comes back as displayed, within what quality 90 loses: no coefficient is rounded by more
 * than half of its quantum, the largest of which is 20, and slopes have few. */
static void jpegs_are_written_as_displayed(void **state) {
    (void)state;
    enum { WIDE = 40, HIGH = 24 };
    for (size_t count = 1; count <= 3; count += 2) {
        aur_image *image = NULL, *back;
        assert_int_equal(aur_image_create(WIDE, HIGH, count, &image, NULL), AUR_OK);
        for (size_t i = 0; i < WIDE * HIGH; ++i)
            for (size_t c = 0; c < count; ++c)
                image->data[i * count + c] =
                    (float)(0.5 * aur_srgb_decode(0.3 + (double)(i % WIDE + c * (i / WIDE)) / 256.0));
        const aur_image_write_options brighter = {.size = sizeof brighter, .exposure = 1.0f};
        write_image(scratch(0, "out.jpg"), image, &brighter);
        back = read_image(scratch(0, "out.jpg"));
        assert_true(back->width == WIDE && back->height == HIGH && back->channel_count == 3);
        double largest = 0.0;
        for (size_t i = 0; i < 3 * WIDE * HIGH; ++i) /* grey ones have three equal channels */
            largest = fmax(largest, fabs(aur_srgb_encode((double)back->data[i]) -
                                         aur_srgb_encode(2.0 * (double)image->data[count == 3 ? i : i / 3])));
        assert_true(largest < 10.0 / 255.0);
        aur_image_destroy(back);
        aur_image_destroy(image);
    }
    remove(scratch(0, "out.jpg"));
}

/* 16 bits, a palette with a transparent colour, and rows in seven passes, each written by libpng; the
 * checksum detects a changed byte. */
static void write_foreign_png(const char *path, int bits, int color, int interlace, const unsigned char *rows,
                              size_t row) {
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 4, 3, bits, color, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (color == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, (png_color[]){{255, 0, 0}, {0, 128, 255}}, 2);
        png_set_tRNS(png, info, (png_byte[]){255, 51}, 2, NULL);
    }
    png_write_info(png, info);
    png_set_packing(png);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass)
        for (size_t y = 0; y < 3; ++y)
            png_write_row(png, rows + y * row);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static void test_png_of_others(void **state) {
    (void)state;
    unsigned char rows[4 * 3 * 4];
    for (size_t i = 0; i < sizeof rows; ++i)
        rows[i] = (unsigned char)(i * 37 + 11);
    for (int interlace = PNG_INTERLACE_NONE; interlace <= PNG_INTERLACE_ADAM7; ++interlace) {
        write_foreign_png(scratch(0, "x.png"), 16, PNG_COLOR_TYPE_GRAY_ALPHA, interlace, rows, 16);
        aur_image *const image = read_image(scratch(0, "x.png"));
        assert_int_equal(image->channel_count, 2);
        for (size_t i = 0; i < 24; ++i) {
            const double value = (rows[2 * i] * 256 + rows[2 * i + 1]) / 65535.0;
            const double expected = i % 2 == 1 ? value : aur_srgb_decode(value);
            assert_near((double)image->data[i], expected, 1e-7); /* rounded to a float once */
        }
        aur_image_destroy(image);
        for (size_t i = 0; i < 12; ++i)
            rows[i] = i % 5 == 0;
        write_foreign_png(scratch(0, "x.png"), 1, PNG_COLOR_TYPE_PALETTE, interlace, rows, 4);
        aur_image *const painted = read_image(scratch(0, "x.png"));
        assert_int_equal(painted->channel_count, 4);
        for (size_t i = 0; i < 12; ++i) {
            const bool second = i % 5 == 0;
            const double expected[] = {second ? 0 : 1, second ? 0.21586050011389926 : 0, second ? 1 : 0,
                                       second ? 0.2 : 1};
            for (size_t c = 0; c < 4; ++c)
                assert_near((double)painted->data[4 * i + c], expected[c], 1e-7);
        }
        aur_image_destroy(painted);
    }
    size_t size;
    unsigned char *const bytes = read_bytes(scratch(0, "x.png"), &size);
    static const size_t offsets[] = {18, 45}; /* in the size, and in the palette */
    for (size_t i = 0; i < 2; ++i) {
        bytes[offsets[i]] ^= 1;
        assert_read_fails("damaged", size, bytes, AUR_ERROR_FORMAT);
        bytes[offsets[i]] ^= 1;
    }
    bytes[size - 20] ^= 1; /* in the pixels or their checksum */
    assert_read_fails("damaged", size, bytes, AUR_ERROR_FORMAT);
    free(bytes);
    remove(scratch(0, "x.png"));
}

/* A white pixel in a file with a colour space; the values are interpreted as sRGB regardless. */
static void write_white_png(const char *path, double gamma, const double *primaries, bool srgb) {
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 1, 1, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (srgb)
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (gamma > 0.0)
        png_set_gAMA(png, info, gamma);
    if (primaries != NULL)
        png_set_cHRM(png, info, primaries[0], primaries[1], primaries[2], primaries[3], primaries[4],
                     primaries[5], primaries[6], primaries[7]);
    png_write_info(png, info);
    png_write_row(png, (const png_byte[]){255, 255, 255});
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static void test_png_of_other_colours(void **state) {
    (void)state;
    static const double rec709[] = {0.3127, 0.329, 0.64, 0.33, 0.3, 0.6, 0.15, 0.06};
    static const double p3[] = {0.3127, 0.329, 0.68, 0.32, 0.265, 0.69, 0.15, 0.06};
    static const double d50[] = {0.3457, 0.3585, 0.64, 0.33, 0.3, 0.6, 0.15, 0.06};
    static const struct {
        double gamma;
        const double *primaries;
        bool srgb;
        const char *note;
    } cases[] = {{0.0, NULL, false, ""},
                 {0.45455, rec709, false, ""},
                 {0.45455, rec709, true, ""},
                 {1.0, NULL, false, "its gamma of 1 is not applied"},
                 {0.55556, rec709, false, "its gamma of 0.55556 is not applied"},
                 {0.45455, p3, false, "its chromaticities are not those of Rec. 709"},
                 {0.0, d50, false, "its chromaticities are not those of Rec. 709"},
                 {1.0, p3, false, "its gamma of 1 is not applied"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        write_white_png(scratch(0, "x.png"), cases[i].gamma, cases[i].primaries, cases[i].srgb);
        aur_image *const image = read_image(scratch(0, "x.png"));
        const char *const notes = aur_image_notes(image);
        assert_true(cases[i].note[0] == '\0' ? notes[0] == '\0' : strstr(notes, cases[i].note) != NULL);
        aur_image_destroy(image);
    }
    remove(scratch(0, "x.png"));
}

/* A smooth image with noise of four levels, as a renderer makes them: a quarter below what stb needs. Its
 * noise alone is two bits a value. */
static void test_png_is_small(void **state) {
    (void)state;
    enum { SIDE = 128, COUNT = SIDE * SIDE * 3 };
    unsigned char *const values = malloc(COUNT);
    aur_image *const image = random_image(SIDE, SIDE, 3);
    for (size_t i = 0; i < COUNT; ++i) {
        const size_t x = i / 3 % SIDE, y = i / 3 / SIDE;
        values[i] = (unsigned char)((x * x + y * y) / 160 + (size_t)image->data[i]);
        image->data[i] = (float)aur_srgb_decode(values[i] / 255.0);
    }
    assert_true(stbi_write_png(scratch(0, "stb.png"), SIDE, SIDE, 3, values, 3 * SIDE));
    write_image(scratch(1, "own.png"), image, NULL);
    size_t size_stb, size_checksum;
    free(read_bytes(scratch(0, "stb.png"), &size_stb));
    free(read_bytes(scratch(1, "own.png"), &size_checksum));
    print_message("%zu bytes by stb, %zu here\n", size_stb, size_checksum);
    assert_true(size_checksum > COUNT * 2 / 8 && 4 * size_checksum < 3 * size_stb);
    free(values);
    aur_image_destroy(image);
    remove(scratch(0, "stb.png"));
    remove(scratch(1, "own.png"));
}

/* IEC 61966-2-1: 0 and 255 are 0 and 1; 10/255 is on the straight part, 128/255 is
 * ((128/255 + 0.055) / 1.055)^2.4. Alpha stays as it is. */
static void test_png_is_decoded_from_srgb(void **state) {
    (void)state;
    static const unsigned char values[] = {0, 10, 128, 128, 255, 0, 0, 64};
    assert_true(stbi_write_png(scratch(0, "x.png"), 2, 1, 4, values, 8));
    aur_image *const image = read_image(scratch(0, "x.png"));
    assert_string_equal(image->channel_names[3], "A");
    static const double expected[] = {0, 10.0 / 255.0 / 12.92, 0.21586050011389926, 128.0 / 255.0, 1, 0,
                                      0, 64.0 / 255.0};
    for (size_t i = 0; i < 8; ++i)
        assert_near((double)image->data[i], expected[i], 1e-7);
    aur_image_destroy(image);
    remove(scratch(0, "x.png"));
}

/* Radiance beyond the screen, NaN and exposure. */
static void test_png_of_any_radiance(void **state) {
    (void)state;
    aur_image *const image = random_image(6, 1, 1);
    for (size_t i = 0; i < 6; ++i)
        image->data[i] = (float[]){NAN, INFINITY, -INFINITY, -3.0f, 1e30f, 0.5f}[i];
    write_image(scratch(0, "x.png"), image,
                &(aur_image_write_options){.size = sizeof(aur_image_write_options), .exposure = 1.0f});
    aur_image *const back = read_image(scratch(0, "x.png"));
    for (size_t i = 0; i < 6; ++i)
        assert_true(back->data[i] == ((float[]){0, 1, 0, 0, 1, 1})[i]);
    aur_image_destroy(back);
    aur_image_destroy(image);
    remove(scratch(0, "x.png"));
}

static void put(void *context, void *data, int size) {
    fwrite(data, 1, (size_t)size, context);
}

static void test_jpeg_is_read(void **state) {
    (void)state;
    unsigned char grey[32 * 32];
    memset(grey, 128, sizeof grey);
    FILE *const file = fopen(scratch(0, "x.jpg"), "wb");
    assert_non_null(file);
    assert_true(stbi_write_jpg_to_func(put, file, 32, 32, 1, grey, 95));
    fclose(file);
    aur_image *const image = read_image(scratch(0, "x.jpg"));
    assert_int_equal(image->width, 32);
    for (size_t i = 0; i < 32 * 32 * image->channel_count; ++i) /* one step of 8 bits */
        assert_near((double)image->data[i], 0.2158605, 0.008);
    aur_image_destroy(image);
    aur_error error;
    aur_image *const black = random_image(1, 1, 3);
    assert_int_equal(aur_image_write(scratch(0, "y.gif"), black, NULL, &error), AUR_ERROR_NAME);
    aur_image_destroy(black);
}

/* Every file cut short at every length is an error. */
static void check_truncations(const char *path, size_t step) {
    size_t size;
    unsigned char *const bytes = read_bytes(path, &size);
    for (size_t length = 0; length + 16 < size; length += length < 100 ? 1 : step)
        assert_read_fails("cut", length, bytes, AUR_ERROR_FORMAT);
    free(bytes);
}

static void test_truncations(void **state) {
    (void)state;
    aur_image *const image = random_image(40, 33, 3);
    static const char *const names[] = {"x.pfm", "x.hdr", "x.png"};
    for (size_t i = 0; i < 3; ++i) {
        write_image(scratch(0, names[i]), image, NULL);
        check_truncations(scratch(0, names[i]), 61);
        remove(scratch(0, names[i]));
    }
    aur_image_destroy(image);
    check_truncations(scratch(0, "x.jpg"), 7); /* left by the test before */
    remove(scratch(0, "x.jpg"));
}

/* Headers that claim far more pixels than the file can hold must cost no memory. */
static void test_headers_that_lie(void **state) {
    (void)state;
    static const char hdr[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n\x02\x02\x75\x30";
    static const char hdr_huge[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000000 +X 16000000\n\x02\x02";
    /* IHDR 20000 x 20000, 8 bits, RGB, with its checksum; then an empty IDAT and IEND. */
    static const char png[] = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x4e\x20\0\0\x4e\x20\x08\x02\0\0\0\0\0\0\0"
                              "\0\0\0\0IDAT\x35\xaf\x06\x1e\0\0\0\0IEND\xae\x42\x60\x82";
    assert_read_fails("hdr", sizeof hdr - 1, hdr, AUR_ERROR_FORMAT);
    assert_read_fails("huge hdr", sizeof hdr_huge - 1, hdr_huge, AUR_ERROR_FORMAT);
    assert_read_fails("png", sizeof png - 1, png, AUR_ERROR_FORMAT);
    assert_read_fails("text", 13, "not an image", AUR_ERROR_FORMAT);
    assert_read_fails("empty", 0, "", AUR_ERROR_FORMAT);
}

static void test_formats_are_detected_by_content(void **state) {
    (void)state;
    aur_image *const image = random_image(4, 4, 3);
    static const char *const formats[][2] = {{"exr", "EXR"}, {"pfm", "PFM"}, {"hdr", "HDR"}, {"png", "PNG"}};
    for (size_t i = 0; i < 4; ++i) {
        const char *const path = scratch(0, "no-extension");
        write_image(
            path, image,
            &(aur_image_write_options){.size = sizeof(aur_image_write_options), .format = formats[i][0]});
        size_t size;
        unsigned char *const bytes = read_bytes(path, &size);
        assert_string_equal(aur_image_format_of(size, bytes), formats[i][1]);
        free(bytes);
        aur_image_destroy(read_image(path));
        remove(path);
    }
    assert_null(aur_image_format_of(5, "<?xml"));
    aur_image_destroy(image);
}

static void test_writing_fails_whole(void **state) {
    (void)state;
    aur_error error;
    aur_image *const image = random_image(4, 4, 5);
    static const char *const names[] = {"x.pfm", "x.hdr", "x.png"};
    for (size_t i = 0; i < 3; ++i) { /* five channels, none of them a colour */
        FILE *const file = fopen(scratch(0, names[i]), "wb");
        assert_non_null(file);
        fputs("precious", file);
        fclose(file);
        assert_int_equal(aur_image_write(scratch(0, names[i]), image, NULL, &error), AUR_ERROR_ARGUMENT);
        size_t size;
        unsigned char *const bytes = read_bytes(scratch(0, names[i]), &size);
        assert_int_equal(size, 8);
        assert_memory_equal(bytes, "precious", 8);
        free(bytes);
        remove(scratch(0, names[i]));
    }
    assert_int_equal(aur_image_write("no/such/folder.exr", image, NULL, &error), AUR_ERROR_WRITE);
    assert_int_equal(aur_image_write("picture.gif", image, NULL, &error), AUR_ERROR_NAME);
    assert_int_equal(aur_image_write("picture", image, NULL, &error), AUR_ERROR_NAME);
    assert_int_equal(aur_image_write("folder.exr/picture", image, NULL, &error), AUR_ERROR_NAME);
    aur_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pfm_bytes),
        cmocka_unit_test(test_pfm_round_trip_is_exact),
        cmocka_unit_test(test_pfm_that_lies),
        cmocka_unit_test(test_hdr_round_trip),
        cmocka_unit_test(test_png_round_trip),
        cmocka_unit_test(jpegs_are_written_as_displayed),
        cmocka_unit_test(test_png_of_others),
        cmocka_unit_test(test_png_of_other_colours),
        cmocka_unit_test(test_png_is_small),
        cmocka_unit_test(test_png_is_decoded_from_srgb),
        cmocka_unit_test(test_png_of_any_radiance),
        cmocka_unit_test(test_jpeg_is_read),
        cmocka_unit_test(test_truncations),
        cmocka_unit_test(test_headers_that_lie),
        cmocka_unit_test(test_formats_are_detected_by_content),
        cmocka_unit_test(test_writing_fails_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
