/* Parses the command line by a command's table, with messages that state what is expected. */
#include "program/cli/options.h"

#include <aureole/ranks.h>
#include <aureole/text.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program/report/figure.h"

static aur_result choose_json(const char *text, void *field, aur_error *error) {
    (void)text, (void)error;
    *(report_format *)field = REPORT_JSON;
    return AUR_OK;
}

const cli_option cli_format_option[] = {
    {CLI_CHOICE(cli_common, format, "format", "FORMAT", "table", "output format"),
     .key.words = (const char *const[]){"table", "csv", "json", "latex", NULL}},
    {CLI_FLAG(cli_common, format, "json", "same as --format json"), .parse = choose_json},
    {.key = {0}}};

const cli_option cli_quiet_option[] = {
    {CLI_FLAG(cli_common, quiet, "quiet", "print neither progress nor warnings"), .letter = 'q'},
    {.key = {0}}};

const cli_option cli_threads_option[] = {
    {CLI_INTEGER(cli_common, threads, "threads", "N", 0, 4096, "0",
                 "number of threads; 0: one per processor; results do not depend on it"),
     .letter = 't'},
    {.key = {0}}};

aur_result cli_add_definition(const char *text, void *field, aur_error *error) {
    cli_definitions *const definitions = field; /* the first member is its count */
    char *const equals = strchr(text, '=');
    if (equals == NULL || equals == text)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "-D: '%s' is not of the form name=value", text);
    if (definitions->count == CLI_DEFINITION_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "-D: more than %d definitions", CLI_DEFINITION_LIMIT);
    *equals = '\0';
    definitions->items[definitions->count++] = (aur_definition){text, equals + 1};
    return AUR_OK;
}

const cli_option cli_definitions_option[] = {
    {CLI_TEXT(cli_definitions, count, "define", "NAME=VALUE", NULL,
              "set the value of a <default> of the scene; may be repeated"),
     .letter = 'D', .parse = cli_add_definition},
    {CLI_FLAG(cli_definitions, confine, "confine", "refuse a scene that reads a file outside of its folder")},
    {CLI_FLAG(
        cli_definitions, diffuse, "diffuse",
        "in Radiance files: replace unsupported materials, patterns and textures by their diffuse part")},
    {.key = {0}}};

const cli_option cli_model_light_option[] = {
    {CLI_CHOICE(cli_definitions, model_light, "model-light", "WHEN", "auto",
                "light a model by the environment 'studio'; auto does so if the model has no light source "
                "except emissive surfaces"),
     .key.words = (const char *const[]){"auto", "always", "none", NULL}},
    {.key = {0}}};

const cli_option *cli_option_at(const cli_command *command, size_t index, size_t *offset) {
    for (const cli_group *group = command->groups; group->options != NULL; ++group) {
        for (const cli_option *option = group->options; option->key.name != NULL; ++option) {
            if (index-- != 0)
                continue;
            if (offset != NULL)
                *offset = group->offset + option->key.offset;
            return option;
        }
    }
    /* Options of every command; they have no struct. */
    for (const cli_option *option = cli_limits_option; option->key.name != NULL; ++option)
        if (index-- == 0) {
            if (offset != NULL)
                *offset = 0;
            return option;
        }
    return NULL;
}

const char *cli_given(const cli_call *call, const char *name) {
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(call->command, i, NULL)) != NULL; ++i)
        if (strcmp(option->key.name, name) == 0)
            return call->texts[i];
    return NULL;
}

cli_list cli_split(char *text) {
    cli_list list = {.count = 1, .text = text};
    for (char *comma = strchr(text, ','); comma != NULL; comma = strchr(comma + 1, ',')) {
        *comma = '\0';
        ++list.count;
    }
    return list;
}

const char *cli_list_at(const cli_list *list, size_t index) {
    const char *item = list->text;
    while (index-- > 0)
        item += strlen(item) + 1;
    return item;
}

/* "--samples", or "-n" for an option without a long name. */
static bool refuse(const cli_option *option, const char *expected, const char *text, const char *nearest) {
    cli_bad_usage("%s%s: must be %s, not '%s'%s%s%s", option->key.name[1] != '\0' ? "--" : "-",
                  option->key.name, expected, text, nearest != NULL ? "; did you mean '" : "",
                  nearest != NULL ? nearest : "", nearest != NULL ? "'?" : "");
    return false;
}

const char *cli_option_name(const cli_option *option, unsigned index) {
    if (option->name != NULL)
        return option->name(index);
    for (unsigned i = 0; option->key.words != NULL && option->key.words[i] != NULL; ++i)
        if (i == index)
            return option->key.words[i];
    return NULL;
}

/* Parses a name as text, or its index among the names as an enum or bool. */
static void put_name(const aur_key *key, const char *name, unsigned value, void *field) {
    if (key->type == AUR_KEY_TEXT)
        *(const char **)field = name;
    else if (key->size == sizeof(bool))
        *(bool *)field = value != 0;
    else
        *(unsigned *)field = value;
}

static bool read_name(const cli_option *option, const char *text, void *field) {
    const char *names[CLI_NAME_LIMIT];
    unsigned count = 0;
    for (const char *name; count < CLI_NAME_LIMIT && (name = cli_option_name(option, count)) != NULL;
         ++count) {
        names[count] = name;
        if (strcmp(name, text) == 0) {
            put_name(&option->key, name, count, field);
            return true;
        }
    }
    char expected[AUR_ERROR_MESSAGE_CAPACITY] = "one of ";
    aur_list_names(count, names, sizeof expected - strlen(expected), expected + strlen(expected));
    const char *const nearest = aur_nearest_name(text, count, names);
    return refuse(option, expected, text, nearest);
}

aur_result cli_parse_plot(const char *text, void *field, aur_error *error) {
    if (report_figure_format_of(text) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "--plot: '%s' must end in .svg, .pdf, .png or .tex", text);
    *(const char **)field = text;
    return AUR_OK;
}

/* Parses one value, or one item of a list. */
static bool read_value(const cli_option *option, const char *text, void *field) {
    if (option->parse != NULL) {
        aur_error error = {0};
        return cli_status(option->parse(text, field, &error), &error) == CLI_SUCCESS;
    }
    if (cli_option_name(option, 0) != NULL)
        return read_name(option, text, field);
    aur_key key = option->key;
    char expected[AUR_ERROR_MESSAGE_CAPACITY];
    key.offset = 0;
    return aur_key_parse(&key, text, field, sizeof expected, expected) ||
           refuse(option, expected, text, NULL);
}

static bool read_option(const cli_option *option, char *text, void *field) {
    if (option->value == NULL) {
        *(bool *)field = true;
        return option->parse == NULL || read_value(option, "", field);
    }
    if (!option->list)
        return read_value(option, text, field);
    const cli_list list = *(cli_list *)field = cli_split(text);
    for (size_t i = 0; i < list.count; ++i) {
        uint64_t item[8]; /* only validated here */
        if (!read_value(option, cli_list_at(&list, i), item))
            return false;
    }
    return true;
}

/* Sets defaults by parsing their text; a computed default leaves the field at zero. */
static bool put_defaults(const cli_command *command, char *fields) {
    const cli_option *option;
    size_t offset;
    for (size_t i = 0; (option = cli_option_at(command, i, &offset)) != NULL; ++i) {
        const char *const text = option->key.default_text;
        if (text == NULL || option->key.computed)
            continue;
        if (option->list)
            *(cli_list *)(void *)(fields + offset) = (cli_list){1, text};
        else if (!read_value(option, text, fields + offset))
            return false;
    }
    return true;
}

/* Whether the text is the help's description of a computed default, which counts as not given. File names may
 * be any text. */
static bool spells_computed_default(const cli_option *option, const char *text) {
    const aur_key *const key = &option->key;
    const bool is_file = option->content != NULL && strncmp(option->content, "file", 4) == 0;
    return key->computed && text != NULL && !is_file && strcmp(text, key->default_text) == 0;
}

/* The table for getopt. A long option has the value LONG_OPTION + its index, a short one its letter. */
enum { LONG_OPTION = 256, SYNONYM_LIMIT = 5 };

/* Synonyms, because other programs, or version 0.1, use different names for the same option: each is accepted
 * where the command has the other. */
static const char *const synonyms[SYNONYM_LIMIT][2] = {
    {"count", "size"}, {"output", "outfile"}, {"format", "to"}, {"samples", "spp"}, {"stored", "kept"}};

typedef struct getopt_options {
    size_t count;
    char letters[2 * CLI_OPTION_LIMIT + 2];
    struct option names[CLI_OPTION_LIMIT + SYNONYM_LIMIT + 1];
} getopt_options;

static const struct option *find_name(const getopt_options *list, const char *name) {
    for (const struct option *found = list->names; found->name != NULL; ++found)
        if (strcmp(found->name, name) == 0)
            return found;
    return NULL;
}

/* Adds the synonyms of the command's options. */
static void add_synonyms(getopt_options *list, size_t names) {
    for (size_t i = 0; i < SYNONYM_LIMIT; ++i) {
        const struct option *const first = find_name(list, synonyms[i][0]), *const second = find_name(
                                                                                list, synonyms[i][1]);
        if ((first == NULL) == (second == NULL))
            continue;
        list->names[names] = first != NULL ? *first : *second;
        list->names[names++].name = synonyms[i][first != NULL];
    }
}

static getopt_options list_options(const cli_command *command) {
    getopt_options list = {.letters = ":"};
    size_t letters = 1, names = 0;
    for (const cli_option *option;
         list.count < CLI_OPTION_LIMIT && (option = cli_option_at(command, list.count, NULL)) != NULL;
         ++list.count) {
        const bool is_long = option->key.name[1] != '\0';
        const char letter = is_long ? option->letter : option->key.name[0];
        if (letter != '\0')
            list.letters[letters++] = letter;
        if (letter != '\0' && option->value != NULL)
            list.letters[letters++] = ':';
        if (is_long)
            list.names[names++] = (struct option){option->key.name,
                                                  option->value == NULL       ? no_argument
                                                  : option->value_is_optional ? optional_argument
                                                                              : required_argument,
                                                  NULL, LONG_OPTION + (int)list.count};
    }
    add_synonyms(&list, names);
    return list;
}

static size_t index_of(const cli_command *command, int code) {
    if (code >= LONG_OPTION)
        return (size_t)(code - LONG_OPTION);
    size_t i = 0;
    for (const cli_option *option; (option = cli_option_at(command, i, NULL)) != NULL; ++i)
        if (option->letter == code || (option->key.name[0] == code && option->key.name[1] == '\0'))
            break;
    return i;
}

/* Prints getopt's error: `text` is the argument that it was parsing. */
static int refuse_option(const cli_command *command, const getopt_options *list, int code, const char *text) {
    const bool is_long = optopt == 0 || optopt >= LONG_OPTION;
    char given[AUR_ERROR_MESSAGE_CAPACITY];
    if (is_long)
        aur_format(given, sizeof given, "%.*s", (int)strcspn(text, "="), text);
    else
        aur_format(given, sizeof given, "-%c", optopt);
    if (code == ':' || optopt >= LONG_OPTION)
        return cli_bad_usage("%s: option '%s' %s: try 'aureole help %s'", command->name, given,
                             code == ':' ? "needs a value" : "takes no value", command->name);
    const char *names[CLI_OPTION_LIMIT + SYNONYM_LIMIT];
    char candidates[AUR_ERROR_MESSAGE_CAPACITY] = "";
    size_t count = 0;
    for (; list->names[count].name != NULL; ++count) {
        names[count] = list->names[count].name;
        const size_t used = strlen(candidates);
        if (is_long && strncmp(names[count], given + 2, strlen(given + 2)) == 0)
            aur_format(candidates + used, sizeof candidates - used, "%s--%s", used > 0 ? ", " : "",
                       names[count]);
    }
    const char *const nearest = is_long ? aur_nearest_name(given + 2, count, names) : NULL;
    if (candidates[0] != '\0')
        return cli_bad_usage("%s: option '%s' may be %s", command->name, given, candidates);
    if (nearest != NULL)
        return cli_bad_usage("%s: unknown option '%s'; did you mean '--%s'?", command->name, given, nearest);
    return cli_bad_usage("%s: unknown option '%s': try 'aureole help %s'", command->name, given,
                         command->name);
}

static bool check_operands(const cli_command *command, const cli_call *call) {
    size_t least = 0, most = 0;
    for (const cli_operand *operand = command->operands; operand->word != NULL; ++operand) {
        least += !operand->optional;
        most = operand->repeated ? SIZE_MAX : most + 1;
    }
    if (call->operand_count < least)
        cli_bad_usage("%s: %s: try 'aureole help %s'", command->name, command->too_few, command->name);
    else if (call->operand_count > most && command->too_many != NULL)
        cli_bad_usage("%s: %s: try 'aureole help %s'", command->name, command->too_many, command->name);
    else if (call->operand_count > most)
        cli_bad_usage("%s: unexpected argument '%s'", command->name, call->operands[most]);
    return call->operand_count >= least && call->operand_count <= most;
}

static aur_result check_folder(const char *path, aur_error *error) {
    char folder[AUR_ERROR_FILE_CAPACITY];
    const char *const slash = strrchr(path, '/');
    if (slash == NULL)
        snprintf(folder, sizeof folder, ".");
    else
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    struct stat status; /* pipes and devices are written in place */
    const bool is_file = strcmp(path, "-") != 0 && (stat(path, &status) != 0 || S_ISREG(status.st_mode));
    if (!is_file || aur_ranks_rank() != 0 || access(folder, W_OK | X_OK) == 0) /* only rank 0 writes */
        return AUR_OK;
    aur_fail(error, AUR_ERROR_WRITE, "cannot write: its folder does not exist or is read-only");
    snprintf(error->file, sizeof error->file, "%s", path);
    return AUR_ERROR_WRITE;
}

aur_result cli_announce_output(const char *path, aur_error *error) {
    const aur_result result = check_folder(path, error);
    return result == AUR_OK ? aur_file_announce_output(path, error) : result;
}

int cli_announce_outputs(const cli_call *call) {
    aur_error error = {0};
    aur_result result = AUR_OK;
    const cli_option *option;
    for (size_t i = 0; result == AUR_OK && (option = cli_option_at(call->command, i, NULL)) != NULL; ++i)
        if (option->writes && call->texts[i] != NULL)
            result = cli_announce_output(call->texts[i], &error);
    for (size_t i = 0; result == AUR_OK && i < call->operand_count; ++i)
        if (i < sizeof call->command->operands / sizeof *call->command->operands &&
            call->command->operands[i].writes)
            result = cli_announce_output(call->operands[i], &error);
    return cli_status(result, &error);
}

/* The number of values of a view option of Radiance's rpict; SIZE_MAX for other words. */
static size_t count_view_values(const char *word) {
    if (strncmp(word, "-v", 2) != 0 || word[2] == '\0')
        return SIZE_MAX;
    if (word[2] == 't' && word[3] != '\0' && word[4] == '\0')
        return 0;
    return word[3] != '\0'                     ? SIZE_MAX
           : strchr("pdu", word[2]) != NULL    ? 3
           : strchr("hvoasl", word[2]) != NULL ? 1
                                               : SIZE_MAX;
}

/* Replaces the view options among the arguments (-vp X Y Z -vd X Y Z ...) by one --camera. */
static void gather_view(const getopt_options *list, int *argc, char **argv) {
    static char camera[1024];
    size_t used = (size_t)aur_format(camera, sizeof camera, "--camera=");
    const size_t empty = used;
    double number;
    int remaining_count = 1;
    const bool has_camera = find_name(list, "camera") != NULL;
    for (int i = 1, next; i < *argc; i = next) {
        const bool is_file =
            has_camera && strcmp(argv[i], "-vf") == 0; /* the view file is a file of the scene */
        const size_t count = has_camera ? count_view_values(argv[i]) : SIZE_MAX;
        for (next = i + 1; next < *argc && count != SIZE_MAX && (size_t)(next - i) <= count &&
                           aur_parse_double(argv[next], &number);)
            ++next;
        const bool is_view = count == 0 || (count != SIZE_MAX && next > i + 1);
        for (int k = i; k < next && is_view && used < sizeof camera; ++k)
            used +=
                (size_t)aur_format(camera + used, sizeof camera - used, used > empty ? " %s" : "%s", argv[k]);
        for (int k = i; k < next && !is_view && !is_file; ++k)
            argv[remaining_count++] = argv[k];
    }
    if (used > empty) { /* in front, because "--" may end the options */
        memmove(argv + 2, argv + 1, (size_t)(remaining_count++ - 1) * sizeof *argv);
        argv[1] = camera;
    }
    *argc = remaining_count;
}

bool cli_read_options(const cli_command *command, int argc, char **argv, cli_call *call) {
    const getopt_options list = list_options(command);
    char *const fields = call->options;
    gather_view(&list, &argc, argv);
    call->command = command;
    if (!put_defaults(command, fields))
        return false;
    opterr = 0;
    optind = 0;
    for (int code; (code = getopt_long(argc, argv, list.letters, list.names, NULL)) != -1;) {
        if (code == '?' || code == ':') {
            refuse_option(command, &list, code, argv[optind - 1]);
            return false;
        }
        const size_t index = index_of(command, code);
        size_t offset = 0;
        const cli_option *const option = cli_option_at(command, index, &offset);
        if (spells_computed_default(option, optarg)) {
            call->texts[index] = NULL;
            memset(fields + offset, 0, option->key.size);
            continue;
        }
        call->texts[index] = optarg != NULL ? optarg : "";
        static char nothing[] = "";
        if (!read_option(option, optarg != NULL ? optarg : nothing, fields + offset))
            return false;
    }
    call->operand_count = (size_t)(argc - optind);
    call->operands = argv + optind;
    return check_operands(command, call);
}
