/* Replaces the commands of libaureole-render, and the functions that other commands use, in a program that is
 * built without it. */
#include "program/cli/listing.h"
#include "program/cli/points/point_source.h"
#include "program/report/canvas.h"

static const char library[] = "libaureole-render";

#define ABSENT(name_)                                                                                        \
    const cli_command cli_command_##name_ = {                                                                \
        .name = #name_, .summary = "(needs libaureole-render)", .absent = library};
ABSENT(render)
ABSENT(merge)
ABSENT(compare)
ABSENT(convert)
ABSENT(view)

const aur_table *cli_render_table_at(size_t index) {
    (void)index;
    return NULL;
}

int cli_read_density(const char *path, aur_density_image **density) {
    (void)density;
    return cli_bad_usage("--warp: %s cannot be read: images need %s, which this program was built without",
                         path, library);
}

bool cli_describe_rendered(const cli_info_input *input, size_t size, const char *start,
                           const cli_info_options *options, int *status) {
    (void)input, (void)size, (void)start, (void)options, (void)status;
    return false;
}

const report_canvas_format report_canvas_png = {.name = "png"}; /* report_figure_save rejects it */
