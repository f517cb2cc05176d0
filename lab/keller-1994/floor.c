/* Hypotheses why the published tables 2 and 3 of Keller 1994 stop falling in the living room and the office.
 * Three causes are tested, each on both tables, because a cause must explain both floors:
 *
 * - open: our closed rooms are opened, first the ceiling and then the walls from above, until Delta_aw at N =
 * 1e5 matches table 3. One fitted parameter per room.
 *
 * - outer faces: the walls have outer faces, which no path reaches. No fitted parameter.
 *
 * - unlit: some faces receive nothing, so their error is exactly 1/4, like that of overlapping or reversed
 * triangles. Their shares of triangles and of area are fitted to the two floors at N = 1e5. Two parameters
 * always fit two floors, so only the smaller N test this.
 *
 * A fit is a hypothesis: the paper's meshes are lost. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "study.h"

enum { ROOMS = 2, WALL_TRIANGLES = 12, STEPS = 9, VARIANTS = 3, TABLES = 2 };

typedef enum floor_cause { OPEN, OUTER, UNLIT, CAUSES } floor_cause;

static const char *const cause_names[CAUSES] = {"open", "outer faces", "unlit"};

static const char *const columns[] = {"scene", "cause", "sequence", "table",     "N",
                                      "rms",   "least", "greatest", "published", NULL};

static double published(size_t table, size_t room, size_t size, size_t set) {
    return (table == 0 ? keller_table2 : keller_table3)(room, size, set);
}

/* From 0, closed, to 1, without a ceiling, to 2, without walls. */
static aur_result load_open(const lab_run *run, size_t room, double opening, aur_scene **scene,
                            aur_error *error) {
    char ceiling[32], walls[32];
    snprintf(ceiling, sizeof ceiling, "%.6f", fmax(1e-3, 1.0 - opening));
    snprintf(walls, sizeof walls, "%.6f", fmax(1e-3, fmin(1.0, 2.0 - opening)));
    const aur_definition definitions[] = {{"ceiling", ceiling}, {"walls", walls}};
    return lab_load_scene(run, keller_scene_at(room)->analytic, 2, definitions, scene, error);
}

/* Delta_a^2 and Delta_aw^2, and the area that the outer faces of the walls add, as a fraction. These are
 * copies of the first triangles, with radiance 1/4. Paths that begin on them leave at once, so the others
 * have fewer paths by that fraction. */
static aur_result deviation(const aur_radiosity *radiosity, bool outer_faces, double squares[TABLES],
                            double *added, aur_error *error) {
    aur_radiosity_description d = {.size = sizeof d};
    double outer = 0.0;
    aur_result result = aur_radiosity_get_description(radiosity, &d, error);
    aur_radiosity_triangle_result *const found = malloc(d.triangles * sizeof *found);
    if (found == NULL)
        return AUR_ERROR_MEMORY;
    if (result == AUR_OK)
        result = aur_radiosity_get_results(radiosity, d.triangles, sizeof *found, found, error);
    if (result == AUR_OK)
        result = keller_deviation(radiosity, 0.5, &squares[0], &squares[1], error);
    for (size_t i = 0; i < WALL_TRIANGLES && result == AUR_OK; ++i)
        outer += found[i].area;
    free(found);
    *added = outer / (d.area + outer);
    if (outer_faces) {
        const double triangles = (double)d.triangles, all = triangles + WALL_TRIANGLES;
        squares[0] = (squares[0] * triangles + 0.0625 * WALL_TRIANGLES) / all;
        squares[1] = (squares[1] * triangles * d.area + 0.0625 * outer) / (all * (d.area + outer));
    }
    return result;
}

/* Both for the first `size_count` sizes. Variant 0 would warn that the scene is open. `aside` receives the
 * fraction of flights that leave or, with outer faces, their fraction of the area. */
static aur_result deviations(const lab_run *run, const aur_scene *scene, bool outer_faces, const char *set,
                             size_t variant, size_t size_count, double squares[KELLER_SIZES][TABLES],
                             double *aside, aur_error *error) {
    aur_radiosity *radiosity = NULL;
    aur_radiosity_description d = {.size = sizeof d};
    double added = 0.0, both[TABLES];
    aur_result result =
        keller_start(run, scene, set, 1 + variant, 29, AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity, error);
    if (result == AUR_OK && outer_faces)
        result = deviation(radiosity, true, both, &added, error);
    for (size_t n = 0; n < size_count && result == AUR_OK; ++n) {
        result = aur_radiosity_trace(radiosity, (uint64_t)((double)keller_sizes[n] * (1.0 - added)), error);
        if (result == AUR_OK)
            result = deviation(radiosity, outer_faces, squares[n], aside, error);
    }
    if (result == AUR_OK)
        result = aur_radiosity_get_description(radiosity, &d, error);
    aur_radiosity_destroy(radiosity);
    if (!outer_faces)
        *aside = (double)d.lost / (double)d.rays;
    return result;
}

/* The opening at which Delta_aw at the largest size is `target`, and the fraction of flights that leave. */
static aur_result find_opening(lab_run *run, size_t room, size_t size_count, double target, double found[2],
                               aur_error *error) {
    double low = 0.0, high = 1.99;
    char key[64];
    snprintf(key, sizeof key, "%s, opening", keller_scene_at(room)->name);
    if (lab_recall(run, key, 2, found))
        return AUR_OK;
    for (int step = 0; step < STEPS; ++step) {
        double squares[KELLER_SIZES][TABLES] = {0};
        aur_scene *scene = NULL;
        found[0] = 0.5 * (low + high);
        aur_result result = load_open(run, room, found[0], &scene, error);
        if (result == AUR_OK)
            result = deviations(run, scene, false, "sobol", 0, size_count, squares, &found[1], error);
        aur_scene_destroy(scene);
        if (result != AUR_OK)
            return result;
        *(sqrt(squares[size_count - 1][1]) < target ? &low : &high) = found[0];
    }
    return lab_save(run, key, 2, found, error);
}

typedef struct tried_cause {
    lab_run *run;
    size_t room, size_count;
    floor_cause cause;
    const aur_scene *scene;
    double aside;
    double triangles;     /* of the scene */
    double unlit[TABLES]; /* fractions of triangles and of area that receive nothing */
    size_t within[TABLES], compared;
} tried_cause;

/* The squared deviations if fractions of the triangles and of the area have an error of 1/4. */
static double with_unlit(const tried_cause *tried, size_t table, double square) {
    const double share = tried->unlit[table], per = table == 0 ? 1.0 : tried->triangles;
    return (1.0 - share) * square + 0.0625 * share / per;
}

static aur_result measure(tried_cause *tried, const char *set, double squares[VARIANTS][KELLER_SIZES][TABLES],
                          aur_error *error) {
    enum { CELLS = KELLER_SIZES * VARIANTS * TABLES };
    double values[CELLS + 1] = {0};
    char key[160];
    const bool outer = tried->cause == OUTER;
    snprintf(key, sizeof key, "%s %s %.100s", keller_scene_at(tried->room)->name, cause_names[tried->cause],
             set);
    aur_result result = AUR_OK;
    if (!lab_recall(tried->run, key, CELLS + 1, values)) {
        for (size_t v = 0; v < VARIANTS && result == AUR_OK; ++v)
            result = deviations(tried->run, tried->scene, outer, set, v, tried->size_count, squares[v],
                                &tried->aside, error);
        memcpy(values, squares, CELLS * sizeof *values);
        values[CELLS] = tried->aside;
        if (result == AUR_OK)
            result = lab_save(tried->run, key, CELLS + 1, values, error);
    }
    memcpy(squares, values, CELLS * sizeof *values);
    tried->aside = values[CELLS];
    return result;
}

static void add_rows(tried_cause *tried, size_t set, const char *name,
                     double squares[VARIANTS][KELLER_SIZES][TABLES]) {
    const bool of_paper = set < KELLER_PUBLISHED_SETS;
    for (size_t table = 0; table < TABLES; ++table)
        for (size_t n = 0; n < tried->size_count; ++n) {
            double least, greatest, of[VARIANTS];
            for (size_t v = 0; v < VARIANTS; ++v)
                of[v] = with_unlit(tried, table, squares[v][n][table]);
            const double rms = keller_rms(VARIANTS, of, &least, &greatest);
            const double paper = of_paper ? published(table, tried->room, n, set) : NAN;
            tried->within[table] += of_paper && fmax(paper / rms, rms / paper) <= 1.5;
            tried->compared += of_paper && table == 0;
            lab_row(
                tried->run,
                (const char *const[]){keller_scene_at(tried->room)->name, cause_names[tried->cause], name,
                                      NULL},
                6,
                (const double[]){(double)(table + 2), (double)keller_sizes[n], rms, least, greatest, paper});
        }
}

/* The fractions that match both published floors at the largest N, over the paper's sets. */
static aur_result fit_unlit(tried_cause *tried, aur_error *error) {
    double target[TABLES] = {0}, found[TABLES] = {0};
    keller_set of;
    size_t sets = 0;
    const size_t last = tried->size_count - 1;
    for (size_t set = 0; set < KELLER_PUBLISHED_SETS && keller_set_at(tried->run, set, &of); ++set) {
        double squares[VARIANTS][KELLER_SIZES][TABLES];
        if (lab_run_options(tried->run)->quick && set % 2 != 0)
            continue;
        const aur_result result = measure(tried, of.name, squares, error);
        if (result != AUR_OK)
            return result;
        ++sets;
        for (size_t table = 0; table < TABLES; ++table) {
            target[table] += pow(published(table, tried->room, last, set), 2.0);
            for (size_t v = 0; v < VARIANTS; ++v)
                found[table] += squares[v][last][table] / VARIANTS;
        }
    }
    for (size_t table = 0; table < TABLES; ++table) {
        const double w = target[table] / (double)sets, f = found[table] / (double)sets;
        const double most = 0.0625 / (table == 0 ? 1.0 : tried->triangles);
        tried->unlit[table] = fmax(0.0, fmin(1.0, (w - f) / (most - f)));
    }
    return AUR_OK;
}

static void note_cause(const tried_cause *tried, double opening) {
    const char *const room = keller_scene_at(tried->room)->name, *const cause = cause_names[tried->cause];
    if (tried->cause == OPEN)
        lab_note(
            tried->run,
            "%s, %s: %.0f %% of the ceiling's length and %.0f %% of the walls' height left, %.1f %% of all "
            "flights leave",
            room, cause, 100.0 * fmax(0.0, 1.0 - opening), 100.0 * fmin(1.0, 2.0 - opening),
            100.0 * tried->aside);
    else if (tried->cause == OUTER)
        lab_note(tried->run, "%s, %s: %.0f %% of the area", room, cause, 100.0 * tried->aside);
    else
        lab_note(tried->run, "%s, %s: %.0f %% of the triangles, %.0f %% of the area", room, cause,
                 100.0 * tried->unlit[0], 100.0 * tried->unlit[1]);
    lab_note(tried->run, "%s, %s: within a factor of 1.5 of %zu of %zu values of table 2 and %zu of table 3",
             room, cause, tried->within[0], tried->compared, tried->within[1]);
}

static aur_result try_cause(tried_cause *tried, double opening, aur_error *error) {
    const bool quick = lab_run_options(tried->run)->quick;
    aur_scene *scene = NULL;
    aur_scene_description d = {.size = sizeof d};
    aur_result result =
        load_open(tried->run, tried->room, tried->cause == OPEN ? opening : 0.0, &scene, error);
    if (result == AUR_OK)
        result = aur_scene_get_description(scene, &d, error);
    tried->scene = scene;
    tried->triangles = (double)d.triangles;
    if (result == AUR_OK && tried->cause == UNLIT)
        result = fit_unlit(tried, error);
    keller_set of;
    for (size_t set = 0; result == AUR_OK && keller_set_at(tried->run, set, &of); ++set) {
        double squares[VARIANTS][KELLER_SIZES][TABLES] = {0};
        const bool of_paper = set < KELLER_PUBLISHED_SETS && (!quick || set % 2 == 0);
        if (!of_paper && set < KELLER_SETS)
            continue;
        const aur_result measured = measure(tried, of.name, squares, error);
        if (measured == AUR_OK)
            add_rows(tried, set, of.name, squares);
        result = lab_forgive(tried->run, of.name, measured, error);
    }
    if (result == AUR_OK)
        note_cause(tried, opening);
    aur_scene_destroy(scene);
    return result;
}

static aur_result study_room(lab_run *run, size_t room, aur_error *error) {
    const size_t size_count = lab_run_options(run)->quick ? 2 : KELLER_SIZES;
    double target = 0.0, found[2] = {0};
    for (size_t set = 0; set < KELLER_PUBLISHED_SETS; ++set)
        target += keller_table3(room, size_count - 1, set) / KELLER_PUBLISHED_SETS;
    aur_result result = find_opening(run, room, size_count, target, found, error);
    for (size_t cause = 0; cause < CAUSES && result == AUR_OK; ++cause) {
        tried_cause tried = {.run = run, .room = room, .size_count = size_count, .cause = (floor_cause)cause};
        result = try_cause(&tried, found[0], error);
    }
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const size_t rooms[ROOMS] = {2, 1}; /* the office is the fast one */
    aur_result result = AUR_OK;
    for (size_t i = 0; i < (lab_run_options(run)->quick ? 1 : ROOMS) && result == AUR_OK; ++i)
        result = study_room(run, rooms[i], error);
    return result;
}

static const report_plot plots[] = {
    {.name = "deviation",
     .title = "Deviation in rooms that are open, have outer faces or unlit ones, against the number of paths",
     .x = "N",
     .y = "rms",
     .low = "least",
     .high = "greatest",
     .series = "sequence",
     .panel = "scene,cause,table",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_floor = {
    .name = "keller-1994-floor",
    .reproduces = "Keller 1994, the floors of tables 2 and 3",
    .summary = "open rooms, walls with outer faces and unlit faces, whose deviations stop falling as "
               "published ones do",
    .columns = columns,
    .measured = "rms",
    .low = "least",
    .high = "greatest",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .seconds = 42,
    .quick_seconds = 1,
    .run = run,
    .takes_no_scene = "its causes are of two of Keller's rooms",
};
