#define _DEFAULT_SOURCE /* wait4 */
#include "child.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"

enum { MOST_ARGUMENTS = 30 };

static bool program_folder(char *folder, unsigned capacity) {
    const ssize_t length = readlink("/proc/self/exe", folder, capacity - 1);
    if (length <= 0)
        return bench_fail("/proc/self/exe cannot be read");
    folder[length] = '\0';
    char *const slash = strrchr(folder, '/');
    if (slash != NULL)
        *slash = '\0';
    return true;
}

bool bench_data_folder(char *folder, unsigned capacity) {
    if (!program_folder(folder, capacity - 16))
        return false;
    strcat(folder, "/bench-data");
    mkdir(folder, 0777);
    return access(folder, W_OK) == 0 || bench_fail("%s cannot be written", folder);
}

static double seconds(const struct timeval *time) {
    return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

static bool wait_for(pid_t child, const char *what, bench_child_cost *cost) {
    int status;
    struct rusage usage;
    if (wait4(child, &status, 0, &usage) != child)
        return bench_fail("%s was lost", what);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return bench_fail("%s failed%s", what,
                          WIFEXITED(status) && WEXITSTATUS(status) == 127 ? ": it is not there" : "");
    *cost = (bench_child_cost){.cpu_seconds = seconds(&usage.ru_utime) + seconds(&usage.ru_stime),
                               .peak_bytes = 1024.0 * (double)usage.ru_maxrss};
    return true;
}

/* A terminal interrupt must reach only the bench: the program would write a partial image. Kills the child
 * when the bench ends. */
static void end_with_parent(pid_t parent) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(127);
}

bool bench_run_child(const char *const *arguments, bench_child_cost *cost) {
    char program[4096];
    if (!program_folder(program, sizeof program - 16))
        return false;
    strcat(program, "/aureole");
    /* execv takes non-const strings but does not change them. */
    union {
        const char *read_only;
        char *word;
    } words[MOST_ARGUMENTS + 2] = {{.read_only = program}};
    char *vector[MOST_ARGUMENTS + 2];
    size_t count = 1;
    for (; arguments[count - 1] != NULL && count <= MOST_ARGUMENTS; ++count)
        words[count].read_only = arguments[count - 1];
    for (size_t i = 0; i < count; ++i)
        vector[i] = words[i].word;
    vector[count] = NULL;
    fflush(stdout);
    const pid_t self = getpid(), child = fork();
    if (child < 0)
        return bench_fail("no process for %s", program);
    if (child == 0) {
        end_with_parent(self);
        const int nowhere = open("/dev/null", O_WRONLY);
        if (nowhere >= 0)
            dup2(nowhere, STDOUT_FILENO);
        execv(program, vector);
        _exit(127);
    }
    return wait_for(child, program, cost);
}

bool bench_run_apart(bool (*work)(void *context), void *context, bench_child_cost *cost) {
    fflush(stdout);
    const pid_t child = fork();
    if (child < 0)
        return bench_fail("no process for a part of the bench");
    if (child == 0)
        _exit(work(context) ? 0 : 1);
    return wait_for(child, "a part of the bench", cost);
}
