/* Result tables, as aligned text, CSV or JSON. */
#pragma once

#include <aureole-lab/plot.h>
#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

typedef enum report_format { REPORT_TABLE, REPORT_CSV, REPORT_JSON, REPORT_LATEX } report_format;

/* Returns NULL when out of memory; the functions below accept NULL and do nothing, and writing fails. */
report_table *report_create(size_t column_count, const char *const *columns);
void report_destroy(report_table *table);
/* Adds a column, before the first cell. */
void report_column(report_table *table, const char *name);

/* Adds cells row by row. Numbers are printed with `digits` significant digits in text, 17 in CSV and JSON; a
 * NULL text is empty. */
void report_text(report_table *table, const char *text);
void report_number(report_table *table, double value, int digits);
void report_integer(report_table *table, uint64_t value);
/* Adds a column and its only cell: a property of a single object. As text such a table has a line per cell.
 */
void report_fact_text(report_table *table, const char *name, const char *text);
void report_fact_number(report_table *table, const char *name, double value);

/* Writes a table, in JSON as an array of objects. The caller checks the stream for errors. Errors: MEMORY. */
aur_result report_write(const report_table *table, report_format format, FILE *stream, aur_error *error);
/* Parts of tables for papers: a LaTeX tabular with booktabs rules and `digits` significant digits; tab-
 * separated cells without quotes; text with TeX's special characters escaped. */
void report_write_latex(const report_table *table, int digits, FILE *to);
void report_write_data(const report_table *table, FILE *to);
void report_escape_latex(FILE *to, const char *text);
/* Replaces the file `path` by the table as CSV, followed by the lines of `notes` (NULL: none) as comments.
 * Errors: MEMORY, WRITE. */
aur_result report_save(const report_table *table, const char *notes, const char *path, aur_error *error);
/* Reads a table that report_save wrote, with texts as cells. The comments become *notes (NULL allowed), one
 * per line, which the caller frees. Errors: OPEN, FORMAT, MEMORY. */
aur_result report_load(const char *path, report_table **table, char **notes, aur_error *error);
/* Adds cells for minimum, mean, maximum and the number of non-finite values of `count` values with a stride
 * of `stride`; one of the two arrays is NULL. */
void report_summary(report_table *table, size_t count, size_t stride, const float *floats,
                    const double *doubles);

/* Whether the table or a cell is missing because memory ran out. */
bool report_failed(const report_table *table);
/* The complete rows of a table, without the column names. */
size_t report_rows(const report_table *table);
size_t report_columns(const report_table *table);
const char *report_column_name(const report_table *table, size_t column);
/* SIZE_MAX if no column has this name, or `name` is NULL. */
size_t report_find(const report_table *table, const char *name);
const char *report_cell(const report_table *table, size_t row, size_t column);
/* A cell as a number; NaN if it is none, or `column` is SIZE_MAX. */
double report_value(const report_table *table, size_t row, size_t column);

/* Format of a plot for a paper. */
typedef struct report_style {
    double width, height; /* of the drawing without its legend, in cm; the font size does not scale */
    double text_size;     /* in points */
    const char *font;     /* of PDF: "Helvetica" or "Times-Roman" */
    const char *data;     /* of TeX: the file for the data; NULL: the data are in the text */
} report_style;

/* Writes the plot to `path`, in the format of report/figure.h given by its extension. Without a file, and
 * *drawn false, if a column is missing or no row has numbers. Errors: NAME, MEMORY, WRITE. */
aur_result report_plot_save(const char *path, const report_table *table, const report_plot *plot,
                            const report_style *style, bool *drawn, aur_error *error);
/* The same in a page, a drawing per panel; nothing if no row has numbers. Errors: MEMORY. */
aur_result report_plot_put(FILE *page, const report_table *table, const report_plot *plot, aur_error *error);
