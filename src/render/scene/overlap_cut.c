
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/vector3d.h"
#include "render/scene/overlaps.h"

enum { MOST_CORNERS = 16, FEW_CORNERS = 8 };

/* Fragments narrower than this fraction of a triangle's extent are dropped. */
static const double NARROWEST = 1e-9;

typedef struct piece {
    size_t count;
    double corners[MOST_CORNERS][3];
} piece;

/* --- the triangles of several shapes */

typedef struct triangles {
    const aur_scene *scene;
    size_t shape_count;
    uint32_t *shapes;
    uint32_t *instances; /* instance of the shapes, or AUR_NO_INSTANCE */
    uint32_t *members;   /* for instances: index of the shape in its group */
    size_t *starts;      /* first triangle index of each shape; then the total */
    uint32_t **picked;   /* selected triangles of each shape; NULL: all */
} triangles;

/* Limit on the triangles of all instances together, above which none is processed. */
enum { MOST_COPIED = 1 << 20 };

/* A rendered mesh with more triangles is not tested against itself: that would take longer than all other
 * loading. */
enum { LARGE_MESH = 1 << 16, FEW_SHAPES = 16 };

static size_t find_shape(const triangles *t, size_t index) {
    size_t low = 0, high = t->shape_count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (t->starts[middle] <= index)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Index of the triangle in its shape. */
static size_t find_triangle(const triangles *t, size_t shape, size_t index) {
    const size_t offset = index - t->starts[shape];
    return t->picked[shape] != NULL ? t->picked[shape][offset] : offset;
}

static void corners_of(const aur_mesh *mesh, size_t triangle, double corners[3][3]) {
    for (size_t c = 0; c < 3; ++c)
        memcpy(corners[c], &mesh->points[3 * (size_t)mesh->indices[3 * triangle + c]], sizeof corners[c]);
}

static void find_corners(const void *context, size_t first, size_t count, double (*corners)[3][3]) {
    const triangles *const t = context;
    for (size_t shape = find_shape(t, first), i = 0; i < count; ++i) {
        while (first + i >= t->starts[shape + 1])
            ++shape;
        corners_of(&t->scene->shapes[t->shapes[shape]]->mesh, find_triangle(t, shape, first + i), corners[i]);
        for (size_t c = 0; t->instances[shape] != AUR_NO_INSTANCE && c < 3; ++c) {
            const double local[3] = {corners[i][c][0], corners[i][c][1], corners[i][c][2]};
            aur_transform_point(&t->scene->instances[t->instances[shape]]->to_world, local, corners[i][c]);
        }
    }
}

typedef struct box {
    double lower[3], upper[3];
} box;

static box box_of(size_t count, const double *points) {
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < 3 * count; ++i) {
        b.lower[i % 3] = points[i] < b.lower[i % 3] ? points[i] : b.lower[i % 3];
        b.upper[i % 3] = points[i] > b.upper[i % 3] ? points[i] : b.upper[i % 3];
    }
    double extent = 0.0;
    for (int d = 0; d < 3; ++d)
        extent = fmax(extent, b.upper[d] - b.lower[d]);
    for (int d = 0; d < 3; ++d) { /* margin wider than the distance of overlapping triangles */
        b.lower[d] -= 2e-6 * extent;
        b.upper[d] += 2e-6 * extent;
    }
    return b;
}

static bool boxes_meet(const box *a, const box *b) {
    bool meet = true;
    for (int d = 0; d < 3; ++d)
        meet &= a->lower[d] <= b->upper[d] && b->lower[d] <= a->upper[d];
    return meet;
}

/* Selects the triangles of a large mesh that are near other shapes; all of them if these are many. */
static bool pick(const triangles *t, size_t shape, const box *boxes, size_t *count) {
    const aur_mesh *const mesh = &t->scene->shapes[t->shapes[shape]]->mesh;
    box near[FEW_SHAPES];
    size_t near_count = 0;
    for (size_t i = 0; i < t->shape_count; ++i)
        if (i != shape && boxes_meet(&boxes[i], &boxes[shape])) {
            if (near_count == FEW_SHAPES)
                return true;
            near[near_count++] = boxes[i];
        }
    uint32_t *const picked = t->picked[shape] = malloc((mesh->triangle_count + 1) * sizeof *picked);
    if (picked == NULL)
        return false;
    *count = 0;
    for (size_t k = 0; near_count > 0 && k < mesh->triangle_count; ++k) {
        double corners[3][3];
        corners_of(mesh, k, corners);
        const box bounds = box_of(3, &corners[0][0]);
        bool meets = false;
        for (size_t i = 0; i < near_count && !meets; ++i)
            meets = boxes_meet(&bounds, &near[i]);
        picked[*count] = (uint32_t)k;
        *count += meets;
    }
    return true;
}

/* Numbers the triangles of all shapes. */
static bool number(triangles *t) {
    bool large = false;
    for (size_t i = 0; i < t->shape_count; ++i)
        large |= t->scene->shapes[t->shapes[i]]->mesh.triangle_count > LARGE_MESH;
    box *const boxes = large && !t->scene->stores_points ? malloc(t->shape_count * sizeof *boxes) : NULL;
    if (large && !t->scene->stores_points && boxes == NULL)
        return false;
    for (size_t i = 0; boxes != NULL && i < t->shape_count; ++i) {
        const aur_mesh *const mesh = &t->scene->shapes[t->shapes[i]]->mesh;
        boxes[i] = box_of(mesh->vertex_count, mesh->points);
    }
    bool good = true;
    size_t total = 0;
    for (size_t i = 0; good && i < t->shape_count; ++i) {
        size_t count = t->scene->shapes[t->shapes[i]]->mesh.triangle_count;
        t->starts[i] = total;
        if (boxes != NULL && count > LARGE_MESH && t->instances[i] == AUR_NO_INSTANCE)
            good = pick(t, i, boxes, &count);
        total += count;
    }
    t->starts[t->shape_count] = total <= UINT32_MAX ? total : 0; /* limit of 32-bit numbers */
    free(boxes);
    return good;
}

static void add_shape(triangles *t, uint32_t shape, uint32_t instance, uint32_t member) {
    t->shapes[t->shape_count] = shape;
    t->instances[t->shape_count] = instance;
    t->members[t->shape_count++] = member;
}

/* Groups with curved shapes are skipped. Returns the number of triangles of a group; 0: skipped. */
static size_t copied_triangles(const aur_scene *scene, const aur_shape_group *group) {
    size_t count = 0;
    for (size_t i = 0; i < group->count; ++i) {
        if (scene->shapes[group->shapes[i]]->curved != NULL)
            return 0;
        count += scene->shapes[group->shapes[i]]->mesh.triangle_count;
    }
    return count;
}

static void add_copies(triangles *t, const aur_scene *scene) {
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        const aur_shape_group *const group = scene->instances[i]->group;
        for (uint32_t k = 0; copied_triangles(scene, group) > 0 && k < group->count; ++k)
            if (scene->shapes[group->shapes[k]]->mesh.triangle_count > 0)
                add_shape(t, group->shapes[k], i, k);
    }
}

/* The triangles of a group; or those outside of groups, followed by the instances. */
static bool collect(const aur_scene *scene, const aur_shape_group *group, triangles *t) {
    size_t most = group != NULL ? group->count : scene->shape_count, copied = 0, copies = 0;
    for (size_t i = 0; group == NULL && i < scene->instance_count && copied <= MOST_COPIED; ++i) {
        copied += copied_triangles(scene, scene->instances[i]->group);
        copies += scene->instances[i]->group->count;
    }
    most += copied <= MOST_COPIED ? copies : 0;
    *t = (triangles){.scene = scene,
                     .shapes = malloc((most + 1) * sizeof *t->shapes),
                     .instances = malloc((most + 1) * sizeof *t->instances),
                     .members = malloc((most + 1) * sizeof *t->members),
                     .starts = calloc(most + 1, sizeof *t->starts),
                     .picked = calloc(most + 1, sizeof *t->picked)};
    if (t->shapes == NULL || t->instances == NULL || t->members == NULL || t->starts == NULL ||
        t->picked == NULL)
        return false;
    const size_t count = group != NULL ? group->count : scene->shape_count;
    for (size_t i = 0; i < count; ++i) {
        const aur_shape *const shape = scene->shapes[group != NULL ? group->shapes[i] : i];
        if (shape->curved == NULL && (group != NULL || !shape->grouped) && shape->mesh.triangle_count > 0)
            add_shape(t, shape->index, AUR_NO_INSTANCE, 0);
    }
    if (group == NULL && copied <= MOST_COPIED)
        add_copies(t, scene);
    return number(t);
}

static void release(triangles *t) {
    for (size_t i = 0; t->picked != NULL && i < t->shape_count; ++i)
        free(t->picked[i]);
    free(t->picked);
    free(t->shapes);
    free(t->instances);
    free(t->members);
    free(t->starts);
}

/* --- a triangle minus others */

typedef struct pieces {
    size_t count, capacity;
    piece *items;
} pieces;

static bool push(pieces *list, const piece *p) {
    if (!aur_array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items))
        return false;
    list->items[list->count++] = *p;
    return true;
}

static piece clip(const piece *p, const aur_plane *plane) {
    piece cut;
    cut.count = aur_polygon_clip(p->count, (const double(*)[3])p->corners, plane, cut.corners);
    return cut;
}

/* The plane through an edge of the covering triangle, perpendicular to its plane; inside is in front. */
static aur_plane edge_plane(const double cover[3][3], size_t e, const double normal[3], double sign) {
    double along[3];
    aur_plane plane;
    for (int d = 0; d < 3; ++d)
        along[d] = sign * (cover[(e + 1) % 3][d] - cover[e][d]);
    aur_cross3(normal, along, plane.normal);
    aur_normalize3(plane.normal);
    plane.offset = aur_dot3(plane.normal, cover[e]);
    return plane;
}

static aur_plane turned(aur_plane plane) {
    for (int d = 0; d < 3; ++d)
        plane.normal[d] = -plane.normal[d];
    plane.offset = -plane.offset;
    return plane;
}

/* The parts of a piece outside of the covering triangle. */
static bool subtract(piece p, const aur_plane edges[3], double narrow, pieces *left) {
    piece inside = p;
    for (int e = 0; e < 3 && inside.count > 0; ++e)
        inside = clip(&inside, &edges[e]);
    if (inside.count == 0 || aur_polygon_width(inside.count, (const double(*)[3])inside.corners) <= narrow)
        return push(left, &p);
    for (int e = 0; e < 3; ++e) {
        const aur_plane outwards = turned(edges[e]);
        const piece outside = clip(&p, &outwards);
        if (outside.count > 0 &&
            aur_polygon_width(outside.count, (const double(*)[3])outside.corners) > narrow &&
            !push(left, &outside))
            return false;
        p = clip(&p, &edges[e]);
    }
    return true;
}

/* Pieces have room for the corners that a cover adds. */
static bool divide(pieces *list) {
    for (size_t i = 0; i < list->count; ++i) {
        const piece p = list->items[i];
        if (p.count <= FEW_CORNERS)
            continue;
        const size_t half = p.count / 2;
        piece first = {.count = half + 1}, second = {.count = p.count - half + 1};
        memcpy(first.corners, p.corners, first.count * sizeof p.corners[0]);
        memcpy(second.corners, p.corners[half], (second.count - 1) * sizeof p.corners[0]);
        memcpy(second.corners[second.count - 1], p.corners[0], sizeof p.corners[0]);
        list->items[i] = first;
        if (!push(list, &second))
            return false;
    }
    return true;
}

/* `left` is the part of the triangle not covered, relative to its first corner. */
static bool cut_triangle(const triangles *t, const aur_overlap *covers, size_t count, pieces *left,
                         pieces *other) {
    double corners[3][3], origin[3];
    find_corners(t, covers->second, 1, &corners);
    memcpy(origin, corners[0], sizeof origin);
    piece whole = {.count = 3};
    double extent = 0.0;
    for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) {
            whole.corners[c][d] = corners[c][d] - origin[d];
            extent = fmax(extent, fabs(whole.corners[c][d]));
        }
    aur_plane plane;
    aur_polygon_plane(3, (const double(*)[3])whole.corners, &plane);
    left->count = 0;
    if (!push(left, &whole))
        return false;
    for (size_t i = 0; i < count; ++i) {
        aur_plane edges[3];
        find_corners(t, covers[i].first, 1, &corners);
        for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
                corners[c][d] -= origin[d];
        for (size_t e = 0; e < 3; ++e)
            edges[e] =
                edge_plane((const double(*)[3])corners, e, plane.normal, covers[i].opposite ? -1.0 : 1.0);
        other->count = 0;
        for (size_t k = 0; k < left->count; ++k)
            if (!subtract(left->items[k], edges, NARROWEST * extent, other))
                return false;
        const pieces swap = *left;
        *left = *other;
        *other = swap;
        if (!divide(left))
            return false;
    }
    return true;
}

/* --- meshes */

/* New triangles, three corners each, with their source triangles; and the triangles that they replace. Both
 * are ascending. */
typedef struct replacement {
    size_t count, capacity, cut_count, cut_capacity;
    struct part {
        uint32_t source;
        double corners[3][3]; /* relative to the source's first corner */
    } * parts;
    uint32_t *cut;
} replacement;

static bool add_parts(replacement *r, uint32_t source, const pieces *left) {
    if (!aur_array_reserve(&r->cut, &r->cut_capacity, r->cut_count + 1, sizeof *r->cut))
        return false;
    r->cut[r->cut_count++] = source;
    for (size_t i = 0; i < left->count; ++i)
        for (size_t c = 1; c + 1 < left->items[i].count; ++c) {
            if (!aur_array_reserve(&r->parts, &r->capacity, r->count + 1, sizeof *r->parts))
                return false;
            struct part *const added = &r->parts[r->count++];
            added->source = source;
            memcpy(added->corners[0], left->items[i].corners[0], sizeof added->corners[0]);
            memcpy(added->corners[1], left->items[i].corners[c], 2 * sizeof added->corners[0]);
        }
    return true;
}

/* Barycentric coordinates of a point in the plane of the source's corners. */
static void find_shares(const double corners[3][3], const double point[3], double shares[3]) {
    double a[3], b[3], normal[3], u[3], v[3];
    for (int d = 0; d < 3; ++d) {
        a[d] = corners[1][d] - corners[0][d];
        b[d] = corners[2][d] - corners[0][d];
    }
    aur_cross3(a, b, normal);
    aur_cross3(point, b, u);
    aur_cross3(a, point, v);
    const double square = aur_dot3(normal, normal);
    shares[1] = aur_dot3(u, normal) / square;
    shares[2] = aur_dot3(v, normal) / square;
    shares[0] = 1.0 - shares[1] - shares[2];
}

/* The array with room for `count` elements, and one more; NULL stays NULL. */
static bool widen(void **array, size_t count, size_t size) {
    void *const wider = *array != NULL ? realloc(*array, (count + 1) * size) : NULL;
    const bool good = wider != NULL || *array == NULL;
    if (good)
        *array = wider;
    return good;
}

/* Reserves space for vertices. */
static bool widen_mesh(aur_mesh *mesh, size_t vertices) {
    void *arrays[] = {mesh->points, mesh->normals, mesh->uvs, mesh->vertex_colors};
    const bool good =
        widen(&arrays[0], 3 * vertices, sizeof(double)) && widen(&arrays[1], 3 * vertices, sizeof(float)) &&
        widen(&arrays[2], 2 * vertices, sizeof(float)) && widen(&arrays[3], 3 * vertices, sizeof(float));
    mesh->points = arrays[0];
    mesh->normals = arrays[1];
    mesh->uvs = arrays[2];
    mesh->vertex_colors = arrays[3];
    return good;
}

static void mix(float *values, size_t width, const uint32_t from[3], const double shares[3], size_t to) {
    for (size_t k = 0; values != NULL && k < width; ++k) {
        double sum = 0.0;
        for (size_t c = 0; c < 3; ++c)
            sum += shares[c] * (double)values[width * from[c] + k];
        values[width * to + k] = (float)sum;
    }
}

static void normalize(float *normal) {
    const float length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int d = 0; d < 3 && length > 0.0f; ++d)
        normal[d] /= length;
}

/* Appends the three vertices of a fragment to the mesh. */
static void add_vertices(aur_mesh *mesh, const struct part *part) {
    double corners[3][3];
    const uint32_t *const from = &mesh->indices[3 * (size_t)part->source];
    corners_of(mesh, part->source, corners);
    for (size_t c = 0; c < 3; ++c) {
        double shares[3];
        const size_t to = mesh->vertex_count++;
        find_shares((const double(*)[3])corners, part->corners[c], shares);
        for (int d = 0; d < 3; ++d)
            mesh->points[3 * to + d] = corners[0][d] + part->corners[c][d];
        mix(mesh->normals, 3, from, shares, to);
        if (mesh->normals != NULL)
            normalize(&mesh->normals[3 * to]);
        mix(mesh->uvs, 2, from, shares, to);
        mix(mesh->vertex_colors, 3, from, shares, to);
    }
}

/* Triangles keep their order; fragments replace the triangles that were cut. */
static bool replace(aur_mesh *mesh, const replacement *r) {
    const size_t vertices = mesh->vertex_count + 3 * r->count,
                 count = mesh->triangle_count - r->cut_count + r->count;
    uint32_t *const indices = malloc((3 * count + 1) * sizeof *indices);
    uint32_t *const sources = malloc((count + 1) * sizeof *sources);
    float *const colors = mesh->face_colors != NULL ? malloc((3 * count + 1) * sizeof *colors) : NULL;
    if (indices == NULL || sources == NULL || (colors == NULL && mesh->face_colors != NULL) ||
        vertices > UINT32_MAX - 1 || !widen_mesh(mesh, vertices)) {
        free(indices);
        free(sources);
        free(colors);
        return false;
    }
    size_t written = 0, cut = 0, part = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const bool whole = cut == r->cut_count || r->cut[cut] != i;
        cut += !whole;
        for (bool first = true; whole ? first : part < r->count && r->parts[part].source == i;
             first = false, ++written) {
            sources[written] = mesh->sources != NULL ? mesh->sources[i] : (uint32_t)i;
            if (colors != NULL)
                memcpy(&colors[3 * written], &mesh->face_colors[3 * i], 3 * sizeof *colors);
            for (uint32_t c = 0; c < 3; ++c)
                indices[3 * written + c] =
                    whole ? mesh->indices[3 * i + c] : (uint32_t)mesh->vertex_count + c;
            if (!whole)
                add_vertices(mesh, &r->parts[part++]);
        }
    }
    free(mesh->indices);
    free(mesh->face_colors);
    mesh->indices = indices;
    mesh->face_colors = colors;
    if (mesh->sources == NULL)
        mesh->source_count = mesh->triangle_count;
    free(mesh->sources);
    mesh->sources = sources;
    mesh->triangle_count = count;
    return true;
}

/* --- scenes */

/* The fragments of one shape's triangles, from their overlaps with earlier triangles. */
static bool cut_shape(const triangles *t, const aur_overlap *overlaps, size_t count, replacement *r) {
    pieces left = {0}, other = {0};
    bool good = true;
    const size_t shape = find_shape(t, overlaps->second);
    for (size_t i = 0, end; i < count && good; i = end) {
        for (end = i + 1; end < count && overlaps[end].second == overlaps[i].second; ++end)
            continue;
        good = cut_triangle(t, &overlaps[i], end - i, &left, &other) &&
               add_parts(r, (uint32_t)find_triangle(t, shape, overlaps[i].second), &left);
    }
    free(left.items);
    free(other.items);
    return good;
}

static void note(aur_scene *scene, const triangles *t, const aur_overlap *first, size_t cut) {
    aur_scene_overlap *const noted = &scene->overlap;
    if (noted->count == 0) {
        const size_t shapes[2] = {find_shape(t, first->first), find_shape(t, first->second)};
        for (size_t k = 0; k < 2; ++k) {
            noted->shapes[k] = t->shapes[shapes[k]];
            noted->triangles[k] =
                (uint32_t)find_triangle(t, shapes[k], k == 0 ? first->first : first->second);
        }
    }
    noted->count += cut;
}

/* Fragments are relative to a corner of their source: only the linear part of the map applies. */
static void make_local(const aur_transform *to_local, replacement *r) {
    for (size_t i = 0; i < 3 * r->count; ++i) {
        double *const corner = r->parts[i / 3].corners[i % 3];
        const double world[3] = {corner[0], corner[1], corner[2]};
        for (int d = 0; d < 3; ++d)
            corner[d] = aur_dot3(&to_local->m[4 * d], world);
    }
}

/* Computes the vertex normals that fragments interpolate. */
static aur_result smooth(aur_shape *shape, aur_error *error) {
    aur_mesh *const mesh = &shape->mesh;
    mesh->positions = malloc((3 * mesh->vertex_count + 1) * sizeof *mesh->positions);
    if (mesh->positions == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
        mesh->positions[i] = (float)(mesh->points[i] - mesh->points[i % 3]);
    const aur_result result = aur_mesh_smooth(mesh, shape->location, error);
    free(mesh->positions);
    mesh->positions = NULL;
    shape->smooth = false;
    return result;
}

/* The overlaps of one shape's triangles, or of an instance, which then gets a separate group. */
static aur_result cut_one(aur_scene *scene, const triangles *t, size_t slot, const aur_overlap *overlaps,
                          size_t count, size_t *cut, aur_error *error) {
    replacement r = {0};
    aur_result result = cut_shape(t, overlaps, count, &r) ? AUR_OK : aur_fail_memory(error);
    aur_shape *shape = scene->shapes[t->shapes[slot]];
    if (result == AUR_OK && t->instances[slot] != AUR_NO_INSTANCE) {
        aur_instance *const instance = scene->instances[t->instances[slot]];
        if (instance->group->shapes[t->members[slot]] == t->shapes[slot])
            result = aur_instance_separate_group(scene, instance, error);
        if (result == AUR_OK)
            shape = scene->shapes[instance->group->shapes[t->members[slot]]];
        make_local(&instance->to_local, &r);
    }
    if (result == AUR_OK && shape->smooth)
        result = smooth(shape, error);
    if (result == AUR_OK && !replace(&shape->mesh, &r))
        result = aur_fail_memory(error);
    if (result == AUR_OK)
        shape->parallelogram = false;
    *cut += r.cut_count;
    free(r.parts);
    free(r.cut);
    return result;
}

/* Cuts from the last shape to the first, because covering triangles must still be complete. */
static aur_result cut_shapes(aur_scene *scene, const triangles *t, const aur_overlaps *overlaps,
                             aur_error *error) {
    size_t cut = 0;
    aur_result result = AUR_OK;
    for (size_t end = overlaps->count, begin; end > 0 && result == AUR_OK; end = begin) {
        const size_t slot = find_shape(t, overlaps->items[end - 1].second);
        for (begin = end - 1; begin > 0 && overlaps->items[begin - 1].second >= t->starts[slot]; --begin)
            continue;
        result = cut_one(scene, t, slot, &overlaps->items[begin], end - begin, &cut, error);
    }
    if (result == AUR_OK && overlaps->count > 0)
        note(scene, t, overlaps->items, cut);
    return result;
}

static aur_result cut_group(aur_scene *scene, const aur_shape_group *group, size_t threads,
                            aur_error *error) {
    triangles t;
    aur_overlaps overlaps = {0};
    aur_result result = collect(scene, group, &t) ? AUR_OK : aur_fail_memory(error);
    const aur_triangle_source source = {t.starts != NULL ? t.starts[t.shape_count] : 0, &t, find_corners,
                                        scene->stores_points};
    if (result == AUR_OK)
        result = aur_overlaps_find(&source, threads, &overlaps, error);
    size_t remaining = 0;
    for (size_t i = 0; i < overlaps.count; ++i)
        if (scene->overlap_rule != AUR_OVERLAPS_OF_FRONTS || !overlaps.items[i].opposite)
            overlaps.items[remaining++] = overlaps.items[i];
    overlaps.count = remaining;
    if (result == AUR_OK)
        result = cut_shapes(scene, &t, &overlaps, error);
    aur_overlaps_release(&overlaps);
    release(&t);
    return result;
}

aur_result aur_scene_cut_overlaps(aur_scene *scene, size_t threads, aur_error *error) {
    if (scene->overlap_rule == AUR_OVERLAPS_STAY)
        return AUR_OK;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < scene->group_count && result == AUR_OK; ++i)
        result = cut_group(scene, scene->groups[i], threads, error);
    if (result == AUR_OK)
        result = cut_group(scene, NULL, threads, error);
    return result;
}

static const char *name_of(const aur_scene *scene, uint32_t shape) {
    const aur_xml_document *const document = &scene->document;
    for (size_t k = 0; k < document->tree.id_count; ++k)
        if (document->tree.ids[k].node->object == scene->shapes[shape])
            return document->tree.ids[k].id;
    return scene->shapes[shape]->descriptor->row.name;
}

void aur_scene_warn_of_overlaps(const aur_scene *scene, const aur_warnings *warnings) {
    const aur_scene_overlap *const found = &scene->overlap;
    if (found->count == 0)
        return;
    const aur_shape *const first = scene->shapes[found->shapes[0]];
    if (first->location.line == 0) { /* shapes of a model have neither a line nor a name */
        aur_warn_at(warnings, scene->shapes[found->shapes[1]]->location,
                    "%zu triangles lie in the plane of others that come first in the file, and are cut where "
                    "those cover them",
                    found->count);
        return;
    }
    aur_warn_at(
        warnings, scene->shapes[found->shapes[1]]->location,
        "%zu triangles lie in the plane of others that come first in the file, and are cut where those "
        "cover them: the first is triangle %u of shape '%s', behind triangle %u of '%s' at %s:%zu",
        found->count, (unsigned)found->triangles[1], name_of(scene, found->shapes[1]),
        (unsigned)found->triangles[0], name_of(scene, found->shapes[0]), first->location.file,
        first->location.line);
}
