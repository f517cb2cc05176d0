/* Functions for experiments: images. */
#include <string.h>

#include "program/lab/run.h"

double lab_mean_product(const aur_image *x, const aur_image *a, const aur_image *b) {
    const size_t count = aur_image_width(x) * aur_image_height(x) * aur_image_channel_count(x);
    const float *const of_x = aur_image_data(x), *const of_a = aur_image_data(a);
    const float *const of_b = aur_image_data(b);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += ((double)of_x[i] - (double)of_a[i]) * ((double)of_x[i] - (double)of_b[i]);
    return sum / (double)count;
}

/* Adds the row of an image; one written before an interruption has a row already. */
static void list_image(lab_run *run, const lab_image_position *position, const char *path) {
    const char *const file = strrchr(path, '/') + 1;
    for (size_t i = 0; i < report_rows(run->images); ++i)
        if (strcmp(report_cell(run->images, i, 2), file) == 0)
            return;
    report_text(run->images, position->view);
    report_text(run->images, position->name);
    report_text(run->images, file);
    report_text(run->images, position->reference ? "reference" : "");
    report_number(run->images, position->exposure, 4);
}

aur_result lab_image(lab_run *run, const lab_image_position *position, const aur_image *image,
                     aur_error *error) {
    static const char *const extensions[] = {"exr", "png"};
    char path[AUR_ERROR_FILE_CAPACITY], name[256];
    snprintf(name, sizeof name, "%s%s%s", position->view != NULL ? position->view : "",
             position->view != NULL ? "-" : "", position->name);
    const aur_image_write_options options = {
        .size = sizeof options, .exposure = (float)position->exposure, .half = true};
    for (size_t i = 2; i-- > 0;) {
        lab_run_path(run, name, extensions[i], path, sizeof path);
        const aur_result result = aur_image_write(path, image, &options, error);
        if (result != AUR_OK)
            return result;
    }
    list_image(run, position, path);
    return lab_run_save(run, run->images, "pictures", NULL, false, error);
}
