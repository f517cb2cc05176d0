/* Open Image Denoise, loaded while the program runs: its C interface, version 1.4 or 2. */
#pragma once

#include <aureole-render/image.h>

typedef struct cli_oidn cli_oidn;

/* From the file that AUREOLE_OIDN names; else as the system finds it, or beside oidnDenoise in PATH. Errors:
 * UNSUPPORTED. */
aur_result cli_oidn_open(cli_oidn **oidn, aur_error *error);
void cli_oidn_close(cli_oidn *oidn); /* NULL is allowed */

/* The first three channels of `image` without noise into those of `out`, by channels 3 to 5 (albedo) and 6 to
 * 8 (normals) of `features`; all of one size. Errors: INTERNAL with the library's words. */
aur_result cli_oidn_run(const cli_oidn *oidn, aur_image *image, aur_image *features, aur_image *out,
                        aur_error *error);
