/* Choosing lights by the tree: against each light drawn by itself. */
#include "scene_text.h"

#include "points/base/random.h"
#include "points/base/simd.h"
#include "points/base/vector3d.h"
#include "render/scene/materials/sampling.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

static aur_vector unit_point(uint64_t a, float size) {
    return (aur_vector){size * (2.0f * unit(a, 1) - 1.0f), size * (2.0f * unit(a, 2) - 1.0f),
                        size * (2.0f * unit(a, 3) - 1.0f)};
}

/* A number in [0,1) that no two lights share. */
static double spread_over(size_t i, size_t count) {
    return ((double)i + 0.5) / (double)count;
}

/* --- the tree alone */

static void place_light(size_t i, double size, aur_light_bounds *bounds) {
    const aur_vector axis = aur_sample_sphere(unit(i, 4), unit(i, 5)), at = unit_point(i, 10.0f);
    *bounds = (aur_light_bounds){.emission = i % 3 == 0 ? 0.0 : 0.5 * AUR_PI,
                                 .spread = i % 3 == 0 ? (double)unit(i, 6) : 0.0,
                                 .power = i % 7 == 0 ? 0.0 : exp(6.0 * (double)unit(i, 7))};
    aur_vector_to_doubles(axis, bounds->axis);
    aur_normalize3(bounds->axis);
    aur_vector_to_doubles(at, bounds->lower);
    aur_vector_to_doubles(at, bounds->upper);
    for (size_t d = 0; d < 3 && i % 2 == 0; ++d)
        bounds->upper[d] += size * (double)unit(i, 8 + d);
}

/* Whether a point of the box, or nearly, shines at the reference with room for rounding. */
static bool surely_lit(const aur_light_bounds *bounds, const aur_light_reference *at) {
    for (size_t k = 0; k < 27; ++k) {
        const size_t step[3] = {k % 3, k / 3 % 3, k / 9};
        double way[3], normal[3];
        for (size_t d = 0; d < 3; ++d)
            way[d] = bounds->lower[d] + 0.5 * (double)step[d] * (bounds->upper[d] - bounds->lower[d]);
        way[0] -= (double)at->position.x;
        way[1] -= (double)at->position.y;
        way[2] -= (double)at->position.z;
        if (!(aur_normalize3(way) > 0.0))
            return true;
        aur_vector_to_doubles(at->normal, normal);
        const bool above = aur_vector_is_zero(at->normal) || aur_dot3(normal, way) > 1e-6;
        if (above && acos(-aur_dot3(bounds->axis, way)) < bounds->spread + bounds->emission - 1e-6)
            return true;
    }
    return false;
}

/* Probabilities sum to 1, are those of sampling, and are positive wherever there is light. */
static void check_tree(size_t count, aur_light_bounds *bounds, const aur_light_reference *at) {
    enum { DRAWS = 1 << 14 };
    aur_light_tree tree;
    assert_int_equal(aur_light_tree_create(&tree, count, bounds, NULL), AUR_OK);
    double sum = 0.0;
    size_t *const drawn = calloc(count, sizeof *drawn);
    for (size_t i = 0; i < count; ++i) {
        const float probability = aur_light_tree_probability(&tree, at, (uint32_t)i);
        sum += (double)probability;
        assert_true(bounds[i].power > 0.0 || probability == 0.0f);
        if (bounds[i].power > 0.0 && surely_lit(&bounds[i], at))
            assert_true(probability > 0.0f);
    }
    size_t none = 0;
    for (size_t i = 0; i < DRAWS; ++i) {
        double rest = spread_over(i, DRAWS);
        uint32_t light;
        float probability;
        if (!aur_light_tree_choose(&tree, at, &rest, &light, &probability)) {
            ++none;
            continue;
        }
        assert_true(rest >= 0.0 && rest < 1.0);
        assert_relative(probability, aur_light_tree_probability(&tree, at, light), 1e-6);
        ++drawn[light];
    }
    /* Boxes of children that hang in one lit node may all be dark by themselves, and draws there are lost. */
    assert_near(sum, 1.0 - (double)none / DRAWS, 2e-3 + (double)none / DRAWS * 0.05);
    for (size_t i = 0; i < count; ++i) /* intervals of u, which points at equal distances meet evenly */
        assert_near((double)drawn[i] / DRAWS, aur_light_tree_probability(&tree, at, (uint32_t)i),
                    1.0001 / DRAWS);
    free(drawn);
    aur_light_tree_release(&tree);
}

static void probabilities_are_those_of_choosing(void **state) {
    (void)state;
    static const size_t counts[] = {2, 3, 16, 17, 60, 400};
    enum { MOST = 400 };
    aur_light_bounds bounds[MOST];
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c)
        for (size_t k = 0; k < 12; ++k) {
            for (size_t i = 0; i < counts[c]; ++i)
                place_light(1000 * k + i, k % 4 == 0 ? 20.0 : 0.5, &bounds[i]);
            bounds[1].power = 1.0;
            aur_light_reference at = {.position = unit_point(77 + k, 12.0f)};
            if (k % 3 != 0)
                at.normal = aur_sample_sphere(unit(k, 21), unit(k, 22));
            check_tree(counts[c], bounds, &at);
        }
}

/* A light at the reference point, lights at one point, and far from the origin. */
static void odd_transforms(void **state) {
    (void)state;
    enum { COUNT = 40 };
    aur_light_bounds bounds[COUNT];
    for (size_t k = 0; k < 4; ++k) {
        for (size_t i = 0; i < COUNT; ++i) {
            place_light(i, 0.0, &bounds[i]);
            for (size_t d = 0; d < 3; ++d) {
                bounds[i].lower[d] = k == 0 ? 3.0 : k == 1 ? bounds[i].lower[d] + 1e6 : exp2((double)i);
                bounds[i].upper[d] = bounds[i].lower[d];
            }
            bounds[i].power = k == 3 ? exp2(-3.0 * (double)i) : 1.0;
        }
        const aur_light_reference at = {
            .position = {(float)bounds[5].lower[0], (float)bounds[5].lower[1], (float)bounds[5].lower[2]}};
        check_tree(COUNT, bounds, &at);
    }
}

/* --- scenes */

#define AREA(radiance) "<emitter type='area'><rgb name='radiance' value='" radiance "'/></emitter>"
#define SQUARE(to_world, more)                                                                               \
    "<shape type='rectangle'><transform name='to_world'>" to_world "</transform>" more "</shape>"

/* The pdf of a sampled point that a ray hits. */
static void check_density(const aur_scene *scene, const aur_light_reference *at,
                          const aur_light_sample *sample) {
    const aur_ray ray = {at->position, 0.0f, sample->direction, INFINITY};
    aur_hit hit;
    if (sample->delta || sample->environment || !aur_scene_intersect(scene, &ray, &hit))
        return;
    aur_surface surface;
    aur_scene_surface(scene, &ray, &hit, &surface);
    const float facing = -aur_vector_dot(surface.geometric_normal, sample->direction);
    if (surface.emitter == sample->emitter && facing > 0.1f &&
        fabsf(hit.distance - sample->distance) < 1e-3f * sample->distance)
        assert_relative(aur_light_pdf_direct(scene, at, &surface), sample->pdf, 4e-3);
}

/* Irradiance at the reference by each light alone, sampled without the others; and by the tree. A light's
 * point has the pdf that is returned. */
static void compare_with_each(const aur_scene *scene, const aur_light_reference *at) {
    enum { COUNT = 1 << 15 };
    double each = 0.0, each_variance = 0.0, sum = 0.0, squares = 0.0;
    for (size_t e = 0; e < scene->emitter_count; ++e) {
        const aur_emitter *const emitter = scene->emitters[e];
        double total = 0.0, total_squares = 0.0;
        for (size_t i = 0; i < COUNT / 16; ++i) {
            const aur_light_query query = {.reference = *at,
                                           .u = {unit(e, 3 * i), unit(e, 3 * i + 1), unit(e, 3 * i + 2)},
                                           .part = AUR_WHOLE_LIGHT};
            aur_light_sample sample = {0};
            if (!emitter->descriptor->sample(emitter, &query, &sample) || !(sample.pdf > 0.0f))
                continue;
            const double cosine = aur_vector_is_zero(at->normal)
                                      ? 1.0
                                      : fmax((double)aur_vector_dot(at->normal, sample.direction), 0.0);
            const double value = cosine * (double)sample.radiance.y / (double)sample.pdf;
            total += value;
            total_squares += value * value;
        }
        const double n = COUNT / 16, mean = total / n;
        each += mean;
        each_variance += (total_squares / n - mean * mean) / n;
    }
    for (size_t i = 0; i < COUNT; ++i) {
        const float u[3] = {(float)spread_over(i, COUNT), unit(99, 2 * i), unit(99, 2 * i + 1)};
        aur_light_sample sample;
        if (!aur_light_sample_direct(scene, at, u, &sample) || !(sample.pdf > 0.0f))
            continue;
        if (i % 64 == 0)
            check_density(scene, at, &sample);
        const double cosine = aur_vector_is_zero(at->normal)
                                  ? 1.0
                                  : fmax((double)aur_vector_dot(at->normal, sample.direction), 0.0);
        const double value = cosine * (double)sample.radiance.y / (double)sample.pdf;
        sum += value;
        squares += value * value;
    }
    const double mean = sum / COUNT, variance = (squares / COUNT - mean * mean) / COUNT;
    assert_near(mean, each,
                4.5 * sqrt(fmax(variance, 0.0) + fmax(each_variance, 0.0)) +
                    1e-5 * each); /* 7 of a million */
}

static void same_light_as_each_alone(void **state) {
    (void)state;
    write_text("pair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 4 0 0\nv 5 0 1\nv 4 1 0\nv 9 0 0\nv 9 0 0\nv 9 0 "
                           "0\nf 1 2 3\nf 4 6 5\nf 7 8 9\n");
    static const char *const bodies[] = {
        /* one light */
        SQUARE("<translate z='3'/>", AREA("2")),
        /* two equal ones at the same position */
        SQUARE("<rotate x='1' angle='180'/><translate z='3'/>", AREA("2"))
            SQUARE("<rotate x='1' angle='180'/><translate z='3'/>", AREA("2")),
        /* some below the horizon, some turned away, one black, one without area */
        SQUARE("<translate z='-2' x='3'/>", AREA("9"))
            SQUARE("<rotate x='1' angle='180'/><translate z='2'/>", AREA("1"))
                SQUARE("<translate z='2' y='4'/>", AREA("5"))
                    SQUARE("<rotate y='1' angle='-80'/><translate x='4'/>", AREA("3"))
                        SQUARE("<translate z='7'/>", AREA("0")),
        /* points, a spot that just reaches, a projector, a beam, the sun and the sky */
        "<emitter type='point'><point name='position' x='1' z='2'/></emitter><emitter type='spot'><float "
        "name='cutoff_angle' value='26.7'/><transform name='to_world'><lookat origin='1,0,2' target='1,0,0' "
        "up='0,1,0'/></transform></emitter>"
        "<emitter type='projector'><transform name='to_world'><lookat origin='0,0,3' target='0,0,0' "
        "up='0,1,0'/></transform></emitter>"
        "<emitter type='spot'><float name='cutoff_angle' value='160'/><transform name='to_world'><lookat "
        "origin='0,0,3' target='0,0,9' up='0,1,0'/></transform></emitter>"
        "<shape type='disk'><transform name='to_world'><rotate x='1' angle='180'/><translate z='4' "
        "x='.5'/></transform>"
        "<emitter type='directionalarea'/></shape><emitter type='directional'><vector name='direction' "
        "z='-1' x='0' y='.2'/></emitter>"
        "<emitter type='constant'><rgb name='radiance' value='.3'/></emitter>",
        /* meshes, one with a triangle without area, and round lights; weights */
        "<shape type='obj'><string name='filename' value='pair.obj'/><boolean name='face_normals' "
        "value='true'/>"
        "<transform name='to_world'><rotate y='1' angle='200'/><translate z='2'/></transform>" AREA(
            "3") "</shape>"
                 "<shape type='sphere'><point name='center' x='-2' y='1' z='1'/><float name='radius' "
                 "value='.4'/>"
                 "<emitter type='area'><float name='sampling_weight' value='4'/></emitter></shape>"
                 "<shape type='cylinder'><float name='radius' value='.1'/><transform "
                 "name='to_world'><translate y='2' z='.2'/></transform>"
                 "<emitter type='area'><float name='sampling_weight' value='0'/></emitter></shape>",
        /* a texture that is black on one side */
        "<shape type='obj'><string name='filename' value='grid.obj'/><transform name='to_world'><rotate "
        "x='1' angle='180'/><translate z='1'/></transform>"
        "<emitter type='area'><texture type='checkerboard' name='radiance'><rgb name='color0' "
        "value='0'/><rgb name='color1' value='8'/>"
        "</texture></emitter></shape>",
    };
    write_text("grid.obj", "v -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt .5 0\nvt 1 "
                           "0\nvt 0 1\nvt .5 1\nvt 1 1\n"
                           "f 1/1 2/2 5/5\nf 1/1 5/5 4/4\nf 2/2 3/3 6/6\nf 2/2 6/6 5/5\n");
    static const aur_light_reference references[] = {
        {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}},   {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}},
        {{1.0f, 0.0f, 1.999f}, {0.0f, 0.6f, 0.8f}}, {{0.5f, 0.2f, 2.5f}, {0.0f, 0.0f, 0.0f}},
        {{1.0f, 0.0f, 2.0f}, {0.0f, 0.0f, -1.0f}},  {{40.0f, 10.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}},
    };
    for (size_t b = 0; b < sizeof bodies / sizeof bodies[0]; ++b) {
        aur_scene *const scene = must_load_uncut(bodies[b]);
        for (size_t r = 0; r < sizeof references / sizeof references[0]; ++r) {
            aur_light_reference at = references[r];
            at.position.x -= (float)aur_scene_origin(scene)[0];
            at.position.y -= (float)aur_scene_origin(scene)[1];
            at.position.z -= (float)aur_scene_origin(scene)[2];
            compare_with_each(scene, &at);
        }
        aur_scene_destroy(scene);
    }
}

/* Otherwise equal lights are chosen in proportion to their weights, with 0 counted as .001; also with lights
 * outside the tree. */
static void weights_count(void **state) {
    (void)state;
    enum { COUNT = 1 << 14 };
    aur_scene *const scene = must_load_body(
        "<emitter type='point'><point name='position' x='2' z='1'/><float name='sampling_weight' "
        "value='3'/></emitter>"
        "<emitter type='point'><point name='position' x='-2' z='1'/></emitter>"
        "<emitter type='point'><point name='position' y='2' z='1'/><float name='sampling_weight' "
        "value='0'/></emitter>"
        "<emitter type='directional'><float name='sampling_weight' value='2'/></emitter>"
        "<emitter type='directional'/><shape type='sphere'><float name='radius' value='.1'/></shape>");
    const double expected[] = {3.0 / 4.001, 1.0 / 4.001, 0.001 / 4.001};
    double counts[5] = {0.0};
    const aur_light_reference at = {.normal = {0.0f, 0.0f, 1.0f}};
    for (size_t i = 0; i < COUNT; ++i) {
        aur_light_sample sample;
        const float u[3] = {(float)spread_over(i, COUNT), 0.5f, 0.5f};
        assert_true(aur_light_sample_direct(scene, &at, u, &sample));
        ++counts[sample.emitter];
    }
    const double near = counts[0] + counts[1] + counts[2];
    for (size_t i = 0; i < 3; ++i)
        assert_near(counts[i] / near, expected[i], 2e-4);
    assert_near(counts[3] / counts[4], 2.0, 0.2); /* of some hundred */
    assert_true(counts[4] > 30.0);
    aur_scene_destroy(scene);
}

/* A single light uses its numbers unchanged, without a choice, and its weight has no effect. */
static void one_light_needs_no_tree(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body(SQUARE("<translate z='3'/>", AREA("2")) SQUARE("<translate z='5'/>", AREA("0")));
    assert_int_equal(scene->choice.tree.node_count, 0);
    const aur_light_reference at = {.normal = {0.0f, 0.0f, 1.0f}};
    const float u[3] = {0.3f, 0.4f, 0.9f};
    float same[3] = {0.3f, 0.4f, 0.9f};
    aur_chosen_light chosen;
    assert_true(aur_light_choose(scene, &at, same, &chosen));
    assert_memory_equal(u, same, sizeof u);
    assert_true(chosen.probability == 1.0f && chosen.part == AUR_WHOLE_LIGHT && chosen.emitter->index == 0);
    aur_scene_destroy(scene);
}

static void write_sky(void) {
    static const char head[] = "PF\n8 4\n-1\n";
    char bytes[sizeof head - 1 + 96 * sizeof(float)];
    memcpy(bytes, head, sizeof head - 1);
    for (size_t i = 0; i < 96; ++i) {
        const float radiance = 20.0f * unit(i, 9);
        memcpy(bytes + sizeof head - 1 + i * sizeof radiance, &radiance, sizeof radiance);
    }
    write_file("sky.pfm", bytes, sizeof bytes);
}

/* Sixteen references at once are bit-identical to single ones, with an environment that is sampled together,
 * and rectangles, some large enough to be sampled by solid angle. */
static void lanes_are_single_samples(void **state) {
    const char *const isa = *state;
    char body[16384];
    size_t length = (size_t)snprintf(
        body, sizeof body, "<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter>");
    write_sky();
    for (size_t i = 0; i < 40; ++i)
        length += (size_t)snprintf(
            body + length, sizeof body - length,
            "<emitter type='point'><point name='position' x='%g' y='%g' z='%g'/></emitter>",
            4.0 * (double)unit(i, 1) - 2.0, 4.0 * (double)unit(i, 2) - 2.0, 4.0 * (double)unit(i, 3));
    for (size_t i = 0; i < 12; ++i)
        length += (size_t)snprintf(
            body + length, sizeof body - length,
            SQUARE("<scale x='%g' y='%g'/><rotate x='1' angle='%g'/><translate x='%g' z='%g'/>", AREA("30")),
            i % 3 == 0 ? 2.0 : 0.1, 0.3 + (double)unit(i, 9), 360.0 * (double)unit(i, 10),
            4.0 * (double)unit(i, 11) - 2.0, 2.0 * (double)unit(i, 12) - 1.0);
    snprintf(body + length, sizeof body - length, SQUARE("<translate z='-1'/>", AREA("3")));
    setenv("AUREOLE_ISA", isa, 1);
    aur_isa_reset();
    aur_scene *const scene = must_load_body(body);
    aur_lane_vectors positions, normals;
    aur_lane_numbers choice, u, v;
    size_t from_sky = 0, drawn = 0;
    for (size_t round = 0; round < 100; ++round) {
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const size_t i = AUR_PACKET_SIZE * round + k;
            aur_lane_set(&positions, k, unit_point(i, 2.0f));
            aur_lane_set(&normals, k,
                         k % 2 == 0 ? (aur_vector){0} : aur_sample_sphere(unit(i, 4), unit(i, 5)));
            choice[k] = unit(i, 6);
            u[k] = unit(i, 7);
            v[k] = unit(i, 8);
        }
        const aur_light_references references = {&positions, &normals};
        aur_light_lanes lanes, fast;
        aur_light_lanes_each(scene, UINT16_MAX, &references, choice, u, v, &lanes);
        aur_light_lanes_direct(scene, UINT16_MAX, &references, choice, u, v, &fast);
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const aur_light_reference at = {aur_lane_vector(&positions, k), aur_lane_vector(&normals, k)};
            aur_light_sample one;
            if (!aur_light_sample_direct(scene, &at, (const float[3]){choice[k], u[k], v[k]}, &one))
                one = (aur_light_sample){0};
            const aur_light_sample lane = aur_light_lane(&lanes, k);
            assert_true(lane.pdf == one.pdf);
            drawn += one.pdf > 0.0f;
            from_sky += one.pdf > 0.0f && one.environment;
            assert_near(fast.pdf[k], one.pdf, 1e-4 * (double)one.pdf);
            if (one.pdf > 0.0f) {
                const aur_vector position = aur_lane_vector(&fast.position, k);
                assert_near(aur_vector_length(aur_vector_subtract(position, one.position)), 0.0,
                            1e-5 * (1.0 + (double)aur_vector_length(one.position)));
                assert_memory_equal(&lane.position, &one.position, sizeof one.position);
                assert_memory_equal(&lane.radiance, &one.radiance, sizeof one.radiance);
            }
        }
    }
    assert_true(from_sky > 100 && drawn - from_sky > 100);
    aur_scene_destroy(scene);
    unsetenv("AUREOLE_ISA");
    aur_isa_reset();
}

/* Few and all lanes of a packet choose what each does alone, with the same remainders: without a tree, with
 * one of one level and of two; beside lights without power, and numbers that rounding may lead beyond. */
static void lanes_choose_as_each_alone(void **state) {
    static const size_t counts[] = {0, 3, 16, 40};
    static const char directional[] =
        "<emitter type='directional'><rgb name='irradiance' value='%d'/></emitter>";
    setenv("AUREOLE_ISA", *state, 1);
    aur_isa_reset();
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c) {
        char body[8192];
        size_t length = 0;
        for (int i = 0; i < 6; ++i)
            length += (size_t)snprintf(body + length, sizeof body - length, directional, i % 3);
        for (size_t i = 0; i < counts[c]; ++i)
            length += (size_t)snprintf(
                body + length, sizeof body - length,
                "<emitter type='point'><point name='position' x='%g' y='%g' z='2'/></emitter>",
                4.0 * (double)unit(i, 1) - 2.0, 4.0 * (double)unit(i, 2) - 2.0);
        snprintf(body + length, sizeof body - length, directional, 0);
        aur_scene *const scene = must_load_body(body);
        size_t found = 0;
        for (size_t round = 0; round < 400; ++round) {
            aur_lane_vectors positions, normals;
            aur_lane_numbers choice, u, v;
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
                const size_t i = AUR_PACKET_SIZE * round + k;
                aur_lane_set(&positions, k, unit_point(i, 2.0f));
                aur_lane_set(&normals, k,
                             k % 3 == 0 ? (aur_vector){0} : aur_sample_sphere(unit(i, 4), unit(i, 5)));
                choice[k] = i % 9 == 0 ? 0x1.fffffep-1f : unit(i, 6);
                u[k] = unit(i, 7);
                v[k] = unit(i, 8);
            }
            const aur_light_references references = {&positions, &normals};
            const uint32_t lanes = round % 2 == 0 ? UINT16_MAX : 0x8404;
            aur_chosen_light chosen[AUR_PACKET_SIZE];
            float numbers[AUR_PACKET_SIZE][3];
            const uint32_t lit =
                aur_light_choose_lanes(scene, lanes, &references, choice, u, v, chosen, numbers);
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
                const aur_light_reference at = {aur_lane_vector(&positions, k), aur_lane_vector(&normals, k)};
                float rest[3] = {choice[k], u[k], v[k]};
                aur_chosen_light one;
                const bool is_lit = (lanes >> k & 1u) != 0 && aur_light_choose(scene, &at, rest, &one);
                assert_int_equal(lit >> k & 1u, is_lit);
                if (!is_lit)
                    continue;
                assert_true(chosen[k].emitter == one.emitter && chosen[k].part == one.part &&
                            chosen[k].probability == one.probability);
                assert_memory_equal(numbers[k], rest, sizeof rest);
                found += one.emitter->first_leaf != AUR_WHOLE_LIGHT;
            }
        }
        assert_true(counts[c] == 0 || found > 300);
        aur_scene_destroy(scene);
    }
    unsetenv("AUREOLE_ISA");
    aur_isa_reset();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probabilities_are_those_of_choosing),
        cmocka_unit_test(odd_transforms),
        cmocka_unit_test(same_light_as_each_alone),
        cmocka_unit_test(weights_count),
        cmocka_unit_test(one_light_needs_no_tree),
        cmocka_unit_test_prestate(lanes_choose_as_each_alone, "portable"),
        cmocka_unit_test_prestate(lanes_choose_as_each_alone, "avx2"),
        cmocka_unit_test_prestate(lanes_choose_as_each_alone, "avx512"),
        cmocka_unit_test_prestate(lanes_are_single_samples, "portable"),
        cmocka_unit_test_prestate(lanes_are_single_samples, "avx2"),
        cmocka_unit_test_prestate(lanes_are_single_samples, "avx512"),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
