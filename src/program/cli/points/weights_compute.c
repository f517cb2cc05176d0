/* Computes samples, weights and worst-case errors from the options of `aureole weights`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/weights.h"

/* The data of one computation. `lobe_counts` is the number of samples of each lobe; the first lobe's samples
 * come first. */
typedef struct weights_job {
    const cli_weights_arguments *arguments;
    cli_weights_result *result;
    size_t lobe_counts[2];
    aur_strategy strategies[2];
    aur_potential *potentials[2];
} weights_job;

static const double pi = 3.14159265358979323846;

bool cli_has_directions(aur_domain domain) {
    return domain == AUR_DOMAIN_HEMISPHERE || domain == AUR_DOMAIN_SPHERE || domain == AUR_DOMAIN_AXES;
}

static bool from_file(const weights_job *task) {
    return cli_has_size(task->arguments->source);
}

static void mirror_axis(const weights_job *task, double axis[3]) {
    const double radians = task->arguments->degrees * pi / 180.0;
    axis[0] = -sin(radians);
    axis[1] = 0.0;
    axis[2] = fmax(0.0, cos(radians));
}

/* Creates the potentials and the lobes that samples are drawn from. */
static aur_result prepare_lobes(weights_job *task, aur_error *error) {
    const cli_weights_arguments *const arguments = task->arguments;
    const aur_directions_options *const points = &arguments->points.options;
    for (size_t k = 0; k < task->result->lobe_count; ++k) {
        aur_lobe lobe = k == 0 ? points->lobe : arguments->mirror;
        if (k == 1 && lobe.kind == AUR_LOBE_GGX)
            lobe.view_degrees = arguments->degrees;
        aur_density density = {.size = sizeof density};
        aur_density_init(&density, NULL);
        aur_result result = aur_density_from_lobe(&lobe, task->result->domain, &density, error);
        if (result != AUR_OK)
            return result;
        if (k == 1) {
            mirror_axis(task, density.axis);
            density.clipped = arguments->clipped;
        }
        task->strategies[k] = (aur_strategy){.count = task->lobe_counts[k], .sampled = lobe};
        memcpy(task->strategies[k].axis, density.axis, sizeof density.axis);
        if (points->optimal_density && lobe.kind == AUR_LOBE_COSINE_POWER)
            result = aur_lobe_optimal(&lobe, points->smoothness, &task->strategies[k].sampled, error);
        if (result == AUR_OK)
            result = aur_potential_create(&density, points->smoothness, &task->potentials[k], error);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

static aur_result load_one(weights_job *task, aur_error *error) {
    const cli_weights_arguments *const arguments = task->arguments;
    aur_points *points;
    aur_points_view view;
    const aur_result result =
        cli_load_points(arguments->source, &arguments->points, arguments->size, &points, &view, error);
    if (result != AUR_OK)
        return result;
    const size_t row = view.dimension * sizeof *view.coordinates;
    double *const xyz = malloc(view.count * row);
    for (size_t i = 0; i < view.count && xyz != NULL; ++i)
        memcpy(xyz + i * view.dimension, view.coordinates + i * view.stride, row);
    if (arguments->near && view.weights != NULL) {
        task->result->near = malloc(view.count * sizeof *view.weights);
        if (task->result->near != NULL)
            memcpy(task->result->near, view.weights, view.count * sizeof *view.weights);
    }
    aur_points_destroy(points);
    if (xyz == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    task->result->count = view.count;
    task->result->dimension = view.dimension;
    task->result->xyz = xyz;
    const aur_directions_options *const options = &arguments->points.options;
    aur_domain *const domain = &task->result->domain;
    if (cli_is_file(arguments->source) && arguments->domain_follows)
        *domain = view.domain;
    else if (cli_is_file(arguments->source) && !arguments->points.domain_given &&
             view.domain == AUR_DOMAIN_AXES)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "%s has axes: lobes and caps are for the hemisphere: --domain hemisphere takes its "
                        "points for that",
                        arguments->source);
    if (cli_has_directions(*domain) && view.dimension != 3)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "lobes and caps are for directions: the file must have the columns x,y,z");
    for (size_t i = 0; *domain == AUR_DOMAIN_HEMISPHERE && i < view.count; ++i)
        if (xyz[3 * i + 2] < -1e-9 && options->lobe.kind == AUR_LOBE_COSINE_POWER)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "point %zu lies below the hemisphere (z = %g): is it --domain sphere?", i + 1,
                            xyz[3 * i + 2]);
    return AUR_OK;
}

aur_oswa_options cli_weights_oswa(const cli_weights_arguments *arguments) {
    const aur_directions_options *const points = &arguments->points.options;
    const bool two = arguments->two;
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = arguments->source,
                              .count = two ? arguments->size : 0,
                              .mirror_count = arguments->mirror_size,
                              .lobe = two ? points->lobe : (aur_lobe){.exponent = 0.0},
                              .mirror_lobe = two ? arguments->mirror : points->lobe,
                              .optimal_density = points->optimal_density,
                              .clipped = arguments->clipped,
                              .map = points->map,
                              .scramble = points->scramble,
                              .seed = points->seed,
                              .smoothness = points->smoothness,
                              .weights = &arguments->weights};
}

static aur_result load_two(weights_job *task, aur_error *error) {
    const aur_oswa_options options = cli_weights_oswa(task->arguments);
    aur_oswa *oswa = NULL;
    aur_result result = aur_oswa_create(&options, &oswa, error);
    if (result != AUR_OK)
        return result;
    task->result->count = aur_oswa_size(oswa);
    task->result->dimension = 3;
    task->result->xyz = malloc(3 * task->result->count * sizeof(double));
    if (task->result->xyz == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    else
        result = aur_oswa_points(oswa, task->arguments->degrees * pi / 180.0, (const double[2]){0.0, 0.0},
                                 false, 3 * task->result->count, task->result->xyz, error);
    task->lobe_counts[0] = options.count;
    task->lobe_counts[1] = options.mirror_count;
    aur_oswa_destroy(oswa);
    return result;
}

/* The samples of lobe k: first index and count. */
static size_t first_of(const weights_job *task, size_t k) {
    return k == 1 && task->lobe_counts[1] > 0 ? task->lobe_counts[0] : 0;
}

static size_t count_of(const weights_job *task, size_t k) {
    return task->lobe_counts[k] > 0 ? task->lobe_counts[k] : task->result->count;
}

/* 1/N over the samples of a lobe that are not below its horizon. */
static void equal_weights(const weights_job *task, size_t k, double *weights) {
    const size_t first = first_of(task, k), count = count_of(task, k);
    const aur_lobe *const lobe = k == 0 ? &task->arguments->points.options.lobe : &task->arguments->mirror;
    const bool hides = lobe->kind == AUR_LOBE_GGX || (k == 1 && task->arguments->clipped);
    size_t visible = 0;
    for (size_t i = first; i < first + count; ++i)
        visible += !hides || task->result->xyz[3 * i + 2] >= 0.0;
    memset(weights, 0, task->result->count * sizeof *weights);
    for (size_t i = first; i < first + count; ++i)
        if (!hides || task->result->xyz[3 * i + 2] >= 0.0)
            weights[i] = 1.0 / (double)visible;
}

static aur_result ratio_weights(const weights_job *task, size_t k, double *weights, aur_error *error) {
    const size_t first = first_of(task, k);
    memset(weights, 0, task->result->count * sizeof *weights);
    if (task->lobe_counts[k] == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a file does not state the density of its points");
    if (task->result->domain != AUR_DOMAIN_HEMISPHERE) {
        equal_weights(task, k, weights); /* only for the uniform density */
        return AUR_OK;
    }
    return aur_mis_weights(AUR_MIS_BALANCE, 1, &task->strategies[k], task->potentials[k], count_of(task, k),
                           task->result->xyz + 3 * first, weights + first, error);
}

static aur_result optimal_weights(weights_job *task, aur_error *error) {
    cli_weights_result *const result = task->result;
    const aur_potential *const *const potentials = (const aur_potential *const *)task->potentials;
    double *const condition = task->arguments->report ? &result->condition : NULL;
    if (task->arguments->method == CLI_METHOD_OSWA || result->lobe_count == 1 || task->lobe_counts[1] == 0)
        return aur_weights_solve(result->count, result->xyz, result->lobe_count, potentials,
                                 &task->arguments->weights, result->lobe_count * result->count,
                                 result->weights, NULL, condition, error);
    memset(result->weights, 0, 2 * result->count * sizeof *result->weights);
    for (size_t k = 0; k < 2; ++k) {
        const size_t first = first_of(task, k);
        const aur_result solved = aur_weights_solve(
            count_of(task, k), result->xyz + 3 * first, 1, potentials + k, &task->arguments->weights,
            count_of(task, k), result->weights + k * result->count + first, NULL, NULL, error);
        if (solved != AUR_OK)
            return solved;
    }
    return AUR_OK;
}

static aur_result mis_weights(weights_job *task, aur_error *error) {
    cli_weights_result *const result = task->result;
    const cli_method method = task->arguments->method;
    if (method == CLI_METHOD_VORONOI)
        return cli_weights_by_cells(task->arguments, result, error);
    for (size_t k = 0; k < result->lobe_count; ++k) {
        double *const weights = result->weights + k * result->count;
        aur_result status = AUR_OK;
        if (method == CLI_METHOD_EQUAL)
            equal_weights(task, k, weights);
        else if (method == CLI_METHOD_RATIO)
            status = ratio_weights(task, k, weights, error);
        else if (result->lobe_count == 1 || task->lobe_counts[1] == 0)
            status = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                              "multiple importance sampling needs a set and two lobes: give --lobe2");
        else
            status = aur_mis_weights(method == CLI_METHOD_POWER ? AUR_MIS_POWER : AUR_MIS_BALANCE, 2,
                                     task->strategies, task->potentials[k], result->count, result->xyz,
                                     weights, error);
        if (status != AUR_OK)
            return status;
    }
    return AUR_OK;
}

static aur_result judge(weights_job *task, aur_error *error) {
    cli_weights_result *const result = task->result;
    double *const plain = malloc(result->count * sizeof *plain);
    if (plain == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const aur_worst_case_options options = {.size = sizeof options,
                                            .threads = task->arguments->common.threads,
                                            .progress = cli_progress(task->arguments->common.quiet)};
    aur_result judged = AUR_OK;
    for (size_t k = 0; k < result->lobe_count && judged == AUR_OK; ++k) {
        const double *const weights = result->weights + k * result->count;
        judged = aur_worst_case_error(result->count, result->xyz, weights, task->potentials[k], &options,
                                      &result->weighted[k], error);
        for (size_t i = 0; i < result->count; ++i)
            result->sum[k] += weights[i];
        equal_weights(task, k, plain);
        if (judged == AUR_OK)
            judged = aur_worst_case_error(result->count, result->xyz, plain, task->potentials[k], &options,
                                          &result->equal[k], error);
        const bool drawn = task->arguments->points.options.optimal_density && !from_file(task);
        if (judged == AUR_OK && drawn) {
            result->has_ratio = true;
            judged = ratio_weights(task, k, plain, error);
        }
        if (judged == AUR_OK && drawn)
            judged = aur_worst_case_error(result->count, result->xyz, plain, task->potentials[k], &options,
                                          &result->ratio[k], error);
    }
    cli_progress_clear();
    free(plain);
    return judged;
}

/* In units of a pair of points: the Voronoi cells take thousands per point. */
static void plan(const weights_job *task) {
    enum { MOST = 7 };
    static cli_phase phases[MOST];
    const cli_weights_arguments *const arguments = task->arguments;
    const double count = (double)task->result->count;
    const bool drawn = arguments->points.options.optimal_density && !from_file(task);
    const size_t sums = arguments->report ? (drawn ? 3 : 2) * (arguments->two ? 2 : 1) : 0;
    for (size_t i = 1; i <= sums; ++i)
        phases[i] = (cli_phase){"worst-case error", count * count};
    phases[0] = (cli_phase){"cutting cells", 8000.0 * count};
    if (arguments->method == CLI_METHOD_VORONOI)
        cli_progress_plan(sums + 1, phases);
    else if (arguments->method != CLI_METHOD_EXACT)
        cli_progress_plan(sums, phases + 1);
}

static aur_result compute(weights_job *task, aur_error *error) {
    cli_weights_result *const result = task->result;
    const bool two_patterns = task->arguments->two && !from_file(task);
    aur_result status = two_patterns ? load_two(task, error) : load_one(task, error);
    if (status == AUR_OK && !two_patterns && !from_file(task))
        task->lobe_counts[0] = result->count;
    plan(task);
    const bool exact = task->arguments->method == CLI_METHOD_EXACT;
    if (status == AUR_OK && result->domain == AUR_DOMAIN_AXES && !exact &&
        task->arguments->method != CLI_METHOD_VORONOI)
        status = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "weights of axes are exact or Voronoi: use --method exact or voronoi");
    const bool directions = cli_has_directions(result->domain);
    if (status == AUR_OK && !directions && !exact)
        status = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "this method needs directions: on the domain '%s' use --method exact",
                          aur_domain_name(result->domain));
    if (status == AUR_OK && !directions && task->arguments->plot != NULL)
        status = aur_fail(error, AUR_ERROR_UNSUPPORTED, "--plot: draws directions");
    if (status == AUR_OK && !exact && result->domain != AUR_DOMAIN_AXES)
        status = prepare_lobes(task, error);
    if (status != AUR_OK)
        return status;
    if (task->arguments->levels.count > 0)
        result->lobe_count = task->arguments->levels.count;
    result->weights = malloc(result->lobe_count * result->count * sizeof *result->weights);
    if (result->weights == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (exact)
        return cli_weights_by_degree(task->arguments, result, error);
    const bool optimal =
        task->arguments->method == CLI_METHOD_OSW || task->arguments->method == CLI_METHOD_OSWA;
    status = optimal ? optimal_weights(task, error) : mis_weights(task, error);
    return status == AUR_OK && task->arguments->report ? judge(task, error) : status;
}

int cli_weights_compute(const cli_weights_arguments *arguments, cli_weights_result *result) {
    weights_job task = {.arguments = arguments, .result = result};
    result->domain = arguments->points.options.domain;
    result->lobe_count = arguments->two ? 2 : 1;
    aur_error error = {0};
    const aur_result status = compute(&task, &error);
    aur_potential_destroy(task.potentials[0]);
    aur_potential_destroy(task.potentials[1]);
    return cli_status(status, &error);
}
