/* aureole lab: the papers' experiments. */
#include <aureole/ranks.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/options.h"
#include "lab/lab.h"

typedef struct lab_command {
    lab_options lab;
    cli_common common;
} lab_command;

static const cli_option options[] = {
    {CLI_TEXT(lab_command, lab.folder, "output", "DIR", "lab-results", "folder of the results"),
     .letter = 'o', .content = "folder"},
    {CLI_FLAG(lab_command, lab.quick, "quick", "a form that takes seconds, with wider intervals")},
    {CLI_TEXT(lab_command, lab.set, "set", "SET", NULL, "compare one more point set"), .content = "set"},
    {CLI_TEXT(lab_command, lab.rows, "rows", "PATTERN", NULL,
              "make only the rows that match, such as '*/bnot'; of experiments whose rows have names")},
    {CLI_TEXT(lab_command, lab.scenes, "scenes", "DIR", "./scenes, else those of the source tree",
              "the bundled scenes"),
     .key.computed = true, .content = "folder"},
    {.key = {0}}};

static const char *experiment_name(unsigned index) {
    const lab_experiment *const experiment = lab_experiment_at(index);
    return experiment != NULL ? experiment->name : NULL;
}

static const char *action_name(unsigned index) {
    static const char *const names[] = {"list", "run"};
    return index < 2 ? names[index] : NULL;
}

static int list(report_format format) {
    static const char *const columns[] = {"experiment", "reproduces", "what it shows"};
    report_table *const table = report_create(3, columns);
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        report_text(table, lab_experiment_at(i)->name);
        report_text(table, lab_experiment_at(i)->reproduces);
        report_text(table, lab_experiment_at(i)->summary);
    }
    return cli_finish(table, format);
}

static const lab_experiment *find(const char *name) {
    for (size_t i = 0; i < lab_experiment_count(); ++i)
        if (strcmp(lab_experiment_at(i)->name, name) == 0)
            return lab_experiment_at(i);
    return NULL;
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
    result->table = NULL; /* cli_finish ends it */
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

static int run_one(const lab_experiment *experiment, const lab_options *lab, report_format format) {
    lab_result result;
    aur_error error = {0};
    const aur_result outcome = lab_run_experiment(experiment, lab, &result, &error);
    cli_progress_clear();
    const int status = outcome == AUR_OK ? print_result(experiment, &result, format) : cli_fail(&error);
    lab_result_release(&result);
    return status;
}

static int run_experiments(lab_command *command, size_t count, char **names) {
    if (count == 0)
        return cli_bad_usage("lab run: an experiment is missing: 'aureole lab list' names them");
    for (size_t i = 0; i < count; ++i)
        if (find(names[i]) == NULL)
            return cli_bad_usage("lab run: unknown experiment '%s': 'aureole lab list' names them", names[i]);
    lab_options *const lab = &command->lab;
    for (size_t i = 0; i < count && lab->rows != NULL; ++i)
        if (find(names[i])->rows == NULL)
            return cli_bad_usage("lab run: the rows of '%s' have no names: --rows does not go with it",
                                 names[i]);
    if (aur_ranks_rank() == 0 && mkdir(lab->folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot make the folder: %s\n", lab->folder, strerror(errno));
        return CLI_FAILURE;
    }
    lab->threads = command->common.threads;
    lab->progress = cli_progress(command->common.quiet);
    lab->warnings = cli_warnings(command->common.quiet);
    int status = CLI_SUCCESS;
    for (size_t i = 0; i < count && status == CLI_SUCCESS; ++i)
        status = run_one(find(names[i]), lab, command->common.format);
    return status;
}

static int run(const cli_call *call) {
    lab_command *const command = call->options;
    const char *const action = call->operands[0];
    if (strcmp(action, "run") == 0)
        return run_experiments(command, call->operand_count - 1, call->operands + 1);
    if (strcmp(action, "list") != 0)
        return cli_bad_usage("lab: %s: try 'aureole help lab'", call->verb->too_few);
    if (call->operand_count > 1)
        return cli_bad_usage("lab list: takes no names");
    return list(command->common.format);
}

const cli_verb cli_verb_lab = {
    .name = "lab",
    .summary = "the papers' experiments, measured",
    .too_few = "'list' or 'run' is wanted",
    .operands = {{"ACTION",
                  "list: the experiments and what each reproduces; run: run experiments, write CSV and "
                  "pictures, print the tables",
                  .name = action_name},
                 {"NAME", "experiments to run", .optional = true, .repeated = true, .name = experiment_name}},
    .groups = {{options, 0},
               {cli_format_option, offsetof(lab_command, common)},
               {cli_threads_option, offsetof(lab_command, common)},
               {cli_quiet_option, offsetof(lab_command, common)},
               {cli_cache_option, offsetof(lab_command, common)},
               {cli_limits_option, offsetof(lab_command, common)}},
    .size = sizeof(lab_command),
    .run = run,
    .ranks = true,
};
