#include "core/file.h"
#include "core/text.h"
#include "quadrature/potential/potential.h"

aur_result aur_weights_write(const char *path, size_t count, const double *xyz, size_t density_count,
                             const double *weights, aur_error *error) {
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    fputs("x,y,z", writer.stream);
    for (size_t k = 0; k < density_count; ++k)
        fprintf(writer.stream, k == 0 ? ",w" : ",w%zu", k + 1);
    for (size_t i = 0; i < count; ++i) {
        aur_print(writer.stream, "\n%.17g,%.17g,%.17g", xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        for (size_t k = 0; k < density_count; ++k)
            aur_print(writer.stream, ",%.17g", weights[k * count + i]);
    }
    fputc('\n', writer.stream);
    return aur_file_commit(&writer, error);
}
