/* The program `aureole` as a process of its own: what a whole run costs, from load to written image. */
#pragma once

#include <stdbool.h>

typedef struct bench_child_cost {
    double cpu_seconds; /* user and system, of all its threads */
    double peak_bytes;  /* of memory; at least what this process has when it starts the child */
} bench_child_cost;

/* Runs the program that lies beside this one with the arguments (NULL ends them, at most 30; the program's
 * name is not among them). What it says of warnings is dropped. False after bench_fail. */
bool bench_run_child(const char *const *arguments, bench_child_cost *cost);

/* Runs the work in a process of its own. False after bench_fail, or where the work says so. */
bool bench_run_apart(bool (*work)(void *context), void *context, bench_child_cost *cost);

/* A folder beside this program for what is made once, made if it is not there; false after bench_fail. */
bool bench_data_folder(char *folder, unsigned capacity);
