#define _DEFAULT_SOURCE /* setenv */
#include "scene_text.h"

#include <stdlib.h>

#include "points/base/random.h"
#include "points/base/simd.h"
#include "render/scene/lights/arcs.h"
#include "render/scene/materials/sampling.h"
#include "render/trace/packet.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* libm in double precision is the oracle. The series errs by 1e-7 (cosines) or 1e-8 of a turn, and rounding
 * at values up to pi, or half a turn, adds two units of the last place, 4.8e-7 and 6e-8. */
static void angles_are_those_of_libm(void **state) {
    (void)state;
    for (size_t k = 0; k <= 100000; ++k) {
        const float x = (float)k / 50000.0f - 1.0f;
        assert_near(aur_arc(x), acos((double)x), 1e-7 + 4.8e-7);
        const double angle = 2.0 * AUR_PI * ((double)k / 100000.0 - 0.5);
        const float at[2] = {(float)(3.0 * cos(angle)), (float)(3.0 * sin(angle))};
        const double turn = atan2((double)at[1], (double)at[0]) / (2.0 * AUR_PI);
        assert_near(aur_turn(at[0], at[1]), turn, 1e-8 + 6e-8);
    }
    assert_true(aur_turn(0.0f, 0.0f) == 0.0f);
}

/* A bright texel, and a column and a row where nothing shines, not as wide as vectors are. */
static void write_sky(void) {
    enum { WIDTH = 13, HEIGHT = 7 };
    char file[64 + WIDTH * HEIGHT * 12];
    int used = sprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (size_t j = 0; j < HEIGHT; ++j)
        for (size_t i = 0; i < WIDTH; ++i) {
            const float value = i == 5 && j == 3 ? 400.0f : i == 2 || j == 5 ? 0.0f : 0.1f + 0.05f * (float)j;
            const float rgb[3] = {value, (float)i * value, 0.5f * value};
            memcpy(file + used, rgb, sizeof rgb);
            used += (int)sizeof rgb;
        }
    write_file("sky.pfm", file, (size_t)used);
}

static void draws_agree(const aur_scene *scene, uint64_t seed, uint32_t lanes) {
    aur_lane_vectors positions, normals;
    aur_lane_numbers choice, u, v;
    aur_light_lanes drawn;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const uint64_t lane = AUR_PACKET_SIZE * seed + k;
        choice[k] = unit(1, lane);
        u[k] = lane % 7 == 0 ? 0.0f : unit(2, lane);
        v[k] = lane % 11 == 0 ? 0x1.fffffep-1f : unit(3, lane);
        aur_lane_set(&positions, k, (aur_vector){unit(4, lane), 0.5f, unit(5, lane)});
        aur_lane_set(&normals, k, k % 3 == 0 ? (aur_vector){0} : aur_sample_sphere(unit(6, lane), 0.3f));
    }
    const aur_light_references references = {&positions, &normals};
    aur_light_lanes_each(scene, lanes, &references, choice, u, v, &drawn);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if ((lanes >> k & 1u) == 0)
            continue;
        const aur_light_reference reference = {aur_lane_vector(&positions, k), aur_lane_vector(&normals, k)};
        const float number = aur_light_chooses(scene) ? choice[k] : 0.5f;
        aur_light_sample one;
        const bool found =
            aur_light_sample_direct(scene, &reference, (const float[3]){number, u[k], v[k]}, &one);
        assert_true(found == (drawn.pdf[k] > 0.0f));
        const aur_vector position = aur_lane_vector(&drawn.position, k);
        const aur_vector radiance = aur_lane_vector(&drawn.radiance, k);
        if (found) {
            assert_true(drawn.pdf[k] == one.pdf && drawn.reachable[k] == (one.delta ? 0.0f : 1.0f));
            const aur_vector direction = aur_lane_vector(&drawn.direction, k);
            assert_true(memcmp(&direction, &one.direction, sizeof direction) == 0);
            assert_true(memcmp(&position, &one.position, sizeof position) == 0);
            assert_true(memcmp(&radiance, &one.radiance, sizeof radiance) == 0);
        }
    }
}

static void looks_agree(const aur_scene *scene, uint64_t seed, uint32_t lanes) {
    aur_lane_vectors directions, radiance;
    aur_lane_numbers pdf;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        aur_lane_set(
            &directions, k,
            aur_sample_sphere(unit(7, AUR_PACKET_SIZE * seed + k), unit(8, AUR_PACKET_SIZE * seed + k)));
    /* poles, and both sides of where the azimuth jumps */
    aur_lane_set(&directions, 0, (aur_vector){0.0f, 1.0f, 0.0f});
    aur_lane_set(&directions, 1, (aur_vector){0.0f, -1.0f, 0.0f});
    aur_lane_set(&directions, 2, (aur_vector){0.0f, 0.0f, -1.0f});
    aur_lane_set(&directions, 3, (aur_vector){-0.0f, 0.0f, -1.0f});
    aur_environment_lanes(scene, lanes, &directions, &radiance, pdf);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if ((lanes >> k & 1u) == 0)
            continue;
        float density;
        const aur_vector one = aur_environment_light(scene, aur_lane_vector(&directions, k), &density);
        const aur_vector many = aur_lane_vector(&radiance, k);
        assert_true(pdf[k] == density && memcmp(&many, &one, sizeof one) == 0);
        assert_true(density >= 0.0f && one.x >= 0.0f);
    }
}

/* Sixteen samples and look-ups are bit-identical to single ones, for any active lanes, with the sky alone and
 * with other lights, for every instruction set. */
static void lanes_have_the_bits_of_single_samples(void **state) {
    (void)state;
    static const char *const names[] = {"portable", "avx2", "avx512"};
    static const char *const rest[] = {
        "<shape type='cube'/>", "<shape type='sphere'><emitter type='area'/></shape><emitter type='point'/>"};
    write_sky();
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        for (size_t j = 0; j < sizeof rest / sizeof rest[0]; ++j) {
            char body[1024];
            snprintf(body, sizeof body,
                     "<emitter type='envmap'><string name='filename' value='sky.pfm'/><transform "
                     "name='to_world'><rotate x='1' y='1' angle='50'/></transform></emitter>%s",
                     rest[j]);
            setenv("AUREOLE_ISA", names[i], 1);
            aur_isa_reset();
            aur_scene *const scene = must_load_body(body);
            for (uint64_t seed = 0; seed < 500; ++seed) {
                const uint32_t lanes = seed % 4 == 0 ? 0xffff : (uint32_t)aur_hash2(9, seed) & 0xffff;
                draws_agree(scene, seed, lanes);
                looks_agree(scene, seed, lanes);
            }
            aur_scene_destroy(scene);
        }
    unsetenv("AUREOLE_ISA");
    aur_isa_reset();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angles_are_those_of_libm),
        cmocka_unit_test(lanes_have_the_bits_of_single_samples),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
