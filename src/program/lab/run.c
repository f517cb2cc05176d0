/* Runs an experiment: its table, its files, and stored measurements. */
#include <aureole/ranks.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "program/lab/run.h"

/* Progress of an experiment, by its expected processor time, because its steps are too diverse to count. Runs
 * may take longer without limit: from nine tenths on, the remaining time is shown as a ninth of the elapsed
 * time. */
static double part_done(double seconds, double expected) {
    const double part = seconds / fmax(expected, 1.0);
    return part < 0.9 ? part : 1.0 - 0.1 * pow(0.9 / part, 9.0);
}

static int show(void *user, const char *what, uint64_t done, uint64_t total) {
    static const double steps = 1e12;
    const lab_run *const run = user;
    const lab_experiment *const of = run->experiment;
    const double part = part_done(lab_run_seconds(run), run->options.quick ? of->quick_seconds : of->seconds);
    (void)what;
    (void)done;
    (void)total;
    return run->shown.function(run->shown.user, of->name, (uint64_t)(steps * part), (uint64_t)steps);
}

static void add_columns(report_table *table, const char *const *columns) {
    for (; *columns != NULL; ++columns)
        report_column(table, *columns);
}

/* What must be equal to resume another run's results. */
static void identify(const lab_experiment *experiment, const lab_options *options, char text[LAB_IDENTITY]) {
    int at =
        snprintf(text, LAB_IDENTITY, "aureole %s, %s, %s form, set %s, rows %s", aur_version(),
                 experiment->name, options->quick ? "quick" : "full",
                 options->set != NULL ? options->set : "none", options->rows != NULL ? options->rows : "all");
    for (size_t i = 0; i < options->parameter_count && at >= 0 && at < LAB_IDENTITY; ++i)
        at += snprintf(text + at, (size_t)(LAB_IDENTITY - at), ", %s=%s", options->parameters[i].name,
                       options->parameters[i].value);
}

/* Whether the experiment has all given parameters. */
static aur_result check_parameters(const lab_run *run, aur_error *error) {
    for (size_t i = 0; i < run->options.parameter_count; ++i) {
        const char *const name = run->options.parameters[i].name;
        const lab_parameter *p = run->experiment->parameters;
        char names[512] = "";
        for (; p != NULL && p->name != NULL && strcmp(p->name, name) != 0; ++p)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s",
                     names[0] != '\0' ? ", " : "", p->name);
        if ((p == NULL || p->name == NULL) && strcmp(name, "scene") == 0)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "experiment '%s' takes no scene: %s (aureole-scene takes any)",
                            run->experiment->name,
                            run->experiment->takes_no_scene != NULL ? run->experiment->takes_no_scene
                                                                    : "it renders none");
        if (p == NULL || p->name == NULL)
            return aur_fail(error, AUR_ERROR_NAME, "experiment '%s': unknown parameter '%s': expected %s",
                            run->experiment->name, name, names[0] != '\0' ? names : "no parameters");
    }
    return AUR_OK;
}

bool lab_is_finished(const lab_experiment *experiment, const lab_options *options) {
    char path[AUR_ERROR_FILE_CAPACITY], identity[LAB_IDENTITY];
    report_table *table = NULL;
    identify(experiment, options, identity);
    snprintf(path, sizeof path, "%s/%s/%s-run.csv", options->folder, experiment->name, experiment->name);
    bool finished = report_load(path, &table, NULL, NULL) == AUR_OK && report_rows(table) == 1 &&
                    strcmp(report_cell(table, 0, 0), identity) == 0;
    report_destroy(table);
    aur_ranks_agree(sizeof finished, &finished);
    return finished;
}

/* Creates the folder and the state of the run. */
static aur_result begin(lab_run *run, aur_error *error) {
    static const char *const of_images[] = {"view", "name", "file", "role", "exposure", NULL};
    static const char *const of_times[] = {"what", "cpu_seconds", NULL};
    char path[AUR_ERROR_FILE_CAPACITY], identity[LAB_IDENTITY];
    snprintf(run->folder, sizeof run->folder, "%s/%s", run->options.folder, run->experiment->name);
    if (aur_ranks_rank() == 0 && mkdir(run->folder, 0777) != 0 && errno != EEXIST)
        return aur_fail(error, AUR_ERROR_WRITE, "%s: cannot create the folder: %s", run->folder,
                        strerror(errno));
    run->options.folder = run->folder;
    lab_run_path(run, "run", "csv", path, sizeof path);
    if (aur_ranks_rank() == 0)
        unlink(path);
    identify(run->experiment, &run->options, identity);
    lab_run_path(run, "unfinished", "txt", path, sizeof path);
    const aur_result result = lab_store_open(path, identity, &run->store, error);
    if (result != AUR_OK)
        return result;
    lab_run_path(run, "pictures", "csv", path, sizeof path);
    if (!lab_store_continues(run->store) || report_load(path, &run->images, NULL, NULL) != AUR_OK) {
        run->images = report_create(0, NULL);
        add_columns(run->images, of_images);
        if (aur_ranks_rank() == 0)
            unlink(path);
    }
    run->times = report_create(0, NULL);
    add_columns(run->times, of_times);
    add_columns(run->result->table, run->experiment->columns);
    if (run->experiment->published != NULL) {
        report_column(run->result->table, "published_over_measured");
        report_column(run->result->table, "verdict");
    }
    run->begin = lab_clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
    run->saved = lab_clock_seconds(CLOCK_MONOTONIC);
    run->shown = run->options.progress;
    if (run->shown.function != NULL)
        run->options.progress = (aur_progress){.function = show, .user = run};
    return AUR_OK;
}

/* At other sizes than its own, a file is represented by its first points, which says nothing about sets of
 * that size. */
static void note_prefixes(lab_run *run) {
    const char *const set = run->options.set;
    aur_points *points;
    if (set == NULL || strncmp(set, "file:", 5) != 0 || run->experiment->takes_no_set != NULL ||
        aur_points_read(set + 5, NULL, &points, NULL) != AUR_OK)
        return;
    lab_note(
        run,
        "%s is one file of %zu points: at smaller sizes its first points are compared, which need not be "
        "as even as a set of that size (file:NAME-%%d.csv or a folder takes a file for each size)",
        set, aur_points_get_view(points)->count);
    aur_points_destroy(points);
}

static void note_verdicts(lab_run *run) {
    const lab_experiment *const of = run->experiment;
    const size_t *const v = run->result->verdicts;
    if (of->published != NULL)
        lab_note(run,
                 "of %zu published values %zu agree (lie in our interval), %zu more are within a factor of "
                 "%g, %zu differ",
                 v[LAB_AGREES] + v[LAB_WITHIN] + v[LAB_DIFFERS], v[LAB_AGREES], v[LAB_WITHIN], of->factor,
                 v[LAB_DIFFERS]);
    if (run->result->claims > 0)
        lab_note(run, "%zu of %zu claims hold", run->result->claims_held, run->result->claims);
    if (run->options.set != NULL && of->takes_no_set != NULL)
        lab_note(run, "--set %s is not compared here: %s", run->options.set, of->takes_no_set);
}

/* Writes the files, and last the mark that the run is finished. */
static aur_result save_all(lab_run *run, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY], identity[LAB_IDENTITY];
    aur_result result = lab_run_save(run, run->result->table, NULL, run->result->notes, true, error);
    for (size_t i = 0; i < run->further_count && result == AUR_OK; ++i)
        result = lab_run_save(run, run->further[i], run->further_names[i], NULL, true, error);
    for (size_t i = 0; i < report_rows(run->images); ++i)
        fprintf(run->files, "%s/%s\n", run->folder, report_cell(run->images, i, 2));
    char raw[AUR_ERROR_FILE_CAPACITY];
    bool written = false;
    lab_run_path(run, "unfinished", "txt", path, sizeof path);
    lab_run_path(run, "runs", "npz", raw, sizeof raw);
    if (result == AUR_OK && aur_ranks_rank() == 0)
        result = lab_store_export(path, raw, &written, error);
    if (written)
        fprintf(run->files, "%s\n", raw);
    run->result->seconds = lab_run_seconds(run);
    lab_time(run, "all", run->result->seconds);
    if (result == AUR_OK)
        result = lab_run_save(run, run->times, "timings", NULL, true, error);
    if (result != AUR_OK)
        return result;
    report_table *const facts = report_create(0, NULL);
    static const char *const names[LAB_VERDICTS] = {"agree", "within", "differ", "unpublished"};
    identify(run->experiment, &run->options, identity);
    report_fact_text(facts, "run", identity);
    report_fact_number(facts, "rows", (double)report_rows(run->result->table));
    for (size_t i = 0; i < LAB_VERDICTS; ++i)
        report_fact_number(facts, names[i], (double)run->result->verdicts[i]);
    report_fact_number(facts, "claims", (double)run->result->claims);
    report_fact_number(facts, "hold", (double)run->result->claims_held);
    result = lab_run_save(run, facts, "run", NULL, false, error);
    report_destroy(facts);
    lab_run_path(run, "unfinished", "txt", path, sizeof path);
    if (result == AUR_OK && aur_ranks_rank() == 0)
        unlink(path);
    return result;
}

/* Terminates a text written to memory; false if out of memory. */
static bool finish(FILE *stream) {
    return stream != NULL && fclose(stream) == 0;
}

aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                              lab_result *result, aur_error *error) {
    *result = (lab_result){.table = report_create(0, NULL)};
    size_t note_size, file_size;
    lab_run run = {.experiment = experiment,
                   .options = *options,
                   .result = result,
                   .notes = open_memstream(&result->notes, &note_size),
                   .files = open_memstream(&result->files, &file_size)};
    aur_result outcome = AUR_OK;
    const bool ready = run.notes != NULL && run.files != NULL;
    if (ready)
        outcome = check_parameters(&run, error);
    if (outcome == AUR_OK && ready)
        outcome = begin(&run, error);
    if (outcome == AUR_OK && ready)
        outcome = experiment->run(&run, error);
    if (outcome == AUR_OK && ready)
        note_verdicts(&run);
    if (outcome == AUR_OK && ready)
        note_prefixes(&run);
    const bool noted = finish(run.notes);
    if (outcome == AUR_OK && ready && noted)
        outcome = save_all(&run, error);
    else if (run.store != NULL && aur_ranks_count() == 1 && report_rows(result->table) > 0)
        lab_run_save(&run, result->table, NULL, "unfinished: the same command continues", false, NULL);
    const bool listed = finish(run.files);
    if (outcome == AUR_OK && !(ready && noted && listed))
        outcome = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    lab_store_close(run.store);
    report_destroy(run.images);
    report_destroy(run.times);
    for (size_t i = 0; i < run.further_count; ++i)
        report_destroy(run.further[i]);
    return outcome;
}

void lab_result_release(lab_result *result) {
    report_destroy(result->table);
    free(result->notes);
    free(result->files);
    *result = (lab_result){0};
}
