/* A custom sampler compared with the library's: judged by its measures, and handed to whatever takes the name
 * of a set.
 *
 *     cc examples/custom_set.c -laureole -lm -o custom_set && ./custom_set
 *
 * The sampler is the R sequence of the plastic number, shifted. Points go in as they lie in memory; what
 * makes its own points by name takes them from a file, as the set `file:PATH`, from C, Python and the command
 * line alike. Prints two measures of both, and an integral that is 1/4 by both. */
#include <aureole/quality.h>
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>

enum { COUNT = 1024 };

static aur_error error;

static void judge(const char *name, const aur_points_view *points) {
    double discrepancy = NAN, distance = NAN, sum = 0.0;
    aur_measure("l2-star", points, NULL, &discrepancy, &error);
    aur_measure("min-distance", points, NULL, &distance, &error);
    for (size_t i = 0; i < points->count; ++i)
        sum += points->coordinates[points->stride * i] * points->coordinates[points->stride * i + 1];
    printf("%s %.6f %.6f %.6f\n", name, discrepancy, distance, sum / (double)points->count);
}

int main(void) {
    double custom[2 * COUNT];
    const double plastic = 1.32471795724474602596;
    for (size_t i = 0; i < COUNT; ++i)
        for (int d = 0; d < 2; ++d)
            custom[2 * i + d] = fmod(0.5 + (double)i / (d == 0 ? plastic : plastic * plastic), 1.0);
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_SQUARE, COUNT, 2, custom);
    judge("custom", &view);

    aur_points_format format;
    if (aur_points_format_from_name("npy", &format, &error) != AUR_OK ||
        aur_points_write("custom.npy", format, &view, NULL, &error) != AUR_OK)
        return 1;
    const char *const sets[] = {"file:custom.npy", "sobol"};
    for (int which = 0; which < 2; ++which) {
        aur_directions_options options = {.size = sizeof options};
        aur_directions_options_init(COUNT, AUR_DOMAIN_SQUARE, &options, NULL);
        aur_points_request request = {.size = sizeof request};
        aur_points_request_init(&options, &request, NULL);
        aur_points *points = NULL;
        if (aur_points_generate(sets[which], &request, &points, &error) != AUR_OK) {
            fprintf(stderr, "%s\n", error.message);
            return 1;
        }
        judge(sets[which], aur_points_get_view(points));
        aur_points_destroy(points);
    }
    return 0;
}
