/* The Cornell box with two bumpy spheres of very many triangles in the place of its blocks: written to a file
 * when it is first asked for. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The path of a scene with about `triangles` triangles in `folder`; false after bench_fail. */
bool bench_heavy_box(const char *folder, size_t triangles, char *path, size_t capacity);
