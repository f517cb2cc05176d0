/* Mirrors in Keller 1994 (section 4): radiance that hits one is reflected unchanged. In the analytic setting
 * the solution remains 1/2 if a wall of the cube becomes a mirror, so the deviation of the other walls can be
 * compared with that of the closed cube. An image of a room with a mirror is compared with path tracing. */
#include <math.h>
#include <string.h>

#include "study.h"

enum { TRIANGLES = 12 };

static const char *const columns[] = {"far_wall", "N", "deviation", NULL};

#define WALL(turn_, move_, of_)                                                                              \
    "<shape type='rectangle'><transform name='to_world'>" turn_ "<translate " move_ "/></transform>" of_     \
    "</shape>"
#define ROOM(others_, far_, left_, right_)                                                                   \
    WALL("<rotate x='1' angle='-90'/>", "y='-1'", others_)                                                   \
    WALL("<rotate x='1' angle='90'/>", "y='1'", others_)                                                     \
    WALL("<rotate y='1' angle='0'/>", "z='-1'", others_)                                                     \
    WALL("<rotate y='1' angle='90'/>", "x='-1'", left_)                                                      \
    WALL("<rotate y='1' angle='-90'/>", "x='1'", right_)                                                     \
    WALL("<rotate y='1' angle='180'/>", "z='1'", far_)
#define DIFFUSE(name_, color_)                                                                               \
    "<bsdf type='diffuse' id='" name_ "'><rgb name='reflectance' value='" color_ "'/></bsdf>"
#define MIRROR "<bsdf type='conductor' id='mirror'><string name='material' value='none'/></bsdf>"
#define LIT "<ref id='half'/><emitter type='area'><rgb name='radiance' value='0.25'/></emitter>"

static const struct {
    const char *far_wall, *scene;
} analytic[] = {
    {"mirror", "<scene version='3.0.0'>" DIFFUSE("half", "0.5")
                   MIRROR ROOM(LIT, "<ref id='mirror'/>", LIT, LIT) "</scene>"},
    {"like the others", "<scene version='3.0.0'>" DIFFUSE("half", "0.5") ROOM(LIT, LIT, LIT, LIT) "</scene>"},
};

/* A room with a coloured wall on either side, and a mirror at the far end. */
static const char mirrored[] =
    "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='75'/><transform "
    "name='to_world'>"
    "<lookat origin='0.3, 0.1, -0.9' target='-0.1, -0.1, 1' up='0, 1, 0'/></transform></sensor>" DIFFUSE(
        "white", "0.7, 0.7, 0.7") DIFFUSE("red", "0.6, 0.1, 0.1") DIFFUSE("green", "0.1, 0.5, 0.1")
        MIRROR ROOM(
            "<ref id='white'/>", "<ref id='mirror'/>", "<ref id='red'/>",
            "<ref id='green'/>") "<shape type='rectangle'><transform name='to_world'><scale value='0.4'/>"
                                 "<rotate x='1' angle='90'/><translate y='0.98'/></transform>"
                                 "<emitter type='area'><rgb name='radiance' value='9, 9, 9'/></emitter>"
                                 "</shape></scene>";

/* Delta_aw of the triangles except those of the far wall, which are the last two. */
static aur_result deviations(const lab_run *run, const char *text, double found[KELLER_SIZES],
                             aur_error *error) {
    aur_radiosity_triangle_result triangles[TRIANGLES];
    aur_scene *scene = NULL;
    aur_radiosity *radiosity = NULL;
    aur_result result = aur_scene_load_memory("cube.xml", strlen(text), text, NULL, &scene, error);
    if (result == AUR_OK)
        result = keller_start(run, scene, "halton", 0, 29, AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity, error);
    for (size_t n = 0; n < KELLER_SIZES && result == AUR_OK; ++n) {
        double squares = 0.0;
        result = aur_radiosity_trace(radiosity, keller_sizes[n], error);
        if (result == AUR_OK)
            result = aur_radiosity_get_results(radiosity, TRIANGLES, sizeof *triangles, triangles, error);
        for (size_t i = 0; i < TRIANGLES - 2 && result == AUR_OK; ++i)
            squares += pow(triangles[i].radiance[0] - 0.5, 2);
        found[n] = sqrt(squares) / (TRIANGLES - 2); /* all have equal areas */
    }
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
    return result;
}

/* The room with a mirror against path tracing: the mean's difference in percent, and that mean's noise. */
static aur_result compare_images(lab_run *run, double off[2], aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    aur_image *images[3] = {NULL};
    double means[3][4] = {{0}};
    lab_stage stage = {0};
    const char *const names[] = {"radiosity", "path"};
    aur_result result =
        aur_scene_load_memory("mirror.xml", sizeof mirrored - 1, mirrored, NULL, &stage.scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(stage.scene, &stage.renderer, error);
    for (size_t k = 0; k < 3 && result == AUR_OK; ++k) {
        const char *const radiosity =
            quick ? "radiosity:paths=2000" : "radiosity:paths=100000,gather_samples=64";
        const lab_rendering how = {.renderer = stage.renderer,
                                   .integrator = k == 0 ? radiosity : "path",
                                   .width = quick ? 16 : 80,
                                   .height = quick ? 16 : 80,
                                   .samples = k == 0  ? 16
                                              : quick ? 32
                                                      : 256,
                                   .seed = k};
        result = lab_render(run, &how, &images[k], error);
        if (result == AUR_OK)
            result = aur_image_mean(images[k], means[k], error);
        if (result == AUR_OK && k < 2)
            result = lab_image(run, &(lab_image_position){"mirror", names[k], k == 1, 0.0}, images[k], error);
    }
    const double reference = 0.5 * (means[1][3] + means[2][3]);
    off[0] = 100.0 * (means[0][3] / reference - 1.0);
    off[1] = 50.0 * fabs(means[1][3] - means[2][3]) / reference;
    for (size_t k = 0; k < 3; ++k)
        aur_image_destroy(images[k]);
    lab_stage_close(&stage);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    double found[2][KELLER_SIZES] = {{0}}, off[2] = {0};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        result = deviations(run, analytic[k].scene, found[k], error);
        for (size_t n = 0; n < KELLER_SIZES && result == AUR_OK; ++n)
            lab_row(run, (const char *const[]){analytic[k].far_wall, NULL}, 2,
                    (const double[]){(double)keller_sizes[n], found[k][n]});
    }
    if (result == AUR_OK)
        result = compare_images(run, off, error);
    if (result != AUR_OK)
        return result;
    const size_t last = KELLER_SIZES - 1;
    lab_claim(run, found[0][last] < 0.1 * found[0][0] && found[0][last] < 2.0 * found[1][last],
              "mirrors reflect without changing the radiance: the deviation from 1/2 falls with one as "
              "without, from %.4f to "
              "%.5f, and from %.4f to %.5f without",
              found[0][0], found[0][last], found[1][0], found[1][last]);
    lab_note(run,
             "image of a room with a mirror: the mean is %+.2f %% off path tracing's, whose noise is %.2f %%",
             off[0], off[1]);
    return AUR_OK;
}

static const report_plot plots[] = {
    {.name = "deviation",
     .title = "Deviation from the analytic solution of a cube with a mirror and without",
     .x = "N",
     .y = "deviation",
     .series = "far_wall",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_mirrors = {
    .name = "keller-1994-mirrors",
    .reproduces = "Keller 1994, mirrors (section 4)",
    .summary = "the analytic answer next to a mirror, and an image with one",
    .columns = columns,
    .plots = plots,
    .takes_no_set = "it compares walls",
    .seconds = 6,
    .quick_seconds = 0.7,
    .run = run,
    .takes_no_scene = "its answer is known for one cube only",
};
