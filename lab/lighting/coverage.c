#include "coverage.h"

#include <math.h>

const char *const lab_tally_of_directions[] = {"case", "target",    "runs",       "held",
                                               "bias", "error_rms", "directions", NULL};
const char *const lab_tally_of_rays[] = {"case", "target", "runs", "held", "bias", "error_rms", "rays", NULL};
const char *const lab_tally_of_samples[] = {"case", "target",    "runs",    "held",
                                            "bias", "error_rms", "samples", NULL};

void lab_tally_count(lab_tally *tally, double value, double half_width, double reference, double work) {
    const double off = value - reference;
    ++tally->runs;
    tally->held += fabs(off) <= half_width;
    tally->bias += off / reference;
    tally->squares += off * off / (reference * reference);
    tally->work += work;
}

void lab_tally_add(lab_tally *sum, const lab_tally *part) {
    sum->runs += part->runs;
    sum->held += part->held;
    sum->bias += part->bias;
    sum->squares += part->squares;
    sum->work += part->work;
}

void lab_tally_report(lab_run *run, const char *name, double target_error, const lab_tally *tally) {
    const double n = (double)tally->runs;
    lab_text(run, name);
    lab_number(run, target_error);
    lab_number(run, n);
    lab_number(run, (double)tally->held / n);
    lab_number(run, tally->bias / n);
    lab_number(run, sqrt(tally->squares / n));
    lab_number(run, tally->work / n);
}
