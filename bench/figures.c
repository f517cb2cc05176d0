#include "figures.h"

#include <stdarg.h>
#include <stdio.h>

enum { CAPACITY = sizeof((bench_figures *)0)->rows / sizeof((bench_figures *)0)->rows[0] };

void bench_figures_add(bench_figures *figures, bench_relation relation, double target, double measured,
                       const char *unit, const char *name, ...) {
    if (figures->count++ >= CAPACITY)
        return;
    bench_figure *const row = &figures->rows[figures->count - 1];
    *row = (bench_figure){.relation = relation, .target = target, .measured = measured, .unit = unit};
    va_list arguments;
    va_start(arguments, name);
    vsnprintf(row->name, sizeof row->name, name, arguments);
    va_end(arguments);
}

void bench_figures_print(const bench_figures *figures) {
    static const char *const signs[] = {">=", "<=", ""};
    printf("\n  %-66s %12s %12s %-6s met\n", "figure", "target", "measured", "");
    for (size_t i = 0; i < figures->count && i < CAPACITY; ++i) {
        const bench_figure *const row = &figures->rows[i];
        char target[32] = "";
        if (row->relation != BENCH_NOTED)
            snprintf(target, sizeof target, "%s %.4g", signs[row->relation], row->target);
        const bool met =
            row->relation == BENCH_AT_LEAST ? row->measured >= row->target : row->measured <= row->target;
        printf("  %-66s %12s %12.4g %-6s %s\n", row->name, target, row->measured, row->unit,
               row->relation == BENCH_NOTED ? ""
               : met                        ? "yes"
                                            : "NO");
    }
    if (figures->count > CAPACITY)
        printf("  %zu figures more\n", figures->count - CAPACITY);
}
