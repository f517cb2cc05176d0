/* Runs `aureole` as a separate process: the cost of a whole run, from loading to the written image. */
#pragma once

#include <stdbool.h>

typedef struct bench_child_cost {
    double cpu_seconds; /* user and system time of all threads */
    double peak_bytes;  /* peak memory; at least the size of this process when it starts the child */
} bench_child_cost;

/* Runs the program next to this one with the arguments (NULL-terminated, at most 30, without the program's
 * name). Warnings are discarded. False after bench_fail. */
bool bench_run_child(const char *const *arguments, bench_child_cost *cost);

/* Runs the work in a separate process. False after bench_fail, or if the work returns false. */
bool bench_run_apart(bool (*work)(void *context), void *context, bench_child_cost *cost);

/* A folder next to this program for cached files, created if missing; false after bench_fail. */
bool bench_data_folder(char *folder, unsigned capacity);
