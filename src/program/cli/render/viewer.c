#include "program/cli/render/image_input.h"

#include <stdlib.h>
#include <string.h>

#include "program/report/page/page.h"

static aur_result make_page(const char *path, double exposure, const char *unit, size_t count,
                            const report_image *images, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *const page = open_memstream(&text, &size);
    if (page == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    report_page_begin(page, "Aureole: images");
    aur_result result = report_page_viewer(page, "", exposure, unit, count, images, error);
    if (result == AUR_OK)
        result = report_page_end(page, error);
    if (fclose(page) != 0 && result == AUR_OK)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, error);
    free(text);
    return result;
}

/* The path after the prefix common to all names, to distinguish them. */
static const char *short_name(size_t count, char **names, size_t index) {
    size_t shared = 0;
    for (size_t i = 0; names[0][i] != '\0'; ++i) {
        for (size_t k = 1; k < count; ++k)
            if (names[k][i] != names[0][i])
                return names[index] + shared;
        if (names[0][i] == '/')
            shared = i + 1;
    }
    return names[index] + shared;
}

int cli_write_viewer(const char *path, size_t count, char **names, const cli_image_input *how,
                     double exposure, bool judged) {
    report_image *const entries = calloc(count, sizeof *entries);
    aur_image **const images = calloc(count, sizeof *images);
    aur_error error = {0};
    int status =
        entries != NULL && images != NULL ? CLI_SUCCESS : cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY});
    for (size_t i = 0; i < count && status == CLI_SUCCESS; ++i) {
        status = cli_read_image(names[i], how, &images[i]);
        if (status == CLI_SUCCESS)
            cli_warn_of_values(names[i], images[i], false, "they are shown as they are");
        entries[i] = (report_image){
            .name = short_name(count, names, i), .image = images[i], .reference = judged && i == 0};
    }
    if (status == CLI_SUCCESS)
        status = cli_status(make_page(path, exposure, how->luminance != CLI_LUMINANCE_NONE ? "cd/m2" : NULL,
                                      count, entries, &error),
                            &error);
    for (size_t i = 0; images != NULL && i < count; ++i)
        aur_image_destroy(images[i]);
    free(images);
    free(entries);
    return status;
}
