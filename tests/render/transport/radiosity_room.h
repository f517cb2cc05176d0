/* The room that tests of radiosity trace, and how they do it. */
#pragma once

#include <aureole-render/radiosity.h>

#include "render/scene/scene_text.h"

/* Walls of [-1,1]^3, seen from inside, that emit 1/4 and reflect half: the radiance is 1/2 everywhere. */
#define WALL_MATERIAL                                                                                        \
    "<bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf>"                                      \
    "<emitter type='area'><rgb name='radiance' value='0.25'/></emitter>"
#define INSIDE "<boolean name='flip_normals' value='true'/>"
#define ROOM "<shape type='cube'>" INSIDE WALL_MATERIAL "</shape>"
/* A wall of it at z = 1 that faces down, and the other five. */
#define LID(material)                                                                                        \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='180'/><translate z='1'/>"       \
    "</transform>" material "</shape>"
#define FIVE_WALLS                                                                                           \
    "<shape type='rectangle'><transform name='to_world'><translate z='-1'/></transform>" WALL_MATERIAL       \
    "</shape>"                                                                                               \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/><translate y='1'/>"        \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='-90'/><translate y='-1'/>"      \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='90'/><translate x='-1'/>"       \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='-90'/><translate x='1'/>"       \
    "</transform>" WALL_MATERIAL "</shape>"

enum { MOST_TRIANGLES = 64 };

/* The path of a file in the test program's folder; the last two given out stay as they are. */
static inline const char *path_of(const char *name) {
    static char path[2][128];
    static int turn;
    turn = 1 - turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", scene_folder, name);
    return path[turn];
}

typedef struct messages {
    size_t count;
    char text[1024];
} messages;

static inline void store_message(void *user, const char *message) {
    messages *const received = user;
    ++received->count;
    snprintf(received->text, sizeof received->text, "%s", message);
}

static inline aur_radiosity_options options_of(aur_radiosity_directions directions, size_t bounces) {
    aur_radiosity_options options = {.size = sizeof options};
    aur_radiosity_options_init(&options, NULL);
    options.directions = directions;
    options.bounces = bounces;
    return options;
}

static inline aur_radiosity *must_create(const aur_scene *scene, const aur_radiosity_options *options) {
    aur_radiosity *radiosity = NULL;
    aur_error error = {0};
    if (aur_radiosity_create(scene, options, &radiosity, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return radiosity;
}

static inline aur_radiosity *must_trace(const aur_scene *scene, const aur_radiosity_options *options,
                                        uint64_t paths) {
    aur_radiosity *const radiosity = must_create(scene, options);
    aur_error error = {0};
    if (aur_radiosity_trace(radiosity, paths, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return radiosity;
}

static inline aur_radiosity_description describe(const aur_radiosity *radiosity) {
    aur_radiosity_description description = {.size = sizeof description};
    assert_int_equal(aur_radiosity_get_description(radiosity, &description, NULL), AUR_OK);
    return description;
}

static inline size_t get_results(const aur_radiosity *radiosity, aur_radiosity_triangle_result *results) {
    const size_t count = describe(radiosity).triangles;
    assert_int_equal(aur_radiosity_get_results(radiosity, MOST_TRIANGLES, sizeof *results, results, NULL),
                     AUR_OK);
    return count;
}

/* Of the first channel, over the triangles that reflect. */
static inline double area_mean(const aur_radiosity *radiosity) {
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    const size_t count = get_results(radiosity, results);
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < count; ++i) {
        if (results[i].albedo[0] == 0.0)
            continue;
        sum += results[i].radiance[0] * results[i].area;
        area += results[i].area;
    }
    return sum / area;
}

static inline void assert_same(const aur_radiosity *a, const aur_radiosity *b) {
    aur_radiosity_triangle_result x[MOST_TRIANGLES], y[MOST_TRIANGLES];
    const size_t count = get_results(a, x);
    assert_int_equal(get_results(b, y), count);
    assert_memory_equal(x, y, count * sizeof x[0]);
    const aur_radiosity_description d = describe(a), e = describe(b);
    assert_int_equal(d.paths, e.paths);
    assert_int_equal(d.rays, e.rays);
    assert_true(d.tail == e.tail && d.lost == e.lost);
}
