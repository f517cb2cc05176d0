/* The first part of the report. */
#include <stdlib.h>
#include <string.h>

#include "program/lab/publication.h"

/* A paper: the prefix of its experiments' names, a summary, its best plot, and the experiments that test
 * causes of differences, whose verdicts do not count. */
typedef struct paper {
    const char *prefix, *title, *finding, *experiment, *plot, *causes[3];
} paper;

/* clang-format off */
static const paper papers[] = {
    {"keller-1994-", "Keller 1994: quasi-Monte Carlo radiosity",
     "Low-discrepancy points are a little better than pseudo-random ones in rooms, and twice as good in an empty cube.",
     "keller-1994-table3", "deviation", {"keller-1994-boxes", "keller-1994-floor"}},
    {"schretter-2012-", "Schretter et al. 2012: golden ratio sequences",
     "Golden-ratio sets have the lowest star discrepancy of the sets compared, and less noise than blue noise in ambient occlusion.",
     "schretter-2012-sets", "star", {NULL}},
    {"marques-2013-", "Marques et al. 2013: spherical Fibonacci point sets",
     "Spherical Fibonacci points have the lowest energy, and in final gathering no other set is better beyond chance.",
     "marques-2013-fig3", "energy", {NULL}},
    {"marques-2018-", "Marques et al. 2018: optimal sample weights",
     "Optimal weights lower the error of random samples by a factor, and that of Sobol and Fibonacci points by some percent.",
     "marques-2018-fig7", "rmse", {"marques-2018-box"}},
    {"marques-2019-", "Marques et al. 2019: extensible spherical Fibonacci grids",
     "Extended grids are as even as new ones at four times the size, and less even at twice the size.",
     "marques-2019-discrepancy", "scd", {NULL}},
};
/* clang-format on */

enum { PAPERS = sizeof papers / sizeof papers[0] };

static bool is_of(const lab_experiment *experiment, const paper *of) {
    return strncmp(experiment->name, of->prefix, strlen(of->prefix)) == 0;
}

aur_result publication_count(const publication *p, const lab_experiment *of, publication_tally *tally,
                             aur_error *error) {
    static const char *const names[LAB_VERDICTS] = {"agrees", "within", "differs", "not published"};
    char path[AUR_ERROR_FILE_CAPACITY];
    report_table *table = NULL;
    char *notes = NULL;
    publication_path(p, of, NULL, path, sizeof path);
    const aur_result result = report_load(path, &table, &notes, error);
    const size_t verdict = result == AUR_OK ? report_find(table, "verdict") : SIZE_MAX;
    tally->rows += result == AUR_OK ? report_rows(table) : 0;
    for (size_t row = 0; verdict != SIZE_MAX && row < report_rows(table); ++row)
        for (size_t i = 0; i < LAB_VERDICTS; ++i)
            tally->verdicts[i] += strncmp(report_cell(table, row, verdict), names[i], strlen(names[i])) == 0;
    for (const char *line = notes; line != NULL && *line != '\0'; line += *line == '\n') {
        const size_t length = strcspn(line, "\n");
        const bool claim = strncmp(line, "claim: ", 7) == 0;
        tally->claims += claim;
        tally->hold += claim && length > 7 && strncmp(line + length - 7, ": holds", 7) == 0;
        line += length;
    }
    report_destroy(table);
    free(notes);
    return result;
}

static aur_result put_figure(const publication *p, const paper *of, aur_error *error) {
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        const lab_experiment *const experiment = lab_experiment_at(i);
        if (strcmp(experiment->name, of->experiment) != 0 || !publication_has(p, experiment))
            continue;
        for (const report_plot *plot = experiment->plots; plot != NULL && plot->name != NULL; ++plot)
            if (strcmp(plot->name, of->plot) == 0)
                return publication_plot(p, experiment, plot, false, error);
    }
    return AUR_OK;
}

static void put_links(const publication *p, const paper *of) {
    fputs("<p>Tables:", p->page);
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        const lab_experiment *const experiment = lab_experiment_at(i);
        if (is_of(experiment, of) && publication_has(p, experiment))
            fprintf(p->page, " <a href=\"#%s\">%s</a>", experiment->name,
                    experiment->name + strlen(of->prefix));
    }
    fputs("</p>\n", p->page);
}

static bool tries_causes(const lab_experiment *experiment, const paper *of) {
    for (const char *const *name = of->causes; *name != NULL; ++name)
        if (strcmp(experiment->name, *name) == 0)
            return true;
    return false;
}

static void put_verdicts(const publication *p, const publication_tally *sum) {
    const size_t *const v = sum->verdicts, published = v[LAB_AGREES] + v[LAB_WITHIN] + v[LAB_DIFFERS];
    fputs("<p class=\"verdicts\">", p->page);
    if (published > 0)
        fprintf(p->page, "Of %zu published values %zu agree, %zu more are within the factor, %zu differ. ",
                published, v[LAB_AGREES], v[LAB_WITHIN], v[LAB_DIFFERS]);
    if (sum->claims > 0)
        fprintf(p->page, "%zu of %zu claims hold.", sum->hold, sum->claims);
    fputs("</p>\n", p->page);
}

static aur_result put_paper(const publication *p, const paper *of, aur_error *error) {
    publication_tally sum = {0};
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        const lab_experiment *const experiment = lab_experiment_at(i);
        if (!is_of(experiment, of) || !publication_has(p, experiment) || tries_causes(experiment, of))
            continue;
        const aur_result result = publication_count(p, experiment, &sum, error);
        if (result != AUR_OK)
            return result;
    }
    if (sum.rows == 0)
        return AUR_OK;
    publication_text(p->page, "<h2>", of->title, "</h2>\n");
    publication_text(p->page, "<p>", of->finding, "</p>\n");
    put_verdicts(p, &sum);
    const aur_result result = put_figure(p, of, error);
    put_links(p, of);
    return result;
}

aur_result publication_put_overview(const publication *p, aur_error *error) {
    for (size_t i = 0; i < PAPERS; ++i) {
        const aur_result result = put_paper(p, &papers[i], error);
        if (result != AUR_OK)
            return result;
    }
    bool begun = false;
    for (size_t i = 0; i < lab_experiment_count(); ++i) {
        const lab_experiment *const experiment = lab_experiment_at(i);
        bool of_paper = false;
        for (size_t k = 0; k < PAPERS; ++k)
            of_paper = of_paper || is_of(experiment, &papers[k]);
        if (of_paper || !publication_has(p, experiment))
            continue;
        fputs(begun ? "" : "<h2>New: in none of the papers</h2>\n<ul>\n", p->page);
        begun = true;
        fprintf(p->page, "<li><a href=\"#%s\">%s</a>: ", experiment->name, experiment->name);
        publication_text(p->page, "", experiment->summary, "</li>\n");
    }
    fputs(begun ? "</ul>\n" : "", p->page);
    return AUR_OK;
}
