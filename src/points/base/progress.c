#include "points/base/parallel.h"

#include <math.h>
#include <stdbool.h>

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    enum { STEPS = 10000 };
    aur_progress_span *const span = user;
    const double part = total > 0 ? (double)done / (double)total : 0.0;
    const uint64_t step = (uint64_t)(STEPS * fmin(span->from + (span->to - span->from) * part, 1.0));
    span->reported = step > span->reported ? step : span->reported;
    return span->whole.function(span->whole.user, what, span->reported, STEPS);
}

int aur_progress_report_work(const aur_progress *progress, const char *what, aur_progress_share *s,
                             double done, double left) {
    const uint64_t whole = UINT64_C(1) << 40;
    const double more = fmax(done - s->done, 0.0), all = more + fmax(left, 0.0);
    s->done += more;
    s->share += all > 0.0 ? (1.0 - s->share) * more / all : 0.0;
    const bool finite = left < INFINITY;
    const double most = 1.0 - 1e-9; /* the work is not over */
    return progress->function(progress->user, what,
                              finite ? (uint64_t)((double)whole * fmin(s->share, most)) : 0,
                              finite ? whole : 0);
}

aur_progress aur_progress_within(aur_progress_span *span) {
    return span->whole.function != NULL ? (aur_progress){report, span} : (aur_progress){0};
}
