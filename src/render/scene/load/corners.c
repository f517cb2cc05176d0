/* The corners of all surfaces. For instances, only corners that may matter, found by a tree over the shape's
 * corners. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "render/scene/load/stage.h"

/* Largest number of instances of a shape for which no tree is built; corners per leaf. */
enum { FEW_COPIES = 8, LEAF = 16 };

/* `first` is the first corner, or none for inner nodes. Nodes are in depth-first order, children right after
 * their parent; `next` is the node after the whole subtree. */
typedef struct node {
    aur_stage_box box;
    size_t first, count, next;
} node;

typedef struct corner_tree {
    size_t copies, count, capacity;
    double (*corners)[3];
    size_t node_count, node_capacity;
    node *nodes; /* NULL if out of memory: then all corners are visited */
} corner_tree;

/* --- all corners of a shape */

static void visit_point(const aur_stage_visitor *visitor, const aur_transform *to_world,
                        const double point[3]) {
    double moved[3];
    if (to_world != NULL)
        aur_transform_point(to_world, point, moved);
    visitor->visit(visitor->user, to_world != NULL ? moved : point);
}

static void visit_bounds(const aur_shape *shape, const aur_transform *to_world,
                         const aur_stage_visitor *visitor) {
    for (size_t k = 0; shape->curved != NULL && k < aur_shape_primitives(shape); ++k) {
        double sides[2][3], point[3];
        aur_shape_curved_bounds(shape, k, sides[0], sides[1]);
        for (size_t corner = 0; corner < 8; ++corner) {
            for (size_t d = 0; d < 3; ++d)
                point[d] = sides[corner >> d & 1][d];
            visit_point(visitor, to_world, point);
        }
    }
}

static void visit_shape(const aur_shape *shape, const aur_transform *to_world,
                        const aur_stage_visitor *visitor) {
    const aur_mesh *const mesh = &shape->mesh;
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        visit_point(visitor, to_world, &mesh->points[3 * (size_t)mesh->indices[i]]);
    visit_bounds(shape, to_world, visitor);
}

/* --- the tree of a shape's corners */

void aur_stage_widen(aur_stage_box *box, const double point[3]) {
    double(*const sides)[3] = box->sides;
    for (size_t d = 0; d < 3; ++d) {
        sides[0][d] = point[d] <= sides[0][d] ? point[d] : sides[0][d];
        sides[1][d] = point[d] >= sides[1][d] ? point[d] : sides[1][d];
    }
}

static void add_corner(void *user, const double point[3]) {
    corner_tree *const tree = user;
    memcpy(tree->corners[tree->count++], point, sizeof *tree->corners);
}

/* Each vertex used by a triangle, once, and the corners of bounding boxes. */
static bool collect(const aur_shape *shape, corner_tree *tree) {
    const aur_mesh *const mesh = &shape->mesh;
    const size_t bounds = shape->curved != NULL ? 8 * aur_shape_primitives(shape) : 0;
    bool *const seen = calloc(mesh->vertex_count + 1, sizeof *seen);
    const bool good = seen != NULL && aur_array_reserve(&tree->corners, &tree->capacity,
                                                        mesh->vertex_count + bounds, sizeof *tree->corners);
    tree->count = 0;
    for (size_t i = 0; good && i < 3 * mesh->triangle_count; ++i) {
        const size_t vertex = mesh->indices[i];
        if (!seen[vertex])
            add_corner(tree, &mesh->points[3 * vertex]);
        seen[vertex] = true;
    }
    if (good)
        visit_bounds(shape, NULL, &(aur_stage_visitor){.visit = add_corner, .user = tree});
    free(seen);
    return good;
}

static size_t split(double (*corners)[3], size_t count, size_t axis, double middle) {
    size_t below = 0;
    for (size_t i = 0; i < count; ++i)
        if (corners[i][axis] <= middle) {
            double held[3];
            memcpy(held, corners[i], sizeof held);
            memcpy(corners[i], corners[below], sizeof held);
            memcpy(corners[below++], held, sizeof held);
        }
    return below;
}

static bool add_node(corner_tree *tree, size_t first, size_t count) {
    double(*const corners)[3] = tree->corners + first;
    const size_t index = tree->node_count++;
    if (!aur_array_reserve(&tree->nodes, &tree->node_capacity, tree->node_count, sizeof *tree->nodes))
        return false;
    node added = {{{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}}}, first, count, 0};
    for (size_t i = 0; i < count; ++i)
        aur_stage_widen(&added.box, corners[i]);
    size_t axis = 0;
    for (size_t d = 1; d < 3; ++d)
        if (added.box.sides[1][d] - added.box.sides[0][d] >
            added.box.sides[1][axis] - added.box.sides[0][axis])
            axis = d;
    const double middle = 0.5 * added.box.sides[0][axis] + 0.5 * added.box.sides[1][axis];
    const size_t below = count > LEAF ? split(corners, count, axis, middle) : 0;
    bool good = true;
    if (below > 0 && below < count) {
        added.count = 0;
        good = add_node(tree, first, below) && add_node(tree, first + below, count - below);
    }
    added.next = tree->node_count;
    tree->nodes[index] = added;
    return good;
}

/* The box of all transformed points of a box. Rounding is monotonic, so it bounds the transformed points
 * exactly. */
static void move_box(const aur_transform *to_world, const aur_stage_box *box, aur_stage_box *moved) {
    for (size_t d = 0; d < 3; ++d)
        for (size_t side = 0; side < 2; ++side) {
            double corner[3], point[3];
            for (size_t k = 0; k < 3; ++k)
                corner[k] = box->sides[to_world->m[4 * d + k] < 0.0 ? 1 - side : side][k];
            aur_transform_point(to_world, corner, point);
            moved->sides[side][d] = point[d];
        }
}

static void visit_tree(const corner_tree *tree, const aur_transform *to_world,
                       const aur_stage_visitor *visitor) {
    for (size_t i = 0; i < tree->node_count;) {
        const node *const at = &tree->nodes[i];
        aur_stage_box moved;
        move_box(to_world, &at->box, &moved);
        const bool matters = visitor->matters(visitor->user, &moved);
        for (size_t k = 0; matters && k < at->count; ++k)
            visit_point(visitor, to_world, tree->corners[at->first + k]);
        i = matters ? i + 1 : at->next;
    }
}

static void visit_copy(const aur_shape *shape, const aur_transform *to_world, corner_tree *tree,
                       const aur_stage_visitor *visitor) {
    if (++tree->copies == FEW_COPIES + 1 && !(collect(shape, tree) && add_node(tree, 0, tree->count)))
        tree->node_count = 0;
    if (tree->node_count > 0)
        visit_tree(tree, to_world, visitor);
    else
        visit_shape(shape, to_world, visitor);
}

void aur_stage_visit_points(const aur_scene *scene, const aur_stage_visitor *visitor) {
    for (size_t i = 0; i < scene->shape_count; ++i)
        if (!scene->shapes[i]->grouped)
            visit_shape(scene->shapes[i], NULL, visitor);
    corner_tree *const trees =
        scene->instance_count > FEW_COPIES ? calloc(scene->shape_count, sizeof *trees) : NULL;
    for (size_t i = 0; i < scene->instance_count; ++i) {
        const aur_instance *const instance = scene->instances[i];
        for (size_t k = 0; k < instance->group->count; ++k) {
            const uint32_t shape = instance->group->shapes[k];
            if (trees != NULL)
                visit_copy(scene->shapes[shape], &instance->to_world, &trees[shape], visitor);
            else
                visit_shape(scene->shapes[shape], &instance->to_world, visitor);
        }
    }
    for (size_t i = 0; trees != NULL && i < scene->shape_count; ++i) {
        free(trees[i].corners);
        free(trees[i].nodes);
    }
    free(trees);
}
