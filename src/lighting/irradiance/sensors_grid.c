/* Sensors on a grid over surfaces: square cells in the surfaces' common plane. */
#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/irradiance/sensors.h"
#include "lighting/viewfactors/facets.h"
#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/scene_data.h"

enum { MOST_CELLS = 1 << 24 };

typedef struct grid {
    const aur_scene *scene;
    aur_grid_options options;
    size_t count, capacity;  /* triangles */
    double (*corners)[3];    /* three per triangle, in world space */
    double x[3], y[3], z[3]; /* the frame: z is the normal on the sensors' side */
    double low[2], step[2];
    size_t cells[2];
    double *heights; /* of the surface at each cell's centre; NaN: none */
    aur_error *error;
} grid;

static aur_result fail(const grid *self, const char *text) {
    return aur_fail(self->error, AUR_ERROR_ARGUMENT, "the grid over '%s': %s", self->options.target, text);
}

static aur_result add_triangle(grid *self, const double a[3], const double b[3], const double c[3]) {
    if (!aur_array_reserve(&self->corners, &self->capacity, 3 * (self->count + 1), sizeof *self->corners))
        return aur_fail_memory(self->error);
    memcpy(self->corners[3 * self->count], a, 3 * sizeof(double));
    memcpy(self->corners[3 * self->count + 1], b, 3 * sizeof(double));
    memcpy(self->corners[3 * self->count + 2], c, 3 * sizeof(double));
    ++self->count;
    return AUR_OK;
}

/* --- surfaces */

/* X0,Y0,X1,Y1,H with H along up, or a corner and two edges. *is_numbers: whether the target is such a list of
 * numbers. */
static aur_result take_rectangle(grid *self, bool *is_numbers) {
    double n[9];
    size_t count = 0;
    const char *at = self->options.target;
    while (count < 9 && (at = aur_read_double(at, AUR_NUMBER_FINITE, &n[count])) != NULL && *at == ',') {
        ++count;
        ++at;
    }
    count += at != NULL && *at == '\0';
    *is_numbers = at != NULL && *at == '\0' && (count == 5 || count == 9);
    if (!*is_numbers)
        return AUR_OK;
    double corner[4][3];
    const bool z_up = fabs(self->options.up[2]) >= fabs(self->options.up[1]);
    for (size_t i = 0; i < 4; ++i) {
        const double u = i == 1 || i == 2 ? 1.0 : 0.0, v = i > 1 ? 1.0 : 0.0;
        for (size_t d = 0; d < 3; ++d)
            corner[i][d] = n[d] + u * n[3 + d < 9 ? 3 + d : 8] + v * n[6 + d < 9 ? 6 + d : 8];
        if (count == 9)
            continue;
        corner[i][0] = u > 0.0 ? n[2] : n[0];
        corner[i][z_up ? 1 : 2] = v > 0.0 ? n[3] : n[1];
        corner[i][z_up ? 2 : 1] = n[4];
    }
    const aur_result result = add_triangle(self, corner[0], corner[1], corner[2]);
    return result == AUR_OK ? add_triangle(self, corner[0], corner[2], corner[3]) : result;
}

static aur_result take_mesh(grid *self) {
    aur_facets_options load = {.size = sizeof load};
    aur_facets_options_init(&load, NULL);
    load.warnings = self->options.warnings;
    aur_facets *facets = NULL;
    aur_result result = aur_facets_load_uncut(self->options.target, &load, &facets, self->error);
    for (size_t i = 0; result == AUR_OK && i < facets->count; ++i) {
        double moved[3][3];
        for (size_t k = 0; k < 9; ++k)
            moved[k / 3][k % 3] = facets->corners[i][k / 3][k % 3] + facets->scene->origin[k % 3];
        result = add_triangle(self, moved[0], moved[1], moved[2]);
    }
    aur_facets_destroy(facets);
    return result;
}

static const char *shape_name(const void *list, size_t index) {
    const aur_shape *const shape = ((aur_shape *const *)list)[index];
    return shape->name != NULL ? shape->name : "";
}

/* All meshes whose names match. */
static aur_result take_shapes(grid *self) {
    const aur_scene *const scene = self->scene;
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_shape *const shape = scene->shapes[i];
        if (shape->name == NULL || shape->grouped || shape->curved != NULL ||
            fnmatch(self->options.target, shape->name, 0) != 0)
            continue;
        for (size_t t = 0; t < shape->mesh.triangle_count; ++t) {
            double corner[3][3];
            aur_vector at[3];
            aur_mesh_corners(&shape->mesh, t, at);
            for (size_t k = 0; k < 3; ++k) {
                aur_vector_to_doubles(at[k], corner[k]);
                for (size_t d = 0; d < 3; ++d)
                    corner[k][d] += scene->origin[d];
            }
            const aur_result result = add_triangle(self, corner[0], corner[1], corner[2]);
            if (result != AUR_OK)
                return result;
        }
    }
    char hint[AUR_HINT_CAPACITY] = "";
    if (self->count == 0)
        aur_names_hint((aur_names){scene->shape_count, shape_name, scene->shapes}, self->options.target, "''",
                       hint);
    return self->count > 0
               ? AUR_OK
               : aur_fail(self->error, AUR_ERROR_NAME,
                          "the grid over '%s': no flat surface or mesh of the scene has such a name%s",
                          self->options.target, strlen(hint) < 200 ? hint : "");
}

/* --- cells */

static aur_result set_frame(grid *self) {
    double normal[3] = {0.0};
    for (size_t i = 0; i < self->count; ++i) {
        double a[3], b[3], across[3];
        for (size_t d = 0; d < 3; ++d) {
            a[d] = self->corners[3 * i + 1][d] - self->corners[3 * i][d];
            b[d] = self->corners[3 * i + 2][d] - self->corners[3 * i][d];
        }
        aur_cross3(a, b, across);
        for (size_t d = 0; d < 3; ++d)
            normal[d] += across[d];
    }
    if (!(aur_normalize3(normal) > 0.0))
        return fail(self, "its surfaces have no area, or face all sides: a flat one expected");
    /* Floors of models face down as often as up; sensors are always above. */
    const double rise = aur_dot3(normal, self->options.up);
    for (size_t d = 0; d < 3 && rise < -0.99; ++d)
        normal[d] = -normal[d];
    memcpy(self->z, normal, sizeof normal);
    /* The x axis, or y if x is normal to the plane, projected into it. */
    const size_t axis = fabs(normal[0]) < 0.9 ? 0 : 1;
    for (size_t d = 0; d < 3; ++d)
        self->x[d] = (d == axis ? 1.0 : 0.0) - normal[axis] * normal[d];
    aur_normalize3(self->x);
    aur_cross3(self->z, self->x, self->y);
    return AUR_OK;
}

static void flatten(const grid *self, const double point[3], double flat[3]) {
    flat[0] = aur_dot3(point, self->x);
    flat[1] = aur_dot3(point, self->y);
    flat[2] = aur_dot3(point, self->z);
}

/* As many cells as fit between the ends, centred; at least one. */
static aur_result set_cells(grid *self) {
    double high[2] = {-INFINITY, -INFINITY};
    self->low[0] = self->low[1] = INFINITY;
    for (size_t i = 0; i < 3 * self->count; ++i) {
        double flat[3];
        flatten(self, self->corners[i], flat);
        for (size_t d = 0; d < 2; ++d) {
            self->low[d] = fmin(self->low[d], flat[d]);
            high[d] = fmax(high[d], flat[d]);
        }
    }
    double total = 1.0;
    for (size_t d = 0; d < 2; ++d) {
        const double room = high[d] - self->low[d] - 2.0 * self->options.margin;
        if (!(room > 0.0))
            return fail(self, "the margin leaves nothing of it");
        const double fit = fmax(floor(room / self->options.spacing * (1.0 + 1e-9)), 1.0);
        total *= fit;
        if (!(total <= MOST_CELLS))
            return fail(self, "more than 16,777,216 cells: a larger spacing expected");
        self->cells[d] = (size_t)fit;
        self->step[d] = fmin(self->options.spacing, room);
        self->low[d] += self->options.margin + 0.5 * (room - fit * self->step[d]);
    }
    const size_t count = self->cells[0] * self->cells[1];
    self->heights = malloc(count * sizeof *self->heights);
    for (size_t i = 0; i < count && self->heights != NULL; ++i)
        self->heights[i] = NAN;
    return self->heights != NULL ? AUR_OK : aur_fail_memory(self->error);
}

/* The cells with centres between two coordinates along an axis. */
static void find_range(const grid *self, size_t axis, double low, double high, size_t range[2]) {
    const double last = (double)self->cells[axis];
    const double from = floor((low - self->low[axis]) / self->step[axis] - 0.5),
                 to = ceil((high - self->low[axis]) / self->step[axis] + 0.5);
    range[0] = (size_t)fmin(fmax(from, 0.0), last);
    range[1] = (size_t)fmin(fmax(to, 0.0), last);
}

static double middle(const grid *self, size_t axis, size_t cell) {
    return self->low[axis] + ((double)cell + 0.5) * self->step[axis];
}

static void fill_triangle(grid *self, size_t triangle) {
    double p[3][3];
    size_t range[2][2];
    for (size_t i = 0; i < 3; ++i)
        flatten(self, self->corners[3 * triangle + i], p[i]);
    const double area = aur_orientation(p[0], p[1], p[2]);
    if (area == 0.0)
        return;
    for (size_t d = 0; d < 2; ++d)
        find_range(self, d, fmin(fmin(p[0][d], p[1][d]), p[2][d]), fmax(fmax(p[0][d], p[1][d]), p[2][d]),
                   range[d]);
    for (size_t j = range[1][0]; j < range[1][1]; ++j)
        for (size_t i = range[0][0]; i < range[0][1]; ++i) {
            const double at[2] = {middle(self, 0, i), middle(self, 1, j)};
            const double b[3] = {aur_orientation(p[1], p[2], at) / area,
                                 aur_orientation(p[2], p[0], at) / area,
                                 aur_orientation(p[0], p[1], at) / area};
            if (fmin(fmin(b[0], b[1]), b[2]) >= -1e-9)
                self->heights[j * self->cells[0] + i] = b[0] * p[0][2] + b[1] * p[1][2] + b[2] * p[2][2];
        }
}

/* --- the margin: omits sensors near a boundary edge (an edge of only one triangle) */

typedef struct edge {
    double ends[2][3]; /* in lexicographic order, so that the edges of neighbours compare equal */
} edge;

static int compare_edges(const void *a, const void *b) {
    const double *const p = a, *const q = b;
    for (size_t i = 0; i < 6; ++i)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

static double distance_to(const double a[2], const double b[2], const double p[2]) {
    const double way[2] = {b[0] - a[0], b[1] - a[1]}, to[2] = {p[0] - a[0], p[1] - a[1]};
    const double square = way[0] * way[0] + way[1] * way[1];
    const double t = square > 0.0 ? fmin(fmax((to[0] * way[0] + to[1] * way[1]) / square, 0.0), 1.0) : 0.0;
    return hypot(to[0] - t * way[0], to[1] - t * way[1]);
}

static void clear_along(grid *self, const double a[2], const double b[2]) {
    size_t range[2][2];
    const double margin = self->options.margin;
    for (size_t d = 0; d < 2; ++d)
        find_range(self, d, fmin(a[d], b[d]) - margin, fmax(a[d], b[d]) + margin, range[d]);
    for (size_t j = range[1][0]; j < range[1][1]; ++j)
        for (size_t i = range[0][0]; i < range[0][1]; ++i) {
            const double p[2] = {middle(self, 0, i), middle(self, 1, j)};
            if (distance_to(a, b, p) < margin * (1.0 - 1e-9))
                self->heights[j * self->cells[0] + i] = NAN;
        }
}

/* The interval of an edge, within 0 .. 1, that coincides with another edge; false if none. */
static bool find_overlap(const grid *self, const double a[2], const double way[2], const edge *other,
                         double part[2]) {
    const double square = way[0] * way[0] + way[1] * way[1];
    for (size_t k = 0; k < 2; ++k) {
        double flat[3];
        flatten(self, other->ends[k], flat);
        const double to[2] = {flat[0] - a[0], flat[1] - a[1]};
        if (!(fabs(way[0] * to[1] - way[1] * to[0]) <= 1e-6 * square))
            return false;
        part[k] = (way[0] * to[0] + way[1] * to[1]) / square;
    }
    if (part[0] > part[1]) {
        const double swap = part[0];
        part[0] = part[1];
        part[1] = swap;
    }
    return part[1] > 1e-9 && part[0] < 1.0 - 1e-9;
}

/* Adjacent surfaces may have T-junctions: an edge is open where it coincides with no other. */
static void clear_open(grid *self, size_t count, const edge *edges, size_t index) {
    double a[3], b[3];
    flatten(self, edges[index].ends[0], a);
    flatten(self, edges[index].ends[1], b);
    const double way[2] = {b[0] - a[0], b[1] - a[1]};
    double at = 0.0;
    while (at < 1.0 - 1e-9) {
        double covered = at, next = 1.0, part[2];
        for (size_t k = 0; k < count; ++k) {
            if (k == index || !find_overlap(self, a, way, &edges[k], part))
                continue;
            if (part[0] <= at + 1e-9)
                covered = fmax(covered, part[1]);
            else
                next = fmin(next, part[0]);
        }
        if (covered > at) {
            at = covered;
            continue;
        }
        const double from[2] = {a[0] + at * way[0], a[1] + at * way[1]},
                     to[2] = {a[0] + next * way[0], a[1] + next * way[1]};
        clear_along(self, from, to);
        at = next;
    }
}

static aur_result apply_margin(grid *self) {
    const size_t count = 3 * self->count;
    edge *const edges = malloc(count * sizeof *edges);
    if (edges == NULL)
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < count; ++i) {
        const double *a = self->corners[i], *b = self->corners[i % 3 == 2 ? i - 2 : i + 1];
        bool swaps = false;
        for (size_t d = 3; d-- > 0;)
            swaps = a[d] != b[d] ? a[d] > b[d] : swaps;
        memcpy(edges[i].ends[swaps ? 1 : 0], a, 3 * sizeof *a);
        memcpy(edges[i].ends[swaps ? 0 : 1], b, 3 * sizeof *b);
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    size_t single = 0;
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && compare_edges(&edges[i], &edges[next]) == 0; ++next)
            continue;
        if (next - i == 1)
            edges[single++] = edges[i];
    }
    for (size_t i = 0; i < single; ++i)
        clear_open(self, single, edges, i);
    free(edges);
    return AUR_OK;
}

static aur_result place(const grid *self, aur_sensors *sensors) {
    size_t count = 0, placed = 0;
    for (size_t i = 0; i < self->cells[0] * self->cells[1]; ++i)
        count += !isnan(self->heights[i]);
    if (count == 0)
        return fail(self, "no cell has its middle on it: a smaller spacing or margin expected");
    const aur_result result = aur_sensors_allocate(self->options.target, count, sensors, self->error);
    for (size_t j = 0; j < self->cells[1] && result == AUR_OK; ++j)
        for (size_t i = 0; i < self->cells[0]; ++i) {
            const double height = self->heights[j * self->cells[0] + i] + self->options.height;
            if (isnan(height))
                continue;
            for (size_t d = 0; d < 3; ++d) {
                sensors->numbers[3 * placed + d] =
                    middle(self, 0, i) * self->x[d] + middle(self, 1, j) * self->y[d] + height * self->z[d];
                sensors->numbers[3 * (count + placed) + d] = self->z[d] + 0.0; /* no -0 */
            }
            ++placed;
        }
    return result;
}

static aur_result check(const aur_grid_options *o, aur_error *error) {
    if (!(o->spacing > 0.0) || !isfinite(o->spacing) || !isfinite(o->height) || !(o->margin >= 0.0) ||
        !isfinite(o->margin))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a grid needs a spacing above 0, a finite height and a margin of 0 or more");
    return AUR_OK;
}

aur_result aur_grid_options_init(aur_grid_options *options, aur_error *error) {
    static const aur_grid_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_grid_options", error);
}

aur_result aur_sensors_grid(const aur_scene *scene, const aur_grid_options *given, aur_sensors **sensors,
                            aur_error *error) {
    *sensors = NULL;
    grid self = {.scene = scene, .options = {.size = sizeof self.options}, .error = error};
    aur_grid_options_init(&self.options, NULL);
    aur_result result =
        aur_options_read(given, sizeof self.options, &self.options, "aur_grid_options", error);
    if (result == AUR_OK)
        result = check(&self.options, error);
    if (result != AUR_OK)
        return result;
    double *const up = self.options.up;
    if (!(aur_normalize3(up) > 0.0))
        up[scene->document.from_radiance ? 2 : 1] = 1.0;
    aur_sensors *const created = calloc(1, sizeof *created);
    bool is_numbers = false;
    result = created != NULL ? take_rectangle(&self, &is_numbers) : aur_fail_memory(error);
    const bool mesh = aur_mesh_format_of_name(self.options.target) < AUR_MESH_FORMAT_COUNT;
    if (result == AUR_OK && !is_numbers)
        result = mesh ? take_mesh(&self) : take_shapes(&self);
    if (result == AUR_OK)
        result = set_frame(&self);
    if (result == AUR_OK)
        result = set_cells(&self);
    for (size_t i = 0; i < self.count && result == AUR_OK; ++i)
        fill_triangle(&self, i);
    if (result == AUR_OK && self.options.margin > 0.0)
        result = apply_margin(&self);
    if (result == AUR_OK)
        result = place(&self, created);
    if (result == AUR_OK)
        result = aur_sensors_check(&created->view, AUR_ERROR_ARGUMENT, error);
    free(self.corners);
    free(self.heights);
    if (result == AUR_OK)
        *sensors = created;
    else
        aur_sensors_destroy(created);
    return result;
}
