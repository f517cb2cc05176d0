/* Resource limits that a service sets for a run. They apply from where they are read, before any large work.
 */
#include <sys/resource.h>
#include <sys/time.h>

#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "program/cli/options.h"

static aur_result limit_memory(const char *text, void *field, aur_error *error) {
    size_t bytes = 0;
    (void)field;
    const aur_result result = cli_parse_bytes("memory-limit", text, &bytes, error);
    if (result != AUR_OK)
        return result;
    struct rlimit limit;
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = (rlim_t)bytes < limit.rlim_max ? (rlim_t)bytes : limit.rlim_max;
    if (setrlimit(RLIMIT_AS, &limit) == 0)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "--memory-limit: refused by the system: '%s'", text);
}

/* A signal handler: only async-signal-safe functions are allowed. */
static void on_time_limit(int signal_number) {
    static const char words[] = "aureole: stopped by --time-limit\n";
    (void)signal_number;
    enum { STATUS = CLI_FAILURE };
    if (write(STDERR_FILENO, words, sizeof words - 1) < 0)
        _exit(STATUS);
    _exit(STATUS);
}

static aur_result limit_time(const char *text, void *field, aur_error *error) {
    double seconds = 0.0;
    (void)field;
    const aur_result result = cli_parse_seconds("time-limit", text, &seconds, error);
    if (result != AUR_OK)
        return result;
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_time_limit;
    sigaction(SIGALRM, &action, NULL);
    const double most = 1e9, least = 1e-3;
    const double span = fmin(fmax(seconds, least), most);
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)span, .tv_usec = (suseconds_t)(1e6 * (span - floor(span)))}};
    setitimer(ITIMER_REAL, &timer, NULL);
    return AUR_OK;
}

/* The libraries get the setting from the environment. */
static aur_result disable_cache(const char *text, void *field, aur_error *error) {
    (void)text;
    (void)field;
    return setenv("AUREOLE_CACHE", "", 1) == 0 ? AUR_OK : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
}

const cli_option cli_cache_option[] = {
    {CLI_FLAG(cli_common, no_cache, "no-cache", "neither read nor write the cache folder"),
     .parse = disable_cache},
    {.key = {0}}};

const cli_option cli_limits_option[] = {
    {CLI_TEXT(cli_common, no_cache, "memory-limit", "SIZE", NULL, "limit the address space, such as 2G"),
     .parse = limit_memory},
    {CLI_TEXT(cli_common, no_cache, "time-limit", "TIME", NULL,
              "stop after this time, such as 10min, with status 3; the checkpoint remains"),
     .parse = limit_time},
    {.key = {0}}};
