/* Why the published table 3 of Keller 1994 stops falling in the living room and the office: our closed rooms
 * are opened, first the ceiling and then the walls from above, until Delta_aw at N = 1e5 is what the paper
 * has. One number is fitted a room; what the smaller N give then is a prediction. That an open room makes
 * such a floor is thereby shown, not that the paper's rooms were open. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "study.h"

enum { ROOMS = 2, WALL_TRIANGLES = 12, STEPS = 9, VARIANTS = 3 };

static const char *const columns[] = {"scene", "cause",    "sequence",  "N", "rms",
                                      "least", "greatest", "published", NULL};

/* From 0, closed, to 1, without a ceiling, to 2, without walls. */
static aur_result load_open(const lab_run *run, size_t room, double opening, aur_scene **scene,
                            aur_error *error) {
    char ceiling[32], walls[32];
    snprintf(ceiling, sizeof ceiling, "%.6f", fmax(1e-3, 1.0 - opening));
    snprintf(walls, sizeof walls, "%.6f", fmax(1e-3, fmin(1.0, 2.0 - opening)));
    const aur_definition definitions[] = {{"ceiling", ceiling}, {"walls", walls}};
    return lab_load_scene(run, keller_scene_at(room)->analytic, 2, definitions, scene, error);
}

/* Delta_aw^2, and what part of the area the outer faces of the walls add. They are the first triangles once
 * more, of radiance 1/4; paths that begin on them leave at once, so the others are as many fewer. */
static aur_result deviation(const aur_radiosity *radiosity, bool outer_faces, double *square, double *added,
                            aur_error *error) {
    aur_radiosity_description d = {.size = sizeof d};
    double plain, outer = 0.0;
    aur_result result = aur_radiosity_get_description(radiosity, &d, error);
    aur_radiosity_triangle_result *const found = malloc(d.triangles * sizeof *found);
    if (found == NULL)
        return AUR_ERROR_MEMORY;
    if (result == AUR_OK)
        result = aur_radiosity_get_results(radiosity, d.triangles, sizeof *found, found, error);
    if (result == AUR_OK)
        result = keller_deviation(radiosity, 0.5, &plain, square, error);
    for (size_t i = 0; i < WALL_TRIANGLES && result == AUR_OK; ++i)
        outer += found[i].area;
    free(found);
    *added = outer / (d.area + outer);
    if (outer_faces)
        *square = (*square * (double)d.triangles * d.area + 0.0625 * outer) /
                  ((double)(d.triangles + WALL_TRIANGLES) * (d.area + outer));
    return result;
}

/* Delta_aw^2 of the first `size_count` sizes. Variant 0 would warn that the scene is open. `aside` becomes
 * the share of flights that leave or, with outer faces, that of their area. */
static aur_result deviations(const lab_run *run, const aur_scene *scene, bool outer_faces, const char *set,
                             size_t variant, size_t size_count, double *squares, double *aside,
                             aur_error *error) {
    aur_radiosity *radiosity = NULL;
    aur_radiosity_description d = {.size = sizeof d};
    double added = 0.0, square;
    aur_result result =
        keller_start(run, scene, set, 1 + variant, 29, AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity, error);
    if (result == AUR_OK && outer_faces)
        result = deviation(radiosity, true, &square, &added, error);
    for (size_t n = 0; n < size_count && result == AUR_OK; ++n) {
        result = aur_radiosity_trace(radiosity, (uint64_t)((double)keller_sizes[n] * (1.0 - added)), error);
        if (result == AUR_OK)
            result = deviation(radiosity, outer_faces, &squares[n], aside, error);
    }
    if (result == AUR_OK)
        result = aur_radiosity_get_description(radiosity, &d, error);
    aur_radiosity_destroy(radiosity);
    if (!outer_faces)
        *aside = (double)d.lost / (double)d.rays;
    return result;
}

/* The opening at which Delta_aw at the largest size is `wanted`, and the share of flights that leave. */
static aur_result find_opening(lab_run *run, size_t room, size_t size_count, double wanted, double found[2],
                               aur_error *error) {
    double low = 0.0, high = 1.99;
    char key[64];
    snprintf(key, sizeof key, "%s, opening", keller_scene_at(room)->name);
    if (lab_recall(run, key, 2, found))
        return AUR_OK;
    for (int step = 0; step < STEPS; ++step) {
        double squares[KELLER_SIZES] = {0};
        aur_scene *scene = NULL;
        found[0] = 0.5 * (low + high);
        aur_result result = load_open(run, room, found[0], &scene, error);
        if (result == AUR_OK)
            result = deviations(run, scene, false, "sobol", 0, size_count, squares, &found[1], error);
        aur_scene_destroy(scene);
        if (result != AUR_OK)
            return result;
        *(sqrt(squares[size_count - 1]) < wanted ? &low : &high) = found[0];
    }
    return lab_keep(run, key, 2, found, error);
}

typedef struct tried_cause {
    const char *name; /* of the room and the cause: a key */
    size_t room, size_count;
    const aur_scene *scene;
    bool outer_faces;
    double aside;
} tried_cause;

static aur_result measure_set(lab_run *run, tried_cause *cause, size_t set, aur_error *error) {
    enum { CELLS = KELLER_SIZES * VARIANTS + 1 };
    double values[CELLS] = {0}, squares[VARIANTS];
    keller_set of;
    keller_set_at(run, set, &of);
    char key[160];
    snprintf(key, sizeof key, "%s %.100s %d", cause->name, of.name, cause->outer_faces);
    aur_result result = AUR_OK;
    if (!lab_recall(run, key, CELLS, values)) {
        for (size_t v = 0; v < VARIANTS && result == AUR_OK; ++v)
            result = deviations(run, cause->scene, cause->outer_faces, of.name, v, cause->size_count,
                                values + v * KELLER_SIZES, &values[CELLS - 1], error);
        if (result == AUR_OK)
            result = lab_keep(run, key, CELLS, values, error);
    }
    cause->aside = values[CELLS - 1];
    for (size_t n = 0; n < cause->size_count && result == AUR_OK; ++n) {
        double least, greatest;
        for (size_t v = 0; v < VARIANTS; ++v)
            squares[v] = values[v * KELLER_SIZES + n];
        const double rms = keller_rms(VARIANTS, squares, &least, &greatest);
        lab_row(
            run,
            (const char *const[]){cause->name, cause->outer_faces ? "outer faces" : "open", of.name, NULL}, 5,
            (const double[]){(double)keller_sizes[n], rms, least, greatest,
                             set < KELLER_PUBLISHED_SETS ? keller_table3(cause->room, n, set) : NAN});
    }
    return result;
}

static aur_result try_cause(lab_run *run, tried_cause *cause, double opening, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    aur_scene *scene = NULL;
    aur_result result = load_open(run, cause->room, opening, &scene, error);
    cause->scene = scene;
    keller_set of;
    for (size_t set = 0; result == AUR_OK && keller_set_at(run, set, &of); ++set) {
        const bool own = set < KELLER_PUBLISHED_SETS && (!quick || set % 2 == 0);
        if (own || set >= KELLER_SETS)
            result = lab_forgive(run, of.name, measure_set(run, cause, set, error), error);
    }
    aur_scene_destroy(scene);
    return result;
}

static aur_result study_room(lab_run *run, size_t room, aur_error *error) {
    const size_t size_count = lab_run_options(run)->quick ? 2 : KELLER_SIZES;
    double wanted = 0.0, found[2] = {0};
    for (size_t set = 0; set < KELLER_PUBLISHED_SETS; ++set)
        wanted += keller_table3(room, size_count - 1, set) / KELLER_PUBLISHED_SETS;
    tried_cause open = {.name = keller_scene_at(room)->name, .room = room, .size_count = size_count};
    tried_cause outer = open;
    outer.outer_faces = true;
    aur_result result = find_opening(run, room, size_count, wanted, found, error);
    if (result == AUR_OK)
        result = try_cause(run, &open, found[0], error);
    if (result == AUR_OK)
        result = try_cause(run, &outer, 0.0, error);
    if (result == AUR_OK)
        lab_note(run,
                 "%s, published %.4f at N = %g: open, with %.0f %% of the ceiling's length and %.0f %% of "
                 "the walls' height left, "
                 "%.1f %% of all flights leave; the outer faces of the walls are %.0f %% of the area",
                 open.name, wanted, (double)keller_sizes[size_count - 1], 100.0 * fmax(0.0, 1.0 - found[0]),
                 100.0 * fmin(1.0, 2.0 - found[0]), 100.0 * found[1], 100.0 * outer.aside);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const size_t rooms[ROOMS] = {2, 1}; /* the office is the quick one */
    aur_result result = AUR_OK;
    for (size_t i = 0; i < (lab_run_options(run)->quick ? 1 : ROOMS) && result == AUR_OK; ++i)
        result = study_room(run, rooms[i], error);
    return result;
}

static const report_plot plots[] = {
    {.name = "deviation",
     .title = "Deviation in rooms that are open or have outer faces against the number of paths",
     .x = "N",
     .y = "rms",
     .low = "least",
     .high = "greatest",
     .series = "sequence",
     .panel = "scene,cause",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_floor = {
    .name = "keller-1994-floor",
    .reproduces = "Keller 1994, the floor of table 3",
    .summary =
        "open rooms, and walls with outer faces, whose deviation stops falling as the published one does",
    .columns = columns,
    .measured = "rms",
    .low = "least",
    .high = "greatest",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .seconds = 30,
    .quick_seconds = 1,
    .run = run,
};
