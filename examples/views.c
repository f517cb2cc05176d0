/* Views for a scanner: camera positions about an object, as even as can be on the part of the sphere that the
 * arm reaches.
 *
 *     cc examples/views.c -laureole -lm -o views && ./views 40 110
 *
 * Prints the positions in metres on a sphere of radius 0.5, and how far, in degrees, any direction of the
 * part is from the nearest view: what an overlap of images is planned by. The second number is the lowest
 * view's angle from the top. */
#include <aureole/quality.h>
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 40;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    options.cap_degrees = argc > 2 ? atof(argv[2]) : 110.0;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    aur_points *views = NULL;
    aur_measure_options within = {.size = sizeof within};
    aur_measure_options_init(&within, NULL);
    within.cap_degrees = options.cap_degrees;
    double covering = 0.0, apart = 0.0;
    aur_error error;
    aur_result result = aur_points_generate("spherical-fibonacci", &request, &views, &error);
    if (result == AUR_OK)
        result = aur_measure("covering", aur_points_get_view(views), &within, &covering, &error);
    if (result == AUR_OK)
        result = aur_measure("min-angle", aur_points_get_view(views), &within, &apart, &error);
    if (result != AUR_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    const double degrees = 57.29577951308232, *const xyz = aur_points_get_view(views)->coordinates;
    for (uint64_t i = 0; i < count; ++i)
        printf("view %llu: %.4f %.4f %.4f\n", (unsigned long long)i + 1, 0.5 * xyz[3 * i],
               0.5 * xyz[3 * i + 1], 0.5 * xyz[3 * i + 2]);
    printf("covering %.2f apart %.2f degrees\n", covering * degrees, apart * degrees);
    aur_points_destroy(views);
    return 0;
}
