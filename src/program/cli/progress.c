#include "program/cli/progress.h"

#include <math.h>
#include <string.h>

cli_estimate cli_estimate_of(size_t count, const cli_phase *phases) {
    cli_estimate e = {.phases = phases, .count = count, .left = NAN};
    for (size_t i = 0; i < count; ++i)
        e.ahead += phases[i].work;
    return e;
}

/* The next phase with that name; `count` if there is none. */
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
    if (e->started)
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
    e->started = true;
}

/* A phase begins with a report of its name. A restart without a new name is another run of the same phase. */
static void follow(cli_estimate *e, double time, const char *what, double fraction) {
    const bool same = e->what != NULL && (e->what == what || strcmp(e->what, what) == 0);
    const bool again = !e->started || fraction < e->last || e->last >= 1.0;
    const size_t found = !same || again ? find(e, what) : e->count;
    if (!again && found == e->count)
        return;
    begin_run(e, time, fraction);
    if (found < e->count)
        begin_phase(e, found);
    if (!e->started) {
        const double all = e->work + e->ahead;
        e->base = e->share = all > 0.0 ? fraction * e->work / all : fraction;
    }
    e->started = true;
}

/* Remaining time of this run: first from the rate of earlier phases, then increasingly from its measured
 * rate. */
static double left_of_run(const cli_estimate *e, double time) {
    const double *const since = e->marks[0];
    const double part = (e->last - since[1]) / (1.0 - since[1]), open = 1.0 - e->last;
    const bool has_rate = e->past_work > 0.0 && e->seconds == 0.0;
    const double before = has_rate ? e->work * open * e->past_seconds / e->past_work : 0.0;
    if (!(part > 0.01))
        return has_rate ? before : NAN;
    const double measured = (time - since[0]) * open / (e->last - since[1]);
    const double weight = has_rate ? fmin(10.0 * part, 1.0) : 1.0;
    return weight * measured + (1.0 - weight) * before;
}

/* The current rate is measured over the last half to three quarters of the run. */
static void move_marks(cli_estimate *e, double time) {
    if (time - e->first_time < 2.0 * (e->marks[1][0] - e->first_time))
        return;
    memcpy(e->marks[0], e->marks[1], sizeof e->marks[0]);
    set_mark(e, 1, time, e->last);
}

/* Measures the rate from the next report with a fraction. */
static void wait_for_fraction(cli_estimate *e, double time, const char *what) {
    if (!e->started)
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
    /* The number of runs of a phase is unknown: assumes that as many follow as have ended. */
    const double phase = e->seconds + (time - e->first_time) + run + e->seconds;
    const double later = work > 0.0 ? e->ahead * (e->past_seconds + phase) / work : 0.0;
    e->left = run + e->seconds + later;
    move_marks(e, time);
    const double elapsed = time - e->start;
    if (elapsed > 0.0 && e->left >= 0.0)
        e->share = fmax(e->share, fmin(e->base + (1.0 - e->base) * elapsed / (elapsed + e->left), 0.99));
}
