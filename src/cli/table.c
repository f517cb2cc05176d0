/* Tables of results as text, CSV or JSON. */
#include <aureole/text.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

typedef struct cell {
    char *text; /* as people read it */
    enum { TEXT, INTEGER, NUMBER } kind;
    uint64_t integer;
    double number;
} cell;

struct cli_table {
    size_t column_count;
    char **columns;
    size_t count, capacity;
    cell *cells;
    bool facts;
    bool failed; /* out of memory */
};

cli_table *cli_table_create(size_t column_count, const char *const *columns) {
    cli_table *const table = calloc(1, sizeof *table);
    for (size_t i = 0; i < column_count; ++i)
        cli_table_column(table, columns[i]);
    return table;
}

void cli_table_destroy(cli_table *table) {
    if (table == NULL)
        return;
    for (size_t i = 0; i < table->count; ++i)
        free(table->cells[i].text);
    for (size_t i = 0; i < table->column_count; ++i)
        free(table->columns[i]);
    free(table->columns);
    free(table->cells);
    free(table);
}

void cli_table_column(cli_table *table, const char *name) {
    if (table == NULL || table->failed)
        return;
    char **const larger = realloc(table->columns, (table->column_count + 1) * sizeof *larger);
    char *const copy = strdup(name);
    if (larger != NULL)
        table->columns = larger;
    table->failed = larger == NULL || copy == NULL;
    if (table->failed)
        free(copy);
    else
        table->columns[table->column_count++] = copy;
}

static void add(cli_table *table, const char *text, cell added) {
    if (table == NULL || table->failed)
        return;
    if (table->count == table->capacity) {
        const size_t capacity = table->capacity == 0 ? 64 : 2 * table->capacity;
        cell *const larger = realloc(table->cells, capacity * sizeof *larger);
        table->failed = larger == NULL;
        if (table->failed)
            return;
        table->cells = larger;
        table->capacity = capacity;
    }
    added.text = strdup(text);
    table->failed = added.text == NULL;
    table->cells[table->count++] = added;
}

void cli_table_text(cli_table *table, const char *text) {
    add(table, text, (cell){.kind = TEXT});
}

void cli_table_number(cli_table *table, double value, int digits) {
    char text[64];
    aur_format(text, sizeof text, "%.*g", digits, value);
    add(table, text, (cell){.kind = NUMBER, .number = value});
}

void cli_table_integer(cli_table *table, uint64_t value) {
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    add(table, text, (cell){.kind = INTEGER, .integer = value});
}

void cli_fact_text(cli_table *table, const char *name, const char *text) {
    cli_table_column(table, name);
    cli_table_text(table, text);
    if (table != NULL)
        table->facts = true;
}

void cli_fact_number(cli_table *table, const char *name, double value) {
    cli_table_column(table, name);
    cli_table_number(table, value, 9);
}

/* The columns a UTF-8 text takes on a terminal, for the letters that we use. */
static size_t display_width(const char *text) {
    size_t width = 0;
    for (const char *c = text; *c != '\0'; ++c)
        width += ((unsigned char)*c & 0xc0) != 0x80;
    return width;
}

static void print_padded(const char *text, size_t width, bool right, bool last) {
    const size_t used = display_width(text);
    const int padding = width > used ? (int)(width - used) : 0;
    if (right)
        printf("%*s%s", padding, "", text);
    else if (last)
        printf("%s", text);
    else
        printf("%s%*s", text, padding, "");
    fputs(last ? "\n" : "  ", stdout);
}

static void print_text(const cli_table *table) {
    const size_t rows = table->count / table->column_count;
    for (size_t row = 0; row <= rows; ++row) {
        for (size_t c = 0; c < table->column_count; ++c) {
            size_t width = display_width(table->columns[c]);
            bool right = rows > 0;
            for (size_t r = 0; r < rows; ++r) {
                const cell *const other = &table->cells[r * table->column_count + c];
                const size_t used = display_width(other->text);
                width = used > width ? used : width;
                right =
                    right && (other->kind == INTEGER || (other->kind == NUMBER && isfinite(other->number)));
            }
            const char *const text =
                row == 0 ? table->columns[c] : table->cells[(row - 1) * table->column_count + c].text;
            print_padded(text, width, right, c + 1 == table->column_count);
        }
    }
}

static void print_csv_field(const char *text) {
    if (strpbrk(text, ",\"\n") == NULL) {
        fputs(text, stdout);
        return;
    }
    putchar('"');
    for (const char *c = text; *c != '\0'; ++c) {
        if (*c == '"')
            putchar('"');
        putchar(*c);
    }
    putchar('"');
}

static void print_csv(const cli_table *table) {
    for (size_t c = 0; c < table->column_count; ++c) {
        print_csv_field(table->columns[c]);
        putchar(c + 1 < table->column_count ? ',' : '\n');
    }
    for (size_t i = 0; i < table->count; ++i) {
        if (table->cells[i].kind == NUMBER)
            aur_print(stdout, "%.17g", table->cells[i].number);
        else
            print_csv_field(table->cells[i].text);
        putchar((i + 1) % table->column_count != 0 ? ',' : '\n');
    }
}

static void print_json(const cli_table *table) {
    aur_json json = {.stream = stdout};
    aur_json_open(&json, '[', true);
    for (size_t i = 0; i < table->count; ++i) {
        const cell *const source = &table->cells[i];
        const size_t column = i % table->column_count;
        if (column == 0)
            aur_json_open(&json, '{', false);
        aur_json_name(&json, table->columns[column]);
        if (source->kind == TEXT)
            aur_json_string(&json, source->text);
        else if (source->kind == INTEGER)
            aur_json_integer(&json, source->integer);
        else
            aur_json_number(&json, source->number);
        if (column + 1 == table->column_count)
            aur_json_close(&json, '}');
    }
    aur_json_close(&json, ']');
}

/* For people, a line a fact. */
static void print_facts(const cli_table *table) {
    cli_table *const lines = cli_table_create(2, (const char *const[]){"property", "value"});
    for (size_t i = 0; i < table->count; ++i) {
        cli_table_text(lines, table->columns[i]);
        add(lines, table->cells[i].text, table->cells[i]);
    }
    cli_table_finish(lines, CLI_TABLE);
}

int cli_table_finish(cli_table *table, cli_format format) {
    const bool good = table != NULL && !table->failed;
    if (!good)
        fprintf(stderr, "aureole: out of memory\n");
    else if (format == CLI_TABLE && table->facts)
        print_facts(table);
    else if (format == CLI_TABLE)
        print_text(table);
    else if (format == CLI_CSV)
        print_csv(table);
    else
        print_json(table);
    cli_table_destroy(table);
    return good ? CLI_SUCCESS : CLI_FAILURE;
}
