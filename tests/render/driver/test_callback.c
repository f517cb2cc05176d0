/* A progress callback may call the library: core.h. */
#include "check.h"

#include <aureole-render/adaptive.h>
#include <aureole-render/render.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const scene_path = AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml";

/* More samples than a tile traces between callbacks (1 << 14 rays), so that a preview polls for cancellation,
 * too. */
enum { SIDE = 16, SAMPLES = 128 };

typedef struct preview {
    aur_renderer *renderer;
    const aur_image *reference;
    struct preview *inner; /* rendered in its callback */
    int calls, most;       /* previews; later calls render none */
} preview;

static aur_image *render(aur_renderer *renderer, const char *integrator, size_t samples,
                         aur_progress progress) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.samples_per_pixel = samples;
    options.integrator = integrator;
    options.threads = 2;
    options.use_cache = 0;
    options.progress = progress;
    aur_image *image;
    aur_error error = {0};
    const aur_result result = aur_renderer_render(renderer, &options, &image, NULL, &error);
    assert_string_equal(error.message, "");
    assert_int_equal(result, AUR_OK);
    return image;
}

static void assert_equal_images(const aur_image *a, const aur_image *b) {
    assert_memory_equal(aur_image_data(a), aur_image_data(b), SIDE * SIDE * 3 * sizeof(float));
}

static int show(void *user, const char *what, uint64_t done, uint64_t total) {
    preview *const p = user;
    (void)what;
    assert_true(done <= total);
    if (p == NULL || p->calls == p->most)
        return 0;
    ++p->calls;
    aur_image *const image = render(p->renderer, "path", SAMPLES, (aur_progress){show, p->inner});
    assert_equal_images(image, p->reference);
    aur_image_destroy(image);
    return 0;
}

typedef struct fixture {
    aur_scene *scene;
    aur_renderer *outer, *previews;
    aur_image *reference;
} fixture;

static fixture prepare(void) {
    fixture f;
    assert_int_equal(aur_scene_load(scene_path, NULL, &f.scene, NULL), AUR_OK);
    assert_int_equal(aur_renderer_create(f.scene, &f.outer, NULL), AUR_OK);
    assert_int_equal(aur_renderer_create(f.scene, &f.previews, NULL), AUR_OK);
    f.reference = render(f.previews, "path", SAMPLES, (aur_progress){0});
    alarm(120);
    return f;
}

static void finish(fixture *f) {
    aur_image_destroy(f->reference);
    aur_renderer_destroy(f->previews);
    aur_renderer_destroy(f->outer);
    aur_scene_destroy(f->scene);
    alarm(0);
}

/* Images inside and outside the callback equal those of separate renders. */
static void renders_previews(void **state) {
    (void)state;
    static const char *const integrators[] = {"path",
                                              "volpath",
                                              "finalgather:photons=3000",
                                              "direct",
                                              "ao",
                                              "radiosity:paths=20000",
                                              "aov:aovs=d:depth"};
    fixture f = prepare();
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i) {
        preview inner = {.renderer = f.previews, .reference = f.reference, .most = 1},
                shown = {.renderer = f.previews, .reference = f.reference, .inner = &inner, .most = 2};
        aur_image *const alone = render(f.outer, integrators[i], SAMPLES, (aur_progress){0});
        aur_renderer *again; /* which has nothing prepared */
        assert_int_equal(aur_renderer_create(f.scene, &again, NULL), AUR_OK);
        aur_image *const image = render(again, integrators[i], SAMPLES, (aur_progress){show, &shown});
        assert_equal_images(image, alone);
        assert_int_equal(shown.calls, 2);
        assert_int_equal(inner.calls, 1);
        aur_image_destroy(alone);
        aur_image_destroy(image);
        aur_renderer_destroy(again);
    }
    finish(&f);
}

static void renders_previews_of_an_error(void **state) {
    (void)state;
    fixture f = prepare();
    preview shown = {.renderer = f.previews, .reference = f.reference, .most = 2};
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.progress = (aur_progress){show, &shown};
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.rounds = 2;
    aur_adaptive *adaptive;
    assert_int_equal(aur_adaptive_create(f.outer, &options, &target, &adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(adaptive, NULL), AUR_OK);
    assert_int_equal(shown.calls, 2);
    aur_adaptive_destroy(adaptive);
    finish(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(renders_previews),
        cmocka_unit_test(renders_previews_of_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
