/* Beyond the papers: every set of the library, by every measure with a single value, on each domain. Nothing
 * is published for comparison. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { MOST_MEASURES = 64 };

static const aur_domain domains[] = {AUR_DOMAIN_SQUARE, AUR_DOMAIN_HEMISPHERE, AUR_DOMAIN_SPHERE,
                                     AUR_DOMAIN_AXES, AUR_DOMAIN_ROTATIONS};

/* The sets with the smallest and the largest value of a measure, among those with as many points as
 * requested. */
typedef struct extremes {
    const char *least, *greatest;
    double low, high;
} extremes;

static bool is_on(const aur_set_description *set, aur_domain domain) {
    const bool lifted =
        domain == AUR_DOMAIN_HEMISPHERE || domain == AUR_DOMAIN_SPHERE || domain == AUR_DOMAIN_AXES;
    return (set->domains >> domain & 1U) != 0 || (lifted && (set->domains >> AUR_DOMAIN_SQUARE & 1U) != 0);
}

/* A measure with a single value on the domain that is not a bound of another one; parameters are 3/2. */
static bool find_metric(const aur_measure_description *measure, aur_domain domain, char metric[64]) {
    const char *const name = aur_domain_name(domain), *const found = strstr(measure->domains, name);
    const bool needs_parameter = measure->parameter != NULL && measure->parameter[0] == ':';
    snprintf(metric, 64, "%s%s", measure->row.name, needs_parameter ? ":1.5" : "");
    /* "sphere" is also a suffix of "hemisphere" */
    const char *const whole =
        found == NULL || found == measure->domains || found[-1] == ' ' ? found : strstr(found + 1, name);
    return whole != NULL && !measure->series && !measure->bound;
}

/* Sets with restricted sizes use their largest one up to `most`. */
static size_t size_of(const aur_set_description *set, size_t most) {
    size_t size = 0;
    if (set->size_at == NULL)
        return most;
    for (size_t i = 0; set->size_at(i) != 0 && set->size_at(i) <= most; ++i)
        size = (size_t)set->size_at(i);
    return size;
}

static void include(extremes *of, const char *set, double value) {
    if (of->least == NULL || value < of->low) {
        of->least = set;
        of->low = value;
    }
    if (of->greatest == NULL || value > of->high) {
        of->greatest = set;
        of->high = value;
    }
}

static size_t points_of(const lab_run *run) {
    return lab_run_options(run)->quick ? 64 : 256;
}

/* Omits sets that cannot be generated or measured, such as a set that needs a file, with a note. */
static aur_result leave_out(lab_run *run, const char *set, aur_domain domain, aur_result result,
                            const aur_error *error) {
    if (result == AUR_ERROR_MEMORY || result == AUR_ERROR_CANCELLED)
        return result;
    lab_note(run, "%s, %s left out: %s", aur_domain_name(domain), set, error->message);
    return AUR_OK;
}

/* Every measure of one set on one domain. `found` has an entry for each measure. */
static aur_result add_set(lab_run *run, const char *set, aur_domain domain, size_t size, extremes *found,
                          aur_error *error) {
    aur_points *generated;
    const lab_points request = {.set = set, .domain = domain, .size = size};
    aur_result result = lab_points_make(&request, &generated, error);
    if (result != AUR_OK)
        return result;
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.threads = lab_run_options(run)->threads;
    for (size_t m = 0; m < aur_measure_count() && m < MOST_MEASURES && result == AUR_OK; ++m) {
        char metric[64];
        double value;
        if (!find_metric(aur_measure_at(m), domain, metric))
            continue;
        result = aur_measure(metric, aur_points_get_view(generated), &how, &value, error);
        if (result == AUR_OK)
            lab_row(run, (const char *const[]){aur_domain_name(domain), metric, set, NULL}, 2,
                    (const double[]){(double)size, value});
        if (result == AUR_OK && size == points_of(run))
            include(&found[m], set, value);
        if (result != AUR_OK)
            result = leave_out(run, set, domain, result, error);
    }
    aur_points_destroy(generated);
    return result;
}

static aur_result add_domain(lab_run *run, aur_domain domain, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    extremes found[MOST_MEASURES] = {{0}};
    aur_result result = AUR_OK;
    for (size_t i = 0; i <= aur_set_count() && result == AUR_OK; ++i) {
        const aur_set_description *const set = aur_set_at(i);
        const char *const name = set != NULL ? set->row.name : options->set;
        if (name == NULL || (set != NULL && (!is_on(set, domain) || set->sized_by_file)))
            continue;
        result = add_set(run, name, domain, set != NULL ? size_of(set, points_of(run)) : points_of(run),
                         found, error);
        if (result != AUR_OK)
            result = leave_out(run, name, domain, result, error);
    }
    for (size_t m = 0; m < aur_measure_count() && m < MOST_MEASURES && result == AUR_OK; ++m)
        if (found[m].least != NULL)
            lab_note(run, "%s, %s: from %.4g (%s) to %.4g (%s)", aur_domain_name(domain),
                     aur_measure_at(m)->row.name, found[m].low, found[m].least, found[m].high,
                     found[m].greatest);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t d = 0; d < sizeof domains / sizeof domains[0] && result == AUR_OK; ++d)
        result = add_domain(run, domains[d], error);
    return result;
}

static const char *const columns[] = {"domain", "measure", "set", "points", "value", NULL};

const lab_experiment lab_aureole_every_measure = {
    .name = "aureole-every-measure",
    .reproduces = "none: all sets, all measures",
    .summary = "every set by every measure on square, hemisphere, sphere, axes and rotations",
    .columns = columns,
    .seconds = 23,
    .quick_seconds = 0.9,
    .run = run,
};
