/* Calls each function of image.h, scene.h, film.h, render.h, adaptive.h, radiosity.h, irradiance.h and
 * daylight.h, most of them with bad input too.
 */
#include <aureole-lighting/daylight.h>
#include <aureole-lighting/view_factors.h>
#include <aureole-render/adaptive.h>
#include <aureole-render/radiosity.h>
#include <aureole-render/render.h>

#include "calls.h"

static aur_error error;

/* A square that shines on another one which faces it. */
static const char scene_text[] =
    "<scene version=\"3.0.0\">\n"
    "<integrator type=\"path\"/>\n"
    "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>\n"
    "<transform name=\"to_world\"><lookat origin=\"0,-6,1\" target=\"0,0,1\" up=\"0,0,1\"/></transform>\n"
    "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"2\"/></sampler>\n"
    "<film type=\"hdrfilm\"><integer name=\"width\" value=\"8\"/><integer name=\"height\" "
    "value=\"8\"/></film></sensor>\n"
    "<shape type=\"rectangle\"><bsdf type=\"diffuse\"/></shape>\n"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/><translate "
    "z=\"2\"/></transform>\n"
    "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>\n"
    "</scene>\n";

static void images(void) {
    aur_image *image = NULL, *other = NULL;
    refuse(aur_image_create(0, 4, 3, &image, &error), AUR_ERROR_ARGUMENT, &error);
    accept(aur_image_create(4, 4, 3, &image, &error), &error);
    require(aur_image_width(image) == 4 && aur_image_height(image) == 4 &&
                aur_image_channel_count(image) == 3,
            "a picture's size");
    for (size_t i = 0; i < 48; ++i)
        aur_image_data(image)[i] = (float)(i % 5) / 4.0f;
    require(strcmp(aur_image_channel_name(image, 0), "R") == 0 && aur_image_find_channel(image, "G") == 1,
            "channels by name");
    accept(aur_image_name_channel(image, 2, "B", &error), &error);
    size_t channels[3];
    require(aur_image_color_channels(image, channels) && channels[2] == 2, "aur_image_color_channels");
    size_t odd[3] = {0, 0, 0};
    aur_image_count_odd(image, 1, odd);
    require(odd[0] + odd[1] + odd[2] == 0 && aur_image_notes(image)[0] == '\0',
            "values that are as they should be");
    aur_image_write_options options = {.size = sizeof options};
    aur_image_write_options_init(&options, NULL);
    const aur_row *row;
    accept(aur_image_find_writer("calls.png", NULL, &row, &error), &error);
    require(aur_row_find_key(row, "tone") != NULL && aur_row_find_key(row, "half") == NULL, "keys of PNG");
    accept(aur_image_find_writer("-", NULL, &row, &error), &error);
    require(strcmp(row->name, "exr") == 0, "aur_image_find_writer");
    refuse(aur_image_find_writer("calls.png", "gif", &row, &error), AUR_ERROR_NAME, &error);
    accept(aur_image_write("calls.pfm", image, &options, &error), &error);
    refuse(aur_image_write("calls.doc", image, NULL, &error), AUR_ERROR_NAME, &error);
    refuse(aur_image_read("no such folder/calls.pfm", &other, &error), AUR_ERROR_OPEN, &error);
    accept(aur_image_read("calls.pfm", &other, &error), &error);
    remove("calls.pfm");
    double value[4], mean[4];
    aur_image_metric metric;
    accept(aur_image_metric_from_name("rmse", &metric, &error), &error);
    aur_tone tone;
    aur_reflected reflected;
    accept(aur_tone_from_name("filmic", &tone, &error), &error);
    accept(aur_reflected_from_name("map", &reflected, &error), &error);
    aur_model_light light = AUR_MODEL_LIGHT_AUTO;
    accept(aur_model_light_from_name("none", &light, &error), &error);
    require(light == AUR_MODEL_LIGHT_NONE, "light of models");
    refuse(aur_model_light_from_name("dim", &light, &error), AUR_ERROR_NAME, &error);
    require(light == AUR_MODEL_LIGHT_NONE && strcmp(aur_model_light_name(light), "none") == 0, "its name");
    require(aur_model_light_name((aur_model_light)9) == NULL, "no name");
    refuse(aur_tone_from_name("sepia", &tone, &error), AUR_ERROR_NAME, &error);
    refuse(aur_reflected_from_name("mirrors", &reflected, &error), AUR_ERROR_NAME, &error);
    require(strcmp(aur_tone_name(tone), "filmic") == 0 && aur_tone_name((aur_tone)9) == NULL, "tones");
    require(strcmp(aur_reflected_name(reflected), "map") == 0 && aur_reflected_name((aur_reflected)9) == NULL,
            "ways to find reflected light");
    require(strcmp(aur_image_metric_name(metric), "rmse") == 0, "aur_image_metric_name");
    accept(aur_image_compare(image, other, metric, value, &error), &error);
    require(value[3] == 0.0, "a picture comes back from its file");
    aur_error_measure measure;
    accept(aur_error_measure_from_name("display", &measure, &error), &error);
    refuse(aur_error_measure_from_name("pixel", &measure, &error), AUR_ERROR_NAME, &error);
    require(strcmp(aur_error_measure_name(measure), "display") == 0, "its name");
    accept(aur_image_error(image, other, measure, value, &error), &error);
    require(value[0] == 0.0, "equal images have no error");
    accept(aur_image_mean(image, mean, &error), &error);
    aur_image_destroy(other);
    static const char bytes[] = "PF\n1 1\n-1.0\n............";
    require(strcmp(aur_image_format_of(sizeof bytes - 1, bytes), "PFM") == 0, "aur_image_format_of");
    accept(aur_image_read_memory("calls", sizeof bytes - 1, bytes, &other, &error), &error);
    refuse(aur_image_compare(image, other, metric, value, &error), AUR_ERROR_ARGUMENT, &error);
    aur_image_destroy(other);
    refuse(aur_image_read_memory("calls", 4, bytes, &other, &error), AUR_ERROR_FORMAT, &error);
    const char *const green[] = {"G"};
    accept(aur_image_select(image, 1, green, &other, &error), &error);
    aur_image *created[4];
    accept(aur_image_downsample(image, 2, &created[0], &error), &error);
    accept(aur_image_flip(image, image, &created[1], &error), &error);
    accept(aur_image_false_color(other, 1.0, &created[2], &error), &error);
    accept(aur_image_difference(image, image, 1.0, &created[3], &error), &error);
    for (size_t i = 0; i < 4; ++i)
        aur_image_destroy(created[i]);
    aur_image_destroy(other);
    aur_image_destroy(image);
    float pixel = 1.0f;
    accept(aur_image_wrap(1, 1, 1, &pixel, &image, &error), &error);
    require(aur_image_data(image) == &pixel, "aur_image_wrap");
    aur_image_destroy(image);
}

static aur_scene *scenes(void) {
    aur_scene *scene = NULL;
    aur_scene_options options = {.size = sizeof options};
    aur_scene_options_init(&options, NULL);
    refuse(aur_scene_load("no such folder/calls.xml", &options, &scene, &error), AUR_ERROR_OPEN, &error);
    refuse(aur_scene_load_memory("calls", 3, "<a>", &options, &scene, &error), AUR_ERROR_FORMAT, &error);
    options.light_modifier = "lamp";
    refuse(aur_scene_load_memory("calls", sizeof scene_text - 1, scene_text, &options, &scene, &error),
           AUR_ERROR_NAME, &error);
    options.light_modifier = NULL;
    accept(aur_scene_load_memory("calls", sizeof scene_text - 1, scene_text, &options, &scene, &error),
           &error);
    aur_scene_description d = {.size = sizeof d};
    accept(aur_scene_get_description(scene, &d, &error), &error);
    require(d.shapes == 2 && d.width == 8, "aur_scene_get_description");
    d.size = 0;
    refuse(aur_scene_get_description(scene, &d, &error), AUR_ERROR_ARGUMENT, &error);
    static const char lamp[] = "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0 1 1 9\n0 180\n0\n1 1\n";
    aur_luminaire_description luminaire = {.size = sizeof luminaire};
    accept(aur_luminaire_describe("calls.ies", sizeof lamp - 1, lamp, &luminaire, &error), &error);
    require(fabs(luminaire.lumens - 12.566370614) < 1e-6 && luminaire.lamp_lumens == 1000.0,
            "aur_luminaire_describe");
    refuse(aur_luminaire_describe("calls.ies", 5, lamp, &luminaire, &error), AUR_ERROR_FORMAT, &error);
    return scene;
}

static void films(const aur_film *film) {
    aur_image *image = NULL;
    accept(aur_film_develop(film, &image, &error), &error);
    aur_image_destroy(image);
    double rmse[4];
    accept(aur_film_error(film, rmse, NULL, &error), &error);
}

static void renders(const aur_scene *scene) {
    require(aur_render_table_at(0) != NULL && aur_render_table_at(1000) == NULL, "aur_render_table_at");
    aur_renderer *renderer = NULL;
    accept(aur_renderer_create(scene, &renderer, &error), &error);
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    aur_render *render = NULL;
    options.integrator = "nothing";
    refuse(aur_render_create(renderer, &options, &render, &error), AUR_ERROR_NAME, &error);
    options.integrator = NULL;
    aur_image *image = NULL;
    accept(aur_renderer_render(renderer, &options, &image, NULL, &error), &error);
    aur_image_destroy(image);
    accept(aur_render_create(renderer, &options, &render, &error), &error);
    accept(aur_render_step(render, 1, &error), &error);
    accept(aur_render_step(render, 1, &error), &error);
    require(aur_render_samples(render) == 2 && aur_render_samples_target(render) == 2, "a render's samples");
    require(aur_render_steps_agree(render), "a render by path in steps");
    aur_render_statistics statistics = {.size = sizeof statistics};
    accept(aur_render_get_statistics(render, &statistics, &error), &error);
    require(statistics.samples == 128, "aur_render_get_statistics");
    films(aur_render_film(render));
    refuse(aur_render_save(render, "calls.part", &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_render_resume(render, "calls.part", &error), AUR_ERROR_ARGUMENT, &error);
    aur_render_cancel(render);
    aur_render_destroy(render);
    options.resumable = true;
    options.use_cache = true;
    accept(aur_render_create(renderer, &options, &render, &error), &error);
    accept(aur_render_step(render, 0, &error), &error);
    accept(aur_render_save(render, "calls.part", &error), &error);
    aur_render_destroy(render);
    accept(aur_render_create(renderer, &options, &render, &error), &error);
    accept(aur_render_resume(render, "calls.part", &error), &error);
    require(aur_render_samples(render) == 2, "aur_render_resume");
    aur_render_destroy(render);
    const char *const part = "calls.part";
    aur_film *film = NULL;
    accept(aur_render_merge_parts(1, &part, &film, &error), &error);
    aur_film_destroy(film);
    remove("calls.part");
    aur_renderer_destroy(renderer);
}

static void adaptive_renders(const aur_scene *scene) {
    aur_renderer *renderer = NULL;
    accept(aur_renderer_create(scene, &renderer, &error), &error);
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    aur_adaptive *adaptive = NULL;
    target.error = -1.0;
    refuse(aur_adaptive_create(renderer, NULL, &target, &adaptive, &error), AUR_ERROR_ARGUMENT, &error);
    target.error = 0.5;
    accept(aur_adaptive_create(renderer, NULL, &target, &adaptive, &error), &error);
    require(strcmp(aur_adaptive_integrator(adaptive), "path") == 0, "aur_adaptive_integrator");
    aur_adaptive_cancel(adaptive);
    refuse(aur_adaptive_run(adaptive, &error), AUR_ERROR_CANCELLED, &error);
    accept(aur_adaptive_run(adaptive, &error), &error);
    refuse(aur_adaptive_save(adaptive, "calls.part", &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_adaptive_resume(adaptive, "calls.part", &error), AUR_ERROR_ARGUMENT, &error);
    aur_adaptive_report report = {.size = sizeof report};
    accept(aur_adaptive_get_report(adaptive, &report, &error), &error);
    require(report.error_high <= 0.5 && report.rounds > 0, "aur_adaptive_get_report");
    report.size = 0;
    refuse(aur_adaptive_get_report(adaptive, &report, &error), AUR_ERROR_ARGUMENT, &error);
    aur_image *image = NULL;
    accept(aur_adaptive_develop(adaptive, true, &image, &error), &error);
    require(aur_image_channel_count(image) == 6, "aur_adaptive_develop");
    aur_image_destroy(image);
    accept(aur_adaptive_develop_half(adaptive, 1, &image, &error), &error);
    aur_error_figures halves;
    accept(aur_adaptive_compare_halves(adaptive, (const aur_image *const[2]){image, image}, &halves, &error),
           &error);
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    aur_renderer_destroy(renderer);
}

static void radiosity_solutions(const aur_scene *scene) {
    aur_sensors_options sensors = {.size = sizeof sensors};
    accept(aur_sensors_options_init(&sensors, &error), &error);
    aur_radiosity_options options = {.size = sizeof options};
    accept(aur_radiosity_options_init(&options, &error), &error);
    require(options.bounces == 6 && options.randomizations == 1, "the options of radiosity");
    aur_radiosity *radiosity = NULL;
    options.bounces = 0;
    refuse(aur_radiosity_create(scene, &options, &radiosity, &error), AUR_ERROR_ARGUMENT, &error);
    options.bounces = 3;
    accept(aur_radiosity_create(scene, &options, &radiosity, &error), &error);
    accept(aur_radiosity_trace(radiosity, 64, &error), &error);
    aur_radiosity_termination rule = {.size = sizeof rule};
    aur_radiosity_termination_init(0.5, &rule, NULL);
    rule.interval = 64;
    bool converged = false;
    accept(aur_radiosity_terminate(radiosity, &rule, &converged, &error), &error);
    aur_radiosity_description d = {.size = sizeof d};
    accept(aur_radiosity_get_description(radiosity, &d, &error), &error);
    aur_radiosity_triangle_result results[4];
    require(d.triangles == 4, "aur_radiosity_get_description");
    accept(aur_radiosity_get_results(radiosity, 4, sizeof results[0], results, &error), &error);
    refuse(aur_radiosity_get_results(radiosity, 3, sizeof results[0], results, &error), AUR_ERROR_CAPACITY,
           &error);
    aur_radiosity_destroy(radiosity);
}

static void irradiances(const aur_scene *scene) {
    static const char text[] = "0 0 0 0 0 1\n";
    accept(aur_file_write("calls.pts", sizeof text - 1, text, &error), &error);
    aur_sensors *sensors = NULL;
    accept(aur_sensors_read("calls.pts", NULL, &sensors, &error), &error);
    remove("calls.pts");
    const aur_sensors_view *const view = aur_sensors_get_view(sensors);
    require(view->count == 1 && view->normals[2] == 1.0, "aur_sensors_get_view");
    aur_irradiance_options options = {.size = sizeof options};
    aur_irradiance_options_init(&options, NULL);
    aur_irradiance result;
    options.error = 2.0;
    refuse(aur_irradiance_estimate(scene, view, &options, sizeof result, &result, &error), AUR_ERROR_ARGUMENT,
           &error);
    options.error = 0.0;
    options.directions = 64;
    accept(aur_irradiance_estimate(scene, view, &options, sizeof result, &result, &error), &error);
    require(result.directions == 64 && result.value[AUR_IRRADIANCE_TOTAL][0] >= 0.0,
            "aur_irradiance_estimate");
    accept(aur_irradiance_write("calls.csv", "csv", NULL, view, sizeof result, &result, &error), &error);
    remove("calls.csv");
    refuse(aur_irradiance_write("calls.csv", "cvs", NULL, view, sizeof result, &result, &error),
           AUR_ERROR_NAME, &error);
    aur_sensors_destroy(sensors);
}

/* Four cells of one unit on the square from -1 to 1. */
static void grids(const aur_scene *scene) {
    aur_grid_options options = {.size = sizeof options};
    accept(aur_grid_options_init(&options, &error), &error);
    options.target = "-1,-1,1,1,0";
    options.spacing = 1.0;
    options.up[2] = 1.0;
    aur_sensors *sensors = NULL;
    accept(aur_sensors_grid(scene, &options, &sensors, &error), &error);
    require(aur_sensors_get_view(sensors)->count == 4, "aur_sensors_grid");
    aur_sensors_destroy(sensors);
    options.spacing = 0.0;
    refuse(aur_sensors_grid(scene, &options, &sensors, &error), AUR_ERROR_ARGUMENT, &error);
}

/* A year of the same overcast hour, day and night. */
static void years(const aur_scene *scene) {
    static const double position[3] = {0.0, 0.0, 5.0}, normal[3] = {0.0, 0.0, 1.0};
    static aur_weather_hour hours[8760];
    aur_weather *weather = NULL;
    refuse(aur_weather_read("no such folder/calls.epw", &weather, &error), AUR_ERROR_OPEN, &error);
    aur_weather_destroy(weather);
    for (int i = 0; i < 8760; ++i)
        hours[i] = (aur_weather_hour){2001, 7, 1 + i / 24 % 28, 1 + i % 24, 0, 0.0, 100.0, 100.0, 10.0};
    const aur_weather_view view = {.size = sizeof view, .count = 8760, .hours = hours};
    const aur_sensors_view sensors = {
        .size = sizeof sensors, .count = 1, .positions = position, .normals = normal};
    aur_daylight_options options = {.size = sizeof options};
    aur_daylight_options_init(&options, NULL);
    aur_daylight result;
    aur_daylight_summary summary = {.size = sizeof summary};
    options.subdivision = 7;
    refuse(aur_daylight_estimate(scene, &sensors, &view, &options, sizeof result, &result, &summary, &error),
           AUR_ERROR_ARGUMENT, &error);
    options.subdivision = 0;
    options.directions = 64;
    options.up[2] = 1.0;
    accept(aur_daylight_estimate(scene, &sensors, &view, &options, sizeof result, &result, &summary, &error),
           &error);
    require(summary.hours == 3650 && result.value[AUR_DAYLIGHT_AUTONOMY] == 100.0, "aur_daylight_estimate");
    options.daylight_hours = true;
    accept(aur_daylight_estimate(scene, &sensors, &view, &options, sizeof result, &result, &summary, &error),
           &error);
    require(summary.hours == 4380, "daylight_hours");
    static double hourly[2 * 8760], normals[3 * 8760];
    static const bool evaluated[8760] = {true};
    options.hourly = hourly;
    options.evaluated = evaluated;
    accept(aur_daylight_estimate(scene, &sensors, &view, &options, sizeof result, &result, NULL, &error),
           &error);
    require(hourly[0] > 0.0 && hourly[1] == 0.0 &&
                fabs(result.value[AUR_DAYLIGHT_ANNUAL] / hourly[0] - 1.0) < 1e-9,
            "one evaluated hour");
    aur_tracker_options tracker = {.size = sizeof tracker};
    aur_tracker_options_init(&tracker, NULL);
    accept(aur_tracker_normals(scene, &view, &tracker, NULL, NULL, NULL, normals, &error), &error);
    tracker.limit = 95.0;
    refuse(aur_tracker_normals(scene, &view, &tracker, NULL, NULL, NULL, normals, &error), AUR_ERROR_ARGUMENT,
           &error);
    options.hourly = NULL;
    options.evaluated = NULL;
    double coefficients[146 * 3], errors[146 * 3];
    options.subdivision = 7;
    refuse(aur_daylight_coefficients(scene, &sensors, &options, coefficients, errors, &error),
           AUR_ERROR_ARGUMENT, &error);
    options.subdivision = 1;
    accept(aur_daylight_coefficients(scene, &sensors, &options, coefficients, errors, &error), &error);
    require(aur_daylight_patch_count(1) == 146 && errors[0] >= 0.0, "aur_daylight_coefficients");
    accept(aur_daylight_coefficients_write("calls.mtx", 1, 1, coefficients, &error), &error);
    remove("calls.mtx");
    refuse(aur_daylight_coefficients_write("no such folder/calls.mtx", 1, 1, coefficients, &error),
           AUR_ERROR_WRITE, &error);
    accept(aur_daylight_write("calls.csv", "csv", &sensors, sizeof result, &result, &error), &error);
    remove("calls.csv");
    refuse(aur_daylight_write("calls.csv", "cvs", &sensors, sizeof result, &result, &error), AUR_ERROR_NAME,
           &error);
}

static void view_factors(void) {
    static const double floor[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const double ceiling[] = {0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1};
    double factor = 0.0;
    accept(aur_view_factor_polygons(4, floor, 4, ceiling, &factor, &error), &error);
    require(fabs(factor - 0.1998) < 1e-4, "the view factor of two facing unit squares"); /* Howell C-11 */
    refuse(aur_view_factor_polygons(2, floor, 4, ceiling, &factor, &error), AUR_ERROR_ARGUMENT, &error);
}

int main(void) {
    images();
    aur_scene *const scene = scenes();
    renders(scene);
    adaptive_renders(scene);
    radiosity_solutions(scene);
    irradiances(scene);
    grids(scene);
    years(scene);
    aur_scene_destroy(scene);
    view_factors();
    return 0;
}
