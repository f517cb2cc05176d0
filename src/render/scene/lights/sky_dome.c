#include "render/scene/lights/sky_dome.h"

#include <stdlib.h>

/* The sky is divided into patches of equal azimuth and height. Sampling interpolates the luminance at their
 * corners, which is close to the sky's radiance. The last row is the ground. */
enum { COLUMNS = AUR_DOME_COLUMNS, SKY_ROWS = 48, ROWS = SKY_ROWS + 1 };

static void direction_at(double column, double height, double local[3]) {
    const double azimuth = 2.0 * AUR_PI * column / COLUMNS, radius = sqrt(fmax(1.0 - height * height, 0.0));
    local[0] = radius * cos(azimuth);
    local[1] = radius * sin(azimuth);
    local[2] = height;
}

/* The luminance at the corners of a patch. */
static aur_bilinear corners_of(const aur_sky_dome *dome, size_t column, size_t row) {
    if (row == SKY_ROWS)
        return (aur_bilinear){{dome->below, dome->below, dome->below, dome->below}};
    const float *const low = dome->corners[row], *const high = dome->corners[row + 1];
    const size_t next = (column + 1) % COLUMNS;
    return (aur_bilinear){{low[column], low[next], high[column], high[next]}};
}

static bool set_corners(aur_sky_dome *dome, aur_dome_luminance *luminance, const void *sky) {
    dome->corners = malloc((SKY_ROWS + 1) * sizeof *dome->corners);
    dome->round = true;
    for (size_t j = 0; j <= SKY_ROWS && dome->corners != NULL; ++j)
        for (size_t i = 0; i < COLUMNS; ++i) {
            double local[3];
            direction_at((double)i, (double)j / SKY_ROWS, local);
            dome->corners[j][i] = luminance(sky, local);
            dome->round &= dome->corners[j][i] == dome->corners[j][0];
        }
    return dome->corners != NULL;
}

aur_result aur_sky_dome_create(aur_sky_dome *dome, aur_dome_luminance *luminance, const void *sky,
                               float below, aur_error *error) {
    double *const radiance = malloc(ROWS * COLUMNS * sizeof *radiance);
    *dome = (aur_sky_dome){.below = below};
    if (!set_corners(dome, luminance, sky) || radiance == NULL) {
        free(radiance);
        return aur_fail_memory(error);
    }
    double rises[ROWS];
    for (size_t j = 0; j < ROWS; ++j) {
        rises[j] = j < SKY_ROWS ? 1.0 / SKY_ROWS : 1.0;
        for (size_t i = 0; i < COLUMNS; ++i) {
            const aur_bilinear at = corners_of(dome, i, j);
            radiance[j * COLUMNS + i] = 0.25 * ((double)at.corner[0] + (double)at.corner[1] +
                                                (double)at.corner[2] + (double)at.corner[3]);
        }
    }
    const aur_result result = aur_patches_create(&dome->patches, ROWS, COLUMNS, radiance, rises, error);
    free(radiance);
    return result;
}

void aur_sky_dome_release(aur_sky_dome *dome) {
    aur_patches_release(&dome->patches);
    free(dome->corners);
}

float aur_sky_dome_pdf(const aur_sky_dome *dome, const double direction[3]) {
    if (!(dome->patches.rows.total > 0.0))
        return 0.0f;
    const double turn = dome->round ? 0.0 : atan2(direction[1], direction[0]) / (2.0 * AUR_PI);
    const double x = (turn < 0.0 ? turn + 1.0 : turn) * COLUMNS,
                 y = direction[2] < 0.0 ? SKY_ROWS : direction[2] * SKY_ROWS;
    const size_t column = x < COLUMNS ? (size_t)x : COLUMNS - 1;
    const size_t row = direction[2] < 1.0 ? (size_t)y : SKY_ROWS - 1;
    const aur_bilinear corners = corners_of(dome, column, row);
    return aur_patches_density(
        &dome->patches, aur_bilinear_value(&corners, (float)(x - (double)column), (float)(y - (double)row)));
}

void aur_sky_dome_draw(const aur_sky_dome *dome, float u, float v, double direction[3]) {
    size_t column = 0, row;
    double along = (double)u * COLUMNS;
    if (dome->round)
        row = aur_distribution_choose(&dome->patches.rows, &v);
    else
        aur_patches_choose(&dome->patches, &u, &v, &column, &row);
    const aur_bilinear corners = corners_of(dome, column, row);
    aur_patch_draw(&corners, &u, &v);
    if (!dome->round)
        along = (double)column + (double)u;
    direction_at(along, row < SKY_ROWS ? ((double)row + (double)v) / SKY_ROWS : -(double)v, direction);
}
