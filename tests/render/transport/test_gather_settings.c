/* Valid settings of final gathering, and integrators of the caller. */
#include "check.h"
#include "render/scene/scene_text.h"

#include <aureole-render/render.h>
#include <string.h>

#include "program/lab/gather.h"
#include "render/gather/settings.h"

#define INITIAL AUR_GATHER_SETTINGS_INITIAL

static aur_result complete(aur_gather_settings options, char message[AUR_ERROR_MESSAGE_CAPACITY]) {
    aur_error error = {0};
    const aur_result result = aur_gather_settings_complete(&options, &error);
    strcpy(message, error.message);
    return result;
}

/* Defaults that depend on other options, and given values. */
static void defaults_follow(void **state) {
    (void)state;
    aur_gather_settings o = INITIAL;
    assert_int_equal(aur_gather_settings_complete(&o, NULL), AUR_OK);
    assert_int_equal(o.density, AUR_GATHER_DENSITY_OPTIMAL);
    assert_int_equal(o.direct, AUR_DIRECT_NEE);
    o = (aur_gather_settings)INITIAL;
    o.weights = AUR_WEIGHTS_EQUAL;
    o.debias = AUR_DEBIAS_ONLY;
    assert_int_equal(aur_gather_settings_complete(&o, NULL), AUR_OK);
    assert_int_equal(o.density, AUR_GATHER_DENSITY_SAME);
    assert_int_equal(o.direct, AUR_DIRECT_NONE);
    o = (aur_gather_settings)INITIAL;
    o.weights = AUR_WEIGHTS_METHOD;
    assert_int_equal(aur_gather_settings_complete(&o, NULL), AUR_OK);
    assert_int_equal(o.density, AUR_GATHER_DENSITY_OPTIMAL);
}

/* Every single change of the defaults, by the bits of `change`. */
enum { CHANGES = 10 };
static aur_gather_settings changed(unsigned change) {
    aur_gather_settings o = INITIAL;
    o.weights = (change >> 0 & 1u) != 0   ? AUR_WEIGHTS_EQUAL
                : (change >> 1 & 1u) != 0 ? AUR_WEIGHTS_METHOD
                                          : o.weights;
    o.density = (change >> 2 & 1u) != 0 ? AUR_GATHER_DENSITY_OPTIMAL : o.density;
    o.share = (change >> 3 & 1u) != 0 ? AUR_SHARE_BLOCKS : (change >> 4 & 1u) != 0 ? AUR_SHARE_NEAR : o.share;
    o.debias = (change >> 5 & 1u) != 0 ? AUR_DEBIAS_ALL : o.debias;
    o.caustic_photons = (change >> 6 & 1u) != 0 ? 9 : 0;
    o.decorrelation = (change >> 7 & 1u) != 0 ? AUR_DECORRELATION_RANDOM : o.decorrelation;
    o.pattern = (change >> 8 & 1u) != 0 ? "sobol" : o.pattern;
    o.scramble = (change >> 9 & 1u) != 0 ? "shift" : NULL;
    return o;
}

/* Rejected settings, as conditions on the fields. */
static bool is_refused(const aur_gather_settings *o) {
    const bool share = o->share != AUR_SHARE_NONE;
    const bool other_set = strcmp(o->pattern, "sobol") == 0 || o->scramble != NULL;
    return (o->weights == AUR_WEIGHTS_EQUAL && o->density == AUR_GATHER_DENSITY_OPTIMAL) ||
           (share && o->decorrelation != AUR_DECORRELATION_BLUE) ||
           (o->share == AUR_SHARE_NEAR && other_set) ||
           (o->debias != AUR_DEBIAS_NONE && (share || o->caustic_photons > 0));
}

static void exclusions_are_those_of_pairs(void **state) {
    (void)state;
    size_t refused = 0;
    for (unsigned change = 0; change < 1u << CHANGES; ++change) {
        const aur_gather_settings o = changed(change);
        char message[AUR_ERROR_MESSAGE_CAPACITY];
        const bool fails = complete(o, message) != AUR_OK;
        if (fails != is_refused(&o))
            fail_msg("%x: '%s'", change, message);
        refused += fails;
    }
    assert_true(refused > 0 && refused < 1u << CHANGES);
}

/* Each message names the conflicting options. */
static void messages_name_both(void **state) {
    (void)state;
    static const struct {
        unsigned change;
        aur_result result;
        const char *one, *other;
    } cases[] = {
        {1u << 0 | 1u << 2, AUR_ERROR_ARGUMENT, "equal weights", "density=optimal"},
        {1u << 3 | 1u << 7, AUR_ERROR_UNSUPPORTED, "share", "decorrelation=blue"},
        {1u << 4 | 1u << 9, AUR_ERROR_UNSUPPORTED, "share=near", "'scramble'"},
        {1u << 5 | 1u << 4, AUR_ERROR_UNSUPPORTED, "debias", "share"},
        {1u << 5 | 1u << 6, AUR_ERROR_UNSUPPORTED, "debias", "caustic_photons"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char message[AUR_ERROR_MESSAGE_CAPACITY];
        assert_int_equal(complete(changed(cases[i].change), message), cases[i].result);
        if (strstr(message, cases[i].one) == NULL || strstr(message, cases[i].other) == NULL)
            fail_msg("case %zu: '%s'", i, message);
    }
}

/* --- integrators of the caller's */

#define BALLS(of_)                                                                                           \
    "<emitter type='constant'/><shape type='sphere'><point name='center' z='4'/></shape>"                    \
    "<shape type='sphere'><point name='center' x='1.5' z='4'/>" of_ "</shape>"

static aur_result render_body(const char *body, const char *integrator, const aur_gather_integrator *gather,
                              aur_image **image, aur_error *error) {
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .filter = "box", /* independent samples per pixel */
                                        .width = 8,
                                        .height = 8,
                                        .samples_per_pixel = 2,
                                        .gather = gather};
    const aur_result result = aur_renderer_render(renderer, &options, image, NULL, error);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return result;
}

static aur_result render(const char *integrator, const aur_gather_integrator *gather, aur_image **image,
                         aur_error *error) {
    return render_body(BALLS(""), integrator, gather, image, error);
}

static const aur_key one_key[] = {{.name = "turns",
                                   .type = AUR_KEY_INTEGER,
                                   .help = "rotations",
                                   .default_text = "16",
                                   .maximum = 65536,
                                   .offset = offsetof(aur_gather_settings, rotations),
                                   .size = sizeof(size_t)}};
static const aur_key stray_key[] = {{.name = "stray",
                                     .type = AUR_KEY_INTEGER,
                                     .default_text = "1",
                                     .maximum = 9,
                                     .offset = sizeof(aur_gather_settings) - 4,
                                     .size = sizeof(uint64_t)}};
#define STUDY(keys_)                                                                                         \
    {                                                                                                        \
        .size = sizeof(aur_gather_integrator), .row = {.name = "study", .key_count = 1, .keys = (keys_) }    \
    }

/* Bit-identical to finalgather without further options; its keys, and an additional one. */
static void caller_has_integrators(void **state) {
    (void)state;
    static const aur_gather_integrator study = STUDY(one_key);
    static const char *const texts[] = {"finalgather:photons=50,diffuse_samples=4",
                                        "study:photons=50,diffuse_samples=4",
                                        "study:photons=50,diffuse_samples=4,turns=0",
                                        "finalgather-lab:photons=50,diffuse_samples=4,rotations=0"};
    aur_image *images[4];
    for (size_t i = 0; i < 4; ++i)
        assert_int_equal(render(texts[i], i == 3 ? &lab_finalgather : &study, &images[i], NULL), AUR_OK);
    const size_t bytes = 3 * 8 * 8 * sizeof(float);
    assert_memory_equal(aur_image_data(images[0]), aur_image_data(images[1]), bytes);
    assert_memory_not_equal(aur_image_data(images[1]), aur_image_data(images[2]), bytes);
    assert_memory_equal(aur_image_data(images[2]), aur_image_data(images[3]), bytes);
    for (size_t i = 0; i < 4; ++i)
        aur_image_destroy(images[i]);
}

static void caller_errors(void **state) {
    (void)state;
    static const aur_gather_integrator study = STUDY(one_key), stray = STUDY(stray_key), unsized = {0};
    static const struct {
        const char *integrator;
        const aur_gather_integrator *gather;
        aur_result result;
        const char *message;
    } cases[] = {
        {"study", NULL, AUR_ERROR_NAME, "study"},
        {"path", &unsized, AUR_ERROR_ARGUMENT, "aur_gather_integrator: 'size' is 0"},
        {"studi", &study, AUR_ERROR_NAME, "did you mean 'study'"},
        {"study:turn=1", &study, AUR_ERROR_NAME, "did you mean 'turns'"},
        {"study:stray=1", &stray, AUR_ERROR_ARGUMENT, "unknown field 'stray' of its settings"},
        {"finalgather-lab:adaptive=true,share=true", &lab_finalgather, AUR_ERROR_UNSUPPORTED, "share"},
        {"finalgather-lab:adaptive=true,debias=true", &lab_finalgather, AUR_ERROR_UNSUPPORTED, "debias"},
        {"finalgather-lab:adaptive=true,pattern=hammersley", &lab_finalgather, AUR_ERROR_UNSUPPORTED,
         "extensible"},
        {"finalgather-lab:adaptive=true,weights=mis", &lab_finalgather, AUR_ERROR_UNSUPPORTED, "take osw"},
        {"finalgather-lab:weights=oswa,rotations=0", &lab_finalgather, AUR_ERROR_ARGUMENT, "rotations"},
        {"finalgather-lab:weights=mis,share=near", &lab_finalgather, AUR_ERROR_UNSUPPORTED, "share needs"},
        {"finalgather-lab:adaptive=true,level_factor=3", &lab_finalgather, AUR_ERROR_ARGUMENT, "2 or 4"},
        {"study:debias=true,share=true", &study, AUR_ERROR_UNSUPPORTED, "share"},
        {"finalgather:rotations=0", &lab_finalgather, AUR_ERROR_NAME, "key of 'finalgather-lab'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        aur_image *image = NULL;
        aur_error error = {0};
        assert_int_equal(render(cases[i].integrator, cases[i].gather, &image, &error), cases[i].result);
        assert_null(image);
        if (strstr(error.message, cases[i].message) == NULL)
            fail_msg("%s: '%s'", cases[i].integrator, error.message);
    }
}

/* --- a method of the caller's */

static aur_result same_set(const aur_gather_settings *options, size_t base, size_t capacity, char *set,
                           size_t *count, aur_error *error) {
    (void)error;
    snprintf(set, capacity, "%s", options->pattern);
    *count = base;
    return AUR_OK;
}

static aur_result store(const aur_gather_settings *options, const aur_gather_common *common, size_t base,
                        const aur_gather_directions *pattern, void *diffuse, void **state, aur_error *error) {
    (void)options, (void)common, (void)base, (void)diffuse, (void)error;
    aur_gather_directions *const stored = malloc(sizeof *stored);
    assert_non_null(stored);
    *stored = *pattern;
    *state = stored;
    return AUR_OK;
}

/* Every direction once, with its weight. */
static void gather_plainly(const void *state, uint32_t lanes, aur_gather_sweep *sweep, float *memory) {
    const aur_gather_directions *const pattern = state;
    float sums[AUR_GATHER_LANES][3] = {{0}};
    for (size_t i = 0; i < pattern->count; ++i) {
        float(*const values)[AUR_GATHER_LANES] =
            (float(*)[AUR_GATHER_LANES])(memory + 3 * AUR_GATHER_LANES * i);
        aur_gather_trace(sweep, lanes, i, values);
        for (size_t lane = 0; lane < AUR_GATHER_LANES; ++lane)
            for (size_t c = 0; c < 3; ++c)
                sums[lane][c] += pattern->weights[i] * values[c][lane] / (float)pattern->count;
    }
    for (size_t lane = 0; lane < AUR_GATHER_LANES; ++lane)
        if ((lanes >> lane & 1u) != 0)
            aur_gather_finish(sweep, lane, sums[lane], pattern->count, 1);
}

static const aur_gather_method plain = {
    .choose = same_set, .prepare = store, .release = free, .gather = gather_plainly};
static aur_result take_plain(aur_gather_settings *options, aur_warnings warnings,
                             const aur_gather_method **method, aur_error *error) {
    (void)options, (void)warnings, (void)error;
    *method = &plain;
    return AUR_OK;
}

/* A method that implements gathering gives its image, to rounding; the directions of both samples are
 * counted. */
static void caller_gathers(void **state) {
    (void)state;
    aur_gather_integrator copy = lab_finalgather;
    copy.row.name = "own";
    copy.select = take_plain;
#define KEYS ":photons=500,diffuse_samples=24,glossy_samples=12,decorrelation=none,clip=false,edges=0,split=1"
    aur_image *images[2];
    assert_int_equal(render("finalgather-lab" KEYS, &lab_finalgather, &images[0], NULL), AUR_OK);
    assert_int_equal(render("own" KEYS, &copy, &images[1], NULL), AUR_OK);
#undef KEYS
    aur_image *none = NULL;
    assert_int_equal(render("own:pattern=sobol,rotations=0", &copy, &none, NULL), AUR_ERROR_UNSUPPORTED);
    assert_null(none);
    assert_int_equal(aur_image_channel_count(images[0]), 3);
    assert_int_equal(aur_image_channel_count(images[1]), 4);
    const size_t counted = aur_image_find_channel(images[1], "directions");
    size_t hits = 0;
    for (size_t i = 0; i < 8 * 8; ++i) {
        const float *const found = aur_image_data(images[1]) + 4 * i;
        for (size_t c = 0; c < 3; ++c)
            assert_relative((double)found[c], (double)aur_image_data(images[0])[3 * i + c], 1e-5);
        assert_true(found[counted] >= 0.0f && found[counted] <= 48.0f);
        hits += found[counted] == 48.0f;
    }
    assert_true(hits > 4);
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
}

/* --- pairs of lobes */

/* A pattern, and the subsets that the samples of a pixel split it into. */
typedef struct pair_state {
    aur_gather_directions pattern;
    size_t subsets;
} pair_state;

static aur_result store_pair(const aur_gather_settings *options, const aur_gather_common *common, size_t base,
                             const aur_gather_directions *pattern, void *diffuse, void **state,
                             aur_error *error) {
    (void)options, (void)error;
    assert_true(pattern->count >= base && pattern->copies == 1);
    assert_true((diffuse == NULL) == (pattern->exponent == 1.0));
    pair_state *const stored = malloc(sizeof *stored);
    assert_non_null(stored);
    *stored = (pair_state){*pattern, common->subsets};
    *state = stored;
    return AUR_OK;
}

/* Adds one lobe of a lane by this sample's part of its pattern, in the library's frame about the axis. */
static void gather_lobe(const pair_state *state, const aur_gather_shading_point *point, size_t lobe,
                        size_t lane, aur_gather_sweep *sweep) {
    const float *const n = point->axes[lobe];
    const float sign = copysignf(1.0f, n[2]), a = -1.0f / (sign + n[2]), b = n[0] * n[1] * a;
    const float x[3] = {1.0f + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    const float y[3] = {b, sign + n[1] * n[1] * a, -n[1]};
    const aur_gather_directions *const pattern = &state->pattern;
    float sum[3] = {0};
    for (size_t i = aur_gather_subset(sweep); i < pattern->count; i += state->subsets) {
        float directions[3][AUR_GATHER_LANES] = {{0}}, densities[AUR_GATHER_LANES] = {0};
        float cosines[AUR_GATHER_LANES], radiance[3][AUR_GATHER_LANES];
        for (size_t c = 0; c < 3; ++c)
            directions[c][lane] = x[c] * pattern->x[i] + y[c] * pattern->y[i] + n[c] * pattern->z[i];
        const uint32_t aimed = aur_gather_trace_directions(
            sweep, 1u << lane, i, (const float(*)[AUR_GATHER_LANES])directions, densities, cosines, radiance);
        if (aimed == 0)
            continue;
        assert_int_equal(aimed, 1u << lane);
        const float factor = lobe == 1 && point->times_cosine ? cosines[lane] : 1.0f;
        for (size_t c = 0; c < 3; ++c)
            sum[c] += factor * pattern->weights[i] * radiance[c][lane] * point->colours[lobe][c];
    }
    for (size_t c = 0; c < 3; ++c)
        sum[c] /= (float)(pattern->count / state->subsets);
    aur_gather_reflect(sweep, lane, sum);
}

/* Each lobe of a pair by its pattern; points with a diffuse lobe remain for the library. */
static uint32_t gather_each(const void *diffuse, uint32_t lanes, aur_gather_sweep *sweep, float *memory) {
    uint32_t gathered = 0;
    (void)memory;
    for (size_t lane = 0; lane < AUR_GATHER_LANES; ++lane) {
        aur_gather_shading_point point;
        if (!aur_gather_describe(sweep, lane, &point)) {
            assert_int_equal(lanes >> lane & 1u, 0);
            continue;
        }
        assert_true(point.view[2] > 0.0f && !point.mirrored && point.rotation == 0);
        if (point.state == NULL) {
            assert_true(point.cosine == 1.0f && point.sine == 0.0f && point.first == 0);
            continue;
        }
        gathered |= 1u << lane;
        gather_lobe(diffuse, &point, 0, lane, sweep);
        gather_lobe(point.state, &point, 1, lane, sweep);
    }
    return gathered;
}

static float no_density(const void *glossy, const float cosines[2]) {
    (void)glossy, (void)cosines;
    return 0.0f;
}

static const aur_gather_method each_lobe = {
    .prepare = store_pair, .release = free, .gather_pairs = gather_each, .pair_density = no_density};
static aur_result take_each_lobe(aur_gather_settings *options, aur_warnings warnings,
                                 const aur_gather_method **method, aur_error *error) {
    (void)options, (void)warnings, (void)error;
    *method = &each_lobe;
    return AUR_OK;
}

/* A ball with a diffuse and a glossy lobe, gathered by a method for pairs that gathers each lobe alone: the
 * library's image, to rounding. */
static void caller_gathers_pairs(void **state) {
    (void)state;
    static const char body[] = BALLS("<bsdf type='phong'><float name='exponent' value='9'/></bsdf>");
    aur_gather_integrator copy = lab_finalgather;
    copy.row.name = "own";
    copy.select = take_each_lobe;
#define KEYS                                                                                                 \
    ":photons=500,diffuse_samples=24,glossy_samples=12,decorrelation=none,clip=false,edges=0,direct=gather," \
    "short_rays=0"
    aur_image *images[2];
    assert_int_equal(render_body(body, "finalgather-lab" KEYS, &lab_finalgather, &images[0], NULL), AUR_OK);
    assert_int_equal(render_body(body, "own" KEYS, &copy, &images[1], NULL), AUR_OK);
#undef KEYS
    assert_int_equal(aur_image_channel_count(images[1]), 3);
    for (size_t i = 0; i < 3 * 8 * 8; ++i)
        assert_relative((double)aur_image_data(images[1])[i], (double)aur_image_data(images[0])[i], 1e-5);
    assert_memory_not_equal(aur_image_data(images[0]), aur_image_data(images[1]), 3 * 8 * 8 * sizeof(float));
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
}

/* The published method has the published regularisation, others 1e-6. */
static void regularization_follows(void **state) {
    (void)state;
    static const char body[] = BALLS("<bsdf type='phong'><float name='exponent' value='9'/></bsdf>");
    static const char *const keys[] = {"oswa-solve", "oswa-solve,regularization=0.5", "oswa",
                                       "oswa,regularization=1e-6", "oswa,regularization=0.5"};
    aur_image *images[5];
    for (size_t i = 0; i < 5; ++i) {
        char integrator[256];
        snprintf(integrator, sizeof integrator,
                 "finalgather-lab:photons=50,diffuse_samples=6,glossy_samples=4,weights=%s", keys[i]);
        assert_int_equal(render_body(body, integrator, &lab_finalgather, &images[i], NULL), AUR_OK);
    }
    const size_t bytes = 3 * 8 * 8 * sizeof(float);
    assert_memory_equal(aur_image_data(images[0]), aur_image_data(images[1]), bytes);
    assert_memory_equal(aur_image_data(images[2]), aur_image_data(images[3]), bytes);
    assert_memory_not_equal(aur_image_data(images[2]), aur_image_data(images[4]), bytes);
    for (size_t i = 0; i < 5; ++i)
        aur_image_destroy(images[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_follow),      cmocka_unit_test(exclusions_are_those_of_pairs),
        cmocka_unit_test(messages_name_both),   cmocka_unit_test(caller_has_integrators),
        cmocka_unit_test(caller_errors),        cmocka_unit_test(caller_gathers),
        cmocka_unit_test(caller_gathers_pairs), cmocka_unit_test(regularization_follows),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
