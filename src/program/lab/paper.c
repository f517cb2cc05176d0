/* Writes results for papers: LaTeX tables, PDF and TikZ plots, tab-separated data. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/lab/publication.h"

typedef struct paper {
    publication from;
    const lab_paper_style *style;
    FILE *written; /* paths, one per line */
} paper;

/* FOLDER/NAME[-WHAT].EXTENSION */
static void path_of(const paper *p, const lab_experiment *of, const char *what, const char *extension,
                    char path[AUR_ERROR_FILE_CAPACITY]) {
    snprintf(path, AUR_ERROR_FILE_CAPACITY, "%s/%s%s%s.%s", p->from.folder, of->name, what != NULL ? "-" : "",
             what != NULL ? what : "", extension);
}

static aur_result save(const paper *p, const report_table *table, const lab_experiment *of, const char *what,
                       bool latex, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY], *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    path_of(p, of, what, latex ? "tex" : "dat", path);
    if (to != NULL && latex)
        report_write_latex(table, (int)p->style->digits, to);
    else if (to != NULL)
        report_write_data(table, to);
    const bool good = to != NULL && fclose(to) == 0;
    const aur_result result =
        good ? aur_file_write(path, size, text, error) : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    free(text);
    if (result == AUR_OK)
        fprintf(p->written, "%s\n", path);
    return result;
}

/* Writes the table of an experiment, or a further one, as LaTeX and as data. */
static aur_result save_table(const paper *p, const lab_experiment *of, const char *what, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    report_table *table = NULL;
    publication_path(&p->from, of, what, path, sizeof path);
    aur_result result = report_load(path, &table, NULL, error);
    for (int latex = 1; latex >= 0 && result == AUR_OK; --latex)
        result = save(p, table, of, what, latex == 1, error);
    report_destroy(table);
    return result;
}

static aur_result save_plot(const paper *p, const lab_experiment *of, const report_plot *plot,
                            aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY], name[128], data[AUR_ERROR_FILE_CAPACITY];
    report_table *table = NULL;
    bool drawn = true;
    snprintf(name, sizeof name, "plot-%s", plot->name); /* the prefix avoids the names of tables */
    publication_path(&p->from, of, plot->table, path, sizeof path);
    path_of(p, of, name, "dat", data);
    aur_result result = report_load(path, &table, NULL, error);
    static const char *const extensions[] = {"pdf", "tex"};
    for (size_t i = 0; i < 2 && result == AUR_OK && drawn; ++i) {
        const report_style style = {.width = p->style->width,
                                    .height = p->style->height,
                                    .text_size = p->style->text_size,
                                    .font = p->style->times ? "Times-Roman" : "Helvetica",
                                    .data = i == 1 ? data : NULL};
        path_of(p, of, name, extensions[i], path);
        result = report_plot_save(path, table, plot, &style, &drawn, error);
        if (result == AUR_OK && drawn)
            fprintf(p->written, "%s\n%s%s", path, i == 1 ? data : "", i == 1 ? "\n" : "");
    }
    report_destroy(table);
    return result;
}

static aur_result save_experiment(const paper *p, const lab_experiment *of, aur_error *error) {
    aur_result result = save_table(p, of, NULL, error);
    for (const report_plot *plot = of->plots; plot != NULL && plot->name != NULL && result == AUR_OK;
         ++plot) {
        bool first = plot->table != NULL;
        for (const report_plot *before = of->plots; before < plot && first; ++before)
            first = before->table == NULL || strcmp(before->table, plot->table) != 0;
        if (first)
            result = save_table(p, of, plot->table, error);
        if (result == AUR_OK)
            result = save_plot(p, of, plot, error);
    }
    return result;
}

aur_result lab_write_paper(const char *results, const char *folder, const lab_paper_style *style,
                           FILE *written, aur_error *error) {
    const paper p = {.from = {.results = results, .folder = folder}, .style = style, .written = written};
    size_t found = 0;
    aur_result result = AUR_OK;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return aur_fail(error, AUR_ERROR_WRITE, "%s: cannot make the folder: %s", folder, strerror(errno));
    for (size_t i = 0; i < lab_experiment_count() && result == AUR_OK; ++i) {
        if (!publication_has(&p.from, lab_experiment_at(i)))
            continue;
        ++found;
        result = save_experiment(&p, lab_experiment_at(i), error);
    }
    if (found == 0)
        return aur_fail(error, AUR_ERROR_OPEN,
                        "%s: no results of the lab: 'aureole lab run NAME -o %s' makes them", results,
                        results);
    return result;
}
