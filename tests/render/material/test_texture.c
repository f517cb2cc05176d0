#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "render/image/format.h"
#include "render/scene/materials/texture.h"

/* 2 x 2: red, green / blue, white. */
static const float colors[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

static char path[64];

static int write_image(const char *ending) {
    snprintf(path, sizeof path, "/tmp/aureole-texture-%d.%s", (int)getpid(), ending);
    aur_image *image;
    if (aur_image_create(2, 2, 3, &image, NULL) != AUR_OK)
        return -1;
    memcpy(image->data, colors, sizeof colors);
    const aur_result result = aur_image_write(path, image, NULL, NULL);
    aur_image_destroy(image);
    return result;
}

static aur_texture *make(const char *keys) {
    char text[256];
    snprintf(text, sizeof text, keys, path);
    aur_parameters parameters;
    aur_error error = {0};
    aur_texture *texture;
    assert_int_equal(aur_parameters_parse(&parameters, "texture", text, &error), AUR_OK);
    if (aur_texture_create(&parameters, NULL, &texture, &error) != AUR_OK)
        fail_msg("%s", error.message);
    aur_parameters_release(&parameters);
    return texture;
}

static void expect(const char *keys, float u, float v, double r, double g, double b) {
    aur_texture *const texture = make(keys);
    const aur_vector color = texture->descriptor->evaluate(texture, (aur_bsdf_point){.u = u, .v = v});
    assert_near(color.x, r, 1e-6);
    assert_near(color.y, g, 1e-6);
    assert_near(color.z, b, 1e-6);
    aur_texture_destroy(texture);
}

static void reads_images(void **state) {
    (void)state;
    static const char *const endings[] = {"pfm", "exr", "png"};
    for (size_t i = 0; i < 3; ++i) {
        assert_int_equal(write_image(endings[i]), AUR_OK);
        expect("bitmap:filename=%s,filter_type=nearest", 0.25f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s,filter_type=nearest", 0.75f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s,filter_type=nearest", 0.25f, 0.75f, 0, 0, 1);
        expect("bitmap:filename=%s,filter_type=nearest,uscale=2", 0.3f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s,filter_type=nearest,uoffset=0.5", 0.25f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s", 0.25f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s", 0.375f, 0.25f, 0.75, 0.25, 0);
        expect("bitmap:filename=%s", 0.0f, 0.25f, 0.5, 0.5, 0);
        expect("bitmap:filename=%s,wrap_mode=clamp", 0.0f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s,wrap_mode=clamp", 7.0f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s,wrap_mode=mirror", -0.25f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s,wrap_mode=repeat", -0.25f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s,filter_type=nearest,uoffset=3e9", 0.25f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s,filter_type=nearest,wrap_mode=mirror,uoffset=-3", 0.25f, 0.25f, 0, 1, 0);
        expect("bitmap:filename=%s,filter_type=nearest,wrap_mode=mirror,uoffset=-3e9", 0.25f, 0.25f, 1, 0, 0);
        expect("bitmap:filename=%s,wrap_mode=repeat", 1e30f, 0.25f, 0, 0, 0);
        aur_texture *const texture = make("bitmap:filename=%s");
        assert_near(texture->mean.x, 0.5, 1e-6);
        assert_near(texture->mean.z, 0.5, 1e-6);
        assert_near(texture->maximum, 1.0, 1e-6);
        aur_texture_destroy(texture);
        unlink(path);
    }
}

static void checks(void **state) {
    (void)state;
    expect("checkerboard:color0=0.8,color1=0.1", 0.25f, 0.25f, 0.8, 0.8, 0.8);
    expect("checkerboard:color0=0.8,color1=0.1", 0.75f, 0.25f, 0.1, 0.1, 0.1);
    expect("checkerboard:color0=0.8,color1=0.1", -0.75f, 5.75f, 0.1, 0.1, 0.1);
    expect("checkerboard:color0=0.8,color1=0.1,uscale=4", 0.1875f, 0.25f, 0.1, 0.1, 0.1);
    expect("checkerboard", 0.1f, 0.1f, 0.4, 0.4, 0.4);
    expect("gridtexture", 0.5f, 0.5f, 0.2, 0.2, 0.2);
    expect("gridtexture", 0.5f, -2.005f, 0.4, 0.4, 0.4);
    expect("gridtexture:color0=0.7,line_width=0.2", 1.15f, 0.5f, 0.4, 0.4, 0.4);
    expect("gridtexture:color0=0.7,line_width=0.2", 1.25f, 0.75f, 0.7, 0.7, 0.7);
    aur_texture *const grid = make("gridtexture:color0=0.7,color1=0,line_width=0.1");
    assert_near(grid->mean.x, 0.7 * 0.8 * 0.8, 1e-6);
    aur_texture_destroy(grid);
    expect("scale:value=0.8,scale=0.5 1 2", 0.3f, 0.1f, 0.4, 0.8, 1.6);
}

static void says_what_is_wrong(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"bitmap", "needs the string 'filename'"},
        {"bitmap:filename=/nowhere.png", "cannot"},
        {"bitmap:filename=x,wrap_mode=tile", "must be one of repeat, mirror, clamp"},
        {"checkerboard:color2=1", "has no 'color2'; did you mean"},
        {"chequerboard", "did you mean 'checkerboard'?"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_parameters parameters;
        aur_error error = {0};
        aur_texture *texture;
        assert_int_equal(aur_parameters_parse(&parameters, "texture", rows[i][0], &error), AUR_OK);
        assert_int_not_equal(aur_texture_create(&parameters, NULL, &texture, &error), AUR_OK);
        if (strstr(error.message, rows[i][1]) == NULL)
            fail_msg("%s: %s", rows[i][0], error.message);
        aur_parameters_release(&parameters);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_images),
        cmocka_unit_test(checks),
        cmocka_unit_test(says_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
