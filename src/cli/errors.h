/* The error of a picture against a reference while it is rendered. */
#ifndef AUR_CLI_ERRORS_H
#define AUR_CLI_ERRORS_H

#include <aureole/render.h>

typedef struct cli_errors cli_errors;

/* Reads the reference. Prints what is wrong and returns NULL. */
cli_errors *cli_errors_create(const char *reference);
void cli_errors_destroy(cli_errors *errors); /* NULL is allowed */
/* For the options of a render: notes the error after each wave. */
aur_waves cli_errors_waves(cli_errors *errors);
/* Writes samples a pixel, samples, rays, CPU seconds, RMSE and relative RMSE of every wave as CSV. */
aur_result cli_errors_write(const cli_errors *errors, const char *path, aur_error *error);

#endif
