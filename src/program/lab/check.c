#include "program/lab/check.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Tolerances if rays are traced: see check.h. */
static const double TOLERANCE = 1e-2, ROUNDING = 1e-7, ZERO = 1e-14;

enum { PATH = 2 * AUR_ERROR_FILE_CAPACITY };

typedef struct comparing {
    const lab_experiment *experiment;
    const char *stored, *folder;
    bool quick;
    lab_comparison *found;
    const char *file;
    const report_table *before, *now;
} comparing;

/* Rank of a difference in text: worse than any numeric one. */
static void differ(comparing *c, double by, const char *what, const char *before, const char *now) {
    if (c->found->where[0] != '\0' && !(by > c->found->largest))
        return;
    c->found->largest = by;
    snprintf(c->found->where, sizeof c->found->where, "%.80s: %.60s: '%.40s' stored, '%.40s' now", c->file,
             what, before, now);
}

/* The unit of the last digit of the number that begins there. */
static double last_digit(const char *text, const char *end) {
    const char *const point = memchr(text, '.', (size_t)(end - text));
    const char *digits = point;
    int exponent = 0;
    while (digits != NULL && ++digits < end && *digits >= '0' && *digits <= '9')
        --exponent;
    const char *const power = memchr(text, 'e', (size_t)(end - text));
    return pow(10.0, exponent + (power != NULL ? atoi(power + 1) : 0));
}

/* Whether two texts are equal except for numbers that may depend on the processor, within their rounding. */
static bool similar(const char *a, const char *b) {
    while (*a != '\0' && *b != '\0') {
        char *a_end, *b_end;
        const double x = strtod(a, &a_end), y = strtod(b, &b_end);
        if (a_end == a || b_end == b) {
            if (*a++ != *b++)
                return false;
            continue;
        }
        const double unit = 1.001 * fmax(last_digit(a, a_end), last_digit(b, b_end));
        if (!(fabs(x - y) <= TOLERANCE * fmax(fabs(x), fabs(y)) + unit))
            return false;
        a = a_end;
        b = b_end;
    }
    return *a == *b;
}

/* The column with the other bound of the interval: rmse, rmse_low and rmse_high, or those of the experiment.
 */
static size_t end_of(const comparing *c, const char *name, const char *suffix, const char *of_experiment) {
    char other[128];
    size_t stem = strlen(name);
    if (stem > 4 && strcmp(name + stem - 4, "_low") == 0)
        stem -= 4;
    else if (stem > 5 && strcmp(name + stem - 5, "_high") == 0)
        stem -= 5;
    snprintf(other, sizeof other, "%.*s%s", (int)stem, name, suffix);
    const size_t column = report_find(c->before, other);
    return column != SIZE_MAX ? column : report_find(c->before, of_experiment);
}

static double width_of(const comparing *c, size_t row, size_t column) {
    const char *const name = report_column_name(c->before, column);
    const double low = report_value(c->before, row, end_of(c, name, "_low", c->experiment->low));
    const double high = report_value(c->before, row, end_of(c, name, "_high", c->experiment->high));
    return isfinite(high - low) ? fabs(high - low) : 0.0;
}

static double largest_in(const report_table *table, size_t column) {
    double largest = 0.0;
    for (size_t row = 0; row < report_rows(table); ++row)
        largest = fmax(largest, fabs(report_value(table, row, column)));
    return largest;
}

static void compare_cell(comparing *c, size_t row, size_t column) {
    const char *const before = report_cell(c->before, row, column), *const now =
                                                                        report_cell(c->now, row, column);
    if (strcmp(before, now) == 0)
        return;
    char what[128];
    snprintf(what, sizeof what, "row %zu, %s", row + 1, report_column_name(c->before, column));
    const double x = report_value(c->before, row, column), y = report_value(c->now, row, column);
    if (!isfinite(x) || !isfinite(y)) {
        const bool same = c->found->traces_rays && similar(before, now);
        c->found->same = c->found->same && same;
        if (!same)
            differ(c, INFINITY, what, before, now);
        return;
    }
    const double by = fabs(x - y) / fmax(fmax(fabs(x), fabs(y)), width_of(c, row, column));
    const bool rounded = fabs(x - y) <= fmax(ROUNDING * largest_in(c->before, column), ZERO);
    c->found->same = c->found->same && c->found->traces_rays && (by <= TOLERANCE || rounded);
    if (!rounded || !c->found->traces_rays)
        differ(c, by, what, before, now);
}

/* Returns the next line and terminates it; "" after the last one. */
static const char *next_line(char **text) {
    char *const line = *text, *const end = line != NULL ? strchr(line, '\n') : NULL;
    *text = end != NULL ? end + 1 : NULL;
    if (end != NULL)
        *end = '\0';
    return line != NULL ? line : "";
}

static void compare_notes(comparing *c, char *before, char *now) {
    char *a = before, *b = now;
    while (a != NULL || b != NULL) {
        const char *const x = next_line(&a), *const y = next_line(&b);
        if (strcmp(x, y) == 0 || (c->found->traces_rays && similar(x, y)))
            continue;
        c->found->same = false;
        differ(c, INFINITY, "note", x, y);
    }
}

static bool same_columns(const report_table *a, const report_table *b) {
    bool same = report_columns(a) == report_columns(b) && report_rows(a) == report_rows(b);
    for (size_t i = 0; same && i < report_columns(a); ++i)
        same = strcmp(report_column_name(a, i), report_column_name(b, i)) == 0;
    return same;
}

static aur_result compare_tables(comparing *c, const char *before, const char *now, aur_error *error) {
    report_table *a = NULL, *b = NULL;
    char *a_notes = NULL, *b_notes = NULL;
    aur_result result = report_load(before, &a, &a_notes, error);
    if (result == AUR_OK)
        result = report_load(now, &b, &b_notes, error);
    c->before = a;
    c->now = b;
    if (result == AUR_OK && !same_columns(a, b)) {
        c->found->same = false;
        differ(c, INFINITY, "the table", "other rows or columns", "these");
    } else if (result == AUR_OK) {
        for (size_t row = 0; row < report_rows(a); ++row)
            for (size_t column = 0; column < report_columns(a); ++column)
                compare_cell(c, row, column);
        compare_notes(c, a_notes, b_notes);
    }
    report_destroy(a);
    report_destroy(b);
    free(a_notes);
    free(b_notes);
    return result;
}

/* Whether a file is one of the tables that are reproducible. */
static bool is_table(const comparing *c, const char *file) {
    static const char *const others[] = {"-run.csv", "-timings.csv", "-pictures.csv", "-stamp.csv"};
    const size_t length = strlen(c->experiment->name), end = strlen(file);
    if (strncmp(file, c->experiment->name, length) != 0 || end < length + 4 ||
        strcmp(file + end - 4, ".csv") != 0)
        return false;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        if (strcmp(file + length, others[i]) == 0)
            return false;
    return true;
}

/* The reference table of that name and form; false if there is none. */
static bool find_stored(const comparing *c, const char *file, char path[PATH]) {
    const char *const name = c->experiment->name;
    snprintf(path, PATH, "%s/%s/quick/%s", c->stored, name, file);
    if (c->quick && access(path, R_OK) == 0)
        return true;
    snprintf(path, PATH, "%s/%s/%s", c->stored, name, file);
    return access(path, R_OK) == 0;
}

static aur_result compare_file(comparing *c, const char *file, aur_error *error) {
    char before[PATH], now[PATH];
    snprintf(now, sizeof now, "%s/%s/%s", c->folder, c->experiment->name, file);
    c->file = file;
    if (find_stored(c, file, before))
        return compare_tables(c, before, now, error);
    c->found->same = false;
    differ(c, INFINITY, "the table", "none", "one");
    return AUR_OK;
}

/* Reference tables that the run has not produced. */
static void find_lost(comparing *c) {
    char path[PATH];
    snprintf(path, sizeof path, "%s/%s%s", c->stored, c->experiment->name, c->quick ? "/quick" : "");
    DIR *const folder = opendir(path);
    for (const struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        snprintf(path, sizeof path, "%s/%s/%.200s", c->folder, c->experiment->name, entry->d_name);
        if (!is_table(c, entry->d_name) || access(path, R_OK) == 0)
            continue;
        c->found->same = false;
        c->file = entry->d_name;
        differ(c, INFINITY, "the table", "one", "none");
    }
    if (folder != NULL)
        closedir(folder);
}

static aur_result read_stamp(comparing *c, aur_error *error) {
    char path[PATH];
    report_table *stamp = NULL;
    snprintf(path, sizeof path, "%s/%s/%s-stamp.csv", c->stored, c->experiment->name, c->experiment->name);
    const aur_result result = report_load(path, &stamp, NULL, error);
    const size_t rays = result == AUR_OK ? report_find(stamp, "rays") : SIZE_MAX;
    if (rays != SIZE_MAX && report_rows(stamp) == 1)
        c->found->traces_rays = strcmp(report_cell(stamp, 0, rays), "yes") == 0;
    report_destroy(stamp);
    return result;
}

aur_result lab_compare(const lab_experiment *experiment, const char *stored, const char *folder, bool quick,
                       lab_comparison *comparison, aur_error *error) {
    *comparison = (lab_comparison){.same = true};
    comparing c = {
        .experiment = experiment, .stored = stored, .folder = folder, .quick = quick, .found = comparison};
    char path[PATH];
    struct dirent **files = NULL;
    aur_result result = read_stamp(&c, error);
    if (result != AUR_OK)
        return result;
    snprintf(path, sizeof path, "%s/%s", folder, experiment->name);
    const int count = scandir(path, &files, NULL, alphasort);
    if (count < 0)
        return aur_fail(error, AUR_ERROR_OPEN, "%s: cannot read the folder", path);
    for (int i = 0; i < count; ++i) {
        if (result == AUR_OK && is_table(&c, files[i]->d_name))
            result = compare_file(&c, files[i]->d_name, error);
        free(files[i]);
    }
    free(files);
    find_lost(&c);
    return result;
}
