/* Annual metrics over all sensors, as defined by LM-83, LEED and EN 17037. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"
#include "program/report/report.h"

/* The 97.5 % quantile of Student's distribution with 15 degrees of freedom: sensors have 16 randomizations.
 */
static const double WIDTH = 2.131449545559323;

/* Prints a value in percent with its 95 % interval. */
typedef struct share {
    double value, least, most;
} share;

static void put(report_table *table, const char *name, share found, double target) {
    enum { DIGITS = 6 };
    report_text(table, name);
    report_number(table, found.value, DIGITS);
    report_number(table, found.least, DIGITS);
    report_number(table, found.most, DIGITS);
    if (isnan(target)) {
        report_text(table, "");
        report_text(table, "");
        return;
    }
    report_number(table, target, DIGITS);
    report_text(table, found.least >= target ? "yes" : found.most < target ? "no" : "undecided");
}

/* The percentage of sensors with more than 250 hours of direct sun (LM-83). Sensors are counted before the
 * division, which a sum of shares would round. */
static share exposure(size_t sensors, const aur_daylight *results) {
    size_t counts[3] = {0};
    for (size_t i = 0; i < sensors; ++i) {
        const double value = results[i].value[AUR_DAYLIGHT_SUN_HOURS];
        const double half = WIDTH * results[i].error[AUR_DAYLIGHT_SUN_HOURS];
        const double values[3] = {value, value - half, value + half};
        for (size_t k = 0; k < 3; ++k)
            counts[k] += values[k] > 250.0 ? 1 : 0;
    }
    const double all = (double)sensors;
    return (share){100.0 * (double)counts[0] / all, 100.0 * (double)counts[1] / all,
                   100.0 * (double)counts[2] / all};
}

/* The mean over sensors. All sensors share their random directions, so the interval assumes fully correlated
 * errors. */
static share mean(size_t sensors, const aur_daylight *results, aur_daylight_measure measure) {
    double sum = 0.0, half = 0.0;
    for (size_t i = 0; i < sensors; ++i) {
        sum += results[i].value[measure] / (double)sensors;
        half += WIDTH * results[i].error[measure] / (double)sensors;
    }
    return (share){sum, sum - half, sum + half};
}

/* LEED v4.1, option 1, and LM-83 without blinds: 300 lux for half of the hours from 8 to 18. */
static void put_leed(report_table *table, const aur_daylight_options *o, share autonomy) {
    static const double targets[] = {40.0, 55.0, 75.0};
    static const char *const names[] = {"LEED v4.1, 1 point", "LEED v4.1, 2 points", "LEED v4.1, 3 points"};
    if ((o->threshold != 300.0 && o->threshold != 0.0) || o->from != 8 || o->to != 18 || o->weekdays ||
        o->schedule != NULL || o->daylight_hours)
        return;
    for (size_t i = 0; i < 3; ++i)
        put(table, names[i], autonomy, targets[i]);
}

/* EN 17037, method 2: a target illuminance over half of the space and a lower one over 95 % of it, for half
 * of the daylight hours, which are the 4380 hours of the year with the most diffuse horizontal light. */
static void put_en17037(report_table *table, const aur_daylight_options *o, share autonomy) {
    static const struct {
        double threshold;
        const char *target, *minimum;
    } rows[] = {{100.0, NULL, "EN 17037, minimum illuminance of the level minimum"},
                {300.0, "EN 17037, target illuminance of the level minimum",
                 "EN 17037, minimum illuminance of the level medium"},
                {500.0, "EN 17037, target illuminance of the level medium",
                 "EN 17037, minimum illuminance of the level high"},
                {750.0, "EN 17037, target illuminance of the level high", NULL}};
    const double threshold = o->threshold != 0.0 ? o->threshold : 300.0;
    if (!o->daylight_hours || o->weekdays)
        return;
    for (size_t i = 0; i < 4; ++i) {
        if (threshold != rows[i].threshold)
            continue;
        if (rows[i].target != NULL)
            put(table, rows[i].target, autonomy, 50.0);
        if (rows[i].minimum != NULL)
            put(table, rows[i].minimum, autonomy, 95.0);
    }
}

static aur_result save(const report_table *table, const char *path, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the metrics");
    const size_t length = strlen(path);
    const bool json = length > 5 && strcmp(path + length - 5, ".json") == 0;
    aur_result result = report_write(table, json ? REPORT_JSON : REPORT_CSV, stream, error);
    if (fclose(stream) != 0 && result == AUR_OK)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the metrics");
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, error);
    free(text);
    return result;
}

aur_result cli_daylight_metrics(const cli_daylight *given, const aur_daylight_summary *summary,
                                size_t sensors, const aur_daylight *results, aur_error *error) {
    static const char *const columns[] = {"metric", "value", "least", "most", "target", "met"};
    const share autonomy = {summary->spatial_autonomy, summary->spatial_autonomy_least,
                            summary->spatial_autonomy_most};
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    put(table, "spatial daylight autonomy", autonomy, NAN);
    put(table, "annual sunlight exposure", exposure(sensors, results), NAN);
    put(table, "mean daylight autonomy", mean(sensors, results, AUR_DAYLIGHT_AUTONOMY), NAN);
    put(table, "mean continuous autonomy", mean(sensors, results, AUR_DAYLIGHT_CONTINUOUS), NAN);
    put(table, "mean useful daylight", mean(sensors, results, AUR_DAYLIGHT_USEFUL), NAN);
    put(table, "mean daylight factor", mean(sensors, results, AUR_DAYLIGHT_FACTOR), NAN);
    put_leed(table, &given->options, autonomy);
    put_en17037(table, &given->options, autonomy);
    const aur_result result = save(table, given->metrics, error);
    report_destroy(table);
    return result;
}
