/* Samples coloured by weight, in Lambert's azimuthal projection (Marques 2018 figs 3 to 5). */
#include <math.h>

#include "program/cli/plot.h"
#include "program/cli/weights.h"

/* N w: 1 is an equal weight. */
static void print_samples(FILE *script, const cli_weights_result *result, size_t lobe, double reach) {
    for (size_t i = 0; i < result->count; ++i) {
        const double *const u = result->xyz + 3 * i;
        const double radius = hypot(u[0], u[1]);
        const double projected = sqrt(fmax(0.0, 1.0 - u[2])) / reach;
        const double scale = radius > 0.0 ? projected / radius : 0.0;
        fprintf(script, "%.6g %.6g %.6g\n", scale * u[0], scale * u[1],
                result->weights[lobe * result->count + i] * (double)result->count);
    }
    fputs("e\n", script);
}

int cli_weights_plot(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    cli_plot plot;
    if (!cli_plot_open(arguments->plot, (int)result->lobe_count * 480 + 80, 480, &plot))
        return CLI_BAD_INPUT;
    FILE *const script = plot.script;
    /* Blue below an equal weight, green at it, red above, as in the paper. */
    fputs("set size ratio -1\nunset key\nunset border\nunset xtics\nunset ytics\n"
          "set xrange [-1.05:1.05]\nset yrange [-1.05:1.05]\n"
          "set palette defined (0 'dark-blue', 0.5 'light-blue', 1 'green', 1.5 'yellow', 2 'red')\n"
          "set cbrange [0:2]\nset cblabel 'N w'\nset parametric\nset trange [0:2*pi]\n",
          script);
    fprintf(script, "set multiplot layout 1,%zu\n", result->lobe_count);
    /* The whole sphere reaches sqrt 2, and so do samples below the horizon. */
    double lowest = 0.0;
    for (size_t i = 0; i < result->count; ++i)
        lowest = fmin(lowest, result->xyz[3 * i + 2]);
    const double reach = sqrt(1.0 - lowest);
    for (size_t k = 0; k < result->lobe_count; ++k) {
        fputs("set title '", script);
        cli_plot_text(&plot, cli_is_file(arguments->source) ? "file" : arguments->source);
        fprintf(script, ", %zu samples, weights for %s: %s' noenhanced\n", result->count,
                k == 0 ? arguments->lobe_text : arguments->mirror_text, arguments->method_name);
        fprintf(script,
                "plot cos(t),sin(t) with lines lc 'gray', %g*cos(t),%g*sin(t) with lines lc 'gray', "
                "'-' using 1:2:3 with points pt 7 ps %s palette\n",
                1.0 / reach, 1.0 / reach, result->count > 512 ? "0.3" : "0.9");
        print_samples(script, result, k, reach);
    }
    fputs("unset multiplot\n", script);
    return cli_plot_close(&plot);
}
