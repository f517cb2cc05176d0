#include "scene_text.h"

#include "points/base/gauss.h"
#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/scene/lights/sky_model.h"
#include "render/scene/materials/sampling.h"

static const double RADIANS = AUR_PI / 180.0;

/* --- the formulas */

static void sun_at(double elevation, double sun[3]) {
    sun[0] = cos(elevation * RADIANS);
    sun[1] = 0.0;
    sun[2] = sin(elevation * RADIANS);
}

enum { NODES = 10, LEVELS = 24 };

/* A piece [from, to] of an integral, with nodes that crowd at `to`: twenty-four intervals, each 1/2.5 as long
 * as the one before. */
static size_t graded(double from, double to, double *nodes, double *weights) {
    double x[NODES], w[NODES];
    aur_gauss_legendre(NODES, x, w);
    size_t count = 0;
    for (int level = 0; level < LEVELS; ++level) {
        const double share = level + 1 < LEVELS ? 1.0 - 1.0 / 2.5 : 1.0, next = from + share * (to - from);
        for (size_t i = 0; i < NODES; ++i) {
            nodes[count] = 0.5 * (from + next) + 0.5 * (next - from) * x[i];
            weights[count++] = 0.5 * (next - from) * w[i];
        }
        from = next;
    }
    return count;
}

/* The irradiance on the horizontal plane in another way than the library's: by angles about the zenith, with
 * Gauss's rule on intervals that shrink towards the sun and the horizon. */
static double irradiance_about_zenith(const aur_sky_model *sky) {
    double x[3 * LEVELS * NODES], wx[3 * LEVELS * NODES], y[LEVELS * NODES], wy[LEVELS * NODES];
    const double zenith = acos(sky->sun[2]), middle = 0.5 * (zenith + 0.5 * AUR_PI);
    size_t count = graded(0.0, zenith, x, wx);
    count += graded(middle, zenith, x + count, wx + count);
    count += graded(middle, 0.5 * AUR_PI, x + count, wx + count);
    const size_t around = graded(AUR_PI, 0.0, y, wy);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t j = 0; j < around; ++j) {
            const double direction[3] = {sin(x[i]) * cos(y[j]), sin(x[i]) * sin(y[j]), cos(x[i])};
            sum += 2.0 * fabs(wx[i] * wy[j]) * sin(x[i]) * cos(x[i]) * aur_sky_model_radiance(sky, direction);
        }
    return sum;
}

static void integrals_agree(void **state) {
    (void)state;
    const aur_sky_model uniform = aur_sky_model_uniform(), overcast = aur_sky_model_overcast();
    assert_relative(aur_sky_model_irradiance(&uniform), AUR_PI, 1e-13);
    assert_relative(aur_sky_model_irradiance(&overcast), 7.0 / 3.0 * AUR_PI, 1e-13);
    /* A low sun in very clear air, for which the b of Perez et al. is .02 and no bound at the horizon: it is
     * 0. */
    double low[3];
    sun_at(3.0, low);
    const aur_sky_model unbounded = aur_sky_model_perez(700.0, 20.0, 1367.0, low);
    assert_true(unbounded.b == 0.0 && unbounded.a > -1.0);
    assert_relative(irradiance_about_zenith(&unbounded), aur_sky_model_irradiance(&unbounded), 1e-8);
    static const double elevations[] = {0.0, 5.0, 37.0, 90.0};
    for (size_t k = 0; k < 4; ++k) {
        double sun[3];
        sun_at(elevations[k], sun);
        for (size_t type = 1; type <= 15; ++type) {
            const aur_sky_model sky = aur_sky_model_cie(type, sun);
            assert_relative(aur_sky_model_irradiance(&sky), irradiance_about_zenith(&sky), 1e-9);
        }
    }
}

/* E_3(x), the integral of exp(-x t) / t^3 for t from 1: by the series of E_1 (Abramowitz and Stegun 5.1.11)
 * and the recurrence 5.1.14. */
static double exponential_integral_3(double x) {
    double series = -0.57721566490153286 - log(x), term = 1.0;
    for (int k = 1; k < 40; ++k) {
        term *= -x / k;
        series -= term / k;
    }
    const double second = exp(-x) - x * series;
    return 0.5 * (exp(-x) - x * second);
}

/* Skies without an indicatrix have a closed form: with t = 1 / cos Z the integral is E_3. */
static void gradations_have_closed_forms(void **state) {
    (void)state;
    static const struct {
        size_t type;
        double a, b;
    } rows[] = {{1, 4.0, -0.7}, {3, 1.1, -0.8}, {5, 0.0, -1.0}};
    double sun[3];
    sun_at(30.0, sun);
    for (size_t i = 0; i < 3; ++i) {
        const aur_sky_model sky = aur_sky_model_cie(rows[i].type, sun);
        const double expected = AUR_PI + 2.0 * AUR_PI * rows[i].a * exponential_integral_3(-rows[i].b);
        assert_relative(aur_sky_model_irradiance(&sky), expected, 1e-11);
    }
    /* Type 1 comes near the overcast sky's 1:3, and type 5 is the same everywhere. */
    const double top[3] = {0, 0, 1}, side[3] = {1, 0, 0};
    const aur_sky_model one = aur_sky_model_cie(1, sun), overcast = aur_sky_model_overcast();
    assert_near(aur_sky_model_radiance(&one, top) / aur_sky_model_radiance(&one, side), 1.0 + 4.0 * exp(-0.7),
                1e-12);
    assert_near(aur_sky_model_radiance(&overcast, top) / aur_sky_model_radiance(&overcast, side), 3.0, 1e-12);
}

/* Mirroring a sky at the vertical plane of the sun changes nothing, nor does turning it with its sun. */
static void skies_are_symmetric(void **state) {
    (void)state;
    const double sun[3] = {0.6, 0.0, 0.8}, turned[3] = {0.0, -0.6, 0.8};
    for (size_t type = 1; type <= 15; ++type) {
        const aur_sky_model sky = aur_sky_model_cie(type, sun), other = aur_sky_model_cie(type, turned);
        for (size_t i = 0; i < 200; ++i) {
            const double z = ((double)i + 0.5) / 200.0, azimuth = 2.4 * (double)i, r = sqrt(1.0 - z * z);
            const double here[3] = {r * cos(azimuth), r * sin(azimuth), z};
            const double mirrored[3] = {here[0], -here[1], z}, there[3] = {here[1], -here[0], z};
            const double value = aur_sky_model_radiance(&sky, here);
            assert_true(value > 0.0);
            assert_relative(aur_sky_model_radiance(&sky, mirrored), value, 1e-12);
            assert_relative(aur_sky_model_radiance(&other, there), value, 1e-12);
        }
    }
}

/* Coefficients as gendaylit of Radiance 6 prints them for the same irradiances (in single precision, with
 * 1367 W/m^2 times its eccentricity of day 0), in five of the eight classes of clearness. */
static void perez_as_published(void **state) {
    (void)state;
    static const struct {
        double elevation, direct, diffuse, of[5];
    } rows[] = {
        {45, 600, 100, {-0.973404, -0.206849, 15.047479, -3.921188, 0.619500}},
        {45, 0, 120, {0.982854, -0.625557, 0.368340, -0.320416, -0.037265}},
        {20, 300, 150, {-1.176165, -0.795290, 11.404091, -3.105303, 0.023928}},
        {60, 900, 60, {-1.004832, -0.226343, 22.632771, -6.350084, 1.268788}},
        {70, 150, 300, {-0.984715, -0.707092, 14.397642, -3.790510, 0.091047}},
    };
    const double outside = 1367.0 * 1.0350198201507328;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        double sun[3];
        sun_at(rows[i].elevation, sun);
        const aur_sky_model sky = aur_sky_model_perez(rows[i].direct, rows[i].diffuse, outside, sun);
        const double of[5] = {sky.a, sky.b, sky.c, sky.d, sky.e};
        for (size_t k = 0; k < 5; ++k)
            assert_near(of[k], rows[i].of[k], 1e-5 * fmax(1.0, fabs(of[k])));
    }
}

/* --- skies of scenes */

static aur_scene *load_sky(const char *keys) {
    char body[1024];
    snprintf(body, sizeof body, "<emitter type='sky'>%s</emitter><shape type='cube'/>", keys);
    return must_load_body(body);
}

#define ROUND_SUN "<vector name='sun_direction' x='.36' y='.6' z='-.48'/>"

static const char *const skies[] = {
    "<string name='model' value='uniform'/>",
    "<vector name='up' value='0 0 1'/><rgb name='ground' value='.1 .2 .3'/>",
    "<string name='model' value='cie'/>" ROUND_SUN,
    "<string name='model' value='cie'/><integer name='cie_type' value='15'/>" ROUND_SUN
    "<rgb name='irradiance' value='1 2 3'/><float name='ground_albedo' value='.5'/>",
    "<string name='model' value='cie'/><string name='coefficients' value='-1 -.3 8 -2 .2'/>" ROUND_SUN,
    "<string name='model' value='perez'/><float name='direct_normal' value='700'/>" ROUND_SUN,
};
enum { SKIES = sizeof skies / sizeof skies[0] };

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* A direction by height and azimuth about `up`, which is y or z. */
static aur_vector about(size_t up, double height, double azimuth) {
    const float radius = (float)sqrt(1.0 - height * height), z = (float)height;
    const float x = radius * (float)cos(azimuth), y = radius * (float)sin(azimuth);
    return up == 1 ? (aur_vector){x, z, -y} : (aur_vector){x, y, z};
}

/* Midpoints of 800 heights and 800 azimuths: the radiance's kink at the sun, where it falls by up to 5 % a
 * degree, leaves 1e-5. */
static void irradiance_reaches_the_target(void **state) {
    (void)state;
    enum { FINE = 800 };
    static const double expected[SKIES][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1},
                                              {1, 2, 3}, {1, 1, 1}, {100, 100, 100}};
    for (size_t k = 0; k < SKIES; ++k) {
        aur_scene *const scene = load_sky(skies[k]);
        double sum[3] = {0};
        for (size_t i = 0; i < FINE; ++i)
            for (size_t j = 0; j < FINE; ++j) {
                const double height = ((double)i + 0.5) / FINE;
                const aur_vector radiance = aur_scene_environment(
                    scene, about(k == 1 ? 2 : 1, height, 2.0 * AUR_PI * ((double)j + 0.5) / FINE));
                const double weight = 2.0 * AUR_PI / FINE / FINE * height;
                sum[0] += weight * (double)radiance.x;
                sum[1] += weight * (double)radiance.y;
                sum[2] += weight * (double)radiance.z;
            }
        for (size_t c = 0; c < 3; ++c)
            assert_relative(sum[c], expected[k][c], 2e-5);
        aur_scene_destroy(scene);
    }
    /* what the ground contributes, in RGB and by the albedo */
    aur_scene *scene = load_sky(skies[1]);
    assert_near(aur_scene_environment(scene, (aur_vector){0.6f, 0.0f, -0.8f}).z, 0.3, 1e-7);
    aur_scene_destroy(scene);
    scene = load_sky(skies[3]);
    assert_near(aur_scene_environment(scene, (aur_vector){0.6f, -0.8f, 0.0f}).y, 0.5 * 2.0 / AUR_PI, 1e-6);
    aur_scene_destroy(scene);
}

/* Lux and candelas are watts times 179. */
static void brightness_by_four_keys(void **state) {
    (void)state;
    static const struct {
        const char *keys;
        double zenith;
    } rows[] = {
        {"<float name='irradiance' value='7'/>", 9.0 / AUR_PI},
        {"<float name='illuminance' value='17900'/>", 100.0 * 9.0 / 7.0 / AUR_PI},
        {"<rgb name='zenith_radiance' value='2 1 1'/>", 2.0},
        {"<float name='zenith_luminance' value='358'/>", 2.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_scene *const scene = load_sky(rows[i].keys);
        assert_relative(aur_scene_environment(scene, (aur_vector){0, 1, 0}).x, rows[i].zenith, 1e-6);
        assert_relative(aur_scene_environment(scene, (aur_vector){1, 0, 0}).x, rows[i].zenith / 3.0, 1e-6);
        aur_scene_destroy(scene);
    }
}

/* Sampled directions are distributed by the pdf: 24 x 16 bins, the lower half merged into one, by Pearson's
 * statistic. A correct program fails with a probability of 1e-6 per sky (5 standard deviations of the
 * statistic's cube root, Wilson and Hilferty 1931), and the numbers are fixed. The pdf integrates to 1 over
 * midpoints of its patches. */
static void draws_what_it_says(void **state) {
    (void)state;
    enum { AROUND = 24, HEIGHTS = 8, BINS = AROUND * HEIGHTS + 1, COUNT = 100000, FINE = 4 };
    for (size_t k = 0; k < SKIES; ++k) {
        aur_scene *const scene = load_sky(skies[k]);
        const size_t up = k == 1 ? 2 : 1;
        double expected[BINS] = {0}, total = 0.0;
        size_t found[BINS] = {0};
        for (size_t i = 0; i < HEIGHTS * 48; ++i)
            for (size_t j = 0; j < AROUND * 16; ++j) {
                const double height = ((double)i + 0.5) / (HEIGHTS * 48);
                const double azimuth = 2.0 * AUR_PI * ((double)j + 0.5) / (AROUND * 16);
                const double weight = 2.0 * AUR_PI / (HEIGHTS * 48) / (AROUND * 16);
                const double above =
                    weight * (double)aur_environment_pdf_direct(scene, about(up, height, azimuth));
                const double below =
                    weight * (double)aur_environment_pdf_direct(scene, about(up, -height, azimuth));
                expected[i / 48 * AROUND + j / 16] += above;
                expected[BINS - 1] += below;
                total += above + below;
            }
        assert_near(total, 1.0, 1e-6);
        for (size_t i = 0; i < COUNT; ++i) {
            const float u[3] = {0.5f, unit(k, 2 * i), unit(k, 2 * i + 1)};
            aur_light_sample sample;
            assert_true(aur_light_sample_direct(scene, &(aur_light_reference){0}, u, &sample));
            assert_true(sample.pdf == aur_environment_pdf_direct(scene, sample.direction));
            const aur_vector d = sample.direction;
            const float height = up == 1 ? d.y : d.z;
            const double turn = atan2((double)(up == 1 ? -d.z : d.y), (double)d.x) / (2.0 * AUR_PI);
            const size_t column = (size_t)((turn < 0.0 ? turn + 1.0 : turn) * AROUND) % AROUND;
            const size_t row =
                (size_t)(height * HEIGHTS) < HEIGHTS ? (size_t)(height * HEIGHTS) : HEIGHTS - 1;
            ++found[height < 0.0f ? BINS - 1 : row * AROUND + column];
        }
        double statistic = 0.0, freedom = -1.0;
        for (size_t i = 0; i < BINS; ++i) {
            const double mean = COUNT * expected[i], gap = (double)found[i] - mean;
            assert_true(mean > 20.0 || found[i] == 0);
            if (mean > 0.0) {
                statistic += gap * gap / mean;
                freedom += 1.0;
            }
        }
        const double spread = 2.0 / (9.0 * freedom);
        assert_true(cbrt(statistic / freedom) < 1.0 - spread + 5.0 * sqrt(spread));
        aur_scene_destroy(scene);
    }
}

/* --- the sun */

/* On a plane facing the disk: pi sin^2 of its half angle times the radiance, for any angle; with a sky, the
 * sky's light and pdf are added. */
static void suns_have_closed_forms(void **state) {
    (void)state;
    static const double angles[] = {0.2665, 5.0, 60.0, 90.0};
    for (size_t k = 0; k < 4; ++k) {
        char body[512];
        snprintf(body, sizeof body,
                 "<emitter type='sun'><float name='half_angle' value='%g'/><rgb name='irradiance' value='3 2 "
                 "1'/><vector name='sun_direction' x='1' y='2' z='2'/></emitter><shape type='cube'/>",
                 angles[k]);
        aur_scene *const scene = must_load_body(body);
        const double sine = sin(angles[k] * RADIANS);
        const aur_vector center = {1.0f / 3.0f, 2.0f / 3.0f, 2.0f / 3.0f};
        assert_relative(aur_scene_environment(scene, center).x, 3.0 / (AUR_PI * sine * sine), 1e-6);
        double sum = 0.0;
        enum { SIDE = 64 };
        for (size_t i = 0; i < SIDE; ++i)
            for (size_t j = 0; j < SIDE; ++j) {
                const float u[3] = {0.5f, ((float)i + 0.5f) / SIDE, ((float)j + 0.5f) / SIDE};
                aur_light_sample sample;
                assert_true(aur_light_sample_direct(scene, &(aur_light_reference){0}, u, &sample));
                assert_false(sample.delta);
                assert_true(aur_environment_pdf_direct(scene, sample.direction) == sample.pdf);
                const double angle = acos(fmin((double)aur_vector_dot(sample.direction, center), 1.0));
                assert_true(angle < 1.0001 * angles[k] * RADIANS + 4e-4);
                sum += (double)(aur_vector_dot(sample.direction, center) * sample.radiance.x / sample.pdf);
            }
        /* the mean of the cosine is linear in u, which midpoints integrate exactly */
        assert_relative(sum / (SIDE * SIDE), 3.0, 1e-6);
        aur_scene_destroy(scene);
    }
}

/* Fluence at a point, by sampled points on lights and by uniform directions: the same, also with a wide sun
 * in front of a sky, and behind a wall. */
static void adds_up(const char *body) {
    enum { COUNT = 200000 };
    aur_scene *const scene = must_load_body(body);
    double sums[2] = {0}, squares[2] = {0};
    for (size_t i = 0; i < COUNT; ++i) {
        const float u[3] = {unit(1, i), unit(2, i), unit(3, i)};
        aur_light_sample sample;
        double values[2] = {0};
        if (aur_light_sample_direct(scene, &(aur_light_reference){0}, u, &sample)) {
            const aur_ray ray = {{0}, 0.0f, sample.direction, sample.distance};
            assert_near(sample.pdf, aur_environment_pdf_direct(scene, sample.direction), 1e-6 * sample.pdf);
            values[0] = aur_scene_occluded(scene, &ray) ? 0.0 : (double)(sample.radiance.x / sample.pdf);
        }
        const aur_ray ray = {{0}, 0.0f, aur_sample_sphere(unit(4, i), unit(5, i)), INFINITY};
        if (!aur_scene_occluded(scene, &ray))
            values[1] = 4.0 * AUR_PI * (double)aur_scene_environment(scene, ray.direction).x;
        for (size_t k = 0; k < 2; ++k) {
            sums[k] += values[k] / COUNT;
            squares[k] += values[k] * values[k] / COUNT;
        }
    }
    const double sigma = sqrt((squares[0] - sums[0] * sums[0] + squares[1] - sums[1] * sums[1]) / COUNT);
    assert_near(sums[0], sums[1], 4.5 * sigma); /* exceeded with probability 7e-6; the numbers are fixed */
    aur_scene_destroy(scene);
}

static void suns_and_skies_add_up(void **state) {
    (void)state;
    adds_up("<emitter type='sky'><string name='model' value='cie'/>" ROUND_SUN "</emitter>"
            "<emitter type='sun'><float name='half_angle' value='20'/><float name='irradiance' "
            "value='.5'/>" ROUND_SUN
            "</emitter><emitter type='sun'><float name='half_angle' value='120'/><float "
            "name='radiance' value='.1'/>"
            "<vector name='sun_direction' x='1' y='0' z='0'/></emitter>"
            "<shape type='cube'><transform name='to_world'><translate x='2' y='1'/></transform></shape>");
    adds_up("<emitter type='sunsky'><float name='sun_aperture' value='50'/><vector name='sun_direction' "
            "value='1 2 2'/>"
            "</emitter><shape type='cube'><transform name='to_world'><translate x='2' "
            "y='1'/></transform></shape>");
}

/* Radiances as Mitsuba 3.9.1 evaluates them (scalar_rgb), which computes in floats. */
static void sunsky_as_in_mitsuba(void **state) {
    (void)state;
    static const struct {
        const char *keys;
        double to[3], expected[3];
    } rows[] = {
        {"<float name='turbidity' value='2.5'/><rgb name='albedo' value='.1 .4 .8'/><float name='sun_scale' "
         "value='0'/><vector name='sun_direction' value='3 1 2'/>",
         {1, 2, 2},
         {0.03776811, 0.06979488, 0.13501951}},
        {"<float name='turbidity' value='7.25'/><float name='sun_scale' value='0'/>"
         "<vector name='sun_direction' value='0 -4 1'/>",
         {-1, 2, 0.1},
         {0.08356679, 0.0867369, 0.07863425}},
        {"<float name='turbidity' value='3.5'/><float name='sky_scale' value='0'/>"
         "<vector name='sun_direction' value='2 -1 2'/>",
         {2, -1, 2},
         {20809.379, 16951.703, 12313.367}},
        {"<float name='turbidity' value='7.25'/><float name='sun_scale' value='0'/>"
         "<vector name='sun_direction' value='0 -4 1'/>",
         {-1, 2, -0.1},
         {0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[512];
        snprintf(body, sizeof body, "<emitter type='sunsky'>%s</emitter><shape type='cube'/>", rows[i].keys);
        aur_scene *const scene = must_load_body(body);
        const double length = aur_length3(rows[i].to);
        const aur_vector found = aur_scene_environment(scene, (aur_vector){(float)(rows[i].to[0] / length),
                                                                           (float)(rows[i].to[1] / length),
                                                                           (float)(rows[i].to[2] / length)});
        assert_near(found.x, rows[i].expected[0], 2e-5 * rows[i].expected[0]);
        assert_near(found.y, rows[i].expected[1], 2e-5 * rows[i].expected[1]);
        assert_near(found.z, rows[i].expected[2], 2e-5 * rows[i].expected[2]);
        aur_scene_destroy(scene);
    }
}

/* The sun's position for a date, in a rotated frame: as in Mitsuba, to .02 degrees; an albedo by <spectrum>
 * equals that of <rgb>; and at night it is dark. */
static void sunsky_by_date_and_time(void **state) {
    (void)state;
    static const char turned[] =
        "<emitter type='sunsky'><float name='hour' value='9'/><float name='sun_aperture' value='%g'/>"
        "%s<transform name='to_world'><rotate x='1' angle='-90'/></transform></emitter>"
        "<shape type='cube'/>";
    const aur_vector sun = {0.09569518f, 0.7828667f, 0.61478615f};
    char body[512];
    snprintf(body, sizeof body, turned, 0.04, "<float name='sky_scale' value='0'/>");
    aur_scene *scene = must_load_body(body);
    assert_true(aur_scene_environment(scene, sun).x > 1e6f);
    aur_scene_destroy(scene);
    /* As much light from a disk of ten times the diameter. */
    double light[2];
    for (size_t i = 0; i < 2; ++i) {
        const double aperture = i == 0 ? 0.6 : 6.0, sine = sin(0.25 * aperture * RADIANS);
        snprintf(body, sizeof body, turned, aperture, "<float name='sky_scale' value='0'/>");
        scene = must_load_body(body);
        light[i] = (double)aur_scene_environment(scene, sun).x * sine * sine;
        aur_scene_destroy(scene);
    }
    assert_relative(light[1], light[0], 1e-6);
    float seen[2];
    static const char *const albedos[2] = {"<spectrum name='albedo' value='.7'/>",
                                           "<rgb name='albedo' value='.7'/>"};
    for (size_t i = 0; i < 2; ++i) {
        snprintf(body, sizeof body, turned, 0.5, albedos[i]);
        scene = must_load_body(body);
        seen[i] = aur_scene_environment(scene, (aur_vector){0.6f, 0.8f, 0.0f}).y;
        aur_scene_destroy(scene);
    }
    assert_true(seen[0] > 0.0f);
    assert_near(seen[0], seen[1], 1e-6 * seen[1]);
    scene =
        must_load_body("<emitter type='sunsky'><float name='hour' value='0'/></emitter><shape type='cube'/>");
    assert_true(aur_scene_environment(scene, (aur_vector){0.0f, 0.0f, 1.0f}).y == 0.0f);
    aur_scene_destroy(scene);
}

/* Where the sun is: the worked example of NREL's solar position algorithm (Reda and Andreas 2004, table A5.1:
 * zenith 50.11162 with .01633 degrees of refraction, azimuth 194.34024) to .02 degrees; and the solstice of
 * 20:51 on June 20, 2024 (UTC), when it is as far north as the earth's axis is tilted, 23.436 degrees, at the
 * longitude where the equation of time, -1.7 minutes to .2, has it in the south. */
static void suns_by_date_and_time(void **state) {
    (void)state;
    static const struct {
        const char *keys;
        double zenith, azimuth, tolerance; /* degrees, from north by east */
    } rows[] = {
        {"<string name='date' value='2003-10-17'/><string name='time' value='12:30:30'/><float "
         "name='timezone' "
         "value='-7'/><float name='latitude' value='39.742476'/><float name='longitude' value='-105.1786'/>",
         50.12795, 194.34024, 0.02},
        {"<string name='date' value='2024-06-20'/><string name='time' value='20:51'/>"
         "<float name='latitude' value='53.436'/><float name='longitude' value='-132.32'/>",
         30.0, 180.0, 0.06},
    };
    for (size_t i = 0; i < 2; ++i)
        for (size_t up = 1; up <= 2; ++up) {
            char body[1024];
            snprintf(body, sizeof body,
                     "<emitter type='sun'>%s<float name='half_angle' value='%g'/>%s</emitter>"
                     "<shape type='cube'/>",
                     rows[i].keys, rows[i].tolerance, up == 2 ? "<vector name='up' value='0 0 1'/>" : "");
            aur_scene *const scene = must_load_body(body);
            const double zenith = rows[i].zenith * RADIANS;
            assert_true(
                aur_scene_environment(scene, about(up, cos(zenith), (90.0 - rows[i].azimuth) * RADIANS)).x >
                0.0f);
            aur_scene_destroy(scene);
        }
}

static void bad_input(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"sky'><string name='model' value='cie'/>", "needs 'sun_direction', or 'date'"},
        {"sky'><string name='model' value='ci'/>", "cie"},
        {"sky'><string name='model' value='cie'/><vector name='sun_direction' value='0 -1 1'/>",
         "is 45.00 degrees below"},
        {"sky'><string name='model' value='cie'/><string name='coefficients' value='1 2 3'/>" ROUND_SUN,
         "five numbers 'a b c d e'"},
        {"sky'><string name='model' value='cie'/><string name='coefficients' value='1 2 3 4 5'/>" ROUND_SUN,
         "b at most 0"},
        {"sky'><string name='model' value='cie'/><integer name='cie_type' value='16'/>" ROUND_SUN, "15"},
        {"sky'><float name='illuminance' value='1'/><float name='irradiance' value='1'/>",
         "'irradiance' or 'illuminance', not both"},
        {"sky'><float name='ground' value='1'/><float name='ground_albedo' value='1'/>",
         "'ground' or 'ground_albedo', not both"},
        {"sky'><float name='ground_albedo' value='1.5'/>", "'ground_albedo' must be"},
        {"sky'><vector name='up' value='0 0 0'/>", "'up' must not be"},
        {"sky'><vector name='north' value='0 1 0'/>", "nor along 'up'"},
        {"sun'>", "needs 'sun_direction', or 'date'"},
        {"sunsky'><float name='turbidity' value='11'/>", "'turbidity' must be"},
        {"sunsky'><float name='hour' value='9'/><vector name='sun_direction' value='0 1 1'/>",
         "'sun_direction' or 'hour', not both"},
        {"sunsky'><integer name='month' value='2'/><integer name='day' value='30'/>",
         "2010-02 has no day 30"},
        {"sunsky'><transform name='to_world'><matrix value='1 1 0 0 1 0 0 0 1'/></transform>",
         "may only turn"},
        {"sun'><string name='date' value='2023-02-29'/>", "a day as 2026-06-21"},
        {"sun'><string name='date' value='23-02-20'/>", "from 1950 to 2050"},
        {"sun'><string name='date' value='2023-02-20'/><string name='time' value='24:00'/>",
         "a time as 14:30"},
        {"sun'><string name='date' value='2023-02-20'/><string name='time' value='0:00'/>",
         "degrees below the horizon"},
        {"sun'><string name='date' value='2023-02-20'/>" ROUND_SUN, "'sun_direction' or 'date', not both"},
        {"sun'><float name='half_angle' value='100'/>" ROUND_SUN, "give 'radiance'"},
        {"sun'><float name='illuminance' value='1'/><float name='radiance' value='1'/>" ROUND_SUN,
         "give one of"},
        {"sky'/><emitter type='constant'>", "a second environment"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[512];
        snprintf(body, sizeof body, "<emitter type='%s</emitter><shape type='cube'/>", rows[i][0]);
        aur_scene *scene = NULL;
        aur_error error = {0};
        if (load_body(body, NULL, &scene, &error) == AUR_OK)
            fail_msg("row %zu loads", i);
        if (strstr(error.message, rows[i][1]) == NULL)
            fail_msg("row %zu: %s", i, error.message);
        assert_int_equal(error.line, 2);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_agree),
        cmocka_unit_test(gradations_have_closed_forms),
        cmocka_unit_test(skies_are_symmetric),
        cmocka_unit_test(perez_as_published),
        cmocka_unit_test(irradiance_reaches_the_target),
        cmocka_unit_test(brightness_by_four_keys),
        cmocka_unit_test(draws_what_it_says),
        cmocka_unit_test(suns_have_closed_forms),
        cmocka_unit_test(sunsky_as_in_mitsuba),
        cmocka_unit_test(sunsky_by_date_and_time),
        cmocka_unit_test(suns_and_skies_add_up),
        cmocka_unit_test(suns_by_date_and_time),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
