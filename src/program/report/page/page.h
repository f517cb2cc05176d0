/* Pages that need nothing beside them: the styles and scripts of src/program/report/page/ stand in each. */
#pragma once

#include <aureole-render/image.h>

#include "program/report/canvas.h"
#include "program/report/report.h"

/* A file of src/program/report/page/, as it was when the program was built. */
typedef struct report_asset {
    const char *name; /* "page.css" */
    size_t size;
    const unsigned char *text;
} report_asset;

extern const report_asset report_assets[]; /* ends without a name */

/* From here on the stream is a page with this title, which the last function ends. */
void report_page_begin(FILE *page, const char *title);
/* Errors: MEMORY. */
aur_result report_page_end(FILE *page, aur_error *error);

/* A table whose columns sort, and below it the CSV file `name` to be saved. Of a table with more than `most`
 * rows the first ones are shown, and where the others are. Errors: MEMORY. */
aur_result report_page_table(FILE *page, const report_table *table, const char *name, size_t most,
                             aur_error *error);

/* An image of a viewer. */
typedef struct report_picture {
    const char *name;
    const aur_image *image; /* all of one viewer have one size */
    bool reference;
    unsigned dropped_bits; /* of the ten of a half float: 1 leaves .1 %, 4 leaves .8 %, 0 is exact */
    bool quick;            /* soon written, in more space */
} report_picture;

/* Writes an image as JSON that `unpack` of pictures.js takes. Errors: ARGUMENT without colour, MEMORY. */
aur_result report_put_picture(FILE *page, const report_picture *picture, aur_error *error);

/* A viewer of images of one scene. `exposure` (stops) is what they are seen with first. With a `unit` (else
 * NULL) their values are seen first, in false colours. Errors: ARGUMENT for sizes that differ or an image
 * without colour, MEMORY. */
aur_result report_page_viewer(FILE *page, const char *title, double exposure, const char *unit, size_t count,
                              const report_picture *pictures, aur_error *error);
