/* What is said of a render when it ends, and where its files go. */
#pragma once

#include <aureole-render/render.h>

/* On standard error: samples, rays and times, and what each of several processes did, all of which call it.
 */
void cli_print_statistics(const aur_render *render);
/* How a render ended that asked for no error: `samples` a pixel, and the relative error of these, or 0. */
typedef struct cli_render_end {
    size_t samples;
    double error;
} cli_render_end;

/* What programs are told of a render, however it was asked for: NaN is what is not known. */
typedef struct cli_render_summary {
    const char *output, *integrator;
    double error, error_low, error_high, bias_high; /* relative to the mean */
    double mean, rounds, samples_per_pixel;
    aur_render_statistics statistics;
} cli_render_summary;

/* On standard output, for programs. */
aur_result cli_print_json(const cli_render_summary *summary, aur_error *error);

/* What an interrupted render has goes beside the picture, as OUT.partial.exr, or render.partial.exr where the
 * picture was to go to standard output. */
void cli_write_partial(const char *wanted, const aur_image *image);
/* The standard error that the film's steps tell (aur_film_error), relative to the mean of its picture; 0
 * where they are too few, or the picture is black. */
double cli_relative_error(const aur_film *film);

/* The last line: where the picture is and how good it is. Warns before it of a black picture, which nobody
 * wants. */
void cli_say_picture(const char *output, const aur_image *image, const cli_render_end *end);
/* Reports on a black picture what clip planes have cut off. */
void cli_explain_black(const aur_scene *scene, const aur_image *image);
