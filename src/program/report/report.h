/* Tables of results, as aligned text, CSV or JSON. */
#pragma once

#include <aureole-lab/plot.h>
#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

typedef enum report_format { REPORT_TABLE, REPORT_CSV, REPORT_JSON, REPORT_LATEX } report_format;

/* Returns NULL when out of memory; the functions below accept NULL and then do nothing, and writing fails. */
report_table *report_create(size_t column_count, const char *const *columns);
void report_destroy(report_table *table);
/* One more column, before the first cell. */
void report_column(report_table *table, const char *name);

/* Cells fill the table row by row. Numbers are printed with `digits` significant digits in text, 17 in CSV
 * and JSON; a text that is NULL is empty. */
void report_text(report_table *table, const char *text);
void report_number(report_table *table, double value, int digits);
void report_integer(report_table *table, uint64_t value);
/* A column and its cell: what is known of one thing. Such a table is printed for people as a line a cell. */
void report_fact_text(report_table *table, const char *name, const char *text);
void report_fact_number(report_table *table, const char *name, double value);

/* Writes a table, in JSON as an array of objects; the stream keeps its own errors. Errors: MEMORY. */
aur_result report_write(const report_table *table, report_format format, FILE *stream, aur_error *error);
/* The parts of tables for papers: a tabular of LaTeX with booktabs' rules, numbers with so many significant
 * digits; cells between tabs, without quotes; text that is no command of TeX's. */
void report_write_latex(const report_table *table, int digits, FILE *to);
void report_write_data(const report_table *table, FILE *to);
void report_escape_latex(FILE *to, const char *text);
/* Replaces the file `path` by the table as CSV, and the lines of `notes` (NULL: none) after it as comments.
 * Errors: MEMORY, WRITE. */
aur_result report_save(const report_table *table, const char *notes, const char *path, aur_error *error);
/* Reads a table that report_save wrote; its cells are texts. The comments after it are the notes, lines in
 * *notes (NULL allowed), to be freed. Errors: OPEN, FORMAT, MEMORY. */
aur_result report_load(const char *path, report_table **table, char **notes, aur_error *error);
/* Cells for minimum, mean and maximum, and how many are not finite, of `count` values, which stand
 * `stride` apart: of one array, the other is NULL. */
void report_summary(report_table *table, size_t count, size_t stride, const float *floats,
                    const double *doubles);

/* Whether a cell was lost for want of memory, or the table itself. */
bool report_failed(const report_table *table);
/* What is in a table: its whole rows, without the names of the columns. */
size_t report_rows(const report_table *table);
size_t report_columns(const report_table *table);
const char *report_column_name(const report_table *table, size_t column);
/* SIZE_MAX when there is none of this name, or `name` is NULL. */
size_t report_find(const report_table *table, const char *name);
const char *report_cell(const report_table *table, size_t row, size_t column);
/* A cell as a number; NaN when it is none, or `column` is SIZE_MAX. */
double report_value(const report_table *table, size_t row, size_t column);

/* How a plot is made for a paper. */
typedef struct report_style {
    double width, height; /* of the drawing without its legend, in cm; the font keeps its size */
    double text_size;     /* in points */
    const char *font;     /* of PDF: "Helvetica" or "Times-Roman" */
    const char *data;     /* of TeX: the file of the numbers; NULL: they stand in the text */
} report_style;

/* Writes the plot to `path`, in a format of report/figure.h that its name ends in; no file, and *drawn false,
 * when a column is missing or no row has numbers. Errors: NAME, MEMORY, WRITE. */
aur_result report_plot_save(const char *path, const report_table *table, const report_plot *plot,
                            const report_style *style, bool *drawn, aur_error *error);
/* The same as a part of a page, a drawing for each panel: nothing without numbers. Errors: MEMORY. */
aur_result report_plot_put(FILE *page, const report_table *table, const report_plot *plot, aur_error *error);
