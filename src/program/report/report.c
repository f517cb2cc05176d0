#include "program/report/report.h"

#include <aureole/text.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct cell {
    char *text; /* formatted for text */
    enum { TEXT, INTEGER, NUMBER } kind;
    uint64_t integer;
    double number;
} cell;

/* The column names are the first row of cells. Tables of facts have the columns "property" and "value". */
struct report_table {
    size_t column_count;
    size_t count, capacity;
    cell *cells;
    bool facts;
    bool failed; /* out of memory */
};

report_table *report_create(size_t column_count, const char *const *columns) {
    report_table *const table = calloc(1, sizeof *table);
    for (size_t i = 0; i < column_count; ++i)
        report_column(table, columns[i]);
    return table;
}

void report_destroy(report_table *table) {
    for (size_t i = 0; table != NULL && i < table->count; ++i)
        free(table->cells[i].text);
    if (table != NULL)
        free(table->cells);
    free(table);
}

static void add(report_table *table, const char *text, cell added) {
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
    added.text = strdup(text != NULL ? text : "");
    table->failed = added.text == NULL;
    table->cells[table->count++] = added;
}

void report_text(report_table *table, const char *text) {
    add(table, text, (cell){.kind = TEXT});
}

void report_column(report_table *table, const char *name) {
    report_text(table, name);
    if (table != NULL)
        ++table->column_count;
}

void report_number(report_table *table, double value, int digits) {
    char text[64];
    aur_format(text, sizeof text, "%.*g", digits, value);
    add(table, text, (cell){.kind = NUMBER, .number = value});
}

void report_integer(report_table *table, uint64_t value) {
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    add(table, text, (cell){.kind = INTEGER, .integer = value});
}

static void add_fact(report_table *table, const char *name) {
    if (table != NULL && !table->facts) {
        table->facts = true;
        report_column(table, "property");
        report_column(table, "value");
    }
    report_text(table, name);
}

void report_fact_text(report_table *table, const char *name, const char *text) {
    add_fact(table, name);
    report_text(table, text);
}

void report_fact_number(report_table *table, const char *name, double value) {
    add_fact(table, name);
    report_number(table, value, 9);
}

/* The columns of a UTF-8 text on a terminal, for the characters in use. */
static size_t display_width(const char *text) {
    size_t width = 0;
    for (const char *c = text; *c != '\0'; ++c)
        width += ((unsigned char)*c & 0xc0) != 0x80;
    return width;
}

/* Columns of numbers are right-aligned. */
static aur_result write_text(const report_table *table, FILE *stream, aur_error *error) {
    const size_t columns = table->column_count;
    struct layout {
        size_t width;
        bool left;
    } *const layouts = calloc(columns, sizeof *layouts);
    if (layouts == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < table->count; ++i) {
        struct layout *const layout = &layouts[i % columns];
        const cell *const source = &table->cells[i];
        const bool number = source->kind == INTEGER || (source->kind == NUMBER && isfinite(source->number));
        const size_t width = display_width(source->text);
        layout->width = width > layout->width ? width : layout->width;
        layout->left = layout->left || (i >= columns && !number) || table->count == columns;
    }
    for (size_t i = 0; i < table->count; ++i) {
        const struct layout *const layout = &layouts[i % columns];
        const char *const text = table->cells[i].text;
        const int padding = (int)(layout->width - display_width(text));
        const bool last = (i + 1) % columns == 0;
        fprintf(stream, "%*s%s%*s%s", layout->left ? 0 : padding, "", text,
                layout->left && !last ? padding : 0, "", last ? "\n" : "  ");
    }
    free(layouts);
    return AUR_OK;
}

/* For programs, facts become one row with a column each. */
static size_t row_count(const report_table *table) {
    return table->facts ? 2 : table->count / table->column_count;
}

static size_t column_count(const report_table *table) {
    return table->facts ? table->count / 2 - 1 : table->column_count;
}

static const cell *cell_at(const report_table *table, size_t row, size_t column) {
    return &table->cells[table->facts ? 2 * (column + 1) + row : row * table->column_count + column];
}

static void write_csv_field(const char *text, FILE *stream) {
    const char *const quote = strpbrk(text, ",\"\n") != NULL ? "\"" : "";
    fputs(quote, stream);
    for (const char *c = text; *c != '\0'; ++c)
        fprintf(stream, *c == '"' ? "\"%c" : "%c", *c);
    fputs(quote, stream);
}

static void write_csv(const report_table *table, FILE *stream) {
    const size_t columns = column_count(table);
    for (size_t i = 0; i < row_count(table) * columns; ++i) {
        const cell *const source = cell_at(table, i / columns, i % columns);
        if (source->kind == NUMBER)
            aur_print(stream, "%.17g", source->number);
        else
            write_csv_field(source->text, stream);
        fputc((i + 1) % columns != 0 ? ',' : '\n', stream);
    }
}

static void write_json(const report_table *table, FILE *stream) {
    aur_json json = {.stream = stream};
    aur_json_open(&json, '[', true);
    for (size_t row = 1; row < row_count(table); ++row) {
        aur_json_open(&json, '{', false);
        for (size_t c = 0; c < column_count(table); ++c) {
            const cell *const source = cell_at(table, row, c);
            aur_json_name(&json, cell_at(table, 0, c)->text);
            if (source->kind == TEXT)
                aur_json_string(&json, source->text);
            else if (source->kind == INTEGER)
                aur_json_integer(&json, source->integer);
            else
                aur_json_number(&json, source->number);
        }
        aur_json_close(&json, '}');
    }
    aur_json_close(&json, ']');
}

/* Columns of only numbers and empty cells are right-aligned. */
static bool has_numbers(const report_table *table, size_t column) {
    bool some = false;
    for (size_t row = 0; row < report_rows(table); ++row) {
        const bool number = isfinite(report_value(table, row, column));
        if (!number && report_cell(table, row, column)[0] != '\0')
            return false;
        some |= number;
    }
    return some;
}

/* With `digits` significant digits; powers of ten as in TeX. */
static void put_number(FILE *to, double value, int digits) {
    char text[64];
    aur_format(text, sizeof text, "%.*g", digits, value);
    char *const power = strchr(text, 'e');
    if (power == NULL) {
        fprintf(to, text[0] == '-' ? "$%s$" : "%s", text);
        return;
    }
    *power = '\0';
    double exponent = 0.0;
    aur_parse_double(power[1] == '+' ? power + 2 : power + 1, &exponent);
    fprintf(to, "$%s\\cdot10^{%d}$", text, (int)exponent);
}

void report_write_latex(const report_table *table, int digits, FILE *to) {
    const size_t columns = report_columns(table);
    fputs("% \\usepackage{booktabs}\n\\begin{tabular}{", to);
    for (size_t c = 0; c < columns; ++c)
        fputc(has_numbers(table, c) ? 'r' : 'l', to);
    fputs("}\n\\toprule\n", to);
    for (size_t c = 0; c < columns; ++c) {
        fputs(c > 0 ? " & " : "", to);
        report_escape_latex(to, report_column_name(table, c));
    }
    fputs(" \\\\\n\\midrule\n", to);
    for (size_t row = 0; row < report_rows(table); ++row)
        for (size_t c = 0; c < columns; ++c) {
            fputs(c > 0 ? " & " : "", to);
            if (has_numbers(table, c) && report_cell(table, row, c)[0] != '\0')
                put_number(to, report_value(table, row, c), digits);
            else
                report_escape_latex(to, report_cell(table, row, c));
            fputs(c + 1 == columns ? " \\\\\n" : "", to);
        }
    fputs("\\bottomrule\n\\end{tabular}\n", to);
}

void report_write_data(const report_table *table, FILE *to) {
    for (size_t row = 0; row < report_rows(table) + 1; ++row)
        for (size_t c = 0; c < report_columns(table); ++c) {
            const char *const text = row == 0 ? report_column_name(table, c) : report_cell(table, row - 1, c);
            fputs(c > 0 ? "\t" : "", to);
            for (const char *letter = text; *letter != '\0'; ++letter)
                fputc((unsigned char)*letter < ' ' ? ' ' : *letter, to);
            fputs(c + 1 == report_columns(table) ? "\n" : "", to);
        }
}

aur_result report_write(const report_table *table, report_format format, FILE *stream, aur_error *error) {
    if (table == NULL || table->failed)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (format == REPORT_TABLE)
        return write_text(table, stream, error);
    if (format == REPORT_LATEX)
        report_write_latex(table, 4, stream);
    else if (format == REPORT_CSV)
        write_csv(table, stream);
    else
        write_json(table, stream);
    return AUR_OK;
}

aur_result report_save(const report_table *table, const char *notes, const char *path, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = report_write(table, REPORT_CSV, stream, error);
    while (notes != NULL && *notes != '\0') {
        const size_t length = strcspn(notes, "\n");
        fprintf(stream, "# %.*s\n", (int)length, notes);
        notes += length + (notes[length] == '\n');
    }
    if (fclose(stream) != 0)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, error);
    free(text);
    return result;
}

bool report_failed(const report_table *table) {
    return table == NULL || table->failed;
}

size_t report_rows(const report_table *table) {
    return table == NULL || table->column_count == 0 ? 0 : row_count(table) - 1;
}

size_t report_columns(const report_table *table) {
    return table == NULL ? 0 : column_count(table);
}

const char *report_column_name(const report_table *table, size_t column) {
    return cell_at(table, 0, column)->text;
}

size_t report_find(const report_table *table, const char *name) {
    for (size_t i = 0; name != NULL && i < report_columns(table); ++i)
        if (strcmp(report_column_name(table, i), name) == 0)
            return i;
    return SIZE_MAX;
}

const char *report_cell(const report_table *table, size_t row, size_t column) {
    return cell_at(table, row + 1, column)->text;
}

double report_value(const report_table *table, size_t row, size_t column) {
    if (column == SIZE_MAX)
        return NAN;
    const cell *const source = cell_at(table, row + 1, column);
    double value = NAN;
    if (source->kind == NUMBER)
        return source->number;
    aur_parse_double(source->text, &value);
    return value;
}

void report_summary(report_table *table, size_t count, size_t stride, const float *floats,
                    const double *doubles) {
    double minimum = INFINITY, maximum = -INFINITY, sum = 0.0;
    uint64_t finite = 0;
    for (size_t i = 0; i < count; ++i) {
        const double value = doubles != NULL ? doubles[i * stride] : (double)floats[i * stride];
        if (!isfinite(value))
            continue;
        minimum = fmin(minimum, value);
        maximum = fmax(maximum, value);
        sum += value;
        ++finite;
    }
    report_number(table, finite > 0 ? minimum : NAN, 6);
    report_number(table, finite > 0 ? sum / (double)finite : NAN, 6);
    report_number(table, finite > 0 ? maximum : NAN, 6);
    report_integer(table, count - finite);
}
