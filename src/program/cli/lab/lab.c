/* aureole lab: the experiments of the papers. */
#include <dlfcn.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "program/cli/lab/lab_run.h"
#include "program/cli/listing.h"
#include "program/lab/lab.h"

static aur_result add_named(cli_definitions *definitions, const char *name, const char *value,
                            aur_error *error) {
    if (definitions->count == CLI_DEFINITION_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "--%s: more than %d parameters", name,
                        CLI_DEFINITION_LIMIT);
    definitions->items[definitions->count++] = (aur_definition){name, value};
    return AUR_OK;
}

/* The field of both is the count, the first member of the definitions. */
static aur_result add_scene(const char *text, void *field, aur_error *error) {
    return add_named(field, "scene", text, error);
}

static aur_result add_integrand(const char *text, void *field, aur_error *error) {
    return add_named(field, "integrand", text, error);
}

static const cli_option options[] = {
    {CLI_TEXT(cli_lab, lab.folder, "output", "DIR", "lab-results; lab-check for check, lab-report for report",
              "output folder of the results, or of the report"),
     .letter = 'o', .key.computed = true, .content = "folder"},
    {CLI_FLAG(cli_lab, all, "all", "all experiments; finished ones are not run again")},
    {CLI_FLAG(cli_lab, again, "again", "with --all, run finished experiments again")},
    {CLI_FLAG(cli_lab, lab.quick, "quick", "run a short version (seconds) with wider intervals")},
    {CLI_FLAG(cli_lab, small, "small",
              "a report of a few MB: large images are halved, and there are no plots for print")},
    {CLI_TEXT(cli_lab, lab.set, "set", "SET", NULL,
              "compare one more point set; file:PATH reads points from a file"),
     .content = "set"},
    {CLI_TEXT(cli_lab, module, "module", "FILE", NULL,
              "load experiments, sets (callback:NAME) and integrands of a shared library (docs/lab.md)"),
     .content = "file"},
    {CLI_TEXT(cli_lab, definitions.count, "define", "NAME=VALUE", NULL,
              "set a parameter of the experiment; may be repeated"),
     .letter = 'D', .parse = cli_add_definition},
    {CLI_TEXT(cli_lab, definitions.count, "scene", "FILE", NULL,
              "same as -D scene=FILE, for experiments that render any scene"),
     .parse = add_scene, .content = "file"},
    {CLI_TEXT(cli_lab, definitions.count, "integrand", "NAME", NULL,
              "same as -D integrand=NAME, for experiments that integrate any function"),
     .parse = add_integrand},
    {CLI_REAL(cli_lab, paper.width, "width", "CM", 1, 100, "8.5", "paper: width of plots")},
    {CLI_REAL(cli_lab, paper.height, "height", "CM", 1, 100, "6", "paper: height of plots, without legends")},
    {CLI_REAL(cli_lab, paper.text_size, "font-size", "PT", 1, 100, "8", "paper: size of text in PDF")},
    {CLI_FLAG(cli_lab, paper.times, "times", "paper: PDF in Times, not Helvetica")},
    {CLI_INTEGER(cli_lab, paper.digits, "digits", "N", 1, 17, "4", "paper: significant digits of tables")},
    {CLI_TEXT(cli_lab, lab.rows, "rows", "PATTERN", NULL,
              "compute only rows that match a pattern such as '*/bnot', in experiments with named rows")},
    {CLI_TEXT(cli_lab, lab.scenes, "scenes", "DIR", "./scenes, or those of the source tree",
              "folder of the bundled scenes"),
     .key.computed = true, .content = "folder"},
    {CLI_TEXT(cli_lab, stored, "stored", "DIR", "./docs/report/results, or those of the source tree",
              "folder of the stored tables that check compares with"),
     .key.computed = true, .content = "folder"},
    {.key = {0}}};

static const char *experiment_name(unsigned index) {
    const lab_experiment *const experiment = lab_experiment_at(index);
    return experiment != NULL ? experiment->name : NULL;
}

static const char *action_name(unsigned index) {
    static const char *const names[] = {"list", "run", "check", "report", "paper"};
    return index < sizeof names / sizeof names[0] ? names[index] : NULL;
}

static int list(report_format format) {
    static const char *const columns[] = {"experiment", "reproduces", "quick", "full", "what it shows"};
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        const lab_experiment *const experiment = lab_experiment_at(i);
        char quick[32], full[32];
        cli_lab_duration(experiment->quick_seconds, quick);
        cli_lab_duration(experiment->seconds, full);
        report_text(table, experiment->name);
        report_text(table, experiment->reproduces);
        report_text(table, quick);
        report_text(table, full);
        report_text(table, experiment->summary);
    }
    return cli_finish_listing(table, format);
}

/* Writes the page of results to a folder, and its plots for print. */
static int report(const char *results, const char *folder, bool small) {
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot create the folder: %s\n", folder, strerror(errno));
        return CLI_FAILURE;
    }
    char path[AUR_ERROR_FILE_CAPACITY];
    aur_error error = {0};
    const int status = cli_status(lab_publish(results, folder, small, path, &error), &error);
    if (status == CLI_SUCCESS)
        printf("%s\n", path);
    return status;
}

/* The library stays loaded until the process ends. */
static int load_module(const char *path) {
    char module_path[AUR_ERROR_FILE_CAPACITY];
    aur_error error = {0};
    snprintf(module_path, sizeof module_path, "%s%s", strchr(path, '/') != NULL ? "" : "./", path);
    void *const library = dlopen(module_path, RTLD_NOW | RTLD_LOCAL);
    const lab_module *(*find)(void) = NULL;
    *(void **)&find = library != NULL ? dlsym(library, "aureole_lab_module") : NULL;
    if (find == NULL) {
        fprintf(stderr, "aureole: --module %s: %s\n", path, dlerror());
        return CLI_FAILURE;
    }
    const aur_result result = lab_add(find(), &error);
    snprintf(error.file, sizeof error.file, "%s", path);
    return cli_status(result, &error);
}

static int run(const cli_call *call) {
    cli_lab *const command = call->options;
    const int loaded = command->module != NULL ? load_module(command->module) : CLI_SUCCESS;
    if (loaded != CLI_SUCCESS)
        return loaded;
    const char *const action = call->operands[0], *const folder = command->lab.folder;
    command->check = strcmp(action, "check") == 0;
    command->lab.folder = folder != NULL ? folder : command->check ? "lab-check" : "lab-results";
    if (command->check && (command->lab.set != NULL || command->lab.rows != NULL))
        return cli_bad_usage(
            "lab check: --set and --rows cannot be used: stored tables have every row and no further set");
    if (strcmp(action, "run") == 0 || command->check)
        return cli_lab_run(command, call->operand_count - 1, call->operands + 1);
    if (strcmp(action, "report") == 0) {
        if (call->operand_count > 2)
            return cli_bad_usage("lab report: takes one folder of results");
        return report(call->operand_count > 1 ? call->operands[1] : "lab-results",
                      folder != NULL ? folder : "lab-report", command->small);
    }
    if (strcmp(action, "paper") == 0) {
        if (call->operand_count > 2)
            return cli_bad_usage("lab paper: takes one folder of results");
        aur_error error = {0};
        return cli_status(lab_write_paper(call->operand_count > 1 ? call->operands[1] : "lab-results",
                                          folder != NULL ? folder : "lab-paper", &command->paper, stdout,
                                          &error),
                          &error);
    }
    if (strcmp(action, "list") != 0)
        return cli_bad_usage("lab: %s: try 'aureole help lab'", call->command->too_few);
    if (call->operand_count > 1)
        return cli_bad_usage("lab list: takes no names");
    return list(command->common.format);
}

const cli_command cli_command_lab = {
    .name = "lab",
    .summary = "run the experiments of the papers and compare with the published figures",
    .notes =
        "The same command continues an interrupted run. Each experiment writes its tables (NAME.csv), images "
        "and timings.csv to a folder of its name. Only timings.csv differs from run to run. See docs/lab.md.",
    .too_few = "expected 'list', 'run', 'check', 'report' or 'paper'",
    .operands =
        {{"ACTION",
          "list: print the experiments, what each reproduces, and its processor time; run: run experiments, "
          "write CSV files and images, print the tables; check: run experiments (all without a NAME) and "
          "compare with the stored tables, exit status 1 if one differs; report: write a page with plots and "
          "images of the results in the folder NAME (lab-results) to DIR/index.html (lab-report); paper: "
          "write "
          "LaTeX tables, PDF and TikZ plots and their data to DIR (lab-paper)",
          .name = action_name},
         {"NAME", "experiments to run, or the folder with results to report", .optional = true,
          .repeated = true, .name = experiment_name}},
    .groups = {{options, 0},
               {cli_format_option, offsetof(cli_lab, common)},
               {cli_threads_option, offsetof(cli_lab, common)},
               {cli_quiet_option, offsetof(cli_lab, common)},
               {cli_cache_option, offsetof(cli_lab, common)}},
    .size = sizeof(cli_lab),
    .run = run,
    .ranks = true,
};
