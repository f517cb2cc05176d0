#include "study.h"

#include <math.h>
#include <stdlib.h>

static const keller_scene scenes[KELLER_SCENES] = {
    {"cube", "keller/cube-analytic.xml", "keller/cube-analytic.xml"},
    {"living-room", "keller/living-room.xml", "keller/living-room-analytic.xml"},
    {"office", "keller/office.xml", "keller/office-analytic.xml"},
    {"teapot", "keller/teapot-box.xml", "keller/teapot-box-analytic.xml"},
};

static const keller_set sets[KELLER_SETS] = {
    {"lcg", true},
    {"icg", true},
    {"halton", true},
    {"faure", true},
    {"sobol", true},
    {"random", true},
    {"faure:scramble=lower-triangular", true},
    {"niederreiter", true},
    {"hammersley", false},
};

const uint64_t keller_sizes[KELLER_SIZES] = {1000, 10000, 100000};

/* [scene: cube, living room, office, teapot][N][set] */
static const double table2[KELLER_SCENES][KELLER_SIZES][KELLER_PUBLISHED_SETS] = {
    {{0.0647699, 0.0469468, 0.0459244, 0.0375936, 0.0458288},
     {0.0138841, 0.0150312, 0.015322, 0.0101492, 0.0154578},
     {0.00416856, 0.00426497, 0.00347108, 0.00388516, 0.0139228}},
    {{5.68352, 3.89019, 2.0911, 1.46717, 5.49831},
     {1.87948, 1.5128, 2.15754, 1.94902, 1.51938},
     {0.64136, 0.550875, 0.524932, 0.727295, 0.573517}},
    {{0.46748, 0.456453, 0.399271, 0.280669, 0.431063},
     {0.259767, 0.202392, 0.331709, 0.475231, 0.234959},
     {0.136946, 0.127394, 0.136938, 0.136222, 0.14049}},
    {{3.55052, 24.4236, 5.28716, 3.58575, 4.63836},
     {1.36052, 2.67153, 0.962619, 1.01024, 0.920303},
     {0.460942, 0.438209, 0.434956, 0.412762, 0.422177}},
};

/* [scene: cube, living room, office, teapot][N][set] */
static const double table3[KELLER_SCENES][KELLER_SIZES][KELLER_PUBLISHED_SETS] = {
    {{0.00589147, 0.00485275, 0.00514532, 0.00398542, 0.00500996},
     {0.00171686, 0.00181801, 0.00147316, 0.00128062, 0.00184561},
     {0.000478878, 0.000538219, 0.000402798, 0.000395118, 0.00152823}},
    {{0.0056218, 0.00591197, 0.00478811, 0.00455163, 0.00582923},
     {0.00325591, 0.00320881, 0.00322973, 0.00330551, 0.00322495},
     {0.0028332, 0.00282448, 0.00282852, 0.00282892, 0.00284094}},
    {{0.00861589, 0.00845805, 0.00825801, 0.0070116, 0.00775931},
     {0.00672887, 0.00668762, 0.00670869, 0.00680193, 0.00695615},
     {0.00661765, 0.00654544, 0.00655064, 0.00657714, 0.00685}},
    {{0.00624067, 0.0116751, 0.00809856, 0.00610271, 0.00580429},
     {0.00183252, 0.00199039, 0.00156816, 0.00158062, 0.00159681},
     {0.000581887, 0.000552315, 0.000543979, 0.000565605, 0.000613286}},
};

double keller_table2(size_t scene, size_t size, size_t set) {
    return table2[scene][size][set];
}

double keller_table3(size_t scene, size_t size, size_t set) {
    return table3[scene][size][set];
}

const keller_scene *keller_scene_at(size_t index) {
    return &scenes[index];
}

bool keller_set_at(const lab_run *run, size_t index, keller_set *set) {
    if (index < KELLER_SETS) {
        *set = sets[index];
        return true;
    }
    *set = (keller_set){lab_run_options(run)->set, true};
    return index == KELLER_SETS && set->name != NULL;
}

aur_result keller_start(const lab_run *run, const aur_scene *scene, const char *set, size_t variant,
                        size_t bounces, aur_radiosity_directions directions, aur_radiosity **radiosity,
                        aur_error *error) {
    const lab_options *const lab = lab_run_options(run);
    aur_radiosity_options options = {.size = sizeof options};
    aur_radiosity_options_init(&options, NULL);
    options.sequence = set;
    options.seed = variant;
    options.variant = variant;
    options.directions = directions;
    options.emission = AUR_RADIOSITY_BY_AREA;
    options.bounces = bounces;
    options.threads = lab->threads;
    options.warnings = variant == 0 ? lab->warnings : (aur_warnings){0};
    return aur_radiosity_create(scene, &options, radiosity, error);
}

aur_result keller_deviation(const aur_radiosity *radiosity, double answer, double *plain, double *weighted,
                            aur_error *error) {
    aur_radiosity_description d = {.size = sizeof d};
    aur_radiosity_get_description(radiosity, &d, NULL);
    aur_radiosity_triangle_result *const results = malloc(d.triangles * sizeof *results);
    if (results == NULL) {
        if (error != NULL)
            *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    const aur_result result =
        aur_radiosity_get_results(radiosity, d.triangles, sizeof *results, results, NULL);
    double sum = 0.0, weighted_sum = 0.0;
    for (size_t i = 0; i < d.triangles && result == AUR_OK; ++i) {
        const double difference = results[i].radiance[0] - answer;
        sum += difference * difference;
        weighted_sum += difference * difference * results[i].area;
    }
    *plain = sum / (double)d.triangles;
    *weighted = weighted_sum / ((double)d.triangles * d.area);
    free(results);
    return result;
}

void keller_published(lab_run *run, double published) {
    if (isnan(published))
        lab_text(run, NULL);
    else
        lab_number(run, published);
}

double keller_rms(size_t count, const double *squares, double *least, double *greatest) {
    double sum = 0.0;
    *least = INFINITY;
    *greatest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        sum += squares[i];
        *least = fmin(*least, sqrt(squares[i]));
        *greatest = fmax(*greatest, sqrt(squares[i]));
    }
    return sqrt(sum / (double)count);
}
