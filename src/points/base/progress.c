#include "points/base/progress.h"

#include <math.h>

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    enum { STEPS = 10000 };
    aur_progress_span *const span = user;
    const double part = total > 0 ? (double)done / (double)total : 0.0;
    const uint64_t step = (uint64_t)(STEPS * fmin(span->from + (span->to - span->from) * part, 1.0));
    span->reported = step > span->reported ? step : span->reported;
    return span->whole.function(span->whole.user, what, span->reported, STEPS);
}

aur_progress aur_progress_within(aur_progress_span *span) {
    return span->whole.function != NULL ? (aur_progress){report, span} : (aur_progress){0};
}
