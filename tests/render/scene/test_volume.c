/* Grid volumes: Mitsuba's values at the same points, invalid input, and no value above the majorant of its
 * cell, along rays too. */
#include "render/scene/scene_text.h"
#include "render/scene/vol_file.h"

#include "points/base/random.h"
#include "render/scene/media/majorants.h"

static const aur_location nowhere = {.file = "test", .line = 1};

/* A gridvolume of a file that is written; `more` is up to two keys and values, ended by NULL. */
static aur_result make(size_t size, const char *bytes, const char *const *more, aur_volume **volume,
                       aur_error *error) {
    aur_parameters parameters;
    assert_int_equal(aur_parameters_init(&parameters, "volume", "gridvolume", nowhere, NULL), AUR_OK);
    assert_int_equal(aur_parameters_add_text(&parameters, AUR_PARAMETER_STRING, "filename",
                                             write_file("g.vol", bytes, size), nowhere, NULL),
                     AUR_OK);
    for (; more != NULL && *more != NULL; more += 2)
        assert_int_equal(
            aur_parameters_add_text(&parameters, AUR_PARAMETER_TEXT, more[0], more[1], nowhere, NULL),
            AUR_OK);
    const aur_result result = aur_volume_create(&parameters, volume, error);
    aur_parameters_release(&parameters);
    if (result == AUR_OK)
        aur_volume_recenter(*volume, (const double[3]){0.0});
    return result;
}

/* 4 x 3 x 2 voxels, three of them nonzero: Mitsuba 3.9.1's values for this grid. */
static void has_the_values_of_mitsuba(void **state) {
    (void)state;
    float values[24] = {0};
    values[1] = 1.0f;
    values[4] = 2.0f;
    values[12] = 3.0f;
    size_t size;
    char *const bytes = vol_bytes(4, 3, 2, 1, values, &size);
    aur_volume *volume;
    assert_int_equal(make(size, bytes, NULL, &volume, NULL), AUR_OK);
    static const float points[][4] = {{0.375f, 1.0f / 6.0f, 0.25f, 1.0f},
                                      {0.125f, 0.5f, 0.25f, 2.0f},
                                      {0.125f, 1.0f / 6.0f, 0.75f, 3.0f},
                                      {0.0f, 0.0f, 0.0f, 0.0f},
                                      {0.25f, 1.0f / 6.0f, 0.25f, 0.5f},
                                      {-0.1f, 0.5f, 0.25f, 2.0f},
                                      {1.5f, 0.5f, 0.5f, 0.0f}};
    for (size_t i = 0; i < sizeof points / sizeof points[0]; ++i) {
        const aur_vector found =
            volume->descriptor->evaluate(volume, (aur_vector){points[i][0], points[i][1], points[i][2]});
        assert_near((double)found.y, (double)points[i][3], 1e-6);
    }
    assert_true(volume->minimum == 0.0f && volume->maximum == 3.0f);
    aur_volume_destroy(volume);
    static const char *const nearest[] = {"filter_type", "nearest", "wrap_mode", "mirror", NULL};
    assert_int_equal(make(size, bytes, nearest, &volume, NULL), AUR_OK);
    assert_true(volume->descriptor->evaluate(volume, (aur_vector){0.3f, 0.2f, 0.2f}).x == 1.0f);
    /* Mirrored at 0: voxel -2 is voxel 1; and repeated, -3 is 1. */
    assert_true(volume->descriptor->evaluate(volume, (aur_vector){-0.3f, 0.2f, 0.2f}).x == 1.0f);
    aur_volume_destroy(volume);
    static const char *const repeated[] = {"filter_type", "nearest", "wrap_mode", "repeat", NULL};
    assert_int_equal(make(size, bytes, repeated, &volume, NULL), AUR_OK);
    assert_true(volume->descriptor->evaluate(volume, (aur_vector){-0.7f, 0.2f, 0.2f}).x == 1.0f);
    aur_volume_destroy(volume);
    /* The box in the file is 2 x 4 x 8. */
    static const char *const boxed[] = {"use_grid_bbox", "true", NULL};
    assert_int_equal(make(size, bytes, boxed, &volume, NULL), AUR_OK);
    assert_near((double)volume->descriptor->evaluate(volume, (aur_vector){0.75f, 2.0f / 3.0f, 2.0f}).x, 1.0,
                1e-6);
    aur_volume_destroy(volume);
    free(bytes);
}

static void refuses_what_is_no_grid(void **state) {
    (void)state;
    static const float values[8] = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f};
    size_t size;
    char *const good = vol_bytes(2, 2, 2, 1, values, &size);
    static const struct {
        size_t at;
        int32_t number;
        const char *message;
    } wrongs[] = {{0, 0x4d4c56, "not a .vol file"}, {4, 2, "must be 1, floats"},
                  {8, 0, "1 to 65536 voxels"},      {12, -1, "1 to 65536 voxels"},
                  {16, 3, "not what its head"},     {20, 2, "1 or 3 channels"},
                  {20, 3, "not what its head"},     {VOL_HEAD + 8, 0x7f800000, "not finite"}};
    for (size_t i = 0; i < sizeof wrongs / sizeof wrongs[0]; ++i) {
        char bytes[VOL_HEAD + 32];
        memcpy(bytes, good, size);
        memcpy(bytes + wrongs[i].at, &wrongs[i].number, 4);
        aur_volume *volume;
        aur_error error = {0};
        assert_int_equal(make(size, bytes, NULL, &volume, &error), AUR_ERROR_FORMAT);
        assert_null(volume);
        if (strstr(error.message, wrongs[i].message) == NULL)
            fail_msg("'%s' does not have '%s'", error.message, wrongs[i].message);
    }
    for (size_t cut = 0; cut < size; ++cut) {
        aur_volume *volume;
        assert_int_equal(make(cut, good, NULL, &volume, NULL), AUR_ERROR_FORMAT);
    }
    free(good);
}

/* Random grids, wraps and rays: stretches of the walk follow each other without a gap from where the ray
 * enters the unit cube to where it leaves, and no value on them is above the majorant. */
static void no_value_is_above_its_majorant(void **state) {
    (void)state;
    static const char *const wraps[] = {"clamp", "repeat", "mirror"}, *const filters[] = {"trilinear",
                                                                                          "nearest"};
    uint64_t hash = 7;
    for (size_t attempt = 0; attempt < 12; ++attempt) {
        enum { X = 13, Y = 6, Z = 1 };
        static float values[X * Y * Z * 3];
        for (size_t i = 0; i < X * Y * Z * 3; ++i)
            values[i] = aur_draw_unit(&hash) < 0.7f ? 0.0f : aur_draw_unit(&hash);
        size_t size;
        char *const bytes = vol_bytes(X, Y, Z, 3, values, &size);
        const char *const more[] = {"wrap_mode", wraps[attempt % 3], "filter_type", filters[attempt % 2],
                                    NULL};
        aur_volume *volume;
        assert_int_equal(make(size, bytes, more, &volume, NULL), AUR_OK);
        free(bytes);
        aur_majorants majorants;
        assert_int_equal(aur_majorants_create(volume, 2.0f, &majorants, NULL), AUR_OK);
        for (size_t i = 0; i < 500; ++i) {
            float u[3], v[3];
            aur_draw_units(&hash, u);
            aur_draw_units(&hash, v);
            aur_vector direction = {v[0] - 0.5f, v[1] - 0.5f, i % 5 == 0 ? 0.0f : v[2] - 0.5f};
            direction = aur_vector_normalize(direction);
            const aur_ray ray = {
                {3.0f * u[0] - 1.0f, 3.0f * u[1] - 1.0f, i % 5 == 0 ? 0.5f : 3.0f * u[2] - 1.0f},
                0.0f,
                direction,
                INFINITY};
            aur_majorant_walk walk;
            aur_majorant_walk_begin(&majorants, &ray, i % 3 == 0 ? 0.7f : INFINITY, &walk);
            float from, to, majorant, length = 0.0f, last = -1.0f;
            while (aur_majorant_walk_next(&walk, &from, &to, &majorant)) {
                assert_true(last < 0.0f || from == last);
                last = to;
                length += to - from;
                for (size_t k = 0; k < 5; ++k) {
                    const float t = from + (to - from) * 0.25f * (float)k;
                    const aur_vector value = volume->descriptor->evaluate(
                        volume, aur_vector_add_scaled(ray.origin, t, ray.direction));
                    assert_true(2.0f * aur_vector_max(value) <= majorant);
                }
            }
            /* The part in the cube, by small steps. */
            enum { STEPS = 4000 };
            size_t inside = 0;
            const float end = i % 3 == 0 ? 0.7f : 6.0f;
            for (size_t k = 0; k < STEPS; ++k) {
                const aur_vector p =
                    aur_vector_add_scaled(ray.origin, end * ((float)k + 0.5f) / STEPS, ray.direction);
                inside +=
                    p.x >= 0.0f && p.x <= 1.0f && p.y >= 0.0f && p.y <= 1.0f && p.z >= 0.0f && p.z <= 1.0f;
            }
            assert_near((double)length, (double)(end * (float)inside / STEPS), 2.0 * (double)end / STEPS);
        }
        aur_majorants_release(&majorants);
        aur_volume_destroy(volume);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_the_values_of_mitsuba),
        cmocka_unit_test(refuses_what_is_no_grid),
        cmocka_unit_test(no_value_is_above_its_majorant),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
