#include "points/base/file.h"
#include "points/base/text.h"
#include "points/pointset/points.h"
#include "points/quadrature/potential/potential.h"

aur_result aur_weights_write(const char *path, aur_domain domain, size_t count, const double *xyz,
                             size_t density_count, const double *weights, aur_error *error) {
    const aur_points_view points = aur_points_view_of(domain, count, 3, xyz);
    if (aur_domain_name(domain) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown domain %d", (int)domain);
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    fputs("x,y,z", writer.stream);
    for (size_t k = 0; k < density_count; ++k)
        fprintf(writer.stream, k == 0 ? ",w" : ",w%zu", k + 1);
    if (aur_points_are_above(&points))
        fprintf(writer.stream, "# domain: %s", aur_domain_name(domain));
    for (size_t i = 0; i < count; ++i) {
        aur_print(writer.stream, "\n%.17g,%.17g,%.17g", xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        for (size_t k = 0; k < density_count; ++k)
            aur_print(writer.stream, ",%.17g", weights[k * count + i]);
    }
    fputc('\n', writer.stream);
    return aur_file_commit(&writer, error);
}
