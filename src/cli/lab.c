/* aureole lab: the papers' experiments. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/options.h"
#include "lab/lab.h"

typedef struct lab_command {
    lab_options lab;
    bool quiet;
    cli_format format;
} lab_command;

static const cli_option options[] = {
    {.key = {"output", AUR_KEY_TEXT, "folder of the results", "lab-results",
             CLI_FIELD(lab_command, lab.folder)},
     .letter = 'o',
     .value = "DIR",
     .content = "folder"},
    {.key = {"quick", .help = "a form that takes seconds, with wider intervals",
             CLI_FIELD(lab_command, lab.quick)}},
    {.key = {"set", AUR_KEY_TEXT, "compare one more point set", CLI_FIELD(lab_command, lab.set)},
     .value = "SET",
     .content = "set"},
    {.key = {"scenes", AUR_KEY_TEXT, "the bundled scenes", "./scenes, else those of the source tree",
             .computed = true, CLI_FIELD(lab_command, lab.scenes)},
     .value = "DIR",
     .content = "folder"},
    {.key = {0}}};

static const char *experiment_name(unsigned index) {
    const lab_experiment *const experiment = lab_experiment_at(index);
    return experiment != NULL ? experiment->name : NULL;
}

static const char *action_name(unsigned index) {
    static const char *const names[] = {"list", "run"};
    return index < 2 ? names[index] : NULL;
}

static int list(cli_format format) {
    static const char *const columns[] = {"experiment", "reproduces", "what it shows"};
    cli_table *const table = cli_table_create(3, columns);
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        cli_table_text(table, lab_experiment_at(i)->name);
        cli_table_text(table, lab_experiment_at(i)->reproduces);
        cli_table_text(table, lab_experiment_at(i)->summary);
    }
    return cli_table_finish(table, format);
}

static const lab_experiment *find(const char *name) {
    for (size_t i = 0; i < lab_experiment_count(); ++i)
        if (strcmp(lab_experiment_at(i)->name, name) == 0)
            return lab_experiment_at(i);
    return NULL;
}

static int print_result(const lab_experiment *experiment, const lab_result *result, cli_format format) {
    if (format == CLI_TABLE)
        printf("%s (%s)\n\n", experiment->name, experiment->reproduces);
    cli_table *const table = cli_table_create(result->column_count, result->columns);
    for (size_t i = 0; i < result->cell_count; ++i) {
        if (result->cells[i].is_number)
            cli_table_number(table, result->cells[i].number, 4);
        else
            cli_table_text(table, result->cells[i].text);
    }
    const int status = cli_table_finish(table, format);
    if (format != CLI_TABLE)
        return status;
    if (result->note_count > 0)
        putchar('\n');
    for (size_t i = 0; i < result->note_count; ++i)
        printf("%s\n", result->notes[i]);
    printf("\nwritten:\n");
    for (size_t i = 0; i < result->file_count; ++i)
        printf("  %s\n", result->files[i]);
    return status;
}

static int run_one(const lab_experiment *experiment, const lab_options *lab, cli_format format) {
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
    if (mkdir(lab->folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot make the folder: %s\n", lab->folder, strerror(errno));
        return CLI_FAILURE;
    }
    lab->progress = cli_progress(command->quiet);
    lab->warnings = cli_warnings(command->quiet);
    int status = CLI_SUCCESS;
    for (size_t i = 0; i < count && status == CLI_SUCCESS; ++i)
        status = run_one(find(names[i]), lab, command->format);
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
    return list(command->format);
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
    .groups = {{options},
               {cli_format_option, offsetof(lab_command, format)},
               {cli_threads_option, offsetof(lab_command, lab.threads)},
               {cli_quiet_option, offsetof(lab_command, quiet)}},
    .size = sizeof(lab_command),
    .run = run,
};
