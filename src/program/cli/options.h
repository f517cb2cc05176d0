/* Verbs and their options as tables: reading the command line, checking it, help, completion and the
 * documentation go by these rows. A new option is one row, and its use. */
#pragma once

#include <aureole-render/scene.h>
#include <aureole/core.h>
#include <aureole/tables.h>
#include <stdbool.h>
#include <stddef.h>

#include "program/cli/cli.h"

enum { CLI_OPTION_LIMIT = 96, CLI_NAME_LIMIT = 256 }; /* options of a command, names of a choice or table */

/* One option. The key has its long name without the dashes (one letter alone stands for an option that has
 * no long name), type, range, default and line of help. */
typedef struct cli_option {
    aur_key key;
    char letter;            /* -n; 0: there is none */
    const char *value;      /* the value's word in the help, "N"; NULL: a flag, which makes its bool true */
    bool list;              /* VALUE[,VALUE...]: the field is a cli_list */
    bool value_is_optional; /* --name[=VALUE]: without one the text is "" */
    /* The names of an enum from 0 on, NULL beyond the last, where they are not the key's words. */
    const char *(*name)(unsigned value);
    /* Reads what is none of the types of keys, or does what a flag says; the text outlives the command. */
    aur_result (*parse)(const char *text, void *field, aur_error *error);
    /* What is completed: "file", "folder", a kind of `aureole help`, or "file or KIND"; or NULL. */
    const char *content;
    bool writes; /* the value is a file that the command writes: no input, and no other output, may be the
                    same */
} cli_option;

/* Rows of options: the struct and the field that the value goes to, the name, the value's word, the range of
 * a number (ends included, unless .key.minimum_open or .key.maximum_open is set too), the default (NULL:
 * none; with .key.computed = true it says what follows from other things) and the help. */
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

/* What stands on the command line without dashes. */
typedef struct cli_operand {
    const char *word; /* "SCENE" */
    const char *help;
    bool optional, repeated;             /* only the last operands may be either */
    const char *(*name)(unsigned value); /* as for options */
    /* As for options; "topic": commands and kinds, "row": one of the kind that the operand before names. */
    const char *content;
    bool writes; /* as for options */
} cli_operand;

/* Options that stand together in a command's struct; several commands may share one. */
typedef struct cli_group {
    const cli_option *options; /* ends with a row without a name */
    size_t offset;             /* of the struct that the options write to, in the command's own */
} cli_group;

typedef struct cli_call cli_call;

/* One command: its file defines `const cli_command cli_command_<name>`, and main.c has the table. */
typedef struct cli_command {
    const char *name;
    const char *summary;              /* one line for the list */
    const char *notes;                /* what is to be said after the options; or NULL */
    const char *too_few, *too_many;   /* what is wrong with such operands; NULL where it is not said so */
    const cli_operand operands[3];    /* end with one without a word */
    const cli_group groups[16];       /* end with one without options */
    size_t size;                      /* of the struct that the options write to */
    int (*run)(const cli_call *call); /* returns the exit status */
    bool ranks;                       /* several processes that mpirun starts share the work */
    const char *absent; /* what it needs and this program was built without: "libaureole-render"; or NULL */
} cli_command;

/* A command line that has been read. */
struct cli_call {
    const cli_command *const *commands; /* all of them; NULL at the end */
    const cli_command *command;
    void *options; /* the command's struct: zero but for defaults and what was given */
    size_t operand_count;
    char **operands;
    const char *texts[CLI_OPTION_LIMIT]; /* what was given, by the option's index; NULL: nothing */
};

/* Option `index` of a command, group after group, NULL beyond the last; *offset (unless NULL) is the place of
 * its field in the command's struct. */
const cli_option *cli_option_at(const cli_command *command, size_t index, size_t *offset);

/* Reads argv[1..argc-1] into a call whose `options` point to zeros. Prints what is wrong and returns false.
 */
bool cli_read_options(const cli_command *command, int argc, char **argv, cli_call *call);
/* The text that was given for an option, "" for a flag, or NULL when it was not given. */
const char *cli_given(const cli_call *call, const char *name);

/* From here on reading an input that is also an output is an error, and what can be known to fail is said
 * before anything is computed. Returns the exit status. */
int cli_announce_outputs(const cli_call *call);
/* For outputs that are no option's value: whether the file can be written into its folder by this process,
 * where it is the one that writes, and is no other output; from then on it is no input. Errors: WRITE,
 * ARGUMENT. */
aur_result cli_announce_output(const char *path, aur_error *error);

/* Name `index` of those that the value may have, or NULL. */
const char *cli_option_name(const cli_option *option, unsigned index);

/* A text that is cut at its commas. */
typedef struct cli_list {
    size_t count;
    const char *text; /* the items one after the other, each with its zero byte */
} cli_list;
cli_list cli_split(char *text);
const char *cli_list_at(const cli_list *list, size_t index);

/* --- options that commands share: each a group of one row */

typedef struct cli_common {
    report_format format; /* of a table of results; --json is --format json */
    size_t threads;       /* 0: one a processor */
    bool quiet;
    bool no_cache; /* it holds once it is read */
} cli_common;
extern const cli_option cli_format_option[], cli_threads_option[], cli_quiet_option[]; /* of a cli_common */
extern const cli_option cli_cache_option[];                                            /* the same */
extern const cli_option
    cli_limits_option[]; /* of every command, and of no struct: they hold once they are read */

enum { CLI_DEFINITION_LIMIT = 64 };

/* What is said about how a scene is read: -D, as often as it is given, --confine and --diffuse. */
typedef struct cli_definitions {
    size_t count;
    aur_definition items[CLI_DEFINITION_LIMIT];
    bool confine, diffuse;
    aur_model_light model_light;
} cli_definitions;
/* Reads NAME=VALUE; `field` is the definitions' count. */
aur_result cli_add_definition(const char *text, void *field, aur_error *error);
extern const cli_option cli_definitions_option[], cli_model_light_option[]; /* of a cli_definitions */

/* Reads the name of a file for a figure: --plot. Errors: ARGUMENT when its ending is no format of one. */
aur_result cli_parse_plot(const char *text, void *field, aur_error *error);

/* Numbers with units on the command line. */

typedef struct cli_unit {
    const char *name;
    double factor;
} cli_unit;

/* A positive number, with one of the units' names after it or none. */
bool cli_parse_quantity(const char *text, size_t unit_count, const cli_unit *units, double *value);

/* The count of numbers with commas between; 0 if there is anything else, or more than `most`. */
size_t cli_split_numbers(const char *text, size_t most, double *numbers);
/* 30s, 5min or 1h; a number alone is seconds. */
aur_result cli_parse_seconds(const char *option, const char *text, double *seconds, aur_error *error);
/* 500M or 2G; a number alone is bytes. */
aur_result cli_parse_bytes(const char *option, const char *text, size_t *bytes, aur_error *error);
