/* Tables of a page. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/page/page.h"

static void put_cell(FILE *page, const report_table *table, size_t row, size_t column) {
    static const char *const verdicts[] = {"agrees", "within", "differs"};
    const char *const text = report_cell(table, row, column);
    const double value = report_value(table, row, column);
    if (!isnan(value)) {
        char exact[40], shown[40];
        aur_format(exact, sizeof exact, "%.17g", value);
        aur_format(shown, sizeof shown, "%.5g", value);
        if (strcmp(exact, shown) == 0)
            fprintf(page, "<td class=\"number\">%s</td>", shown);
        else
            fprintf(page, "<td class=\"number\" title=\"%s\">%s</td>", exact, shown);
        return;
    }
    const char *kind = "";
    for (size_t i = 0; i < 3; ++i)
        if (strncmp(text, verdicts[i], strlen(verdicts[i])) == 0)
            kind = verdicts[i];
    fprintf(page, "<td class=\"%s\">", kind);
    report_escape(page, text);
    fputs("</td>", page);
}

aur_result report_page_table(FILE *page, const report_table *table, const char *name, size_t most,
                             aur_error *error) {
    const size_t rows = report_rows(table), shown = rows < most ? rows : most;
    if (report_failed(table))
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    fputs("<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>", page);
    for (size_t i = 0; i < report_columns(table); ++i) {
        fputs("<th><button type=\"button\">", page);
        report_escape(page, report_column_name(table, i));
        fputs("</button></th>", page);
    }
    fputs("</tr></thead>\n<tbody>\n", page);
    for (size_t row = 0; row < shown; ++row) {
        fputs("<tr>", page);
        for (size_t i = 0; i < report_columns(table); ++i)
            put_cell(page, table, row, i);
        fputs("</tr>\n", page);
    }
    fputs("</tbody></table></div>\n", page);
    if (shown < rows) {
        fprintf(page, "<p>%zu more rows are in ", rows - shown);
        report_escape(page, name);
        fputs(".</p>\n", page);
        return AUR_OK;
    }
    fputs("<p>Data: <a class=\"csv\" data-name=\"", page);
    report_escape(page, name);
    fputs("\"></a></p>\n", page);
    return AUR_OK;
}
