/* The report of what was run. */
#pragma once

#include "program/lab/lab.h"

/* Writes the page of all results in a folder to `folder`/index.html, which `path` gets. Beside it stand its
 * plots for print, as PDF, SVG and TikZ, unless it is small; a small page shows large pictures as means of 2
 * x 2 pixels, within .8 %. Errors: OPEN when there are no results, FORMAT, WRITE, MEMORY. */
aur_result lab_publish(const char *results, const char *folder, bool small,
                       char path[AUR_ERROR_FILE_CAPACITY], aur_error *error);
