#include "program/cli/lab/lab_run.h"

#include <aureole/ranks.h>
#include <aureole/sphere.h>
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program/cli/points/point_source.h"
#include "program/lab/check.h"

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

/* The experiments to run and their progress. */
typedef struct schedule {
    const cli_lab *command;
    size_t count;
    const lab_experiment **experiments;
    double expected, spent; /* processor seconds: expected in total, and spent */
    double spent_expected;  /* expected for the experiments that have been run */
    report_table *summary;
    cli_phase *phases; /* for the progress: number of experiments */
} schedule;

void cli_lab_duration(double seconds, char text[32]) {
    const unsigned long whole = (unsigned long)llround(fmax(1.0, seconds));
    if (whole < 100)
        snprintf(text, 32, "%lu s", whole);
    else if (whole < 5400)
        snprintf(text, 32, "%lu min", (whole + 30) / 60);
    else
        snprintf(text, 32, "%lu h %lu min", whole / 3600, whole % 3600 / 60);
}

static double expected_of(const schedule *plan, const lab_experiment *experiment) {
    return plan->command->lab.quick ? experiment->quick_seconds : experiment->seconds;
}

/* Whether existing results are used without running the experiment. */
static bool has_result(const schedule *plan, const lab_experiment *experiment) {
    const cli_lab *const command = plan->command;
    return command->all && !command->check && !command->again && lab_is_finished(experiment, &command->lab);
}

/* Indents the lines of a text. */
static void print_lines(const char *text, const char *indent) {
    while (text != NULL && *text != '\0') {
        const size_t length = strcspn(text, "\n");
        printf("%s%.*s\n", indent, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

static int print_result(const lab_experiment *experiment, lab_result *result, report_format format) {
    if (format == REPORT_TABLE)
        printf("%s (%s)\n\n", experiment->name, experiment->reproduces);
    report_table *const table = result->table;
    result->table = NULL; /* cli_finish destroys it */
    const int status = cli_finish(table, format);
    if (format != REPORT_TABLE)
        return status;
    if (result->notes != NULL && result->notes[0] != '\0')
        putchar('\n');
    print_lines(result->notes, "");
    printf("\nwritten:\n");
    print_lines(result->files, "  ");
    return status;
}

static size_t processors(const schedule *plan) {
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    const size_t available = online > 0 ? (size_t)online : 1, threads = plan->command->common.threads;
    return threads > 0 && threads < available ? threads : available;
}

/* The remaining time is the expectation for the other experiments, scaled by the error of the expectation so
 * far. */
static void announce(const schedule *plan, size_t index) {
    if (plan->command->common.quiet || plan->count == 1 || aur_ranks_rank() != 0)
        return;
    char this_one[32], left[32];
    const double pace = plan->spent_expected > 0.0 ? plan->spent / plan->spent_expected : 1.0;
    cli_lab_duration(pace * expected_of(plan, plan->experiments[index]), this_one);
    cli_lab_duration(pace * (plan->expected - plan->spent_expected), left);
    fprintf(stderr, "aureole: [%zu/%zu] %s: about %s of processor time; all that remain: %s\n", index + 1,
            plan->count, plan->experiments[index]->name, this_one, left);
}

static void summarize(schedule *plan, const lab_experiment *experiment, const lab_result *result,
                      const char *state) {
    report_text(plan->summary, experiment->name);
    report_text(plan->summary, state);
    report_integer(plan->summary, report_rows(result->table));
    for (size_t i = 0; i < LAB_UNPUBLISHED; ++i)
        report_integer(plan->summary, result->verdicts[i]);
    report_integer(plan->summary, result->claims);
    report_integer(plan->summary, result->claims_held);
    report_number(plan->summary, result->seconds, 3);
}

/* Adds a row to the summary: whether the run reproduces the stored tables. */
static int check_one(schedule *plan, const lab_experiment *experiment, const lab_result *result) {
    const cli_lab *const command = plan->command;
    lab_comparison found;
    aur_error error = {0};
    const char *const of_tree = AUR_SCENES_FOLDER "/../docs/report/results";
    const char *const here = access("docs/report/results", R_OK) == 0 ? "docs/report/results" : of_tree;
    int status = cli_status(lab_compare(experiment, command->stored != NULL ? command->stored : here,
                                        command->lab.folder, command->lab.quick, &found, &error),
                            &error);
    const bool missing = result->notes != NULL && strstr(result->notes, "scripts/scenes.sh") != NULL;
    report_text(plan->summary, experiment->name);
    report_text(plan->summary, status != CLI_SUCCESS    ? "not stored"
                               : found.where[0] == '\0' ? "identical"
                               : found.same             ? "within tolerance"
                               : missing                ? "meshes missing"
                                                        : "DIFFERS");
    report_number(plan->summary, found.largest, 2);
    report_text(plan->summary, found.where);
    report_number(plan->summary, result->seconds, 3);
    return status == CLI_FAILURE || (status == CLI_SUCCESS && (missing || found.same)) ? status
                                                                                       : CLI_DIFFERENCE;
}

static int run_one(schedule *plan, const lab_experiment *experiment) {
    const cli_lab *const command = plan->command;
    lab_result result = {0};
    aur_error error = {0};
    if (has_result(plan, experiment)) {
        summarize(plan, experiment, &result, "stored");
        return CLI_SUCCESS;
    }
    const aur_result outcome = lab_run_experiment(experiment, &command->lab, &result, &error);
    cli_progress_clear();
    int status = cli_status(outcome, &error);
    if (outcome == AUR_ERROR_CANCELLED)
        fputs("aureole: interrupted; results so far are stored: the same command continues\n", stderr);
    plan->spent += result.seconds;
    plan->spent_expected += expected_of(plan, experiment);
    if (command->check && outcome == AUR_OK)
        status = check_one(plan, experiment, &result);
    else if (command->all)
        summarize(plan, experiment, &result, outcome == AUR_OK ? "done" : "failed");
    else if (outcome == AUR_OK)
        status = print_result(experiment, &result, command->common.format);
    lab_result_release(&result);
    return status;
}

/* With --all and --check, an experiment that fails does not stop the others. */
static int run_all(schedule *plan) {
    const bool go_on = plan->command->all || plan->command->check;
    int worst = CLI_SUCCESS;
    for (size_t i = 0; i < plan->count && (go_on ? worst != CLI_FAILURE : worst == CLI_SUCCESS); ++i) {
        announce(plan, i);
        const int status = run_one(plan, plan->experiments[i]);
        worst = status > worst ? status : worst;
    }
    return worst;
}

/* Results that took hours are on disk even if standard output is full. */
static int save_summary(const schedule *plan, int status) {
    char path[AUR_ERROR_FILE_CAPACITY];
    aur_error error = {0};
    snprintf(path, sizeof path, "%s/check.csv", plan->command->lab.folder);
    const int saved = cli_status(report_save(plan->summary, NULL, path, &error), &error);
    return saved > status ? saved : status;
}

/* Whether file:NAME-%d.csv exists for some size; always true for a folder. */
static bool has_some_size(const char *set) {
    const char *const mark = strstr(set, "%d");
    char pattern[AUR_ERROR_FILE_CAPACITY];
    if (mark == NULL)
        return true;
    snprintf(pattern, sizeof pattern, "%.*s[0-9]*%s", (int)(mark - set - 5), set + 5, mark + 2);
    glob_t found = {0};
    const bool some = glob(pattern, 0, NULL, &found) == 0;
    globfree(&found);
    return some;
}

/* Detects a missing set or unreadable file before an hour of work. */
static int check_set(const char *set) {
    aur_error error;
    aur_points *points = NULL;
    if (set == NULL)
        return CLI_SUCCESS;
    aur_directions_options some = {.size = sizeof some};
    aur_directions_options_init(16, AUR_DOMAIN_SPHERE, &some, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&some, &request, NULL);
    const aur_result result = aur_points_generate(set, &request, &points, &error);
    aur_points_destroy(points);
    /* a file of this size is not required */
    const bool sized = cli_is_sized_file(set) && has_some_size(set);
    const bool invalid =
        result == AUR_ERROR_NAME || result == AUR_ERROR_FORMAT || (result == AUR_ERROR_OPEN && !sized);
    return invalid ? cli_fail(&error) : CLI_SUCCESS;
}

static void estimate(schedule *plan) {
    size_t count = 0;
    for (size_t i = 0; i < plan->count; ++i) {
        const lab_experiment *const experiment = plan->experiments[i];
        if (has_result(plan, experiment))
            continue;
        plan->expected += expected_of(plan, experiment);
        if (plan->phases != NULL)
            plan->phases[count++] = (cli_phase){experiment->name, expected_of(plan, experiment)};
    }
    cli_progress_plan(count, plan->phases);
    if (plan->command->common.quiet || plan->expected < 10.0 || aur_ranks_rank() != 0)
        return;
    char all[32], wall[32];
    cli_lab_duration(plan->expected, all);
    cli_lab_duration(plan->expected / (double)processors(plan), wall);
    fprintf(stderr, "aureole: about %s of processor time, at least %s on %zu processors\n", all, wall,
            processors(plan));
}

static int choose(schedule *plan, size_t count, char **names) {
    const bool all = plan->command->all;
    if (all && count > 0)
        return cli_bad_usage("lab run: --all takes no names");
    if (!all && count == 0 && !plan->command->check)
        return cli_bad_usage(
            "lab run: no experiment given: 'aureole lab list' prints their names, --all runs all");
    const bool every = count == 0;
    plan->count = every ? lab_experiment_count() : count;
    plan->experiments = malloc(plan->count * sizeof *plan->experiments);
    if (plan->experiments == NULL)
        return cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY});
    for (size_t i = 0; i < plan->count; ++i) {
        plan->experiments[i] = every ? lab_experiment_at(i) : lab_find_experiment(names[i]);
        if (plan->experiments[i] == NULL)
            return cli_bad_usage("lab run: unknown experiment '%s': 'aureole lab list' names them", names[i]);
        if (plan->command->lab.rows != NULL && plan->experiments[i]->rows == NULL)
            return cli_bad_usage("lab run: --rows cannot be used with '%s': its rows have no names",
                                 plan->experiments[i]->name);
    }
    return check_set(plan->command->lab.set);
}

int cli_lab_run(cli_lab *command, size_t count, char **names) {
    static const char *const columns[] = {"experiment", "state",  "rows", "agree",      "within",
                                          "differ",     "claims", "hold", "cpu_seconds"};
    static const char *const of_check[] = {"experiment", "tables", "largest_difference", "where",
                                           "cpu_seconds"};
    const bool summed = command->all || command->check;
    lab_options *const lab = &command->lab;
    schedule plan = {.command = command};
    int status = choose(&plan, count, names);
    if (status == CLI_SUCCESS && fcntl(STDOUT_FILENO, F_GETFL) < 0) { /* before hours of work */
        fputs("aureole: standard output is closed\n", stderr);
        status = CLI_FAILURE;
    }
    if (status == CLI_SUCCESS && aur_ranks_rank() == 0 && mkdir(lab->folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot create the folder: %s\n", lab->folder, strerror(errno));
        status = CLI_FAILURE;
    }
    lab->threads = command->common.threads;
    lab->parameter_count = command->definitions.count;
    lab->parameters = command->definitions.items;
    lab->progress = cli_progress_of_resumable(command->common.quiet);
    lab->warnings = cli_warnings(command->common.quiet);
    if (status == CLI_SUCCESS) {
        plan.phases = calloc(plan.count, sizeof *plan.phases);
        estimate(&plan);
        plan.summary = command->check ? report_create(sizeof of_check / sizeof of_check[0], of_check)
                       : summed       ? report_create(sizeof columns / sizeof columns[0], columns)
                                      : NULL;
        status = run_all(&plan);
        if (command->check && aur_ranks_rank() == 0)
            status = save_summary(&plan, status);
        const int printed = summed ? cli_finish(plan.summary, command->common.format) : CLI_SUCCESS;
        status = status == CLI_SUCCESS ? printed : status;
    }
    cli_progress_plan(0, NULL);
    free(plan.phases);
    free(plan.experiments);
    return status;
}
