/* What the verbs that read pictures share. */
#pragma once

#include <aureole/image.h>

/* Reads a picture; `channels` (NAME[,NAME...], or NULL for all) selects some. Prints what is wrong and
 * returns the exit status. */
int cli_read_picture(const char *path, const char *channels, aur_image **image);
