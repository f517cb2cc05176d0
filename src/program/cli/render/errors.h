/* The error of a picture against a reference while it is rendered. */
#pragma once

#include <aureole-render/render.h>

typedef struct cli_errors cli_errors;

/* Reads the reference. Prints what is wrong and returns NULL. */
cli_errors *cli_errors_create(const char *reference);
void cli_errors_destroy(cli_errors *errors); /* NULL is allowed */
/* Notes the error of what there is of the picture. */
aur_result cli_errors_note(cli_errors *errors, const aur_render *render, aur_error *error);
/* Writes samples a pixel, samples, rays, CPU seconds, RMSE and relative RMSE of what was noted as CSV. */
aur_result cli_errors_write(const cli_errors *errors, const char *path, aur_error *error);
