#include "program/report/plot_layout.h"

#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The words of a row in the columns of a list, blanks between. */
static void label(const report_table *table, size_t row, const char *columns, char text[REPORT_LABEL]) {
    text[0] = '\0';
    while (columns != NULL && *columns != '\0') {
        char name[64];
        const size_t length = strcspn(columns, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, columns);
        columns += length + (columns[length] == ',');
        const size_t column = report_find(table, name), used = strlen(text);
        if (column == SIZE_MAX)
            continue;
        const double value = report_value(table, row, column);
        if (isnan(value))
            snprintf(text + used, REPORT_LABEL - used, "%s%s", used > 0 ? " " : "",
                     report_cell(table, row, column));
        else
            aur_format(text + used, REPORT_LABEL - used, "%s%s %g", used > 0 ? " " : "", name, value);
    }
}

/* The index of a word among those that there are, which it joins; REPORT_GROUPS when there are too many. */
static size_t join(char words[REPORT_GROUPS][REPORT_LABEL], size_t *count, const char *word) {
    for (size_t i = 0; i < *count; ++i)
        if (strcmp(words[i], word) == 0)
            return i;
    if (*count == REPORT_GROUPS)
        return REPORT_GROUPS;
    memcpy(words[*count], word, REPORT_LABEL);
    return (*count)++;
}

static bool is_drawn(const report_layout *l, size_t row) {
    const double x = report_value(l->table, row, l->x), y = report_value(l->table, row, l->y);
    return isfinite(x) && isfinite(y) && !(l->plot->log_x && x <= 0.0) && !(l->plot->log_y && y <= 0.0);
}

bool report_layout_has(const report_layout *l, size_t row, size_t panel, size_t series) {
    char text[REPORT_LABEL];
    if (!is_drawn(l, row))
        return false;
    label(l->table, row, l->plot->panel, text);
    if (strcmp(text, l->panels[panel]) != 0)
        return false;
    label(l->table, row, l->plot->series, text);
    return series == REPORT_GROUPS || strcmp(text, l->series[series]) == 0;
}

bool report_layout_begin(report_layout *layout, const report_table *table, const report_plot *plot) {
    *layout = (report_layout){.table = table,
                              .plot = plot,
                              .x = report_find(table, plot->x),
                              .y = report_find(table, plot->y),
                              .low = report_find(table, plot->low),
                              .high = report_find(table, plot->high)};
    if (layout->x == SIZE_MAX || layout->y == SIZE_MAX)
        return false;
    for (size_t row = 0; row < report_rows(table); ++row) {
        char text[REPORT_LABEL];
        if (!is_drawn(layout, row))
            continue;
        label(table, row, plot->panel, text);
        join(layout->panels, &layout->panel_count, text);
        label(table, row, plot->series, text);
        join(layout->series, &layout->series_count, text);
    }
    return layout->panel_count > 0;
}

static int by_x(const void *a, const void *b) {
    const report_plotted *const p = a, *const q = b;
    return (p->x > q->x) - (p->x < q->x);
}

size_t report_layout_points(const report_layout *layout, size_t panel, size_t series,
                            report_plotted *points) {
    size_t count = 0;
    for (size_t row = 0; row < report_rows(layout->table); ++row)
        if (report_layout_has(layout, row, panel, series))
            points[count++] = (report_plotted){report_value(layout->table, row, layout->x),
                                               report_value(layout->table, row, layout->y),
                                               report_value(layout->table, row, layout->low),
                                               report_value(layout->table, row, layout->high)};
    if (count > 0 && !layout->plot->points)
        qsort(points, count, sizeof *points, by_x);
    return count;
}
