/* What pilots tell of final gathering, where the law that they follow is known. */
#include "check.h"

#include <math.h>

#include "render/adaptive/gather_model.h"

/* As in gather_model.c: of the squares of errors, and the price of a ray to a light. */
static const double POWER = 1.5, POWER_OF_PLACES = 1.25, LIGHT_PRICE = 0.5;

/* Squares of the error by directions, one point on lights, and the camera's ray; rays of a pattern without
 * lights, and of a point on lights. */
typedef struct known_model {
    double gather, lights, camera, others, light;
} known_model;

static aur_pilot_outcome pilot(const known_model *known, double lights, double camera) {
    return (aur_pilot_outcome){sqrt(known->gather + known->lights * pow(lights, -POWER) + camera),
                               known->others + known->light * lights};
}

static aur_gather_pilots pilots_of(const known_model *known, double side) {
    aur_gather_pilots pilots = {.side = side};
    pilots.of[AUR_PILOT_FEW] = pilot(known, AUR_PILOT_LIGHTS, known->camera);
    pilots.of[AUR_PILOT_MORE] = pilot(known, AUR_PILOT_LIGHTS_MORE, known->camera);
    pilots.of[AUR_PILOT_MOST] = pilot(known, AUR_PILOT_LIGHTS_MOST, known->camera);
    pilots.of[AUR_PILOT_CENTRE] = pilot(known, AUR_PILOT_LIGHTS_MOST, 0.0);
    return pilots;
}

/* All parts of a law that the pilots follow exactly come out to rounding, with the squares' own cancellation.
 */
static void parts_are_told_exactly(void **state) {
    (void)state;
    static const double lights[] = {0.01, 0.1, 0.5}, cameras[] = {0.0, 0.003, 0.02};
    for (size_t i = 0; i < 9; ++i) {
        const known_model known = {0.01, lights[i % 3], cameras[i / 3], 10.0, 0.8};
        const aur_gather_pilots pilots = pilots_of(&known, 4.0);
        const aur_gather_model model = aur_gather_model_of(&pilots);
        const double own = 1e-13;
        assert_near(model.gather, known.gather, own);
        assert_near(model.camera, known.camera / 4.0, own);
        for (double l = 1.0; l <= 128.0; l *= 2.0)
            assert_near(aur_gather_model_lights(&model, l), known.lights * pow(l, -POWER), own);
        assert_near(model.fixed + AUR_PILOT_DIRECTIONS * model.direction, known.others, 1e-12);
        assert_near(model.light, LIGHT_PRICE * known.light, 1e-12);
        assert_true(model.power == POWER_OF_PLACES && model.bright == 0.0 && !model.alone);
    }
}

/* Without further pilots all is the directions', and the pilot with more points alone tells of lights. Chance
 * may make that one the worse: then points bring nothing. */
static void fewer_pilots_tell_less(void **state) {
    (void)state;
    const known_model known = {0.01, 0.04, 0.0, 10.0, 0.8};
    const aur_gather_pilots all = pilots_of(&known, 4.0);
    aur_gather_pilots some = {.side = 4.0};
    some.of[AUR_PILOT_FEW] = all.of[AUR_PILOT_FEW];
    aur_gather_model model = aur_gather_model_of(&some);
    assert_near(model.gather, 0.05, 1e-13);
    assert_true(aur_gather_model_lights(&model, 1.0) == 0.0 && model.light == 0.0 && model.power == POWER);
    some.of[AUR_PILOT_MORE] = all.of[AUR_PILOT_MORE];
    model = aur_gather_model_of(&some);
    assert_near(model.gather, 0.01, 1e-13);
    assert_near(aur_gather_model_lights(&model, 3.0), 0.04 * pow(3.0, -POWER), 1e-13);
    some.of[AUR_PILOT_MORE].error = 0.3;
    model = aur_gather_model_of(&some);
    assert_near(model.gather, 0.09, 1e-13);
    assert_true(aur_gather_model_lights(&model, 1.0) == 0.0);
}

/* No other number of points on lights, from 1 to 4096, takes fewer rays to the noise by the law. */
static void patterns_take_the_least_rays(void **state) {
    (void)state;
    for (size_t i = 0; i < 30; ++i) {
        const known_model known = {0.01, 0.1 * pow(10.0, (double)(i % 3) - 1.0), 0.004, 10.0, 0.8};
        const aur_gather_pilots pilots = pilots_of(&known, 4.0);
        const aur_gather_model model = aur_gather_model_of(&pilots);
        const aur_gather_target target = {0.05 * pow(0.5, (double)i / 3.0), 4.0, 1.8, 0.5};
        const aur_gather_pattern found = aur_gather_model_pattern(&model, &target);
        const double left = fmax(target.noise - 0.001 / 4.0, 0.5 * target.noise);
        const double reached =
            model.gather * pow(AUR_PILOT_DIRECTIONS * 1.8 / found.directions, model.power) +
            aur_gather_model_lights(&model, found.lights);
        assert_near(reached, left, 1e-9 * left);
        assert_near(found.rays, model.fixed + model.direction * found.directions + model.light * found.lights,
                    1e-9 * found.rays);
        for (double l = 1.0; l <= 4096.0; l *= 2.0) {
            const double rest = left - aur_gather_model_lights(&model, l);
            if (rest < 0.1 * left)
                continue;
            const double directions =
                AUR_PILOT_DIRECTIONS * 1.8 * pow(model.gather / rest, 1.0 / model.power);
            assert_true(found.rays <=
                        (model.fixed + model.direction * directions + model.light * l) * (1.0 + 1e-9));
        }
    }
}

/* Points on bright texels cost half a ray here, and leave so much of the square that directions have. They
 * are taken where they save more than a tenth of the time, which is as that to the power 2 / 3, if whole
 * pictures save the square of it. */
static void bright_texels_are_drawn_where_they_pay(void **state) {
    (void)state;
    const double draw = 0.5;
    const known_model plain = {0.01, 0.005, 0.0, 10.0, 0.8};
    for (double left = 0.3; left < 1.3; left += 0.05) {
        const known_model drawn = {left * plain.gather, plain.lights, 0.0, plain.others + draw, plain.light};
        aur_gather_pilots pilots = {.side = 4.0};
        pilots.of[AUR_PILOT_FEW] = pilot(&plain, AUR_PILOT_LIGHTS, 0.0);
        pilots.of[AUR_PILOT_MORE] = pilot(&plain, AUR_PILOT_LIGHTS_MORE, 0.0);
        pilots.of[AUR_PILOT_DRAWN] = pilot(&drawn, AUR_PILOT_LIGHTS_MORE, 0.0);
        const aur_gather_model model = aur_gather_model_of(&pilots);
        const double price = (plain.others + draw) / plain.others;
        const bool pays = 1.1 * price * pow(left, 2.0 / POWER) < 1.0;
        assert_true(left > 0.5 || pays);
        assert_true(left < 1.0 || !pays);
        assert_near(model.bright, pays ? (double)AUR_PILOT_BRIGHT / AUR_PILOT_DIRECTIONS : 0.0, 0.0);
        assert_near(model.gather, (pays ? left : 1.0) * plain.gather, 1e-13);
        assert_near(model.fixed + AUR_PILOT_DIRECTIONS * model.direction, plain.others + (pays ? draw : 0.0),
                    1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(parts_are_told_exactly),
                                       cmocka_unit_test(fewer_pilots_tell_less),
                                       cmocka_unit_test(patterns_take_the_least_rays),
                                       cmocka_unit_test(bright_texels_are_drawn_where_they_pay)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
