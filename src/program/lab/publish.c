#include "program/lab/publication.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "program/report/page/page.h"

/* A small page halves images of more pixels than SMALL_PIXELS if they remain at least SMALL_WIDTH wide. For
 * each experiment it shows one such view and the first rows of long tables. */
enum { MOST_IMAGES = 32, SMALL_PIXELS = 128 * 160, SMALL_ROWS = 25, SMALL_WIDTH = 128 };

static void put_notes(FILE *page, const char *notes) {
    if (notes == NULL || *notes == '\0')
        return;
    fputs("<ul class=\"notes\">\n", page);
    while (*notes != '\0') {
        const size_t length = strcspn(notes, "\n");
        char *const line = strndup(notes, length);
        if (line != NULL)
            publication_text(page, "<li>", line, "</li>\n");
        free(line);
        notes += length + (notes[length] == '\n');
    }
    fputs("</ul>\n", page);
}

/* The form of the run: full for reference tables, which have no file that states it. */
static const char *form_of(const publication *p, const lab_experiment *of) {
    char path[AUR_ERROR_FILE_CAPACITY];
    report_table *facts = NULL;
    publication_path(p, of, "run", path, sizeof path);
    const bool quick = report_load(path, &facts, NULL, NULL) == AUR_OK && report_rows(facts) == 1 &&
                       strstr(report_cell(facts, 0, 0), " quick form") != NULL;
    report_destroy(facts);
    publication_path(p, of, "unfinished", path, sizeof path);
    strcpy(path + strlen(path) - 3, "txt");
    return access(path, R_OK) == 0 ? "unfinished" : quick ? "quick" : "full";
}

/* Lists the experiments and their verdicts. */
static aur_result put_summary(const publication *p, aur_error *error) {
    static const char *const columns[] = {"experiment", "reproduces", "form",        "rows",   "agree",
                                          "within",     "differ",     "unpublished", "claims", "hold"};
    report_table *const summary = report_create(sizeof columns / sizeof columns[0], columns);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < lab_experiment_count() && result == AUR_OK; ++i) {
        const lab_experiment *const of = lab_experiment_at(i);
        publication_tally tally = {0};
        if (!publication_has(p, of))
            continue;
        result = publication_count(p, of, &tally, error);
        report_text(summary, of->name);
        report_text(summary, of->reproduces);
        report_text(summary, form_of(p, of));
        report_integer(summary, tally.rows);
        for (size_t k = 0; k < LAB_VERDICTS; ++k) {
            if (of->published != NULL)
                report_integer(summary, tally.verdicts[k]);
            else
                report_text(summary, NULL);
        }
        for (size_t k = 0; k < 2; ++k) {
            if (tally.claims > 0)
                report_integer(summary, k == 0 ? tally.claims : tally.hold);
            else
                report_text(summary, NULL);
        }
    }
    if (result == AUR_OK)
        result = report_page_table(p->page, summary, "summary.csv", SIZE_MAX, error);
    report_destroy(summary);
    return result;
}

/* The image, or block means if it is large and the page is small. */
static aur_result read_image(const publication *p, const char *path, aur_image **image, bool *reduced,
                             aur_error *error) {
    aur_image *whole = NULL;
    const aur_result result = aur_image_read(path, &whole, error);
    *image = whole;
    if (result != AUR_OK || !p->small || aur_image_width(whole) < 2 * SMALL_WIDTH ||
        aur_image_width(whole) * aur_image_height(whole) <= SMALL_PIXELS)
        return result;
    *reduced = true;
    const aur_result halved = aur_image_downsample(whole, 2, image, error);
    aur_image_destroy(whole);
    return halved;
}

/* The images of one view, from row `first` of their table on. */
static aur_result put_view(const publication *p, const lab_experiment *of, const report_table *list,
                           size_t first, bool *shown, aur_error *error) {
    enum { VIEW, NAME, FILE_NAME, ROLE, EXPOSURE };
    const char *const view = report_cell(list, first, VIEW);
    report_image views[MOST_IMAGES];
    aur_image *images[MOST_IMAGES];
    size_t count = 0;
    bool reduced = false;
    aur_result result = AUR_OK;
    for (size_t row = first; row < report_rows(list) && count < MOST_IMAGES && result == AUR_OK; ++row) {
        if (strcmp(report_cell(list, row, VIEW), view) != 0 || (view[0] == '\0' && row != first))
            continue;
        char path[2 * AUR_ERROR_FILE_CAPACITY];
        const char *const file = report_cell(list, row, FILE_NAME);
        if (strchr(file, '/') != NULL)
            return aur_fail(error, AUR_ERROR_FORMAT, "%s: '%s' is not the file name of an image", of->name,
                            file);
        snprintf(path, sizeof path, "%s/%s/%s", p->results, of->name, file);
        result = read_image(p, path, &images[count], &reduced, error);
        views[count] = (report_image){.name = report_cell(list, row, NAME),
                                      .image = images[count],
                                      .reference = strcmp(report_cell(list, row, ROLE), "reference") == 0,
                                      .dropped_bits = p->small ? 4 : 1};
        count += result == AUR_OK;
    }
    char title[256];
    snprintf(title, sizeof title, "%s%s", view, reduced ? " (means of 2 x 2 pixels)" : "");
    *shown = result == AUR_OK && (!p->small || aur_image_width(images[0]) >= SMALL_WIDTH);
    if (*shown)
        result = report_page_viewer(p->page, title, report_value(list, first, EXPOSURE), NULL, count, views,
                                    error);
    for (size_t i = 0; i < count; ++i)
        aur_image_destroy(images[i]);
    return result;
}

static aur_result put_images(const publication *p, const lab_experiment *of, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    report_table *list = NULL;
    publication_path(p, of, "pictures", path, sizeof path);
    if (access(path, R_OK) != 0)
        return AUR_OK;
    aur_result result = report_load(path, &list, NULL, error);
    if (result == AUR_OK && report_columns(list) != 5)
        result = aur_fail(error, AUR_ERROR_FORMAT, "%s: not a list of images of the lab", path);
    size_t views = 0, left_out = 0;
    for (size_t row = 0; result == AUR_OK && row < report_rows(list); ++row) {
        const char *const view = report_cell(list, row, 0);
        bool seen = false, shown = false;
        for (size_t before = 0; before < row && view[0] != '\0'; ++before)
            seen = seen || strcmp(report_cell(list, before, 0), view) == 0;
        if (!seen && (!p->small || views == 0))
            result = put_view(p, of, list, row, &shown, error);
        views += shown;
        left_out += !seen && !shown;
    }
    if (result == AUR_OK && left_out > 0)
        fprintf(p->page, "<p>%zu more views of %s are in the folder of results.</p>\n", left_out, of->name);
    report_destroy(list);
    return result;
}

static aur_result put_experiment(const publication *p, const lab_experiment *of, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY], name[128];
    report_table *table = NULL;
    char *notes = NULL;
    publication_path(p, of, NULL, path, sizeof path);
    aur_result result = report_load(path, &table, &notes, error);
    if (result != AUR_OK)
        return result;
    fprintf(p->page, "<section id=\"%s\">", of->name);
    publication_text(p->page, "<h3>", of->reproduces, "</h3>\n");
    publication_text(p->page, "<p>", of->summary, ". ");
    fprintf(p->page, "<code>aureole lab run %s</code></p>\n", of->name);
    put_notes(p->page, notes);
    for (const report_plot *plot = of->plots; plot != NULL && plot->name != NULL && result == AUR_OK; ++plot)
        result = publication_plot(p, of, plot, true, error);
    snprintf(name, sizeof name, "%s.csv", of->name);
    if (result == AUR_OK)
        result = report_page_table(p->page, table, name, p->small ? SMALL_ROWS : SIZE_MAX, error);
    if (result == AUR_OK)
        result = put_images(p, of, error);
    fputs("</section>\n", p->page);
    report_destroy(table);
    free(notes);
    return result;
}

static aur_result put_all(const publication *p, aur_error *error) {
    report_page_begin(p->page, "Aureole: the papers' experiments");
    fprintf(
        p->page,
        "<p class=\"pale\">Aureole %s. A published value agrees when it lies in our interval of 95 %%. Quick "
        "forms have fewer samples than the papers: the verdicts that count are those of full forms.</p>\n",
        aur_version());
    aur_result result = publication_put_overview(p, error);
    fputs("<h2>All tables</h2>\n", p->page);
    if (result == AUR_OK)
        result = put_summary(p, error);
    for (size_t i = 0; i < lab_experiment_count() && result == AUR_OK; ++i)
        if (publication_has(p, lab_experiment_at(i)))
            result = put_experiment(p, lab_experiment_at(i), error);
    return result != AUR_OK ? result : report_page_end(p->page, error);
}

aur_result lab_publish(const char *results, const char *folder, bool small,
                       char path[AUR_ERROR_FILE_CAPACITY], aur_error *error) {
    char *text = NULL;
    size_t size = 0, found = 0;
    publication p = {.results = results, .folder = folder, .small = small};
    snprintf(path, AUR_ERROR_FILE_CAPACITY, "%s/index.html", folder);
    for (size_t i = 0; i < lab_experiment_count(); ++i)
        found += publication_has(&p, lab_experiment_at(i));
    if (found == 0)
        return aur_fail(error, AUR_ERROR_OPEN,
                        "%s: no results of the lab: 'aureole lab run --all -o %s' makes them", results,
                        results);
    p.page = open_memstream(&text, &size);
    if (p.page == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = put_all(&p, error);
    if (fclose(p.page) != 0 && result == AUR_OK)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, error);
    free(text);
    return result;
}
