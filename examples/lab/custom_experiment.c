/* A custom experiment and a custom set outside of Aureole's source tree: a module of the lab.
 *
 *     cc -shared -fPIC custom_experiment.c $(pkg-config --cflags aureole-lab) -lm -o custom_experiment.so
 *     aureole lab run custom-distances --module custom_experiment.so --set r2 -D largest=256 -o results
 *     aureole lab report results --module custom_experiment.so -o report
 *
 * The set is the golden ratio's lattice; the experiment compares smallest distances, times the root of N. */
#include <aureole-lab/lab.h>
#include <aureole/quality.h>
#include <math.h>
#include <string.h>

/* The set callback:golden: N points of the square for any N. */
static aur_result golden(void *user, uint64_t count, size_t dimension, double *points, double *weights,
                         aur_error *error) {
    (void)user, (void)weights, (void)error;
    for (uint64_t i = 0; i < count; ++i) {
        points[dimension * i] = ((double)i + 0.5) / (double)count;
        points[dimension * i + 1] = fmod((double)i * 0.61803398874989484820, 1.0);
    }
    return AUR_OK;
}

static aur_result distance(const char *set, size_t count, double *value, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SQUARE, &options, error);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, error);
    aur_points *points;
    aur_result result = aur_points_generate(set, &request, &points, error);
    if (result != AUR_OK)
        return result;
    result = aur_measure("min-distance", aur_points_get_view(points), NULL, value, error);
    *value *= sqrt((double)count);
    aur_points_destroy(points);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const char *const sets[] = {"hammersley", "sobol", "callback:golden", lab_run_options(run)->set};
    const double largest = lab_parameter_number(run, "largest");
    double least[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
    for (size_t s = 0; s < 4 && sets[s] != NULL; ++s)
        for (size_t count = 16; (double)count <= largest; count *= 4) {
            double value = NAN;
            const aur_result result = distance(sets[s], count, &value, error);
            /* The set of --set may lack a size: a note says so, and the row is left out. */
            if (result != AUR_OK && lab_forgive(run, sets[s], result, error) != AUR_OK)
                return result;
            if (result != AUR_OK)
                continue;
            least[s] = fmin(least[s], value);
            lab_row(run, (const char *const[]){sets[s], NULL}, 2, (const double[]){(double)count, value});
        }
    lab_claim(run, least[2] > least[1], "golden points keep larger distances than Sobol' points");
    return AUR_OK;
}

static const char *const columns[] = {"set", "points", "distance", NULL};
static const lab_parameter parameters[] = {{"largest", "1024", "most points"}, {.name = NULL}};
static const report_plot plots[] = {{.name = "distance",
                                     .title = "Smallest distance times the root of N",
                                     .x = "points",
                                     .y = "distance",
                                     .series = "set",
                                     .log_x = true},
                                    {.name = NULL}};
static const lab_experiment distances = {.name = "custom-distances",
                                         .reproduces = "nothing yet",
                                         .summary = "smallest distances of a few sets",
                                         .columns = columns,
                                         .plots = plots,
                                         .parameters = parameters,
                                         .run = run};

const lab_module *aureole_lab_module(void) {
    static const lab_experiment *const experiments[] = {&distances};
    static const aur_set_callback sets[] = {{.size = sizeof(aur_set_callback),
                                             .name = "golden",
                                             .domain = AUR_DOMAIN_SQUARE,
                                             .generate = golden}};
    static const lab_module module = {.size = sizeof module,
                                      .version = LAB_VERSION,
                                      .experiment_count = 1,
                                      .experiments = experiments,
                                      .set_count = 1,
                                      .sets = sets};
    return &module;
}
