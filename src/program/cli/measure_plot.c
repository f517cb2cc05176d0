/* Figures against N on log-log axes: what every paper in the field shows. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/cli/measure.h"
#include "program/cli/plot.h"

/* value = factor * N^slope by least squares of the logarithms. */
typedef struct power_law {
    size_t count; /* points that have a logarithm */
    double slope, factor;
} power_law;

static double figure_of(const cli_measure_arguments *arguments, const cli_measure_row *row, size_t metric,
                        size_t which) {
    return row->figures[metric * cli_figures_per_metric(arguments) + which];
}

static bool drawable(double value) {
    return isfinite(value) && value > 0.0;
}

static power_law fit(const cli_measure_arguments *arguments, const cli_measure_rows *rows, const char *source,
                     size_t metric) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    size_t count = 0;
    for (size_t r = 0; r < rows->count; ++r) {
        const cli_measure_row *const row = &rows->items[r];
        const double value = figure_of(arguments, row, metric, 0);
        if (row->source != source || !drawable(value))
            continue;
        const double a = log((double)row->count), b = log(value);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
        ++count;
    }
    const double n = (double)count;
    const double spread = n * xx - x * x;
    if (count < 2 || !(spread > 1e-9))
        return (power_law){.count = 0};
    const double slope = (n * xy - x * y) / spread;
    return (power_law){count, slope, exp((y - slope * x) / n)};
}

/* From the least to the largest value of what is drawn. */
typedef struct axis {
    double low, high;
} axis;

static void widen(axis *a, double value) {
    a->low = fmin(a->low, value);
    a->high = fmax(a->high, value);
}

/* A logarithmic axis with a margin on both sides, and so large a part of its length `below` the values. */
static void print_axis(FILE *script, char name, axis a, double below) {
    const double length = fmax(log10(a.high / a.low), 0.1);
    const double low = log10(a.low) - (0.04 + below / (1.0 - below)) * length;
    const double high = log10(a.high) + 0.04 * length;
    fprintf(script, "set %crange [%.17g:%.17g]\nset %ctics (", name, pow(10.0, low), pow(10.0, high), name);
    /* As few numbers as there can be, but two of them. */
    static const char *const choices[] = {"1", "125", "123456789"};
    double tics[64];
    size_t count = 0;
    for (size_t c = 0; c < 3 && count < 2; ++c) {
        count = 0;
        for (int power = (int)floor(low); power <= high; ++power)
            for (const char *digit = choices[c]; *digit != '\0' && count < 64; ++digit) {
                const double tic = (*digit - '0') * pow(10.0, power);
                if (log10(tic) >= low && log10(tic) <= high)
                    tics[count++] = tic;
            }
    }
    for (size_t t = 0; t < count; ++t)
        fprintf(script, "%s%.17g", t > 0 ? ", " : "", tics[t]);
    fputs(")\n", script);
}

/* The axes of a panel: tight about its values, with room for the legend below them. */
static void print_axes(const cli_measure_arguments *arguments, const cli_measure_rows *rows, size_t metric,
                       FILE *script) {
    axis x = {INFINITY, 0.0}, y = x;
    for (size_t r = 0; r < rows->count; ++r) {
        const double value = figure_of(arguments, &rows->items[r], metric, 0);
        if (!drawable(value))
            continue;
        widen(&x, (double)rows->items[r].count);
        widen(&y, value);
        if (arguments->seed_count > 0)
            widen(&y, value + figure_of(arguments, &rows->items[r], metric, 1));
    }
    print_axis(script, 'x', x, 0.0);
    print_axis(script, 'y', y, fmin(0.03 + 0.07 * (double)arguments->source_count, 0.6));
}

static void print_title(cli_plot *plot, const char *source, const power_law *law) {
    fputs("title '", plot->script);
    cli_plot_text(plot, source);
    if (law->count > 0)
        fprintf(plot->script, "  slope %.3f", law->slope);
    fputs("' noenhanced", plot->script);
}

static void draw_panel(const cli_measure_arguments *arguments, const cli_measure_rows *rows, size_t metric,
                       cli_plot *plot) {
    FILE *const script = plot->script;
    const bool spread = arguments->seed_count > 0;
    const char *separator = "plot ";
    print_axes(arguments, rows, metric, script);
    fputs("set ylabel '", script);
    cli_plot_text(plot, cli_metric(arguments, metric));
    fputs("' noenhanced\n", script);
    for (size_t s = 0; s < arguments->source_count; ++s) {
        const power_law law = fit(arguments, rows, arguments->sources[s], metric);
        fprintf(script, "%s'-' with %s lt %zu ", separator, spread ? "yerrorbars" : "points", s + 1);
        print_title(plot, arguments->sources[s], &law);
        if (law.count > 0)
            fprintf(script, ", %.17g*x**%.17g with lines lt %zu dt 2 notitle", law.factor, law.slope, s + 1);
        separator = ", ";
    }
    fputc('\n', script);
    for (size_t s = 0; s < arguments->source_count; ++s) {
        for (size_t r = 0; r < rows->count; ++r) {
            const cli_measure_row *const row = &rows->items[r];
            const double value = figure_of(arguments, row, metric, 0);
            if (row->source != arguments->sources[s] || !drawable(value))
                continue;
            fprintf(script, "%zu %.17g", row->count, value);
            if (spread) { /* a bar that reaches zero has no place on this axis */
                const double deviation = figure_of(arguments, row, metric, 1);
                fprintf(script, " %.17g %.17g", fmax(value - deviation, 1e-3 * value), value + deviation);
            }
            fputc('\n', script);
        }
        fputs("e\n", script);
    }
}

static void print_slopes(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    for (size_t m = 0; m < arguments->metrics.count; ++m)
        for (size_t s = 0; s < arguments->source_count; ++s) {
            const power_law law = fit(arguments, rows, arguments->sources[s], m);
            if (law.count > 0)
                fprintf(stderr, "%s of %s: slope %.4f over %zu sizes\n", cli_metric(arguments, m),
                        arguments->sources[s], law.slope, law.count);
        }
}

static bool has_values(const cli_measure_arguments *arguments, const cli_measure_rows *rows, size_t metric) {
    for (size_t r = 0; r < rows->count; ++r)
        if (drawable(figure_of(arguments, &rows->items[r], metric, 0)))
            return true;
    cli_bad_usage(
        "--plot: no value of '%s' is positive and finite, so none has a place on a logarithmic axis",
        cli_metric(arguments, metric));
    return false;
}

int cli_measure_plot(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    for (size_t m = 0; m < arguments->metrics.count; ++m)
        if (!has_values(arguments, rows, m))
            return CLI_BAD_INPUT;
    cli_plot plot;
    const int height = 120 + 320 * (int)arguments->metrics.count;
    if (!cli_plot_open(arguments->plot, 640, height, &plot))
        return CLI_BAD_INPUT;
    /* Colours that differ in print and for the colour-blind (Okabe and Ito 2008), each with a mark of its
     * own. */
    fputs(
        "set logscale xy\nset grid\nset xlabel 'N'\nset key inside left bottom Left reverse\nset format "
        "'%g'\n"
        "set pointsize 0.7\nset linetype 1 lc rgb '#0072b2' pt 7\nset linetype 2 lc rgb '#d55e00' pt 5\n"
        "set linetype 3 lc rgb '#009e73' pt 9\nset linetype 4 lc rgb '#cc79a7' pt 11\n"
        "set linetype 5 lc rgb '#000000' pt 13\nset linetype 6 lc rgb '#56b4e9' pt 6\n"
        "set linetype 7 lc rgb '#e69f00' pt 4\nset linetype 8 lc rgb '#666666' pt 8\nset linetype cycle 8\n",
        plot.script);
    fprintf(plot.script, "set multiplot layout %zu,1\n", arguments->metrics.count);
    for (size_t m = 0; m < arguments->metrics.count; ++m)
        draw_panel(arguments, rows, m, &plot);
    fputs("unset multiplot\n", plot.script);
    const int status = cli_plot_close(&plot);
    if (status == CLI_SUCCESS && !arguments->common.quiet)
        print_slopes(arguments, rows);
    return status;
}
