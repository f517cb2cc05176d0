/* Self-contained pages: the styles and scripts of src/program/report/page/ are embedded. */
#pragma once

#include <aureole-render/image.h>

#include "program/report/canvas.h"
#include "program/report/report.h"

/* A file of src/program/report/page/, embedded at build time. */
typedef struct report_asset {
    const char *name; /* "page.css" */
    size_t size;
    const unsigned char *text;
} report_asset;

extern const report_asset report_assets[]; /* ends without a name */

/* Begins a page with this title on the stream; report_page_end ends it. */
void report_page_begin(FILE *page, const char *title);
/* Errors: MEMORY. */
aur_result report_page_end(FILE *page, aur_error *error);

/* A table with sortable columns, and a download of the CSV file `name`. Of more than `most` rows only the
 * first ones are shown, with a note. Errors: MEMORY. */
aur_result report_page_table(FILE *page, const report_table *table, const char *name, size_t most,
                             aur_error *error);

/* An image of a viewer. */
typedef struct report_image {
    const char *name;
    const aur_image *image; /* all images of a viewer have one size */
    bool reference;
    unsigned dropped_bits; /* rounded mantissa bits of the half floats' ten: 1 gives an error of .1 %, 4 of .8
                              %, 0 is exact */
    bool quick;            /* fast compression, with a larger result */
} report_image;

/* Writes an image as JSON for `unpack` of images.js. Errors: ARGUMENT without color, MEMORY. */
aur_result report_put_image(FILE *page, const report_image *viewed, aur_error *error);

/* A viewer of images of one scene. `exposure` (stops) is the initial exposure. With a `unit` (else NULL) the
 * initial view shows their values, in false colors. Errors: ARGUMENT for sizes that differ or an image
 * without color, MEMORY. */
aur_result report_page_viewer(FILE *page, const char *title, double exposure, const char *unit, size_t count,
                              const report_image *images, aur_error *error);
