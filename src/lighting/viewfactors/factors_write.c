/* Writes results to files. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/view_factors.h"
#include "points/base/text.h"

/* The arrays that scipy.sparse.load_npz expects, and further arrays per row. */
static void write_npz(const aur_view_factors *f, FILE *stream) {
    aur_npz npz = {.stream = stream};
    char rows[32], entries[32];
    const uint64_t count = f->starts[f->rows];
    const int64_t shape[2] = {(int64_t)f->rows, (int64_t)f->rows};
    snprintf(rows, sizeof rows, "(%zu,)", f->rows);
    snprintf(entries, sizeof entries, "(%" PRIu64 ",)", count);
    aur_npz_add(&npz, "format", "|S3", "()", 1, 3, "csr");
    aur_npz_add(&npz, "shape", "<i8", "(2,)", 2, 8, shape);
    char starts[32];
    snprintf(starts, sizeof starts, "(%zu,)", f->rows + 1);
    aur_npz_add(&npz, "indptr", "<i8", starts, f->rows + 1, 8, f->starts);
    aur_npz_add(&npz, "indices", "<i4", entries, count, 4, f->columns);
    aur_npz_add(&npz, "data", "<f8", entries, count, 8, f->values);
    aur_npz_add(&npz, "half_widths", "<f8", entries, count, 8, f->half_widths);
    aur_npz_add(&npz, "areas", "<f8", rows, f->rows, 8, f->areas);
    aur_npz_add(&npz, "sky", "<f8", rows, f->rows, 8, f->sky);
    aur_npz_add(&npz, "sky_half_widths", "<f8", rows, f->rows, 8, f->sky_half_widths);
    aur_npz_add(&npz, "back", "<f8", rows, f->rows, 8, f->back);
    if (f->name_width > 0) {
        char type[32];
        snprintf(type, sizeof type, "|S%zu", f->name_width);
        aur_npz_add(&npz, "names", type, rows, f->rows, f->name_width, f->names);
    }
    aur_npz_end(&npz);
}

static void write_csv(const aur_view_factors *f, FILE *stream) {
    fputs("row,column,factor,half_width\n", stream);
    for (size_t i = 0; i < f->rows; ++i) {
        for (uint64_t e = f->starts[i]; e < f->starts[i + 1]; ++e)
            aur_print(stream, "%zu,%" PRIu32 ",%.17g,%.6g\n", i, f->columns[e], f->values[e],
                      f->half_widths[e]);
        aur_print(stream, "%zu,-1,%.17g,%.6g\n", i, f->sky[i], f->sky_half_widths[i]);
        if (f->back[i] > 0.0)
            aur_print(stream, "%zu,-2,%.17g,\n", i, f->back[i]);
    }
}

/* View3D 3.3's text format: a first line of 30 characters, areas, all factors row by row, emittances. */
static void write_view3d(const aur_view_factors *f, FILE *stream) {
    char header[80];
    snprintf(header, sizeof header, "Aureole %s 0 0 0 %zu", aur_version(), f->rows);
    fprintf(stream, "%-30s\n", header);
    for (size_t i = 0; i < f->rows; ++i)
        aur_print(stream, i == 0 ? "%.9g" : " %.9g", f->areas[i]);
    for (size_t i = 0; i < f->rows; ++i) {
        uint64_t e = f->starts[i];
        for (size_t k = 0; k < f->rows; ++k) {
            fputc(k == 0 ? '\n' : ' ', stream);
            if (e < f->starts[i + 1] && f->columns[e] == k)
                aur_print(stream, "%.9g", f->values[e++]);
            else
                fputc('0', stream);
        }
    }
    for (size_t i = 0; i < f->rows; ++i)
        fputs(i == 0 ? "\n1.000" : " 1.000", stream);
    fputc('\n', stream);
}

/* Opens one of uDALES's files, with the same suffix as the first one. */
static aur_result write_companion(const aur_view_factors *f, const char *path, const char *ending,
                                  const char *name, const char *head, const double *numbers,
                                  aur_error *error) {
    const char *const slash = strrchr(path, '/');
    const int folder = slash != NULL ? (int)(slash - path) + 1 : 0;
    const size_t size = strlen(path) + strlen(name) + 1;
    char *const companion = malloc(size);
    if (companion == NULL)
        return aur_fail_memory(error);
    snprintf(companion, size, "%.*s%s%s", folder, path, name, ending);
    aur_file_writer writer;
    aur_result result = aur_file_open(companion, &writer, error);
    free(companion);
    if (result != AUR_OK)
        return result;
    fprintf(writer.stream, "# %s\n", head);
    for (size_t i = 0; i < f->rows; ++i)
        aur_print(writer.stream, "%.8f\n", numbers[i]);
    return aur_file_commit(&writer, error);
}

/* The format of uDALES's preprocessing: rows and columns from 1, and no factor below 5e-7. */
static aur_result write_udales(const aur_view_factors *f, const char *path, aur_error *error) {
    static const char first[] = "vfsparse.inp";
    const char *const slash = strrchr(path, '/'), *const name = slash != NULL ? slash + 1 : path;
    if (strncmp(name, first, sizeof first - 1) != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "for uDALES a file named vfsparse.inp.NNN expected, not '%s'", path);
    aur_file_writer writer;
    aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < f->rows; ++i)
        for (uint64_t e = f->starts[i]; e < f->starts[i + 1]; ++e)
            if (f->values[e] >= 5e-7)
                aur_print(writer.stream, "%zu %" PRIu32 " %.8f\n", i + 1, f->columns[e] + 1, f->values[e]);
    result = aur_file_commit(&writer, error);
    const char *const ending = name + sizeof first - 1;
    if (result == AUR_OK)
        result = write_companion(f, path, ending, "svf.inp", "sky view factors", f->sky, error);
    if (result == AUR_OK)
        result = write_companion(f, path, ending, "facetarea.inp", "area of facets", f->areas, error);
    return result;
}

aur_result aur_view_factors_write(const aur_view_factors *factors, const char *format, const char *path,
                                  aur_error *error) {
    static const struct {
        const char *name;
        void (*write)(const aur_view_factors *factors, FILE *stream);
    } formats[] = {{"npz", write_npz}, {"csv", write_csv}, {"view3d", write_view3d}};
    if (strcmp(format, "udales") == 0)
        return write_udales(factors, path, error);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i) {
        if (strcmp(format, formats[i].name) != 0)
            continue;
        aur_file_writer writer;
        const aur_result result = aur_file_open(path, &writer, error);
        if (result != AUR_OK)
            return result;
        formats[i].write(factors, writer.stream);
        return aur_file_commit(&writer, error);
    }
    return aur_fail(error, AUR_ERROR_NAME, "unknown format '%s': expected npz, csv, view3d or udales",
                    format);
}
