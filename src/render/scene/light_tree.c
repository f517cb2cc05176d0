#include "render/scene/light_tree.h"

#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/vector3d.h"

/* --- bounds of several lights */

static double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static double angle_between(const double a[3], const double b[3]) {
    double cross[3];
    aur_cross3(a, b, cross);
    return atan2(aur_length3(cross), aur_dot3(a, b));
}

static void set_spread(aur_light_bounds *bounds, double spread) {
    bounds->spread = spread;
    bounds->spread_cosine = cos(spread);
}

/* Extends the normal cone of `into` to contain that of `other`, which is not wider. */
static void widen_cone(aur_light_bounds *into, const aur_light_bounds *other) {
    if (!(other->spread > 0.0) && aur_dot3(into->axis, other->axis) >= into->spread_cosine)
        return;
    const double apart = angle_between(into->axis, other->axis);
    if (fmin(apart + other->spread, AUR_PI) <= into->spread)
        return;
    const double spread = 0.5 * (into->spread + apart + other->spread);
    const double turn = spread - into->spread;
    double across[3]; /* angle from the axis to that of the other */
    for (size_t d = 0; d < 3; ++d)
        across[d] = other->axis[d] - aur_dot3(into->axis, other->axis) * into->axis[d];
    if (spread >= AUR_PI || !(aur_normalize3(across) > 1e-9)) {
        set_spread(into, apart < 1.0 ? fmin(apart + other->spread, AUR_PI) : AUR_PI);
        return;
    }
    const double along = cos(turn), aside = sin(turn);
    for (size_t d = 0; d < 3; ++d)
        into->axis[d] = along * into->axis[d] + aside * across[d];
    aur_normalize3(into->axis);
    set_spread(into, spread);
}

/* Empty bounds have no power. */
static void add_bounds(aur_light_bounds *into, const aur_light_bounds *other) {
    if (!(other->power > 0.0))
        return;
    if (!(into->power > 0.0)) {
        *into = *other;
        return;
    }
    if (other->spread > into->spread) {
        aur_light_bounds wider = *other;
        widen_cone(&wider, into);
        for (size_t d = 0; d < 3; ++d)
            into->axis[d] = wider.axis[d];
        into->spread = wider.spread;
        into->spread_cosine = wider.spread_cosine;
    } else {
        widen_cone(into, other);
    }
    for (size_t d = 0; d < 3; ++d) {
        into->lower[d] = fmin(into->lower[d], other->lower[d]);
        into->upper[d] = fmax(into->upper[d], other->upper[d]);
    }
    into->emission = fmax(into->emission, other->emission);
    into->power += other->power;
}

static double squared_radius(const aur_light_bounds *bounds) {
    double sum = 0.0;
    for (size_t d = 0; d < 3; ++d)
        sum += 0.25 * (bounds->upper[d] - bounds->lower[d]) * (bounds->upper[d] - bounds->lower[d]);
    return sum;
}

/* The cost of the bounds, as in the article: power times the size of the sphere and the solid angle of
 * emission. */
static double cost_of(const aur_light_bounds *bounds) {
    const double spread = bounds->spread, end = fmin(spread + bounds->emission, AUR_PI);
    const double directions =
        2.0 * AUR_PI * (1.0 - cos(spread)) +
        0.5 * AUR_PI *
            (2.0 * end * sin(spread) - cos(spread - 2.0 * end) - 2.0 * spread * sin(spread) + cos(spread));
    return bounds->power > 0.0 ? bounds->power * squared_radius(bounds) * directions : 0.0;
}

/* --- splitting */

enum { BUCKETS = 12, FEW = 4, LIGHT_NUMBERS = sizeof(aur_light_children) / sizeof(float *) };

/* A range of lights: order[first .. first + count). */
typedef struct light_range {
    size_t first, count;
    aur_light_bounds bounds;
    double cost;
} light_range;

typedef struct light_builder {
    const aur_light_bounds *lights;
    uint32_t *order;
    size_t range_capacity, node_capacity, child_capacity, target_capacity;
    light_range *ranges;              /* of each node */
    float (*children)[LIGHT_NUMBERS]; /* as child_numbers has them */
} light_builder;

static double middle(const aur_light_bounds *bounds, size_t axis) {
    return 0.5 * (bounds->lower[axis] + bounds->upper[axis]);
}

static light_range range_of(const light_builder *builder, size_t first, size_t count) {
    light_range range = {.first = first, .count = count};
    for (size_t i = 0; i < count; ++i)
        add_bounds(&range.bounds, &builder->lights[builder->order[first + i]]);
    range.cost = cost_of(&range.bounds);
    return range;
}

/* A split plane between two bins along an axis. */
typedef struct light_split {
    double cost;
    size_t axis, bucket; /* the last bin before the plane */
    double low, scale;   /* the bin of a centre m is (m - low) * scale */
} light_split;

static size_t bucket_of(const light_split *split, const aur_light_bounds *light) {
    const double at = (middle(light, split->axis) - split->low) * split->scale;
    return (size_t)clamped(at, 0.0, BUCKETS - 1);
}

static double extent(const aur_light_bounds *bounds, size_t axis) {
    return bounds->upper[axis] - bounds->lower[axis];
}

static size_t longest_axis(const aur_light_bounds *bounds) {
    size_t longest = 0;
    for (size_t d = 1; d < 3; ++d)
        if (extent(bounds, d) > extent(bounds, longest))
            longest = d;
    return longest;
}

/* The best plane along one axis, if better than *best. */
static void try_axis(const light_builder *builder, const light_range *range, size_t axis, light_split *best) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < range->count; ++i) {
        const double at = middle(&builder->lights[builder->order[range->first + i]], axis);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    if (!(high > low) || !isfinite(BUCKETS / (high - low)))
        return;
    light_split split = {.axis = axis, .low = low, .scale = BUCKETS / (high - low)};
    aur_light_bounds buckets[BUCKETS] = {{.power = 0.0}}, before = {.power = 0.0}, behind = before;
    double costs[BUCKETS] = {0.0}, cost = 0.0;
    for (size_t i = 0; i < range->count; ++i) {
        const aur_light_bounds *const light = &builder->lights[builder->order[range->first + i]];
        add_bounds(&buckets[bucket_of(&split, light)], light);
    }
    for (size_t i = 0; i + 1 < BUCKETS; ++i) {
        add_bounds(&before, &buckets[i]);
        costs[i] = cost = buckets[i].power > 0.0 ? cost_of(&before) : cost;
    }
    /* The article's factor against long thin boxes. */
    const double slender =
        extent(&range->bounds, longest_axis(&range->bounds)) / extent(&range->bounds, axis);
    for (size_t i = BUCKETS - 1; i > 0; --i) {
        if (!(buckets[i].power > 0.0))
            continue;
        add_bounds(&behind, &buckets[i]);
        split.cost = slender * (costs[i - 1] + cost_of(&behind));
        split.bucket = i - 1;
        if (split.cost < best->cost)
            *best = split;
    }
}

/* Partitions lights by the plane; returns the number before it. */
static size_t partition(const light_builder *builder, const light_range *range, const light_split *split) {
    uint32_t *const order = builder->order + range->first;
    size_t before = 0;
    for (size_t i = 0; i < range->count; ++i) {
        if (bucket_of(split, &builder->lights[order[i]]) > split->bucket)
            continue;
        const uint32_t light = order[i];
        order[i] = order[before];
        order[before++] = light;
    }
    return before;
}

/* Small ranges, which are the most frequent, are split along the longest axis only. Splits a range of two or
 * more lights. */
static void split_range(const light_builder *builder, light_range *range, light_range *other) {
    light_split best = {.cost = INFINITY};
    const size_t longest = longest_axis(&range->bounds);
    for (size_t axis = 0; axis < 3 && range->count > 2; ++axis)
        if (range->count > FEW || axis == longest)
            try_axis(builder, range, axis, &best);
    size_t before = range->count / 2;
    if (best.cost < INFINITY)
        before = partition(builder, range, &best);
    const light_range whole = *range;
    *range = range_of(builder, whole.first, before);
    *other = range_of(builder, whole.first + before, whole.count - before);
}

/* --- nodes */

/* Writes the bounds of a child to the arrays of aur_light_children. */
static void child_numbers(const aur_light_bounds *bounds, double whole, float numbers[LIGHT_NUMBERS]) {
    double reach = 0.0;
    for (size_t d = 0; d < 3; ++d) {
        numbers[d] = (float)middle(bounds, d);
        numbers[3 + d] = (float)bounds->axis[d];
        reach += fmax(fabs(bounds->lower[d]), fabs(bounds->upper[d]));
    }
    /* Margin for the rounding of centres and of vectors to them. */
    numbers[6] = (float)(1.000001 * sqrt(squared_radius(bounds)) + 1e-6 * reach + 1e-15);
    numbers[7] = (float)fmax(bounds->power / whole, 1e-30);
    numbers[8] = (float)cos(bounds->spread);
    numbers[9] = (float)fabs(sin(bounds->spread));
    numbers[10] = (float)(cos(fmin(bounds->emission, AUR_PI)) - 1e-5);
}

/* A node over a range. */
static bool push_node(aur_light_tree *tree, light_builder *builder, const light_range *range, uint32_t parent,
                      uint32_t slot) {
    if (!aur_array_reserve(&builder->ranges, &builder->range_capacity, tree->node_count + 1,
                           sizeof *builder->ranges) ||
        !aur_array_reserve(&tree->nodes, &builder->node_capacity, tree->node_count + 1, sizeof *tree->nodes))
        return false;
    tree->nodes[tree->node_count] = (aur_light_node){.parent = parent, .slot = slot};
    builder->ranges[tree->node_count++] = *range;
    return true;
}

/* The range with the largest gain from splitting, or `count` if all are single lights. */
static size_t widest(size_t count, const light_range *parts) {
    size_t found = count;
    for (size_t i = 0; i < count; ++i)
        if (parts[i].count > 1 && (found == count || parts[i].cost > parts[found].cost))
            found = i;
    return found;
}

/* Creates the children of a node, and recursively those of children with several lights. */
static bool fill_node(aur_light_tree *tree, light_builder *builder, uint32_t index) {
    light_range parts[AUR_LIGHT_CHILDREN] = {builder->ranges[index]};
    const double whole = parts[0].bounds.power;
    uint32_t count = 1;
    for (size_t i; count < AUR_LIGHT_CHILDREN && (i = widest(count, parts)) < count; ++count)
        split_range(builder, &parts[i], &parts[count]);
    const size_t first = tree->child_count;
    if (!aur_array_reserve(&builder->children, &builder->child_capacity, first + count,
                           sizeof *builder->children) ||
        !aur_array_reserve(&tree->targets, &builder->target_capacity, first + count, sizeof *tree->targets))
        return false;
    tree->child_count += count;
    tree->nodes[index].first = (uint32_t)first;
    tree->nodes[index].count = count;
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t light = builder->order[parts[k].first];
        const bool single = parts[k].count == 1;
        child_numbers(&parts[k].bounds, whole, builder->children[first + k]);
        tree->targets[first + k] = single ? light | AUR_LIGHT_LEAF : (uint32_t)tree->node_count;
        if (single)
            tree->leaves[light] = (aur_light_leaf){index, k};
        else if (!push_node(tree, builder, &parts[k], index, k))
            return false;
    }
    return true;
}

/* Stores the children's data as arrays. */
static bool spread_children(aur_light_tree *tree, const light_builder *builder) {
    const size_t size = tree->child_count + AUR_LIGHT_CHILDREN;
    aur_light_children *const children = &tree->children;
    float **const arrays[LIGHT_NUMBERS] = {
        &children->center[0],     &children->center[1],   &children->center[2],  &children->axis[0],
        &children->axis[1],       &children->axis[2],     &children->radius,     &children->power,
        &children->spread_cosine, &children->spread_sine, &children->dark_cosine};
    tree->numbers = calloc(LIGHT_NUMBERS * size, sizeof *tree->numbers);
    for (size_t n = 0; n < LIGHT_NUMBERS && tree->numbers != NULL; ++n) {
        *arrays[n] = tree->numbers + n * size;
        for (size_t i = 0; i < tree->child_count; ++i)
            (*arrays[n])[i] = builder->children[i][n];
    }
    return tree->numbers != NULL;
}

aur_result aur_light_tree_create(aur_light_tree *tree, size_t count, aur_light_bounds *bounds,
                                 aur_error *error) {
    *tree = (aur_light_tree){.kernels = &AUR_KERNEL_HERE(aur_light_kernels)};
    light_builder builder = {.lights = bounds, .order = malloc((count + 1) * sizeof *builder.order)};
    tree->leaves = malloc((count + 1) * sizeof *tree->leaves);
    bool good = builder.order != NULL && tree->leaves != NULL;
    size_t lit = 0;
    for (size_t i = 0; good && i < count; ++i) {
        tree->leaves[i] = (aur_light_leaf){AUR_LIGHT_LEAF, 0};
        set_spread(&bounds[i], bounds[i].spread);
        if (bounds[i].power > 0.0)
            builder.order[lit++] = (uint32_t)i;
    }
    if (good) {
        const light_range all = range_of(&builder, 0, lit);
        good = push_node(tree, &builder, &all, 0, 0);
    }
    for (uint32_t i = 0; good && i < tree->node_count; ++i)
        good = fill_node(tree, &builder, i);
    good = good && spread_children(tree, &builder);
    free(builder.order);
    free(builder.ranges);
    free(builder.children);
    if (good)
        return AUR_OK;
    aur_light_tree_release(tree);
    return aur_fail_memory(error);
}

void aur_light_tree_release(aur_light_tree *tree) {
    free(tree->nodes);
    free(tree->targets);
    free(tree->leaves);
    free(tree->numbers);
    *tree = (aur_light_tree){.nodes = NULL};
}

/* --- choosing */

/* Importance of the children of a node, and their sum. */
static double importances(const aur_light_tree *tree, const aur_light_node *node,
                          const aur_light_reference *reference, aur_lane_numbers importance) {
    double total = 0.0;
    tree->kernels->importance(&tree->children, node->first, reference, importance);
    for (size_t k = 0; k < node->count; ++k)
        total += (double)importance[k];
    return total;
}

/* The child selected by *u, if any has importance above 0. */
static size_t choose_child(const aur_lane_numbers importance, size_t count, double total, double *u) {
    const double target = *u * total;
    double below = 0.0;
    size_t chosen = 0;
    for (size_t k = 0; k < count; ++k) {
        if (!(importance[k] > 0.0f))
            continue;
        chosen = k;
        if (target < below + (double)importance[k])
            break;
        below += (double)importance[k];
    }
    /* Rounding may lead beyond the last one. */
    if (below >= total)
        below = total - (double)importance[chosen];
    *u = clamped((target - below) / (double)importance[chosen], 0.0, 0x1.fffffffffffffp-1);
    return chosen;
}

bool aur_light_tree_descend(const aur_light_tree *tree, const aur_light_reference *reference, uint32_t target,
                            double *u, uint32_t *light, double *product) {
    while ((target & AUR_LIGHT_LEAF) == 0) {
        const aur_light_node *const node = &tree->nodes[target];
        aur_lane_numbers importance;
        const double total = importances(tree, node, reference, importance);
        if (!(total > 0.0))
            return false;
        const size_t k = choose_child(importance, node->count, total, u);
        *product *= (double)importance[k] / total;
        target = tree->targets[node->first + k];
    }
    *light = target & ~AUR_LIGHT_LEAF;
    return *product > 0.0;
}

bool aur_light_tree_choose(const aur_light_tree *tree, const aur_light_reference *reference, double *u,
                           uint32_t *light, float *probability) {
    double product = 1.0;
    const bool found = aur_light_tree_descend(tree, reference, 0, u, light, &product);
    *probability = (float)product;
    return found;
}

float aur_light_tree_probability(const aur_light_tree *tree, const aur_light_reference *reference,
                                 uint32_t light) {
    const aur_light_leaf leaf = tree->leaves[light];
    uint32_t at = leaf.node, slot = leaf.slot;
    double product = at == AUR_LIGHT_LEAF ? 0.0 : 1.0;
    while (product > 0.0) {
        const aur_light_node *const node = &tree->nodes[at];
        aur_lane_numbers importance;
        const double total = importances(tree, node, reference, importance);
        if (!(importance[slot] > 0.0f))
            return 0.0f;
        product *= (double)importance[slot] / total;
        if (at == 0)
            break;
        at = node->parent;
        slot = node->slot;
    }
    return (float)product;
}
