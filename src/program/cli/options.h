/* Tables of commands and their options. Parsing, validation, help, completion and documentation use these
 * tables. To add an option, add one row and use its value. */
#pragma once

#include <aureole-render/scene.h>
#include <aureole/core.h>
#include <aureole/tables.h>
#include <stdbool.h>
#include <stddef.h>

#include "program/cli/cli.h"

enum { CLI_OPTION_LIMIT = 96, CLI_NAME_LIMIT = 256 }; /* options of a command, names of a choice or table */

/* One option. The key has its long name without the dashes (one letter for an option without a long name),
 * type, range, default and help. */
typedef struct cli_option {
    aur_key key;
    char letter; /* -n; 0: none */
    const char
        *value; /* placeholder of the value in the help, "N"; NULL: a flag, which sets its bool to true */
    bool list;  /* VALUE[,VALUE...]: the field is a cli_list */
    bool value_is_optional; /* --name[=VALUE]: "" without a value */
    /* The names of an enum by value, NULL beyond the last, if they are not the key's words. */
    const char *(*name)(unsigned value);
    /* Parses other types, or implements a flag; the text outlives the command. */
    aur_result (*parse)(const char *text, void *field, aur_error *error);
    /* Completion: "file", "folder", a kind of `aureole help`, or "file or KIND"; or NULL. */
    const char *content;
    bool writes; /* the value is an output file: it must differ from all inputs and other outputs */
} cli_option;

/* Rows of options: the struct and its field, the name, the placeholder, the range of a number (closed, unless
 * .key.minimum_open or .key.maximum_open is set), the default (NULL: none; with .key.computed = true a
 * description of it) and the help. */
#define CLI_FIELD(type_, struct_, field_, name_, default_, help_)                                            \
    .key.name = (name_), .key.type = (type_), .key.help = (help_), .key.default_text = (default_),           \
    .key.offset = offsetof(struct_, field_), .key.size = sizeof(((struct_ *)0)->field_)
#define CLI_FLAG(struct_, field_, name_, help_)                                                              \
    CLI_FIELD(AUR_KEY_BOOLEAN, struct_, field_, name_, NULL, help_)
#define CLI_TEXT(struct_, field_, name_, value_, default_, help_)                                            \
    CLI_FIELD(AUR_KEY_TEXT, struct_, field_, name_, default_, help_), .value = (value_)
#define CLI_CHOICE(struct_, field_, name_, value_, default_, help_)                                          \
    CLI_FIELD(AUR_KEY_CHOICE, struct_, field_, name_, default_, help_), .value = (value_)
#define CLI_INTEGER(struct_, field_, name_, value_, minimum_, maximum_, default_, help_)                     \
    CLI_FIELD(AUR_KEY_INTEGER, struct_, field_, name_, default_, help_),                                     \
        .value = (value_), .key.minimum = (minimum_), .key.maximum = (maximum_)
#define CLI_REAL(struct_, field_, name_, value_, minimum_, maximum_, default_, help_)                        \
    CLI_FIELD(AUR_KEY_REAL, struct_, field_, name_, default_, help_),                                        \
        .value = (value_), .key.minimum = (minimum_), .key.maximum = (maximum_)

/* A positional argument. */
typedef struct cli_operand {
    const char *word; /* "SCENE" */
    const char *help;
    bool optional, repeated;             /* only the last operands may be optional or repeated */
    const char *(*name)(unsigned value); /* see cli_option */
    /* See cli_option; also "topic": commands and kinds, and "row": a row of the kind given by the previous
     * operand. */
    const char *content;
    bool writes; /* see cli_option */
} cli_operand;

/* A group of options in a command's struct; several commands may share one. */
typedef struct cli_group {
    const cli_option *options; /* ends with a row without a name */
    size_t offset;             /* of the group's struct in the command's struct */
} cli_group;

typedef struct cli_call cli_call;

/* A command: its file defines `const cli_command cli_command_<name>`, and main.c has the table. */
typedef struct cli_command {
    const char *name;
    const char *summary;              /* one line for the list of commands */
    const char *notes;                /* text printed after the options; or NULL */
    const char *too_few, *too_many;   /* message for too few operands; NULL: a general one */
    const cli_operand operands[3];    /* end with one without a name */
    const cli_group groups[16];       /* end with one without options */
    size_t size;                      /* of the struct of option values */
    int (*run)(const cli_call *call); /* returns the exit status */
    bool ranks;                       /* several MPI processes share the work */
    const char *absent; /* the library that this program was built without: "libaureole-render"; or NULL */
} cli_command;

/* A parsed command line. */
struct cli_call {
    const cli_command *const *commands; /* all commands; NULL-terminated */
    const cli_command *command;
    void *options; /* the command's struct with defaults and given values */
    size_t operand_count;
    char **operands;
    const char *texts[CLI_OPTION_LIMIT]; /* the given text by option index; NULL: not given */
};

/* Option `index` of a command over all groups, NULL beyond the last; *offset (unless NULL) is that of its
 * field in the command's struct. */
const cli_option *cli_option_at(const cli_command *command, size_t index, size_t *offset);

/* Parses argv[1..argc-1] into a call whose `options` point to zeros. Prints errors and returns false. */
bool cli_read_options(const cli_command *command, int argc, char **argv, cli_call *call);
/* The given text of an option, "" for a flag, or NULL. */
const char *cli_given(const cli_call *call, const char *name);

/* Checks the outputs before the computation: from now on reading an input that is also an output is an error.
 * Returns the exit status. */
int cli_announce_outputs(const cli_call *call);
/* For outputs that are not the value of an option: checks that this process, if it writes, can write the
 * file, and that it is no other output; from now on it may not be read. Errors: WRITE, ARGUMENT. */
aur_result cli_announce_output(const char *path, aur_error *error);

/* Name `index` of the value's choices, or NULL. */
const char *cli_option_name(const cli_option *option, unsigned index);

/* A text that is split at its commas. */
typedef struct cli_list {
    size_t count;
    const char *text; /* the items in sequence, each zero-terminated */
} cli_list;
cli_list cli_split(char *text);
const char *cli_list_at(const cli_list *list, size_t index);

/* --- options that commands share: each a group of one option */

typedef struct cli_common {
    report_format format; /* for tables of results; --json is --format json */
    size_t threads;       /* 0: all processors */
    bool quiet;
    bool no_cache; /* applied while it is parsed */
} cli_common;
extern const cli_option cli_format_option[], cli_threads_option[], cli_quiet_option[]; /* of a cli_common */
extern const cli_option cli_cache_option[];                                            /* the same */
extern const cli_option
    cli_limits_option[]; /* options of every command without a struct: applied while they are parsed */

enum { CLI_DEFINITION_LIMIT = 64 };

/* Options for reading scenes: -D (repeatable), --confine and --diffuse. */
typedef struct cli_definitions {
    size_t count;
    aur_definition items[CLI_DEFINITION_LIMIT];
    bool confine, diffuse;
    aur_model_light model_light;
} cli_definitions;
/* Reads NAME=VALUE; `field` is the definitions' count. */
aur_result cli_add_definition(const char *text, void *field, aur_error *error);
extern const cli_option cli_definitions_option[], cli_model_light_option[]; /* of a cli_definitions */

/* Parses the file name of a figure: --plot. Errors: ARGUMENT for an unknown extension. */
aur_result cli_parse_plot(const char *text, void *field, aur_error *error);

/* Numbers with units on the command line. */

typedef struct cli_unit {
    const char *name;
    double factor;
} cli_unit;

/* A positive number, optionally followed by the name of a unit. */
bool cli_parse_quantity(const char *text, size_t unit_count, const cli_unit *units, double *value);

/* The number of comma-separated numbers; 0 on a syntax error or more than `most`. */
size_t cli_split_numbers(const char *text, size_t most, double *numbers);
/* 30s, 5min or 1h; seconds without a unit. */
aur_result cli_parse_seconds(const char *option, const char *text, double *seconds, aur_error *error);
/* 500M or 2G; bytes without a unit. */
aur_result cli_parse_bytes(const char *option, const char *text, size_t *bytes, aur_error *error);
