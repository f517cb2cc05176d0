/* Selection of colour channels, by name and never by order; luminance and chroma; HDR headers' descriptions
 * of the values. */
#include <math.h>

#include "hand_exr.h"
#include "test_images.h"

enum { WIDTH = 16, HEIGHT = 12 };

static float red(size_t x, size_t y) {
    return 1.0f + (float)x / 16.0f + 0.0f * (float)y;
}

static float green(size_t x, size_t y) {
    return 2.0f + (float)y / 16.0f + 0.0f * (float)x;
}

static float blue(size_t x, size_t y) {
    return 0.5f + (float)(x + y) / 32.0f;
}

static aur_image *must_read(const char *name, hand_file file) {
    aur_image *image;
    aur_error error;
    assert_success(aur_image_read_memory(name, file.size, file.bytes, &image, &error), &error);
    free(file.bytes);
    return image;
}

/* A file with these channel names; the letters of `values` select each one's value. */
static aur_image *named(const char *const *names, const char *values, int type) {
    hand_channel channels[8];
    const size_t count = strlen(values);
    for (size_t c = 0; c < count; ++c)
        channels[c] = (hand_channel){names[c],
                                     type,
                                     {1, 1},
                                     values[c] == 'r'   ? red
                                     : values[c] == 'g' ? green
                                                        : blue};
    return must_read("names.exr", hand_exr(WIDTH, HEIGHT, count, channels));
}

static void finds_colors_by_name(void **state) {
    (void)state;
    static const struct {
        const char *names[8], *values;
        char first; /* the value of the red channel: 'r', 'g' for grey, or 0 for a refusal */
    } files[] = {
        {{"B", "G", "R"}, "bgr", 'r'},
        {{"b", "g", "r"}, "bgr", 'r'},
        {{"blue", "green", "red"}, "bgr", 'r'},
        {{"Blue", "Green", "RED"}, "bgr", 'r'},
        {{"A", "B", "G", "R", "Z", "ZBack"}, "gbgrgg", 'r'},
        {{"diffuse.B", "diffuse.G", "diffuse.R"}, "bgr", 'r'},
        {{"diffuse.b", "diffuse.g", "diffuse.r"}, "bgr", 'r'},
        {{"d.blue", "d.green", "d.red"}, "bgr", 'r'},
        {{".B", ".G", ".R"}, "bgr", 'r'},
        {{"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G", "ViewLayer.Combined.R"},
         "gbgr",
         'r'},
        {{"V.Combined.B", "V.Combined.G", "V.Combined.R", "V.Glow.B", "V.Glow.G", "V.Glow.R"}, "bgrggg", 'r'},
        {{"B", "G", "R", "d.B", "d.G", "d.R"}, "bgrggg", 'r'},
        {{"N.X", "N.Y", "N.Z", "d.B", "d.G", "d.R"}, "gggbgr", 'r'},
        {{"Y"}, "g", 'g'},
        {{"y"}, "g", 'g'},
        {{"A", "Y", "Z"}, "rgb", 'g'},
        {{"height"}, "g", 'g'},
        {{"d.Y"}, "g", 'g'},
        {{"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"}, "bgrbgr", 0},
        {{"H", "S", "V"}, "rgb", 0},
        {{"A", "Z", "ZBack"}, "rgb", 0},
        {{"Z"}, "r", 0},
        {{"A"}, "r", 0},
        {{"ZBack"}, "r", 0},
        {{"N.X", "N.Y", "N.Z"}, "rgb", 0},
        {{"u", "v", "w"}, "rgb", 0},
        {{"G", "R"}, "gr", 0},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        aur_image *const image = named(files[i].names, files[i].values, 1 + (int)(i % 2));
        size_t channels[3];
        aur_error error;
        const bool found = aur_image_color_channels(image, channels);
        assert_int_equal(found, files[i].first != 0);
        for (size_t k = 0; found && k < 3; ++k) {
            const float expected = files[i].first == 'g' || k == 1 ? green(3, 5)
                                   : k == 0                        ? red(3, 5)
                                                                   : blue(3, 5);
            assert_true(image->data[(5 * WIDTH + 3) * image->channel_count + channels[k]] == expected);
        }
        if (!found) {
            assert_int_equal(aur_image_write(scratch(0, "x.pfm"), image, NULL, &error), AUR_ERROR_ARGUMENT);
            assert_non_null(strstr(error.message, "--channels"));
            assert_non_null(strstr(error.message, files[i].names[0]));
        }
        aur_image_destroy(image);
    }
}

/* Channels selected by the caller are the colour, whatever their names, in the caller's order. */
static void takes_chosen_channels(void **state) {
    (void)state;
    aur_image *const image = named((const char *const[]){"N.X", "N.Y", "N.Z"}, "rgb", 2);
    static const char *const chosen[] = {"N.Z", "N.X", "N.Y"};
    for (size_t count = 1; count <= 3; ++count) {
        aur_image *some;
        aur_error error;
        size_t channels[3] = {9, 9, 9};
        assert_success(aur_image_select(image, count, chosen, &some, &error), &error);
        assert_int_equal(aur_image_color_channels(some, channels), count != 2);
        for (size_t k = 0; k < 3 && count != 2; ++k)
            assert_int_equal(channels[k], count == 1 ? 0 : k);
        aur_image_destroy(some);
    }
    aur_image_destroy(image);
}

static float luminance(size_t x, size_t y) {
    return 0.212639f * red(x, y) + 0.7151687f * green(x, y) + 0.0721923f * blue(x, y);
}

static float red_chroma(size_t x, size_t y) {
    return red(x, y) / luminance(x, y) - 1.0f;
}

static float blue_chroma(size_t x, size_t y) {
    return blue(x, y) / luminance(x, y) - 1.0f;
}

/* Colours are exact where chroma is stored; in between they are those of a smooth function to the size of its
 * oscillations. */
static void reads_luminance_and_chroma(void **state) {
    (void)state;
    static const size_t steps[][2] = {{1, 1}, {2, 2}, {2, 1}, {1, 2}, {4, 4}};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; ++i) {
        const size_t sx = steps[i][0], sy = steps[i][1];
        const hand_channel channels[] = {{"BY", 2, {sx, sy}, blue_chroma},
                                         {"RY", 2, {sx, sy}, red_chroma},
                                         {"Y", 2, {1, 1}, luminance},
                                         {"Z", 1, {sx, sy}, green}};
        aur_image *const image = must_read("chroma.exr", hand_exr(WIDTH, HEIGHT, 4, channels));
        for (size_t c = 0; c < 4; ++c)
            assert_string_equal(image->channel_names[c], ((const char *const[]){"R", "G", "B", "Z"})[c]);
        for (size_t y = 0; y < HEIGHT; ++y)
            for (size_t x = 0; x < WIDTH; ++x) {
                const float *const at = image->data + (y * WIDTH + x) * 4;
                const bool beyond = x + sx > WIDTH || y + sy > HEIGHT; /* the last sample */
                const double allowed = x % sx == 0 && y % sy == 0 ? 1e-6 : beyond ? 0.3 : 0.05;
                assert_near(at[0], red(x, y), allowed);
                assert_near(at[1], green(x, y), allowed);
                assert_near(at[2], blue(x, y), allowed);
                assert_true(at[3] == green(x - x % sx, y - y % sy)); /* no chroma: lasts until the next */
            }
        aur_image_destroy(image);
    }
}

static void converts_xyz(void **state) {
    (void)state;
    aur_image *const image = named((const char *const[]){"X", "Y", "Z"}, "rgb", 2);
    assert_string_equal(image->channel_names[0], "R");
    assert_non_null(strstr(aur_image_notes(image), "XYZ"));
    /* Back by the matrix of IEC 61966-2-1. */
    const float *const rgb = image->data;
    assert_near(0.4124f * rgb[0] + 0.3576f * rgb[1] + 0.1805f * rgb[2], red(0, 0), 1e-3);
    assert_near(0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2], green(0, 0), 1e-3);
    assert_near(0.0193f * rgb[0] + 0.1192f * rgb[1] + 0.9505f * rgb[2], blue(0, 0), 1e-3);
    aur_image_destroy(image);
}

/* OpenEXR's C library exchanges channels of B44 where none is of 16 bits; with one that is, it does not. */
static void refuses_b44_of_floats(void **state) {
    (void)state;
    static const char attribute[] = "compression\0compression\0\1\0\0";
    for (int type = 1; type <= 2; ++type) {
        const hand_channel channels[] = {
            {"B", 2, {1, 1}, blue}, {"G", type, {1, 1}, green}, {"R", 2, {1, 1}, red}};
        hand_file file = hand_exr(WIDTH, HEIGHT, 3, channels);
        size_t at = 0;
        while (memcmp(file.bytes + at, attribute, sizeof attribute) != 0)
            ++at;
        file.bytes[at + sizeof attribute] = 6;
        aur_image *image;
        aur_error error = {0};
        aur_image_read_memory("b44.exr", file.size, file.bytes, &image, &error);
        assert_int_equal(strstr(error.message, "B44") != NULL, type == 2);
        aur_image_destroy(image);
        free(file.bytes);
    }
}

/* --- HDR */

static aur_image *read_hdr_text(const char *header, const char *size, size_t count, const void *pixels) {
    char bytes[2048];
    const int used = snprintf(bytes, 1024, "#?RADIANCE\n%s\n%s\n", header, size);
    memcpy(bytes + used, pixels, count);
    aur_image *image;
    aur_error error;
    assert_success(aur_image_read_memory("x.hdr", (size_t)used + count, bytes, &image, &error), &error);
    return image;
}

#define RGBE "FORMAT=32-bit_rle_rgbe\n"

/* Value 128 with exponent 129 is 1; the red of pixel (x, y) encodes its position. */
static void reads_every_scan_order(void **state) {
    (void)state;
    static const char *const orders[] = {"-Y 2 +X 3", "+Y 2 +X 3", "-Y 2 -X 3", "+Y 2 -X 3",
                                         "+X 3 -Y 2", "-X 3 -Y 2", "+X 3 +Y 2", "-X  3   +Y        2"};
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; ++i) {
        unsigned char pixels[6][4];
        const char *const order = orders[i];
        const bool columns = order[1] == 'X';
        const bool left = strstr(order, "-X") != NULL, up = strstr(order, "+Y") != NULL;
        for (size_t k = 0; k < 6; ++k) {
            size_t x = columns ? k / 2 : k % 3, y = columns ? k % 2 : k / 3;
            x = left ? 2 - x : x;
            y = up ? 1 - y : y;
            memcpy(pixels[k],
                   (unsigned char[]){(unsigned char)(128 + 8 * x), (unsigned char)(128 + 16 * y), 0, 129}, 4);
        }
        aur_image *const image = read_hdr_text(RGBE, order, sizeof pixels, pixels);
        assert_int_equal(aur_image_width(image), 3);
        assert_int_equal(aur_image_height(image), 2);
        for (size_t p = 0; p < 6; ++p) {
            assert_true(image->data[3 * p] == (float)(128 + 8 * (p % 3)) / 128.0f);
            assert_true(image->data[3 * p + 1] == (float)(128 + 16 * (p / 3)) / 128.0f);
        }
        aur_image_destroy(image);
    }
}

static void divides_by_exposure(void **state) {
    (void)state;
    static const unsigned char pixel[4] = {128, 192, 255, 132}; /* 8, 12, 15.9375 */
    static const struct {
        const char *header;
        double red, green, blue;
        bool note;
    } files[] = {
        {RGBE, 8, 12, 15.9375, false},
        {RGBE "EXPOSURE=2\nEXPOSURE= 4.0\n", 1, 1.5, 15.9375 / 8, false},
        {"EXPOSURE=.5\nCOLORCORR= 2 4 .25\n" RGBE, 8, 6, 127.5, false},
        {RGBE "EXPOSURE=1e-2\r\nVIEW= -vp 0 0 0\n", 800, 1200, 1593.75, false},
        {"FORMAT= 32-bit_rle_rgbe\nPRIMARIES= .64 .33 .29 .60 .15 .06 .333 .333\n", 8, 12, 15.9375, false},
        {RGBE "PRIMARIES= .7 .29 .17 .79 .13 .05 .3127 .329\n", 8, 12, 15.9375, true},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        aur_image *const image = read_hdr_text(files[i].header, "-Y 1 +X 1", 4, pixel);
        assert_near(image->data[0], files[i].red, 1e-6 * files[i].red);
        assert_near(image->data[1], files[i].green, 1e-6 * files[i].green);
        assert_near(image->data[2], files[i].blue, 1e-6 * files[i].blue);
        assert_int_equal(strstr(aur_image_notes(image), "PRIMARIES") != NULL, files[i].note);
        aur_image_destroy(image);
    }
    aur_image *image;
    aur_error error;
    static const char bad[] = "#?RADIANCE\n" RGBE "EXPOSURE=0\n\n-Y 1 +X 1\nabcd";
    assert_int_equal(aur_image_read_memory("x.hdr", sizeof bad - 1, bad, &image, &error), AUR_ERROR_FORMAT);
}

/* ra_xyze of Radiance: a file of XYZE has 179 times the radiance. White of equal energy is white there. */
static void reads_xyze(void **state) {
    (void)state;
    static const unsigned char pixels[8] = {179, 179, 179, 136, 150, 179, 120, 137};
    aur_image *const image = read_hdr_text("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 2", 8, pixels);
    for (size_t c = 0; c < 3; ++c)
        assert_near(image->data[c], 1.0, 1e-6);
    /* Back by the chromaticities of Radiance's primaries. */
    const double x[3] = {0.51414462, 0.32388448, 0.1619709}, y[3] = {0.26510582, 0.67010582, 0.06478836};
    double sum[2] = {0.0, 0.0};
    for (size_t c = 0; c < 3; ++c) {
        sum[0] += x[c] * (double)image->data[3 + c];
        sum[1] += y[c] * (double)image->data[3 + c];
    }
    assert_near(sum[0], 300.0 / 179.0, 1e-6);
    assert_near(sum[1], 2.0, 1e-6);
    aur_image_destroy(image);
}

/* A run of 1, 1, 1, n repeats the pixel before; one more at once counts 256 times as much. */
static void reads_old_runs(void **state) {
    (void)state;
    static const unsigned char bytes[] = {128, 0, 0, 129, 1,   1, 1, 4,   0, 128, 0, 129, 1, 1, 1, 2,
                                          1,   1, 1, 1,   128, 0, 0, 130, 1, 1,   1, 7,   9, 0, 0, 136};
    aur_image *const image = read_hdr_text(RGBE, "-Y 1 +X 273", sizeof bytes, bytes);
    for (size_t x = 0; x < 273; ++x) {
        assert_true(image->data[3 * x] == (x < 5 ? 1.0f : x < 264 ? 0.0f : x < 272 ? 2.0f : 9.0f));
        assert_true(image->data[3 * x + 1] == (x >= 5 && x < 264 ? 1.0f : 0.0f));
    }
    aur_image_destroy(image);
    static const unsigned char wrong[][12] = {{1, 1, 1, 4, 128, 0, 0, 129}, {128, 0, 0, 129, 1, 1, 1, 9}};
    for (size_t i = 0; i < 2; ++i) {
        char file[128];
        const int used = snprintf(file, sizeof file, "#?RADIANCE\n" RGBE "\n-Y 1 +X 5\n");
        memcpy(file + used, wrong[i], 12);
        aur_image *none;
        aur_error error;
        assert_int_equal(aur_image_read_memory("x.hdr", (size_t)used + 12, file, &none, &error),
                         AUR_ERROR_FORMAT);
    }
}

static void counts_odd_values(void **state) {
    (void)state;
    aur_image *const image = random_image(4, 4, 3);
    image->data[0] = image->data[3] = INFINITY;
    image->data[6] = NAN;
    image->data[9] = -1.0f;
    image->data[12] = -INFINITY;
    image->data[15] = -0.0f;
    image->data[1] = NAN;
    size_t found[3] = {0, 0, 0};
    aur_image_count_odd(image, 0, found);
    assert_int_equal(found[0], 2);
    assert_int_equal(found[1], 1);
    assert_int_equal(found[2], 2);
    aur_image_count_odd(image, 7, found);
    assert_int_equal(found[0] + found[1] + found[2], 5);
    aur_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_colors_by_name),
                                       cmocka_unit_test(takes_chosen_channels),
                                       cmocka_unit_test(reads_luminance_and_chroma),
                                       cmocka_unit_test(converts_xyz),
                                       cmocka_unit_test(refuses_b44_of_floats),
                                       cmocka_unit_test(reads_every_scan_order),
                                       cmocka_unit_test(divides_by_exposure),
                                       cmocka_unit_test(reads_xyze),
                                       cmocka_unit_test(reads_old_runs),
                                       cmocka_unit_test(counts_odd_values)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
