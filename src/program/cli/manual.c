/* aureole manual: manual pages in the language of man (troff), generated from the same tables as `aureole
 * help`: one page for the program, one per command, one for the components of scenes, one for sets and
 * measures. */
#include <aureole/text.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/cli/listing.h"

typedef struct manual_options {
    const char *folder;
} manual_options;

/* Escapes text: a line that begins with . or ' would be a troff request. */
static void put_text(FILE *page, const char *text) {
    bool start = true;
    for (const char *c = text; *c != '\0'; ++c) {
        if (start && (*c == '.' || *c == '\''))
            fputs("\\&", page);
        start = *c == '\n';
        switch (*c) {
        case '\\':
            fputs("\\e", page);
            break;
        case '-':
            fputs("\\-", page);
            break;
        case '\'':
            fputs("\\(aq", page);
            break;
        case '`':
            fputs("\\(ga", page);
            break;
        case '^':
            fputs("\\(ha", page);
            break;
        case '~':
            fputs("\\(ti", page);
            break;
        case ',':
            fputs(",\\:", page); /* allow a line break after it */
            break;
        default:
            fputc(*c, page);
        }
    }
}

static void put_line(FILE *page, const char *text) {
    put_text(page, text);
    fputc('\n', page);
}

static void put_section(FILE *page, const char *name) {
    fprintf(page, ".SH ");
    put_line(page, name);
}

static void put_entry(FILE *page, const char *what, const char *help) {
    fprintf(page, ".TP\n\\fB");
    put_text(page, what);
    fprintf(page, "\\fR\n");
    put_line(page, help);
}

/* The title, in capitals, and the section NAME. */
static void put_head(FILE *page, const char *name, int section, const char *summary) {
    fprintf(page, ".\\\" Written by aureole manual.\n.TH \"");
    for (const char *c = name; *c != '\0'; ++c)
        fputc(*c >= 'a' && *c <= 'z' ? *c - 'a' + 'A' : *c, page);
    fprintf(page, "\" %d \"\" \"aureole %s\" \"Aureole\"\n.ad l\n.nh\n", section, aur_version());
    put_section(page, "NAME");
    put_text(page, name);
    fprintf(page, " \\- ");
    put_line(page, summary);
}

static void put_exit_statuses(FILE *page) {
    put_section(page, "EXIT STATUS");
    put_entry(page, "0", "Done.");
    put_entry(page, "1", "The compared images differ.");
    put_entry(page, "2",
              "The command line or the input is wrong: the message states where and what is expected.");
    put_entry(page, "3",
              "The command failed: a file cannot be written, memory is exhausted, or it was interrupted.");
}

static void put_command(FILE *page, const cli_command *command) {
    char name[64], what[CLI_WORDS_CAPACITY], help[CLI_HELP_CAPACITY];
    aur_format(name, sizeof name, "aureole-%s", command->name);
    put_head(page, name, 1, command->summary);
    put_section(page, "SYNOPSIS");
    fprintf(page, "\\fBaureole %s\\fR", command->name);
    for (const cli_operand *operand = command->operands; operand->word != NULL; ++operand)
        fprintf(page, " %s\\fI%s\\fR%s%s", operand->optional ? "[" : "", operand->word,
                operand->repeated ? "..." : "", operand->optional ? "]" : "");
    fprintf(page, "%s\n", cli_option_at(command, 0, NULL) != NULL ? " [\\fIOPTION\\fR...]" : "");
    if (command->notes != NULL) {
        put_section(page, "DESCRIPTION");
        put_line(page, command->notes);
    }
    if (command->operands[0].word != NULL)
        put_section(page, "ARGUMENTS");
    for (const cli_operand *operand = command->operands; operand->word != NULL; ++operand)
        put_entry(page, operand->word, operand->help);
    const cli_option *option;
    if (cli_option_at(command, 0, NULL) != NULL)
        put_section(page, "OPTIONS");
    for (size_t i = 0; (option = cli_option_at(command, i, NULL)) != NULL; ++i) {
        cli_write_option(option, false, what);
        cli_write_option_help(option, help);
        put_entry(page, what, help);
    }
    put_exit_statuses(page);
    put_section(page, "SEE ALSO");
    put_line(page, "aureole(1), aureole-scene(5), aureole-names(7)");
}

static void put_program(FILE *page, const cli_command *const *commands) {
    put_head(page, "aureole", 1, "quasi-Monte Carlo points, weights and light transport");
    put_section(page, "SYNOPSIS");
    fprintf(page, "\\fBaureole\\fR \\fICOMMAND\\fR [\\fIARGUMENT\\fR...] [\\fIOPTION\\fR...]\n");
    put_section(page, "DESCRIPTION");
    put_line(page, "Generates, measures and weighs sample points on the square, the hemisphere and the "
                   "sphere, and renders images with them. The same inputs and seed give identical bits with "
                   "any number of threads. Each command has its page: aureole-COMMAND(1).");
    put_section(page, "COMMANDS");
    for (size_t i = 0; commands[i] != NULL; ++i)
        put_entry(page, commands[i]->name, commands[i]->summary);
    put_section(page, "ENVIRONMENT");
    put_entry(page, "AUREOLE_CACHE",
              "Cache folder of results that take long to compute; empty for no cache.");
    put_entry(page, "AUREOLE_ISA", "The widest instruction set to use: portable, avx2 or avx512.");
    put_exit_statuses(page);
    put_section(page, "EXAMPLES");
    fprintf(page, ".nf\n");
    put_line(page, "aureole points spherical-fibonacci -n 64 --domain hemisphere -o points.csv\naureole "
                   "measure spherical-fibonacci sobol -n 1024 --metric energy\naureole render scene.xml "
                   "--error 2% -o image.png");
    fprintf(page, ".fi\n");
    put_section(page, "SEE ALSO");
    put_line(page, "aureole-scene(5), aureole-names(7)");
}

/* Prints every row of a kind with its keys. */
static void put_kind(FILE *page, const aur_table *kind) {
    char title[128], what[CLI_WORDS_CAPACITY], help[CLI_HELP_CAPACITY];
    aur_format(title, sizeof title, "%s: %s", kind->kind, kind->summary);
    put_section(page, title);
    for (size_t i = 0; i <= kind->count; ++i) {
        const aur_row *const row = i < kind->count ? kind->rows[i] : kind->common;
        if (row == NULL)
            continue;
        if (i < kind->count)
            put_entry(page, row->name, row->summary);
        else
            put_entry(page, "all of them", "Parameters of every plugin of this kind.");
        fprintf(page, ".RS\n");
        for (size_t k = 0; aur_row_key(row, k) != NULL; ++k) {
            cli_write_key(aur_row_key(row, k), what);
            cli_write_key_help(aur_row_key(row, k), help);
            put_entry(page, what, help);
        }
        fprintf(page, ".RE\n");
    }
}

static const char scene_example[] =
    "<scene version=\"3.0.0\">\n"
    "  <default name=\"spp\" value=\"64\"/>\n"
    "  <integrator type=\"path\"><integer name=\"max_depth\" value=\"8\"/></integrator>\n"
    "  <sensor type=\"perspective\">\n"
    "    <float name=\"fov\" value=\"40\"/>\n"
    "    <transform name=\"to_world\">\n"
    "      <lookat origin=\"0, 1, 5\" target=\"0, 1, 0\" up=\"0, 1, 0\"/>\n"
    "    </transform>\n"
    "    <film type=\"hdrfilm\"><integer name=\"width\" value=\"320\"/></film>\n"
    "    <sampler type=\"independent\">\n"
    "      <integer name=\"sample_count\" value=\"$spp\"/>\n"
    "    </sampler>\n"
    "  </sensor>\n"
    "  <bsdf type=\"diffuse\" id=\"red\"><rgb name=\"reflectance\" value=\"0.6, 0.1, 0.1\"/></bsdf>\n"
    "  <shape type=\"sphere\">\n"
    "    <point name=\"center\" x=\"0\" y=\"1\" z=\"0\"/>\n"
    "    <ref id=\"red\"/>\n"
    "  </shape>\n"
    "  <emitter type=\"constant\"/>\n"
    "</scene>";

static void put_scene(FILE *page, const cli_command *const *commands) {
    (void)commands;
    put_head(page, "aureole-scene", 5, "the scene format");
    put_section(page, "DESCRIPTION");
    put_line(page, "Scenes are XML in the format of Mitsuba 3. The children of <scene> are plugins: the "
                   "element is the kind, its type is one of the names below. The children of a plugin are "
                   "its parameters, each with a name and a value, and nested plugins.");
    put_entry(page, "<integer>, <float>, <boolean>, <string>", "A parameter's value, as value=\"...\".");
    put_entry(page, "<vector>, <point>", "Three numbers, as x, y and z or as value=\"1, 2, 3\".");
    put_entry(page, "<rgb>, <spectrum>", "A colour: one number, three numbers, or a <texture>.");
    put_entry(page, "<transform>",
              "Its children are applied in order: translate, rotate, scale, matrix, lookat.");
    put_entry(page, "<ref id=\"...\">", "The plugin that has this id.");
    put_entry(page, "<default name=\"...\" value=\"...\">",
              "The value of $name, unless -D name=value sets it.");
    put_entry(page, "<include filename=\"...\">", "The children of another scene's file.");
    put_entry(page, "<alias id=\"...\" as=\"...\">", "Another id of a plugin.");
    put_entry(page, "<path value=\"...\">", "A folder in which files are searched.");
    put_section(page, "EXAMPLE");
    fprintf(page, ".nf\n");
    put_line(page, scene_example);
    fprintf(page, ".fi\n");
    for (size_t i = 0; cli_render_table_at(i) != NULL; ++i)
        put_kind(page, cli_render_table_at(i));
    put_section(page, "SEE ALSO");
    put_line(page, "aureole(1), aureole-render(1), aureole-names(7)");
}

static void put_names(FILE *page, const cli_command *const *commands) {
    (void)commands;
    put_head(page, "aureole-names", 7, "point sets and measures, and their parameters");
    put_section(page, "DESCRIPTION");
    put_line(
        page,
        "A SET is written NAME[:key=value[,key=value...]], such as halton:permute=random, or file:PATH.");
    for (size_t i = 0; aur_table_at(i) != NULL; ++i)
        put_kind(page, aur_table_at(i));
    put_section(page, "SEE ALSO");
    put_line(page, "aureole(1), aureole-points(1), aureole-measure(1), aureole-scene(5)");
}

/* The pages that do not belong to a command. */
typedef struct manual_page {
    const char *name; /* name for `aureole manual NAME` */
    const char *file; /* path below the folder of all pages */
    void (*put)(FILE *page, const cli_command *const *commands);
} manual_page;

static const manual_page pages[] = {{"aureole", "man1/aureole.1", put_program},
                                    {"scene", "man5/aureole-scene.5", put_scene},
                                    {"names", "man7/aureole-names.7", put_names}};
enum { PAGE_COUNT = sizeof pages / sizeof pages[0] };

static const char *page_name(unsigned index) {
    return index < PAGE_COUNT ? pages[index].name : NULL;
}

static int print_page(const cli_command *const *commands, const char *name) {
    const char *names[CLI_NAME_LIMIT];
    size_t count = 0;
    for (; count < PAGE_COUNT; ++count) {
        names[count] = pages[count].name;
        if (strcmp(names[count], name) == 0)
            return pages[count].put(stdout, commands), CLI_SUCCESS;
    }
    for (size_t i = 0; commands[i] != NULL && count < CLI_NAME_LIMIT; ++i) {
        names[count++] = commands[i]->name;
        if (strcmp(commands[i]->name, name) == 0)
            return put_command(stdout, commands[i]), CLI_SUCCESS;
    }
    const char *const nearest = aur_nearest_name(name, count, names);
    if (nearest != NULL)
        return cli_bad_usage("manual: no page '%s'; did you mean '%s'?", name, nearest);
    return cli_bad_usage("manual: unknown page '%s': expected aureole, scene, names or a command", name);
}

/* Writes one page below the folder; false, with a message, on failure. */
static bool write_page(const cli_command *const *commands, const char *folder, const char *file,
                       const manual_page *page, const cli_command *command) {
    char path[PATH_MAX], *text = NULL;
    size_t size = 0;
    aur_error error = {0};
    FILE *const stream = open_memstream(&text, &size);
    if (stream != NULL && page != NULL)
        page->put(stream, commands);
    else if (stream != NULL)
        put_command(stream, command);
    aur_result result =
        stream != NULL && fclose(stream) == 0 ? AUR_OK : aur_fail(&error, AUR_ERROR_MEMORY, "out of memory");
    aur_format(path, sizeof path, "%s/%.4s", folder, file); /* "man1" */
    (void)mkdir(folder, 0777);                              /* a failure shows when the file is opened */
    (void)mkdir(path, 0777);
    aur_format(path, sizeof path, "%s/%s", folder, file);
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, &error);
    free(text);
    return cli_status(result, &error) == CLI_SUCCESS;
}

static int write_pages(const cli_command *const *commands, const char *folder) {
    bool good = true;
    for (size_t i = 0; i < PAGE_COUNT && good; ++i)
        good = write_page(commands, folder, pages[i].file, &pages[i], NULL);
    for (size_t i = 0; commands[i] != NULL && good; ++i) {
        char file[96];
        aur_format(file, sizeof file, "man1/aureole-%s.1", commands[i]->name);
        good = write_page(commands, folder, file, NULL, commands[i]);
    }
    return good ? CLI_SUCCESS : CLI_FAILURE;
}

static int run(const cli_call *call) {
    const manual_options *const given = call->options;
    if ((given->folder != NULL) == (call->operand_count > 0))
        return cli_bad_usage(
            "manual: expected a PAGE to print, or -o FOLDER for all pages: try 'aureole help "
            "manual'");
    return given->folder != NULL ? write_pages(call->commands, given->folder)
                                 : print_page(call->commands, call->operands[0]);
}

static const cli_option options[] = {{CLI_TEXT(manual_options, folder, "output", "FOLDER", NULL,
                                               "write all pages to man1, man5 and man7 of this folder"),
                                      .letter = 'o', .content = "folder"},
                                     {.key = {0}}};

const cli_command cli_command_manual = {
    .name = "manual",
    .summary = "print the manual pages of the program, its commands, the scene format, sets and measures",
    .notes = "To read a page: aureole manual render | man -l -. Installed pages are found by man: man "
             "aureole-render.",
    .operands = {{"PAGE", "a command, or one of aureole, scene, names", .optional = true, .name = page_name,
                  .content = "command"}},
    .groups = {{options, 0}},
    .size = sizeof(manual_options),
    .run = run,
};
