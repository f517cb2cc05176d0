/* aureole lab: the papers' experiments. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/cli.h"
#include "lab/lab.h"

static int list(int argc, char **argv) {
    enum { FORMAT = 256 };
    static const struct option options[] = {{"format", required_argument, NULL, FORMAT}, {NULL, 0, NULL, 0}};
    cli_format format = CLI_TABLE;
    int option;
    optind = 0;
    while ((option = cli_next_option(argc, argv, "", options)) != -1)
        if (option != FORMAT || !cli_parse_format(optarg, &format))
            return CLI_BAD_INPUT;
    if (optind != argc)
        return cli_bad_usage("lab list: takes no names");
    static const char *const columns[] = {"experiment", "reproduces", "what it shows"};
    cli_table *const table = cli_table_create(3, columns);
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        cli_table_text(table, lab_experiment_at(i)->name);
        cli_table_text(table, lab_experiment_at(i)->reproduces);
        cli_table_text(table, lab_experiment_at(i)->summary);
    }
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
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
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
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

static int run_one(const lab_experiment *experiment, const lab_options *options, cli_format format) {
    lab_result result;
    aur_error error = {0};
    const aur_result outcome = lab_run_experiment(experiment, options, &result, &error);
    cli_progress_clear();
    const int status = outcome == AUR_OK ? print_result(experiment, &result, format) : cli_fail(&error);
    lab_result_release(&result);
    return status;
}

static int run_experiments(int argc, char **argv) {
    enum { QUICK = 256, SET, SCENES, FORMAT };
    static const struct option options[] = {
        {"quick", no_argument, NULL, QUICK},         {"set", required_argument, NULL, SET},
        {"scenes", required_argument, NULL, SCENES}, {"format", required_argument, NULL, FORMAT},
        {"output", required_argument, NULL, 'o'},    {"threads", required_argument, NULL, 't'},
        {"quiet", no_argument, NULL, 'q'},           {NULL, 0, NULL, 0}};
    lab_options lab = {.folder = "lab-results"};
    cli_format format = CLI_TABLE;
    bool quiet = false;
    int option;
    optind = 0;
    while ((option = cli_next_option(argc, argv, "o:t:q", options)) != -1) {
        bool good = true;
        if (option == QUICK)
            lab.quick = true;
        else if (option == SET)
            lab.set = optarg;
        else if (option == SCENES)
            lab.scenes = optarg;
        else if (option == FORMAT)
            good = cli_parse_format(optarg, &format);
        else if (option == 'o')
            lab.folder = optarg;
        else if (option == 't')
            good = cli_parse_size("-t", optarg, 1, 1024, &lab.threads);
        else if (option == 'q')
            quiet = true;
        else
            good = false;
        if (!good)
            return CLI_BAD_INPUT;
    }
    if (optind == argc)
        return cli_bad_usage("lab run: an experiment is missing: 'aureole lab list' names them");
    for (int i = optind; i < argc; ++i)
        if (find(argv[i]) == NULL)
            return cli_bad_usage("lab run: unknown experiment '%s': 'aureole lab list' names them", argv[i]);
    if (mkdir(lab.folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot make the folder: %s\n", lab.folder, strerror(errno));
        return CLI_FAILURE;
    }
    lab.progress = cli_progress(quiet);
    lab.warnings = cli_warnings(quiet);
    int status = CLI_SUCCESS;
    for (int i = optind; i < argc && status == CLI_SUCCESS; ++i)
        status = run_one(find(argv[i]), &lab, format);
    return status;
}

static int run(int argc, char **argv) {
    if (argc >= 2 && strcmp(argv[1], "list") == 0)
        return list(argc - 1, argv + 1);
    if (argc >= 2 && strcmp(argv[1], "run") == 0)
        return run_experiments(argc - 1, argv + 1);
    return cli_bad_usage("lab: 'list' or 'run' is wanted: try 'aureole help lab'");
}

const cli_verb cli_verb_lab = {
    "lab", "list | run NAME... [options]", "the papers' experiments, measured",
    "  list                the experiments and what each reproduces\n"
    "  run NAME...         run experiments; writes CSV and pictures and prints the table\n"
    "  -o DIR              folder of the results (default: lab-results)\n"
    "  --quick             a form that takes seconds, with wider intervals\n"
    "  --set SET           compare one more point set\n"
    "  --scenes DIR        the bundled scenes (default: ./scenes, else those of the source tree)\n"
    "  --format F          table, csv or json\n"
    "  -t N, -q            threads; no progress bar and no warnings\n",
    run};
