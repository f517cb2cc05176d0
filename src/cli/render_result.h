/* What is said of a render when it ends, and where its files go. */
#pragma once

#include <aureole/render.h>

/* Whether a file can be written into its folder by this process, where it is the one that writes: what can be
 * known to fail is said before an hour is spent. Errors: WRITE. */
aur_result cli_check_folder(const char *path, aur_error *error);

/* On standard error: samples, rays and times, and what each of several processes did, all of which call it.
 */
void cli_print_statistics(const aur_render *render);
/* On standard output, for programs. */
aur_result cli_print_json(const aur_render *render, const char *output, aur_error *error);

/* What an interrupted render has goes beside the picture, as OUT.partial.exr, or render.partial.exr where the
 * picture was to go to standard output. */
void cli_write_partial(const char *wanted, const aur_image *image);
/* Warns of a black picture, which nobody wants, and says where it is unless -o said it. `image` may be NULL:
 * it is not known. */
void cli_say_picture(const char *output, bool by_default, const aur_image *image);
