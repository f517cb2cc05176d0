#include "points/base/file.h"
#include "points/base/text.h"
#include "points/pointset/points.h"
#include "points/quadrature/potential/potential.h"

aur_result aur_weights_write_points(const char *path, const aur_points_view *given, size_t density_count,
                                    const double *weights, aur_error *error) {
    aur_points_view points;
    aur_file_writer writer;
    aur_result result = aur_points_view_read(given, &points, error);
    if (result == AUR_OK)
        result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    aur_points_write_header(&points, density_count, writer.stream);
    for (size_t i = 0; i < points.count; ++i) {
        const double *const point = aur_point_at(&points, i);
        for (size_t d = 0; d < points.dimension; ++d)
            aur_print(writer.stream, d == 0 ? "%.17g" : ",%.17g", point[d]);
        for (size_t k = 0; k < density_count; ++k)
            aur_print(writer.stream, ",%.17g", weights[k * points.count + i]);
        fputc('\n', writer.stream);
    }
    return aur_file_commit(&writer, error);
}

aur_result aur_weights_write(const char *path, aur_domain domain, size_t count, const double *xyz,
                             size_t density_count, const double *weights, aur_error *error) {
    const aur_points_view points = aur_points_view_of(domain, count, 3, xyz);
    return aur_weights_write_points(path, &points, density_count, weights, error);
}
