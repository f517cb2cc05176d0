/* The gaps between the first numbers of the golden ratio sequence and of van der Corput's (Schretter 2012,
 * fig. 1 and section 2), and the paper's rules for constructing golden sequences and sets (section 2, eq. 7,
 * appendix). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"
#include "schretter.h"

enum { MOST = 1024 };

static const char *const columns[] = {"sequence", "numbers", "largest_gap_n", "smallest_gap_n", "ratio",
                                      "star_n",   NULL};

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct gaps {
    double largest, smallest;
} gaps;

/* Which gaps count: between numbers only, also to the ends of the interval, or on the circle that joins its
 * ends. */
typedef enum gap_reading { GAPS_BETWEEN, GAPS_WITH_ENDS, GAPS_ON_CIRCLE } gap_reading;

static gaps find_gaps(gap_reading reading, size_t count, const double *numbers, double sorted[MOST]) {
    gaps found = {0.0, INFINITY};
    memcpy(sorted, numbers, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, by_value);
    const double before = reading == GAPS_ON_CIRCLE ? sorted[count - 1] - 1.0 : 0.0;
    const size_t begin = reading == GAPS_BETWEEN ? 1 : 0, end = reading == GAPS_WITH_ENDS ? count : count - 1;
    for (size_t i = begin; i <= end; ++i) {
        const double gap = (i < count ? sorted[i] : 1.0) - (i > 0 ? sorted[i - 1] : before);
        found.largest = fmax(found.largest, gap);
        found.smallest = fmin(found.smallest, gap);
    }
    return found;
}

/* The star discrepancy of sorted numbers (Niederreiter 1992, theorem 2.6). */
static double star(size_t count, const double *sorted) {
    const double n = (double)count;
    double most = 0.0;
    for (size_t i = 0; i < count; ++i)
        most = fmax(most, fabs(sorted[i] - ((double)i + 0.5) / n));
    return 0.5 / n + most;
}

typedef struct sequence {
    const char *name;
    double numbers[MOST];
    double worst; /* the largest ratio of two gaps */
    gaps first_five;
    double extent; /* of the first five */
} sequence;

static void study(lab_run *run, sequence *of, size_t most) {
    double sorted[MOST];
    for (size_t n = 2; n <= most; ++n) {
        const gaps found = find_gaps(GAPS_WITH_ENDS, n, of->numbers, sorted);
        of->worst = fmax(of->worst, found.largest / found.smallest);
        if (n == 5) {
            of->first_five = found;
            of->extent = sorted[4] - sorted[0];
        }
        if (n > 16 && (n & (n - 1)) != 0 && n % 100 != 0)
            continue;
        const double count = (double)n;
        lab_row(run, (const char *const[]){of->name, NULL}, 5,
                (const double[]){count, count * found.largest, count * found.smallest,
                                 found.largest / found.smallest, count * star(n, sorted)});
    }
}

static void judge(lab_run *run, const sequence *corput, const sequence *golden) {
    const double limit = 1.0 + 0.5 * (1.0 + sqrt(5.0));
    lab_claim(run, fabs(corput->worst - 2.0) < 1e-12,
              "van der Corput: the largest gap is at most twice the smallest (%.4g)", corput->worst);
    lab_claim(run, golden->worst < limit + 1e-9,
              "golden: a gap is at most 1 + Phi = 2.618 times another (three-gap theorem; %.4g)",
              golden->worst);
    lab_claim(
        run, golden->first_five.largest < corput->first_five.largest,
        "fig. 1: of five numbers the golden sequence's largest gap is smaller (%.4f, van der Corput's %.4f)",
        golden->first_five.largest, corput->first_five.largest);
    lab_claim(run, golden->extent > corput->extent,
              "fig. 1: and the outermost two are farther apart (%.4f, van der Corput's %.4f)", golden->extent,
              corput->extent);
}

/* The claim of section 2, "more evenly for any number of elements", for each interpretation of the gaps. */
static void judge_evenness(lab_run *run, const sequence *corput, const sequence *golden) {
    static const struct {
        const char *name;
        gap_reading reading;
    } readings[] = {{"between numbers alone, as fig. 1 draws them", GAPS_BETWEEN},
                    {"with the ends of the interval as numbers", GAPS_WITH_ENDS},
                    {"on the circle, as Cranley-Patterson rotation makes it", GAPS_ON_CIRCLE}};
    double unused[MOST];
    for (size_t r = 0; r < sizeof readings / sizeof readings[0]; ++r) {
        size_t wins = 0;
        for (size_t n = 2; n <= MOST; ++n)
            wins += find_gaps(readings[r].reading, n, golden->numbers, unused).largest <=
                    find_gaps(readings[r].reading, n, corput->numbers, unused).largest + 1e-15;
        lab_claim(run, wins == MOST - 1,
                  "sec. 2: it covers the interval more evenly for any number of elements, gaps %s (its "
                  "largest gap is not larger at %zu of %d numbers)",
                  readings[r].name, wins, MOST - 1);
    }
}

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_points[] = {"sequence", "x", "element", NULL};
    const size_t most = lab_run_options(run)->quick ? 128 : MOST;
    sequence corput = {.name = "van der Corput"}, golden = {.name = "golden ratio"};
    /* The paper's indices start at 1, like the library's golden sequence. */
    aur_result result = schretter_numbers("van-der-corput", 1, MOST, corput.numbers, error);
    if (result == AUR_OK)
        result = schretter_numbers("golden", 0, MOST, golden.numbers, error);
    if (result != AUR_OK)
        return result;
    report_table *const points = lab_table(run, "five", of_points);
    const sequence *const both[] = {&corput, &golden};
    for (size_t s = 0; s < 2; ++s)
        for (size_t i = 0; i < 5; ++i)
            lab_table_row(points, (const char *const[]){both[s]->name, NULL}, 2,
                          (const double[]){both[s]->numbers[i], (double)(i + 1)});
    study(run, &corput, most);
    study(run, &golden, most);
    judge(run, &corput, &golden);
    judge_evenness(run, &corput, &golden);
    schretter_check_rules(run, MOST, golden.numbers);
    return schretter_time(run, error);
}

static const report_plot plots[] = {
    {.name = "five",
     .title = "Fig. 1: the first five numbers, from the first (below) to the fifth",
     .table = "five",
     .x = "x",
     .y = "element",
     .panel = "sequence",
     .points = true},
    {.name = "largest",
     .title = "The largest gap, in mean gaps",
     .x = "numbers",
     .y = "largest_gap_n",
     .series = "sequence",
     .log_x = true},
    {.name = "smallest",
     .title = "The smallest gap, in mean gaps",
     .x = "numbers",
     .y = "smallest_gap_n",
     .series = "sequence",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_schretter_2012_gaps = {
    .name = "schretter-2012-gaps",
    .reproduces = "Schretter 2012, fig. 1, sections 2 and 3, appendix",
    .summary =
        "gaps of the golden ratio sequence and van der Corput's, the paper's rules, and the time of both",
    .columns = columns,
    .plots = plots,
    .takes_no_set = "the two sequences are of one dimension, which few sets have",
    .seconds = 0.3,
    .quick_seconds = 0.2,
    .run = run,
};
