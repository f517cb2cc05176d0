#include "program/cli/progress.h"

#include <math.h>
#include <string.h>

cli_estimate cli_estimate_of(size_t count, const cli_phase *phases) {
    cli_estimate e = {.phases = phases, .count = count, .left = NAN};
    for (size_t i = 0; i < count; ++i)
        e.ahead += phases[i].work;
    return e;
}

/* The next phase of that name; `count`: there is none. */
static size_t find(const cli_estimate *e, const char *what) {
    size_t i = e->next;
    while (i < e->count && (e->phases[i].what == NULL || strcmp(e->phases[i].what, what) != 0))
        ++i;
    return i;
}

static void set_mark(cli_estimate *e, int mark, double time, double fraction) {
    e->marks[mark][0] = time;
    e->marks[mark][1] = fraction;
}

static void begin_run(cli_estimate *e, double time, double fraction) {
    if (e->begun)
        e->seconds += time - e->first_time;
    else
        e->start = time;
    e->first_time = time;
    e->first = fraction;
    set_mark(e, 0, time, fraction);
    set_mark(e, 1, time, fraction);
}

static void begin_phase(cli_estimate *e, size_t index) {
    e->past_work += e->work;
    e->past_seconds += e->work > 0.0 ? e->seconds : 0.0;
    e->seconds = 0.0;
    for (; e->next <= index; ++e->next) {
        e->work = e->phases[e->next].work;
        e->ahead = fmax(e->ahead - e->work, 0.0);
    }
}

void cli_estimate_begin(cli_estimate *e, double time, size_t index) {
    begin_run(e, time, 0.0);
    begin_phase(e, index);
    e->what = NULL;
    e->last = 0.0;
    e->begun = true;
}

/* A phase begins with a report of its name. What begins again without that is more of the same phase. */
static void follow(cli_estimate *e, double time, const char *what, double fraction) {
    const bool same = e->what != NULL && (e->what == what || strcmp(e->what, what) == 0);
    const bool again = !e->begun || fraction < e->last || e->last >= 1.0;
    const size_t found = !same || again ? find(e, what) : e->count;
    if (!again && found == e->count)
        return;
    begin_run(e, time, fraction);
    if (found < e->count)
        begin_phase(e, found);
    if (!e->begun) {
        const double all = e->work + e->ahead;
        e->base = e->share = all > 0.0 ? fraction * e->work / all : fraction;
    }
    e->begun = true;
}

/* What this run still takes: by the rate of the phases that have ended, and more and more by its own. */
static double left_of_run(const cli_estimate *e, double time) {
    const double *const since = e->marks[0];
    const double part = (e->last - since[1]) / (1.0 - since[1]), open = 1.0 - e->last;
    const bool known = e->past_work > 0.0 && e->seconds == 0.0;
    const double before = known ? e->work * open * e->past_seconds / e->past_work : 0.0;
    if (!(part > 0.01))
        return known ? before : NAN;
    const double own = (time - since[0]) * open / (e->last - since[1]);
    const double trust = known ? fmin(10.0 * part, 1.0) : 1.0;
    return trust * own + (1.0 - trust) * before;
}

/* The present rate is that of the last half to three quarters of the run. */
static void move_marks(cli_estimate *e, double time) {
    if (time - e->first_time < 2.0 * (e->marks[1][0] - e->first_time))
        return;
    memcpy(e->marks[0], e->marks[1], sizeof e->marks[0]);
    set_mark(e, 1, time, e->last);
}

/* The rate counts from where the fraction is known again. */
static void wait_for_fraction(cli_estimate *e, double time, const char *what) {
    if (!e->begun)
        follow(e, time, what, 0.0);
    e->what = what;
    e->left = NAN;
    set_mark(e, 0, time, e->last);
    set_mark(e, 1, time, e->last);
}

void cli_estimate_report(cli_estimate *e, double time, const char *what, double fraction) {
    if (isnan(fraction)) {
        wait_for_fraction(e, time, what);
        return;
    }
    follow(e, time, what, fraction);
    e->what = what;
    e->last = fraction;
    const double run = left_of_run(e, time), work = e->past_work + e->work;
    /* Of runs whose number nobody knows as much is to come as there has been. */
    const double phase = e->seconds + (time - e->first_time) + run + e->seconds;
    const double later = work > 0.0 ? e->ahead * (e->past_seconds + phase) / work : 0.0;
    e->left = run + e->seconds + later;
    move_marks(e, time);
    const double elapsed = time - e->start;
    if (elapsed > 0.0 && e->left >= 0.0)
        e->share = fmax(e->share, fmin(e->base + (1.0 - e->base) * elapsed / (elapsed + e->left), 0.99));
}
