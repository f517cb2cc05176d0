/* aureole-bench list | NAME... [--quick] [--isa SET] [--only TEXT] [--scene FILE]. To add a bench, add one
 * file and one line here. */
#define _DEFAULT_SOURCE /* setenv */
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "points/base/parallel.h"
#include "points/base/simd.h"

/* One bench per line. */
/* clang-format off */
extern const bench bench_ao;
extern const bench bench_adaptive_calibration_alone;
extern const bench bench_adaptive_speed_alone;
extern const bench bench_defaults;
extern const bench bench_domains;
extern const bench bench_film;
extern const bench bench_gather;
extern const bench bench_gather_rays_alone;
extern const bench bench_gather_weights;
extern const bench bench_lights;
extern const bench bench_limits;
extern const bench bench_large;
extern const bench bench_load;
extern const bench bench_measures;
extern const bench bench_parallel;
extern const bench bench_path;
extern const bench bench_patterns;
extern const bench bench_points_sphere;
extern const bench bench_points_square;
extern const bench bench_race;
extern const bench bench_race_limits;
extern const bench bench_radiosity;
extern const bench bench_relaxed;
extern const bench bench_scene;
extern const bench bench_share;
extern const bench bench_weights;

static const bench *const benches[] = {
    &bench_ao,
    &bench_adaptive_calibration_alone,
    &bench_adaptive_speed_alone,
    &bench_defaults,
    &bench_domains,
    &bench_film,
    &bench_gather,
    &bench_gather_rays_alone,
    &bench_gather_weights,
    &bench_lights,
    &bench_limits,
    &bench_large,
    &bench_load,
    &bench_measures,
    &bench_parallel,
    &bench_path,
    &bench_patterns,
    &bench_points_sphere,
    &bench_points_square,
    &bench_race,
    &bench_race_limits,
    &bench_radiosity,
    &bench_relaxed,
    &bench_scene,
    &bench_share,
    &bench_weights,
};
/* clang-format on */

enum { BENCH_COUNT = sizeof benches / sizeof benches[0] };

static const bench *find(const char *name) {
    for (size_t i = 0; i < BENCH_COUNT; ++i)
        if (strcmp(benches[i]->name, name) == 0)
            return benches[i];
    return NULL;
}

static void print_list(void) {
    for (size_t i = 0; i < BENCH_COUNT; ++i)
        printf("%-12s %s\n", benches[i]->name, benches[i]->summary);
}

static void print_help(void) {
    puts("usage: aureole-bench list\n"
         "       aureole-bench all|NAME... [--quick] [--isa portable|avx2|avx512] [--only TEXT] [--scene "
         "FILE]\n"
         "  --quick  small work, to see whether all runs: figures of no worth\n"
         "  --isa    instructions that our kernels and Embree's may use, as if the processor had no wider "
         "ones;\n"
         "           else AUREOLE_ISA's, or all it has. What a bench used is printed behind its name\n"
         "  --only   of adaptive, adaptive-calibration and adaptive-speed, the rooms or scenes with TEXT in "
         "their names\n"
         "  --scene  of adaptive: a scene file instead\n"
         "Rates are units a CPU second; [low, high] are the quartiles of a ratio over the pairs.");
}

/* The processor's name from /proc/cpuinfo; prints nothing without one. */
static void print_machine(const bench_options *options) {
    FILE *const file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *const colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            printf("%s", colon + 2);
            break;
        }
    }
    if (file != NULL)
        fclose(file);
    printf("%zu threads%s\n", options->threads, options->quick ? "; quick: figures of no worth" : "");
}

/* Restricts the instruction set of our kernels, of Embree's and of child processes. */
static bool restrict_isa(const char *name) {
    aur_error error;
    if (aur_isa_check(name, &error) != AUR_OK)
        return bench_fail("--isa: %s", error.message);
    if (setenv("AUREOLE_ISA", name, 1) != 0 || unsetenv("AUREOLE_EMBREE_ISA") != 0)
        return bench_fail("out of memory");
    aur_isa_reset();
    return true;
}

static bool run(const bench *chosen, const bench_options *options) {
    printf("%s: %s [our kernels: %s; Embree's: %s]\n", chosen->name, chosen->summary,
           aur_isa_name(aur_isa_available()), aur_isa_name(aur_isa_of_rays()));
    fflush(stdout);
    return chosen->run(options);
}

int main(int argc, char **argv) {
    static const struct option long_options[] = {
        {"quick", no_argument, NULL, 'q'},      {"isa", required_argument, NULL, 'i'},
        {"only", required_argument, NULL, 'o'}, {"scene", required_argument, NULL, 's'},
        {"help", no_argument, NULL, 'h'},       {NULL, 0, NULL, 0}};
    bench_options options = {.pairs = 15, .seconds = 0.05, .threads = aur_parallel_threads(0)};
    for (int option; (option = getopt_long(argc, argv, "", long_options, NULL)) != -1;) {
        if (option == 'h') {
            print_help();
            return 0;
        }
        if (option == 'i') {
            if (!restrict_isa(optarg))
                return 2;
            continue;
        }
        if (option == 'o') {
            options.only = optarg;
            continue;
        }
        if (option == 's') {
            options.scene = optarg;
            continue;
        }
        if (option != 'q')
            return 2;
        options.quick = true;
        options.pairs = 3;
        options.seconds = 0.002;
    }
    if (optind == argc) {
        print_help();
        return 2;
    }
    if (strcmp(argv[optind], "list") == 0) {
        print_list();
        return 0;
    }
    const bool all = strcmp(argv[optind], "all") == 0;
    for (int i = optind; i < argc && !all; ++i)
        if (find(argv[i]) == NULL) {
            bench_fail("no bench is named '%s': 'aureole-bench list' names them", argv[i]);
            return 2;
        }
    print_machine(&options);
    const size_t count = all ? BENCH_COUNT : (size_t)(argc - optind);
    for (size_t i = 0; i < count; ++i)
        if (!run(all ? benches[i] : find(argv[optind + (int)i]), &options))
            return 3;
    return 0;
}
