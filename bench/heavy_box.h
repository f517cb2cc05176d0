/* The Cornell box with two bumpy spheres of very many triangles instead of blocks; written on first use. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The path of a scene of about `triangles` triangles in `folder`; false after bench_fail. */
bool bench_heavy_box(const char *folder, size_t triangles, char *path, size_t capacity);
