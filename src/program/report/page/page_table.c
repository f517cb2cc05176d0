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
        aur_print(page, "<td class=\"number\" title=\"%.17g\">%.5g</td>", value, value);
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

/* A string of JavaScript, which no text ends early. */
static void put_string(FILE *page, const char *text) {
    fputc('"', page);
    for (; *text != '\0'; ++text)
        if (*text == '"' || *text == '\\' || *text == '<' || (unsigned char)*text < ' ')
            fprintf(page, "\\u%04x", (unsigned)*text);
        else
            fputc(*text, page);
    fputc('"', page);
}

aur_result report_page_table(FILE *page, const report_table *table, const char *name, aur_error *error) {
    fputs("<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>", page);
    for (size_t i = 0; i < report_columns(table); ++i) {
        fputs("<th><button type=\"button\">", page);
        report_escape(page, report_column_name(table, i));
        fputs("</button></th>", page);
    }
    fputs("</tr></thead>\n<tbody>\n", page);
    for (size_t row = 0; row < report_rows(table); ++row) {
        fputs("<tr>", page);
        for (size_t i = 0; i < report_columns(table); ++i)
            put_cell(page, table, row, i);
        fputs("</tr>\n", page);
    }
    fputs("</tbody></table></div>\n", page);
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = report_write(table, REPORT_CSV, stream, error);
    if (fclose(stream) != 0)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK) {
        fputs("<p>Data: <script type=\"application/json\" class=\"csv\" data-name=\"", page);
        report_escape(page, name);
        fputs("\">", page);
        put_string(page, text);
        fputs("</script></p>\n", page);
    }
    free(text);
    return result;
}
