/* The view factors of an empty room, wall by wall, in closed form: what a radiant balance begins with.
 *
 *     cc examples/room.c -laureole-lighting -laureole-render -laureole -lm -o room && ./room 5 4 2.5
 *
 * Prints the matrix of floor, ceiling and four walls; its rows sum to 1, and area times factor is the same
 * both ways. A room with furniture is a mesh: `aureole viewfactors room.obj`, or aur_facets_load. */
#include <aureole-lighting/view_factors.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The corners of each side, counter-clockwise as seen from within: a 1 takes the room's length, width or
 * height. */
static const int sides[6][4][3] = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}},
    {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}},
    {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}};
static const char *const names[6] = {"floor", "ceiling", "south", "north", "west", "east"};

int main(int argc, char **argv) {
    double extent[3] = {5.0, 4.0, 2.5}, corners[6][12];
    for (int d = 0; d < 3 && d + 1 < argc; ++d)
        extent[d] = atof(argv[d + 1]);
    for (int s = 0; s < 6; ++s)
        for (int i = 0; i < 12; ++i)
            corners[s][i] = extent[i % 3] * sides[s][i / 3][i % 3];
    for (int from = 0; from < 6; ++from) {
        double sum = 0.0;
        printf("%-8s", names[from]);
        for (int to = 0; to < 6; ++to) {
            double factor = 0.0;
            aur_error error;
            if (from != to &&
                aur_view_factor_polygons(4, corners[from], 4, corners[to], &factor, &error) != AUR_OK) {
                fprintf(stderr, "%s to %s: %s\n", names[from], names[to], error.message);
                return 1;
            }
            printf(" %.8f", factor);
            sum += factor;
        }
        printf("  sum %.10f\n", sum);
    }
    return 0;
}
