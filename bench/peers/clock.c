/* CPU seconds of one call that generates a set's points, median of several: clock SET N DOMAIN SCRAMBLE. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 101 };

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double cpu_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

int main(int argc, char **argv) {
    if (argc != 5)
        return 2;
    aur_domain domain = AUR_DOMAIN_SQUARE;
    while (aur_domain_name(domain) != NULL && strcmp(aur_domain_name(domain), argv[3]) != 0)
        ++domain;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(strtoull(argv[2], NULL, 10), domain, &options, NULL);
    options.scramble = strcmp(argv[4], "owen") == 0 ? AUR_SCRAMBLE_OWEN : AUR_SCRAMBLE_NONE;
    options.seed = 1;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    request.dimension = domain == AUR_DOMAIN_SQUARE ? 2 : 0;
    double seconds[MOST];
    size_t count = 0;
    /* Short calls repeat for a millisecond, a thousand clock ticks. */
    for (double spent = 0.0; count < 3 || (count < MOST && spent < 0.3); ++count) {
        size_t calls = 0;
        const double start = cpu_seconds();
        do {
            aur_points *points = NULL;
            aur_error error;
            if (aur_points_generate(argv[1], &request, &points, &error) != AUR_OK) {
                fprintf(stderr, "%s\n", error.message);
                return 1;
            }
            aur_points_destroy(points);
            ++calls;
        } while (cpu_seconds() - start < 1e-3);
        const double passed = cpu_seconds() - start;
        seconds[count] = passed / (double)calls;
        spent += passed;
    }
    qsort(seconds, count, sizeof *seconds, compare);
    printf("%.9g\n", seconds[count / 2]);
    return 0;
}
