/* A temporary folder in /tmp for the files of one bench. */
#pragma once

#include <stdbool.h>

typedef struct bench_folder {
    char path[32];
} bench_folder;

/* False after bench_fail. */
bool bench_folder_create(bench_folder *folder);
/* Removes it and the files in it. */
void bench_folder_remove(const bench_folder *folder);
