#include "program/lab/publication.h"

#include <string.h>
#include <unistd.h>

#include "program/report/page/page.h"

void publication_path(const publication *p, const lab_experiment *of, const char *what, char *path,
                      size_t capacity) {
    snprintf(path, capacity, "%s/%s/%s%s%s.csv", p->results, of->name, of->name, what != NULL ? "-" : "",
             what != NULL ? what : "");
}

bool publication_has(const publication *p, const lab_experiment *of) {
    char path[AUR_ERROR_FILE_CAPACITY];
    publication_path(p, of, NULL, path, sizeof path);
    return access(path, R_OK) == 0;
}

void publication_text(FILE *page, const char *begin, const char *text, const char *end) {
    fputs(begin, page);
    report_escape(page, text);
    fputs(end, page);
}

/* Writes the plot in the formats for print, web pages and papers, with a link to each. */
static aur_result print_plot(const publication *p, const char *experiment, const report_table *table,
                             const report_plot *plot, aur_error *error) {
    static const char *const extensions[] = {"pdf", "svg", "tex"};
    aur_result result = AUR_OK;
    bool drawn = false;
    for (size_t i = 0; i < 3 && !p->small && result == AUR_OK; ++i) {
        char name[128], path[AUR_ERROR_FILE_CAPACITY];
        snprintf(name, sizeof name, "%s-%s.%s", experiment, plot->name, extensions[i]);
        snprintf(path, sizeof path, "%s/%s", p->folder, name);
        result = report_plot_save(path, table, plot, NULL, &drawn, error);
        if (drawn)
            fprintf(p->page, "%s<a href=\"%s\">%s</a>", i == 0 ? "<p>For print: " : ", ", name, name);
    }
    fputs(drawn ? "</p>\n" : "", p->page);
    return result;
}

aur_result publication_plot(const publication *p, const lab_experiment *of, const report_plot *plot,
                            bool print, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    report_table *table = NULL;
    publication_path(p, of, plot->table, path, sizeof path);
    if (plot->table != NULL && access(path, R_OK) != 0) /* the run has not finished */
        return AUR_OK;
    aur_result result = report_load(path, &table, NULL, error);
    if (result == AUR_OK)
        result = report_plot_put(p->page, table, plot, error);
    if (result == AUR_OK && print)
        result = print_plot(p, of->name, table, plot, error);
    report_destroy(table);
    return result;
}
