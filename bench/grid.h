/* A large mesh: a wavy square of 2 side^2 triangles. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct bench_grid {
    size_t side, vertex_count, triangle_count;
    float *positions;  /* x, y, z of each vertex */
    uint32_t *indices; /* three of each triangle */
} bench_grid;

/* False after bench_fail; call bench_grid_release in either case. */
bool bench_grid_create(bench_grid *g, size_t side);
void bench_grid_release(bench_grid *g);
void bench_grid_write_ply(const bench_grid *g, FILE *file);
/* Builds and frees Embree's tree of the mesh, with the settings of an Aureole scene. */
void bench_grid_build(const bench_grid *g);
