/* The meaning of the columns of a file of points, and checks that the points are on their domain. */
#include "points/pointset/files/points_file.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "points/pointset/points.h"

static const size_t file_limit = (size_t)1 << 34;

/* u1,u2,..., followed by w with weights. */
static bool is_cube_header(const char *header, size_t columns) {
    const char *at = header;
    for (size_t c = 1; c <= columns; ++c) {
        uint64_t number;
        const char *const end = *at == 'u' ? aur_read_integer(at + 1, columns, &number) : NULL;
        if (end == NULL || number != c)
            return false;
        at = *end == ',' ? end + 1 : end;
    }
    return *at == '\0' || strcmp(at, "w") == 0;
}

/* Domain, coordinates per point, and whether a column of weights follows them. */
typedef struct meaning {
    aur_domain domain;
    size_t dimension;
    bool weights;
} meaning;

static bool is_flat(aur_domain domain) {
    return domain == AUR_DOMAIN_SQUARE || domain == AUR_DOMAIN_CUBE;
}

static bool is_of_directions(aur_domain domain) {
    return domain == AUR_DOMAIN_HEMISPHERE || domain == AUR_DOMAIN_SPHERE || domain == AUR_DOMAIN_AXES;
}

/* The requested domain, or NULL, decides between the two meanings of x,y. */
static aur_result by_header(const char *path, const aur_matrix *matrix, const aur_domain *requested,
                            meaning *m, aur_error *error) {
    char header[sizeof matrix->header];
    memcpy(header, matrix->header, sizeof header);
    const size_t length = strlen(header);
    static const char *const names[] = {",w", ",weight"}; /* rotations have a coordinate w */
    m->weights = false;
    for (size_t k = 0; k < 2 && !m->weights; ++k) {
        const size_t from = length - strlen(names[k]);
        m->weights = from < length && strcmp(header + from, names[k]) == 0;
        if (m->weights)
            header[from] = '\0';
    }
    m->dimension = matrix->column_count - m->weights;
    if (strcmp(header, "u,v") == 0)
        m->domain = AUR_DOMAIN_SQUARE;
    else if (strcmp(header, "x,y,z") == 0)
        m->domain = AUR_DOMAIN_SPHERE;
    else if (strcmp(header, "w,x,y,z") == 0)
        m->domain = AUR_DOMAIN_ROTATIONS;
    else if (strcmp(header, "x,y") == 0)
        m->domain = requested != NULL && is_flat(*requested) ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_DISK;
    else if (strcmp(header, "u") == 0 || is_cube_header(header, m->dimension))
        m->domain = m->dimension == 2 ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_CUBE;
    else
        return aur_fail_at(
            error, (aur_location){.file = path, .line = 1}, AUR_ERROR_FORMAT,
            "the header '%s' must be u,v (square), x,y (disk), x,y,z (sphere), w,x,y,z (rotations) or "
            "u1,u2,... (cube), and w or weight for weights after it",
            matrix->header);
    return AUR_OK;
}

/* Columns without names of points whose domain is declared. */
static aur_result by_declaration(const char *path, const aur_matrix *matrix, meaning *m, aur_error *error) {
    static const size_t dimensions[] = {2, 0, 2, 3, 3, 3, 4}; /* of the domains; 0: any */
    const size_t columns = matrix->column_count;
    *m = (meaning){is_of_directions(matrix->domain) ? AUR_DOMAIN_SPHERE : matrix->domain,
                   columns - matrix->weighted, matrix->weighted};
    /* Without a name for weights they are one column too many. */
    const size_t dimension = dimensions[matrix->domain];
    if (!m->weights && dimension != 0 && columns == dimension + 1)
        *m = (meaning){m->domain, dimension, true};
    if (columns > matrix->weighted && (dimension == 0 || m->dimension == dimension))
        return AUR_OK;
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                       "%zu columns are not points of the domain '%s'", columns,
                       aur_domain_name(matrix->domain));
}

/* Without names two columns are u,v, three are unit vectors, four are unit vectors with weights. Any other
 * number are coordinates on the cube, and so are three or four columns of an array that are not unit vectors.
 * If rotations are requested, four columns are quaternions, and a fifth has their weights. */
static void by_columns(const aur_matrix *matrix, const aur_domain *requested, meaning *m) {
    const size_t columns = matrix->column_count;
    *m = (meaning){AUR_DOMAIN_CUBE, columns, false};
    if (requested != NULL && *requested == AUR_DOMAIN_ROTATIONS && (columns == 4 || columns == 5)) {
        *m = (meaning){AUR_DOMAIN_ROTATIONS, 4, columns == 5};
        return;
    }
    if (columns == 2)
        m->domain = AUR_DOMAIN_SQUARE;
    const bool flat = requested != NULL && is_flat(*requested);
    const bool unit = columns >= 3 && matrix->row_count > 0 && aur_is_unit(matrix->values);
    if (!flat && ((columns == 3 && (unit || matrix->lines != NULL)) || (columns == 4 && unit)))
        *m = (meaning){AUR_DOMAIN_SPHERE, 3, columns == 4};
}

/* Whether all of the first `length` numbers of rows, or of columns, that are not 0 have length 1 to .1 %. */
static bool are_unit(const aur_matrix *matrix, bool columns) {
    const size_t rows = matrix->row_count, width = matrix->column_count;
    bool some = false;
    for (size_t i = 0; i < (columns ? width : rows); ++i) {
        double square = 0.0;
        for (size_t k = 0; k < (columns ? rows : width); ++k) {
            const double value = matrix->values[columns ? k * width + i : i * width + k];
            square += value * value;
        }
        if (square != 0.0 && !(fabs(square - 1.0) <= 2e-3))
            return false;
        some |= square != 0.0;
    }
    return some;
}

/* FSL's bvecs have one direction per column. */
static aur_result refuse_columns(const char *path, const aur_matrix *matrix, aur_error *error) {
    if (matrix->row_count != 3 || !are_unit(matrix, true) || are_unit(matrix, false))
        return AUR_OK;
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                       "its 3 rows have a direction in each column, as FSL's bvecs: write a direction a row "
                       "(numpy.loadtxt(PATH).T), without columns of zeros");
}

/* The error of a point, or NULL. */
static const char *off_domain(const meaning *m, const double *row) {
    if (m->domain == AUR_DOMAIN_SPHERE)
        return aur_is_unit(row)            ? NULL
               : aur_dot3(row, row) == 0.0 ? "0 0 0 is not a direction: leave such rows (b = 0) out"
                                           : "a direction must have length 1";
    if (m->domain == AUR_DOMAIN_ROTATIONS) {
        const double square = row[0] * row[0] + aur_dot3(row + 1, row + 1);
        return fabs(square - 1.0) <= 2e-6 ? NULL : "a rotation must be a quaternion w,x,y,z of length 1";
    }
    if (m->domain == AUR_DOMAIN_DISK)
        return row[0] * row[0] + row[1] * row[1] <= 1.0
                   ? NULL
                   : "a point of the disk must have x^2 + y^2 <= 1 (the header x,y selects the disk unless "
                     "another domain is given, u,v the square)";
    for (size_t d = 0; d < m->dimension; ++d)
        if (!(row[d] >= 0.0 && row[d] < 1.0))
            return "a coordinate must be at least 0 and below 1";
    return NULL;
}

/* Whether points of the file's domain are valid on the requested one. */
static aur_result check_domain(const char *path, const aur_matrix *matrix, const meaning *m,
                               aur_domain requested, aur_error *error) {
    if (m->domain == requested || (m->domain == AUR_DOMAIN_SPHERE && is_of_directions(requested)) ||
        (m->domain == AUR_DOMAIN_SQUARE && requested == AUR_DOMAIN_CUBE))
        return AUR_OK;
    const bool header = matrix->header[0] != '\0';
    return aur_fail_at(
        error, (aur_location){.file = path, .line = header}, AUR_ERROR_UNSUPPORTED,
        "%s%s%s points are on the %s, not on the %s%s%s", header ? "the header '" : "its", matrix->header,
        header ? "' says that the" : "", aur_domain_name(m->domain), aur_domain_name(requested),
        is_flat(m->domain) ? ": to map them there, name them file:" : "", is_flat(m->domain) ? path : "");
}

/* The requested domain, else the declared one, or NULL. */
static const aur_domain *expected_domain(const aur_matrix *matrix, const aur_domain *requested) {
    return requested == NULL && matrix->declared ? &matrix->domain : requested;
}

/* Checks that a comment and the columns agree. */
static bool contradicts(const aur_matrix *matrix, const meaning *m) {
    return matrix->declared && matrix->domain != m->domain &&
           !(is_flat(matrix->domain) && is_flat(m->domain)) &&
           !(is_of_directions(matrix->domain) && m->domain == AUR_DOMAIN_SPHERE);
}

static aur_result find_meaning(const char *path, const aur_matrix *matrix, const aur_domain *requested,
                               meaning *m, aur_error *error) {
    if (matrix->row_count == 0)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "no points");
    aur_result result = AUR_OK;
    if (matrix->header[0] != '\0') {
        result = by_header(path, matrix, expected_domain(matrix, requested), m, error);
    } else if (matrix->declared) {
        result = by_declaration(path, matrix, m, error);
    } else {
        result = requested == NULL || !is_flat(*requested) ? refuse_columns(path, matrix, error) : AUR_OK;
        by_columns(matrix, requested, m);
    }
    if (result == AUR_OK && contradicts(matrix, m))
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                           "a comment says that the points are of the domain '%s', and the header '%s'",
                           aur_domain_name(matrix->domain), matrix->header);
    return result == AUR_OK && requested != NULL ? check_domain(path, matrix, m, *requested, error) : result;
}

/* Checks each row and copies it. */
static aur_result copy_rows(const char *path, const aur_domain *requested, const aur_matrix *matrix,
                            const meaning *m, aur_points *points, aur_error *error) {
    const aur_domain *const expected = expected_domain(matrix, requested);
    bool below_horizon = false;
    for (size_t r = 0; r < matrix->row_count; ++r) {
        const double *const row = matrix->values + r * matrix->column_count;
        const char *const wrong = off_domain(m, row);
        const aur_location where = {.file = path, .line = matrix->lines != NULL ? matrix->lines[r] : 0};
        if (wrong != NULL && matrix->lines != NULL)
            return aur_fail_at(error, where, AUR_ERROR_FORMAT, "%s", wrong);
        if (wrong != NULL)
            return aur_fail_at(error, where, AUR_ERROR_FORMAT, "point %zu: %s", r + 1, wrong);
        if (expected != NULL && *expected == AUR_DOMAIN_HEMISPHERE && row[2] < 0.0)
            return aur_fail_at(error, where, AUR_ERROR_FORMAT,
                               "point %zu has z = %g, below the hemisphere z >= 0", r + 1, row[2]);
        memcpy(points->coordinates + r * m->dimension, row, m->dimension * sizeof *row);
        if (m->weights)
            points->weights[r] = row[m->dimension];
        below_horizon |= m->domain == AUR_DOMAIN_SPHERE && row[2] < 0.0;
    }
    if (m->domain == AUR_DOMAIN_SPHERE)
        points->view.domain = expected != NULL ? *expected
                              : below_horizon  ? AUR_DOMAIN_SPHERE
                                               : AUR_DOMAIN_HEMISPHERE;
    points->view.guessed =
        expected == NULL && (points->view.domain == AUR_DOMAIN_HEMISPHERE ||
                             (matrix->header[0] == '\0' && (m->dimension == 3 || m->dimension == 4) &&
                              m->domain == AUR_DOMAIN_CUBE && are_unit(matrix, false)));
    return AUR_OK;
}

aur_result aur_points_interpret(const char *path, const aur_domain *requested, aur_matrix *matrix,
                                aur_points **points, aur_error *error) {
    meaning m = {0};
    aur_result result = find_meaning(path, matrix, requested, &m, error);
    if (result == AUR_OK)
        result = aur_points_create(m.domain, matrix->row_count, m.dimension, m.weights, points, error);
    if (result == AUR_OK)
        result = copy_rows(path, requested, matrix, &m, *points, error);
    if (result != AUR_OK) {
        aur_points_destroy(*points);
        *points = NULL;
        return result;
    }
    (*points)->view.lines = (*points)->lines = matrix->lines;
    matrix->lines = NULL;
    return AUR_OK;
}

/* The name of a format that points are written in but not read from, or NULL. */
static const char *foreign_format(size_t size, const char *data) {
    static const char *const formats[][2] = {{"ply\n", "PLY"},      {"{", "JSON"},   {"[", "JSON"},
                                             {"PK\x03\x04", "NPZ"}, {"<svg", "SVG"}, {"\x89PNG", "PNG"}};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i)
        if (size >= strlen(formats[i][0]) && memcmp(data, formats[i][0], strlen(formats[i][0])) == 0)
            return formats[i][1];
    return NULL;
}

/* `data`, which is modified, is followed by a zero byte. */
static aur_result parse_points(const char *name, size_t size, char *data, const aur_domain *requested,
                               aur_points **points, aur_error *error) {
    const char *const foreign = foreign_format(size, data);
    if (foreign != NULL)
        return aur_fail_at(error, (aur_location){.file = name}, AUR_ERROR_FORMAT,
                           "points are read from CSV and NPY, not from %s", foreign);
    aur_matrix matrix;
    aur_result result = aur_npy_recognize(data, size) ? aur_npy_parse(name, data, size, &matrix, error)
                                                      : aur_csv_parse(name, data, size, &matrix, error);
    if (result == AUR_OK)
        result = aur_points_interpret(name, requested, &matrix, points, error);
    free(matrix.values);
    free(matrix.lines);
    return result;
}

static aur_result read_points(const char *path, const aur_domain *requested, aur_points **points,
                              aur_error *error) {
    *points = NULL;
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, file_limit, &data, &size, error);
    if (result != AUR_OK)
        return result;
    result = parse_points(path, size, data, requested, points, error);
    free(data);
    return result;
}

aur_result aur_points_read(const char *path, const aur_domain *domain, aur_points **points,
                           aur_error *error) {
    return read_points(path, domain, points, error);
}

aur_result aur_points_read_memory(const char *name, size_t size, const void *data, const aur_domain *domain,
                                  aur_points **points, aur_error *error) {
    *points = NULL;
    char *const copy = size < file_limit ? malloc(size + 1) : NULL;
    if (copy == NULL)
        return aur_fail_memory_at(error, (aur_location){.file = name});
    memcpy(copy, data, size);
    copy[size] = '\0';
    const aur_result result = parse_points(name, size, copy, domain, points, error);
    free(copy);
    return result;
}
