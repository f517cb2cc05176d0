/* Tables of results as text, CSV or JSON. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

typedef struct cell {
    char *text;  /* as people read it */
    char *exact; /* as programs read it; NULL: the same */
    bool number;
} cell;

struct cli_table {
    size_t column_count;
    char **columns;
    size_t count, capacity;
    cell *cells;
    bool failed;
};

cli_table *cli_table_create(size_t column_count, const char *const *columns) {
    cli_table *const table = calloc(1, sizeof *table);
    if (table == NULL)
        return NULL;
    table->column_count = column_count;
    table->columns = calloc(column_count, sizeof *table->columns);
    table->failed = table->columns == NULL;
    for (size_t i = 0; i < column_count && !table->failed; ++i) {
        table->columns[i] = strdup(columns[i]);
        table->failed = table->columns[i] == NULL;
    }
    return table;
}

void cli_table_destroy(cli_table *table) {
    if (table == NULL)
        return;
    for (size_t i = 0; i < table->count; ++i) {
        free(table->cells[i].text);
        free(table->cells[i].exact);
    }
    for (size_t i = 0; i < table->column_count && table->columns != NULL; ++i)
        free(table->columns[i]);
    free(table->columns);
    free(table->cells);
    free(table);
}

static void add(cli_table *table, const char *text, const char *exact, bool number) {
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
    cell *const added = &table->cells[table->count++];
    *added = (cell){.text = strdup(text), .exact = exact != NULL ? strdup(exact) : NULL, .number = number};
    table->failed = added->text == NULL || (exact != NULL && added->exact == NULL);
}

void cli_table_text(cli_table *table, const char *text) {
    add(table, text, NULL, false);
}

void cli_table_number(cli_table *table, double value, int digits) {
    char text[64], exact[64];
    snprintf(text, sizeof text, "%.*g", digits, value);
    snprintf(exact, sizeof exact, "%.17g", value);
    add(table, text, exact, isfinite(value));
}

void cli_table_integer(cli_table *table, uint64_t value) {
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    add(table, text, NULL, true);
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
                right = right && other->number;
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

static const char *exact_text(const cell *source) {
    return source->exact != NULL ? source->exact : source->text;
}

static void print_csv(const cli_table *table) {
    for (size_t c = 0; c < table->column_count; ++c) {
        print_csv_field(table->columns[c]);
        putchar(c + 1 < table->column_count ? ',' : '\n');
    }
    for (size_t i = 0; i < table->count; ++i) {
        print_csv_field(exact_text(&table->cells[i]));
        putchar((i + 1) % table->column_count != 0 ? ',' : '\n');
    }
}

static void print_json_string(const char *text) {
    putchar('"');
    for (const char *c = text; *c != '\0'; ++c) {
        const unsigned char letter = (unsigned char)*c;
        if (letter == '"' || letter == '\\')
            printf("\\%c", letter);
        else if (letter < 0x20)
            printf("\\u%04x", letter);
        else
            putchar(letter);
    }
    putchar('"');
}

static void print_json(const cli_table *table) {
    fputs("[", stdout);
    for (size_t i = 0; i < table->count; ++i) {
        const size_t column = i % table->column_count;
        if (column == 0)
            fputs(i == 0 ? "\n  {" : ",\n  {", stdout);
        else
            fputs(", ", stdout);
        print_json_string(table->columns[column]);
        fputs(": ", stdout);
        if (table->cells[i].number)
            fputs(exact_text(&table->cells[i]), stdout);
        else if (table->cells[i].exact != NULL)
            fputs("null", stdout); /* JSON has no infinity and no NaN */
        else
            print_json_string(table->cells[i].text);
        if (column + 1 == table->column_count)
            putchar('}');
    }
    fputs(table->count > 0 ? "\n]\n" : "]\n", stdout);
}

int cli_table_print(const cli_table *table, cli_format format) {
    if (table == NULL || table->failed) {
        fprintf(stderr, "aureole: out of memory\n");
        return CLI_FAILURE;
    }
    if (format == CLI_TABLE)
        print_text(table);
    else if (format == CLI_CSV)
        print_csv(table);
    else
        print_json(table);
    return CLI_SUCCESS;
}
