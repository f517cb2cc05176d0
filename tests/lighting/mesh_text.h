/* OBJ files for tests, and helpers for the matrix. */
#pragma once

#include <aureole-lighting/view_factors.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "check.h"

#define PI 3.14159265358979323846

typedef struct mesh_file {
    char path[64];
    FILE *stream;
    size_t vertices;
} mesh_file;

static inline void mesh_begin(mesh_file *file, const char *name) {
    snprintf(file->path, sizeof file->path, "view-factors-%s-%ld.obj", name, (long)getpid());
    file->stream = fopen(file->path, "w");
    file->vertices = 0;
    assert_non_null(file->stream);
}

static inline void mesh_group(mesh_file *file, const char *name) {
    fprintf(file->stream, "g %s\n", name);
}

static inline void mesh_polygon(mesh_file *file, size_t count, const double (*corners)[3]) {
    for (size_t i = 0; i < count; ++i)
        fprintf(file->stream, "v %.17g %.17g %.17g\n", corners[i][0], corners[i][1], corners[i][2]);
    fputs("f", file->stream);
    for (size_t i = 0; i < count; ++i)
        fprintf(file->stream, " %zu", file->vertices + i + 1);
    fputc('\n', file->stream);
    file->vertices += count;
}

/* The six sides of a box, each in a separate group named `name` and its number (x, y, z low, then high) if
 * `sides`; seen from outside, or from inside. */
static inline void mesh_box(mesh_file *file, const char *name, const double low[3], const double high[3],
                            bool inside, bool sides) {
    static const int faces[6][4] = {{0, 4, 6, 2}, {0, 1, 5, 4}, {0, 2, 3, 1},
                                    {1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}};
    for (size_t f = 0; f < 6; ++f) {
        double corners[4][3];
        for (size_t k = 0; k < 4; ++k)
            for (int d = 0; d < 3; ++d)
                corners[inside ? 3 - k : k][d] = (faces[f][k] >> d & 1) != 0 ? high[d] : low[d];
        fprintf(file->stream, sides ? "g %s%zu\n" : "g %s\n", name, f);
        mesh_polygon(file, 4, (const double(*)[3])corners);
    }
}

/* A sphere of 2 n by n quads and triangles, without the polar cap above the colatitude `opening`. */
static inline void mesh_sphere(mesh_file *file, const double center[3], double radius, size_t n,
                               double opening, bool inside) {
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < 2 * n; ++k) {
            double corners[4][3];
            size_t count = 0;
            for (size_t c = 0; c < 4; ++c) {
                const size_t row = i + (c == 1 || c == 2), column = (k + (c >= 2)) % (2 * n);
                const double theta = opening + (PI - opening) * (double)row / (double)n;
                const double phi = PI * (double)column / (double)n;
                const double sine = row == n || (row == 0 && opening == 0.0) ? 0.0 : sin(theta);
                if (sine == 0.0 && (c == 2 || c == 3))
                    continue; /* the pole is one corner */
                corners[count][0] = center[0] + radius * sine * cos(phi);
                corners[count][1] = center[1] + radius * sine * sin(phi);
                corners[count++][2] = center[2] + radius * cos(theta);
            }
            for (size_t c = 0; inside && c < count / 2; ++c)
                for (int d = 0; d < 3; ++d) {
                    const double swap = corners[c][d];
                    corners[c][d] = corners[count - 1 - c][d];
                    corners[count - 1 - c][d] = swap;
                }
            mesh_polygon(file, count, (const double(*)[3])corners);
        }
}

static inline aur_facets *mesh_load(mesh_file *file, const aur_facets_options *options) {
    aur_facets *facets = NULL;
    aur_error error;
    fclose(file->stream);
    if (aur_facets_load(file->path, options, &facets, &error) != AUR_OK) {
        print_error("%s\n", error.message);
        fail();
    }
    unlink(file->path);
    return facets;
}

static inline aur_view_factors *factors_of(const aur_facets *facets, const aur_view_factors_options *options,
                                           aur_view_factors_matrix *matrix) {
    aur_view_factors *factors = NULL;
    assert_int_equal(aur_view_factors_create(facets, options, &factors, NULL), AUR_OK);
    matrix->size = sizeof *matrix;
    assert_int_equal(aur_view_factors_get_matrix(factors, matrix, NULL), AUR_OK);
    return factors;
}

/* 0 when there is no such entry; *half_width may be NULL. */
static inline double factor_at(const aur_view_factors_matrix *m, size_t row, size_t column,
                               double *half_width) {
    for (uint64_t e = m->starts[row]; e < m->starts[row + 1]; ++e)
        if (m->columns[e] == column) {
            if (half_width != NULL)
                *half_width = m->half_widths[e];
            return m->values[e];
        }
    if (half_width != NULL)
        *half_width = 0.0;
    return 0.0;
}

/* Rows are 1, exchanges are symmetric, nothing is negative. */
static inline void check_physics(const aur_view_factors_matrix *m) {
    for (size_t i = 0; i < m->rows; ++i) {
        double sum = m->sky[i] + m->back[i];
        assert_true(m->sky[i] >= 0.0 && m->back[i] >= 0.0);
        for (uint64_t e = m->starts[i]; e < m->starts[i + 1]; ++e) {
            const size_t k = m->columns[e];
            assert_true(e == m->starts[i] || m->columns[e - 1] < k);
            assert_true(m->values[e] >= 0.0);
            sum += m->values[e];
            assert_relative(m->areas[k] * factor_at(m, k, i, NULL), m->areas[i] * m->values[e], 1e-12);
        }
        assert_near(sum, m->areas[i] > 0.0 ? 1.0 : 0.0, 1e-12);
    }
}
