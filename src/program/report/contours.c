/* Marching triangles between the centers of cells. */
#include "program/report/contours.h"

#include <math.h>
#include <stdlib.h>

/* The line of a level in the triangle of three cell centers: at most one. */
static bool cut_triangle(report_contours *self, double level, const size_t corners[3]) {
    report_point ends[2];
    size_t found = 0;
    for (size_t i = 0; i < 3; ++i) {
        const size_t a = corners[i], b = corners[(i + 1) % 3];
        const double p = self->values[a], q = self->values[b];
        if (!((p < level) != (q < level)) || found == 2)
            continue;
        const double t = (level - p) / (q - p), n = (double)self->across;
        const double ax = fmod((double)a, n), bx = fmod((double)b, n), ay = floor((double)a / n),
                     by = floor((double)b / n);
        ends[found++] = (report_point){.x = self->low[0] + self->step[0] * (ax + t * (bx - ax)),
                                       .y = self->low[1] + self->step[1] * (ay + t * (by - ay))};
    }
    if (found < 2)
        return true;
    if (self->count + 2 > self->capacity) {
        const size_t capacity = 2 * self->capacity + 64;
        report_point *const larger = realloc(self->segments, capacity * sizeof *larger);
        if (larger == NULL)
            return false;
        self->segments = larger;
        self->capacity = capacity;
    }
    self->segments[self->count++] = ends[0];
    self->segments[self->count++] = ends[1];
    return true;
}

bool report_find_contours(double high, double side, report_contours *self) {
    const report_ruler ruler = {.low = 0.0, .high = high, .from = 0.0, .to = 3.0 * side};
    double levels[REPORT_TICK_LIMIT];
    const size_t level_count = report_find_ticks(&ruler, levels);
    bool fits = true;
    for (size_t k = 0; k < level_count; ++k)
        for (size_t j = 0; j + 1 < self->up && fits; ++j)
            for (size_t i = 0; i + 1 < self->across && fits; ++i) {
                const size_t at = j * self->across + i, above = at + self->across;
                const double sum =
                    self->values[at] + self->values[at + 1] + self->values[above] + self->values[above + 1];
                fits =
                    isnan(sum) || (cut_triangle(self, levels[k], (const size_t[3]){at, at + 1, above + 1}) &&
                                   cut_triangle(self, levels[k], (const size_t[3]){at, above + 1, above}));
            }
    return fits;
}
