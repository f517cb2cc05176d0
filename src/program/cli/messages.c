/* Output to standard error: errors, warnings and the progress bar. The bar is the program's only global
 * state, because the terminal has one bar. */
#include <aureole/ranks.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "program/cli/cli.h"
#include "program/cli/progress.h"

/* Lock-free atomics are safe in signal handlers; all threads that report progress read this. */
static atomic_bool interrupted;

typedef struct progress_bar {
    bool draws; /* on a terminal; otherwise lines are printed, for logs */
    bool shown, started;
    double start, last; /* time when the command started; when the bar was last drawn */
    cli_estimate estimate;
} progress_bar;

static progress_bar bar;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Set by the first progress report: from then on the work can be stopped by the next report. */
static atomic_bool reported;

/* The first signal requests a stop; the second one terminates the program. */
static void on_interrupt(int signal_number) {
    if (!reported) {
        static const char words[] = "aureole: stopped before the first result\n";
        if (write(STDERR_FILENO, words, sizeof words - 1) < 0)
            _exit(CLI_FAILURE);
        _exit(CLI_FAILURE);
    }
    if (atomic_exchange(&interrupted, true)) {
        signal(signal_number, SIG_DFL);
        raise(signal_number);
    }
}

void cli_progress_clear(void) {
    if (!bar.shown)
        return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
    bar.shown = false;
}

static void format_seconds(double seconds, char text[72]) {
    const uint64_t whole = seconds < 0 ? 0 : seconds > 359999 ? 359999 : (uint64_t)llround(seconds);
    if (whole >= 3600)
        snprintf(text, 72, "%" PRIu64 ":%02" PRIu64 ":%02" PRIu64, whole / 3600, whole / 60 % 60, whole % 60);
    else
        snprintf(text, 72, "%" PRIu64 ":%02" PRIu64, whole / 60, whole % 60);
}

static void draw(double elapsed) {
    enum { WIDTH = 30 };
    const cli_estimate *const estimate = &bar.estimate;
    char cells[WIDTH + 1];
    const int filled = (int)(estimate->share * WIDTH);
    for (int i = 0; i < WIDTH; ++i)
        cells[i] = i < filled ? '#' : '.';
    cells[WIDTH] = '\0';
    char spent[72], left[72] = "?";
    format_seconds(elapsed, spent);
    if (isfinite(estimate->left))
        format_seconds(estimate->left, left);
    const double percent = 100.0 * estimate->share;
    if (!isfinite(estimate->left) && estimate->share == 0.0) { /* only the elapsed time is available */
        fprintf(stderr, bar.draws ? "\r\033[K%s  %s" : "aureole: %s, %s\n", estimate->what, spent);
        bar.shown = bar.draws;
        fflush(stderr);
        return;
    }
    if (!bar.draws) {
        fprintf(stderr, "aureole: %s, %.0f %%, %s, %s left\n", estimate->what, percent, spent, left);
        return;
    }
    fprintf(stderr, "\r\033[K%s [%s] %3.0f %%  %s, %s left", estimate->what, cells, percent, spent, left);
    fflush(stderr);
    bar.shown = true;
}

static int show(void *user, const char *what, uint64_t done, uint64_t total) {
    reported = true;
    if (interrupted)
        return 1;
    const double time = now();
    cli_estimate_report(&bar.estimate, time, what != NULL ? what : "working",
                        total > 0 ? fmin((double)done / (double)total, 1.0) : (double)NAN);
    if (user == NULL)
        return 0;
    /* The bar's refresh backs off: ten a second at first, one a second after a minute. Lines come every ten
     * seconds, every minute after five. */
    const double elapsed = time - bar.start;
    const double pause = !bar.draws     ? elapsed < 300 ? 10.0 : 60.0
                         : elapsed < 10 ? 0.1
                         : elapsed < 60 ? 0.3
                                        : 1.0;
    const bool over = done >= total && total > 0 && bar.estimate.next >= bar.estimate.count;
    if (over)
        cli_progress_clear();
    if (over || time - bar.last < pause)
        return 0;
    bar.last = time;
    draw(elapsed);
    return 0;
}

void cli_progress_plan(size_t count, const cli_phase *phases) {
    bar.estimate = cli_estimate_of(count, phases);
}

double cli_progress_share(void) {
    return bar.estimate.share;
}

void cli_progress_begin(size_t index) {
    cli_estimate_begin(&bar.estimate, now(), index);
}

/* Prints the number of processes and their hosts once, for logs. */
static void print_ranks(void) {
    static bool printed;
    const size_t count = aur_ranks_count();
    if (count < 2 || printed)
        return;
    printed = true;
    aur_rank_description *const ranks = calloc(count, sizeof *ranks);
    if (ranks != NULL)
        aur_ranks_describe(ranks);
    if (ranks == NULL || aur_ranks_rank() != 0) {
        free(ranks);
        return;
    }
    fprintf(stderr, "aureole: %zu ranks:", count);
    for (size_t r = 0, first = 0; r < count; ++r)
        if (r + 1 == count || strcmp(ranks[r].host, ranks[r + 1].host) != 0) {
            fprintf(stderr, "%s %zu", first > 0 ? "," : "", first);
            if (r > first)
                fprintf(stderr, " to %zu", r);
            fprintf(stderr, " on %s", ranks[r].host);
            first = r + 1;
        }
    fputc('\n', stderr);
    free(ranks);
}

static void handle_signals(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_interrupt;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL); /* batch systems send it before SIGKILL */
}

aur_progress cli_progress(bool quiet) {
    if (!quiet)
        print_ranks();
    if (aur_ranks_count() > 1) /* mpirun signals all ranks, which stop together */
        handle_signals();
    if (!bar.started) { /* may have its phases already */
        bar.draws = isatty(STDERR_FILENO);
        bar.started = true;
        bar.start = bar.last = now();
    }
    return (aur_progress){.function = show, .user = quiet || aur_ranks_rank() != 0 ? NULL : &bar};
}

aur_progress cli_progress_of_resumable(bool quiet) {
    handle_signals();
    return cli_progress(quiet);
}

static void warn(void *user, const char *message) {
    (void)user;
    cli_progress_clear();
    fprintf(stderr, "aureole: warning: %s\n", message);
}

aur_warnings cli_warnings(bool quiet) {
    return (aur_warnings){.function = quiet ? NULL : warn};
}

static int exit_status(aur_result result) {
    switch (result) {
    case AUR_OK:
        return CLI_SUCCESS;
    case AUR_ERROR_INTERNAL:
    case AUR_ERROR_MEMORY:
    case AUR_ERROR_CANCELLED:
    case AUR_ERROR_WRITE:
        return CLI_FAILURE;
    default:
        return CLI_BAD_INPUT;
    }
}

int cli_fail(const aur_error *error) {
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY + 64];
    aur_error_format(error, sizeof text, text);
    cli_progress_clear();
    fprintf(stderr, "aureole: %s\n", text[0] != '\0' ? text : aur_result_string(error->result));
    return exit_status(error->result);
}

int cli_status(aur_result result, const aur_error *error) {
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(error);
}

int cli_finish(report_table *table, report_format format) {
    aur_error error = {0};
    cli_progress_clear();
    const aur_result result = report_write(table, format, stdout, &error);
    report_destroy(table);
    return cli_status(result, &error);
}

int cli_bad_usage(const char *format, ...) {
    cli_progress_clear();
    fputs("aureole: ", stderr);
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    return CLI_BAD_INPUT;
}
