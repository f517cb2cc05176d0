#include <aureole/exact.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/quadrature/check.h"
#include "points/quadrature/exact/system.h"
#include "points/sphere/lobe.h"

/* The tolerance of points below the rim of a domain: rounding. */
static const double rim = 1e-9;

static aur_result check_degree(const aur_exact_options *o, size_t most, aur_error *error) {
    if (o->degree != AUR_DEGREE_LARGEST && o->degree > most)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the degree must be at most %zu, not %zu", most,
                        o->degree);
    if (o->tolerance != 0.0 &&
        !(o->tolerance >= AUR_EXACT_TOLERANCE_MIN && o->tolerance <= AUR_EXACT_TOLERANCE_MAX))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the tolerance of exact weights must be between %g and %g, not %g",
                        AUR_EXACT_TOLERANCE_MIN, AUR_EXACT_TOLERANCE_MAX, o->tolerance);
    return AUR_OK;
}

static aur_result check_options(aur_exact_options *o, double *lowest, aur_error *error) {
    const bool sphere = o->domain == AUR_DOMAIN_SPHERE;
    if (!sphere && o->domain != AUR_DOMAIN_HEMISPHERE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "no exact weights exist on the domain '%s'",
                        aur_domain_name(o->domain));
    const double most = sphere ? 180.0 : 90.0;
    const bool wide = o->cap_degrees > 90.0 && o->cap_degrees <= 180.0;
    if (!(o->cap_degrees >= 0.0 && o->cap_degrees <= most))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the cap must be between 0 and %g degrees, not %g%s", most,
                        o->cap_degrees, wide ? ": wider ones are for the domain sphere" : "");
    if (o->cap_degrees == 0.0)
        o->cap_degrees = most;
    const aur_result result = aur_lobe_check(&o->lobe, error);
    if (result != AUR_OK)
        return result;
    const bool ggx = o->lobe.kind == AUR_LOBE_GGX;
    if (o->lobe.kind == AUR_LOBE_VISIBLE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "weights are for the light that is reflected, ggx:ALPHA:VIEW, not for visible "
                        "normals, which are for "
                        "points");
    if (o->lobe.exponent > AUR_EXACT_EXPONENT_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the exponent of a lobe of exact weights must be between 0 and %g, not %g",
                        AUR_EXACT_EXPONENT_MAX, o->lobe.exponent);
    if ((ggx || o->lobe.exponent > 0.0) && o->cap_degrees != 90.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a lobe is for the whole hemisphere");
    const aur_result degree = check_degree(o, ggx ? AUR_EXACT_GGX_DEGREE_MAX : AUR_BASIS_DEGREE_MAX, error);
    if (degree != AUR_OK)
        return degree;
    *lowest = o->cap_degrees == 180.0  ? -1.0
              : o->cap_degrees == 90.0 ? 0.0
                                       : cos(o->cap_degrees / 180.0 * AUR_PI);
    return AUR_OK;
}

typedef struct located_point {
    const double *at;
    size_t dimension, index;
} located_point;

static int compare(const void *a, const void *b) {
    const located_point *const p = a, *const q = b;
    for (size_t d = 0; d < p->dimension; ++d)
        if (p->at[d] != q->at[d])
            return p->at[d] < q->at[d] ? -1 : 1;
    return 0;
}

/* Below the surface a GGX lobe is 0. */
static bool hidden(const aur_exact_options *o, const double *direction) {
    return o->lobe.kind == AUR_LOBE_GGX && direction[2] < 0.0;
}

/* Fills near[count]: the given weights, else equal ones that coincident points share. Returns the number of
 * distinct points with weight. */
static size_t share(size_t count, size_t dimension, const double *points, const aur_exact_options *o,
                    located_point *order, double *near) {
    const double *const given = o->near;
    size_t used = 0, distinct = 0;
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        if (!hidden(o, points + dimension * i) && (given == NULL || given[i] > 0.0))
            order[used++] = (located_point){points + dimension * i, dimension, i};
    qsort(order, used, sizeof *order, compare);
    for (size_t first = 0, next; first < used; first = next) {
        for (next = first + 1; next < used && compare(&order[first], &order[next]) == 0; ++next) {
        }
        for (size_t k = first; k < next; ++k)
            near[order[k].index] = 1.0 / (double)(next - first);
        ++distinct;
    }
    for (size_t i = 0; i < count; ++i) {
        near[i] = given != NULL && !hidden(o, points + dimension * i) ? given[i] : near[i];
        sum += near[i];
    }
    for (size_t i = 0; i < count; ++i)
        near[i] /= sum;
    return distinct;
}

static aur_result check_near(size_t count, const aur_exact_options *o, aur_error *error) {
    bool some = o->near == NULL;
    for (size_t i = 0; i < count && o->near != NULL; ++i) {
        if (!(o->near[i] >= 0.0 && o->near[i] < INFINITY))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "weight %zu must be at least 0 and finite, not %g",
                            i + 1, o->near[i]);
        some = some || o->near[i] > 0.0;
    }
    return some ? AUR_OK : aur_fail(error, AUR_ERROR_ARGUMENT, "all weights to stay near to are 0");
}

static aur_result check_points(size_t count, const double *xyz, const aur_exact_options *o, double lowest,
                               aur_error *error) {
    if (count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "weights need at least one point");
    const aur_result result = aur_check_directions(count, xyz, error);
    bool some = false;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        const bool below = hidden(o, xyz + 3 * i);
        if (xyz[3 * i + 2] < lowest - rim && !below)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "point %zu (z = %g) lies outside the %s", i + 1,
                            xyz[3 * i + 2], o->cap_degrees == 90.0 ? "hemisphere" : "cap");
        some = some || (!below && (o->near == NULL || o->near[i] > 0.0));
    }
    const aur_result near = result == AUR_OK ? check_near(count, o, error) : result;
    if (near == AUR_OK && !some)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no point lies above the surface");
    return near;
}

static size_t least_of(size_t a, size_t b) {
    return a < b ? a : b;
}

/* An upper bound of the degree for so many distinct points: with more functions than points, a function of
 * degree k vanishes at all points, and its square has a positive integral. */
static size_t degree_bound(const aur_exact_system *system) {
    if (system->space == NULL)
        return least_of(2 * (size_t)sqrt((double)system->distinct_points) - 1, AUR_BASIS_DEGREE_MAX);
    size_t degree = 0;
    while (2 * degree < AUR_BASIS_DEGREE_MAX &&
           aur_exact_functions(system, degree) <= system->distinct_points)
        ++degree;
    return least_of(2 * degree - 1, AUR_BASIS_DEGREE_MAX);
}

/* The largest degree whose rows fit the limit of entries. */
static size_t room_bound(const aur_exact_system *system, size_t bound) {
    const size_t most = system->space != NULL ? AUR_EXACT_ENTRIES_MAX / system->points.count : SIZE_MAX;
    while (bound > 0 && aur_exact_functions(system, bound) > most)
        --bound;
    return bound;
}

/* A search for the largest degree by solving for a sequence of degrees. */
typedef struct ladder {
    const aur_exact_system *system;
    double *best, *candidate;
    aur_exact_found *found;
    aur_error *error;
    aur_result result;
    aur_progress progress;
    aur_progress_share share;
    double done;          /* work of the previous degrees: steps times functions */
    size_t degree, bound; /* the current degree, and the upper bound */
    size_t low, high;     /* with positive weights, and without */
    size_t ceiling;  /* no exact weights from this degree on, since weights of a degree are exact for lower
                        degrees, too */
    double steps[2]; /* of these two */
    bool hard;       /* the initial guess had no positive weights */
    bool failed[AUR_BASIS_DEGREE_MAX + 1];
} ladder;

static double functions_of(double degree) {
    return (degree + 1.0) * (degree + 1.0);
}

/* The predicted work of the current and later degrees; INFINITY: unknown. The largest degree of non-uniform
 * sets may be anywhere below the initial guess. */
static double work_left(const ladder *l, double steps) {
    enum { USUAL_TRIALS = 4, USUAL_STEPS = 90, NARROW = 2 };
    const bool bracketed = l->high <= l->bound, narrow = l->low > 0 && l->high - l->low <= NARROW;
    if (l->done == 0.0 || (l->hard && !narrow))
        return INFINITY;
    const double usual = bracketed ? 0.5 * (l->steps[0] + l->steps[1]) : USUAL_STEPS;
    const double middle = bracketed ? 0.5 * (double)(l->low + l->high) : (double)l->degree;
    double attempts = bracketed ? fmax(log2((double)(l->high - l->low)) - 1.0, 0.0) : USUAL_TRIALS,
           last = 0.0;
    if (l->degree > l->high)
        attempts = 0.0;
    for (size_t more = l->high + 1; bracketed && more <= l->high + 2 && more < l->ceiling; ++more)
        last += l->failed[more] || more <= l->degree ? 0.0 : functions_of((double)more) * l->steps[1];
    if (l->high > l->low + 1) /* one of them may be the degree `high`, which is done */
        last *= 0.75;
    return functions_of((double)l->degree) * fmax(usual - steps, 0.25 * usual) +
           functions_of(middle) * attempts * usual + last;
}

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    ladder *const l = user;
    const double left = work_left(l, (double)done);
    (void)total;
    return aur_progress_report_work(&l->progress, what, &l->share,
                                    l->done + functions_of((double)l->degree) * (double)done, left);
}

static bool climbs(ladder *l, size_t degree) {
    aur_exact_found found = {.exact = false};
    l->degree = degree;
    if (l->failed[degree])
        return false;
    if (l->result == AUR_OK)
        l->result =
            aur_exact_iterate(l->system, degree, AUR_EXACT_SEARCH_STEPS, l->candidate, &found, l->error);
    const bool good = l->result == AUR_OK && found.exact && found.least > 0.0;
    const double steps = (double)found.iterations;
    l->hard = l->hard || (l->done == 0.0 && degree > 0 && !good);
    l->done += functions_of((double)degree) * steps;
    l->failed[degree] = !good;
    if (!found.exact && degree < l->ceiling)
        l->ceiling = degree;
    if (good ? degree > l->low : degree < l->high) {
        *(good ? &l->low : &l->high) = degree;
        l->steps[good ? 0 : 1] = steps;
    }
    if (!good)
        return false;
    double *const candidate = l->candidate;
    l->candidate = l->best;
    l->best = candidate;
    *l->found = found;
    return true;
}

/* Bisection from an initial guess, and two degrees more: near the limit positivity is not monotonic in the
 * degree. */
static aur_result search(const aur_exact_system *system, size_t bound, double *weights,
                         aur_exact_found *found, aur_error *error) {
    const size_t count = system->points.count;
    double *const storage = malloc(2 * count * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    ladder l = {.best = storage,
                .candidate = storage + count,
                .found = found,
                .error = error,
                .progress = system->progress,
                .bound = bound,
                .high = bound + 1,
                .ceiling = bound + 1};
    aur_exact_system reporting = *system;
    if (system->progress.function != NULL)
        reporting.progress = (aur_progress){report, &l};
    l.system = &reporting;
    climbs(&l, 0);
    /* Uniform sets on the sphere have positive weights to about this degree; elsewhere low degrees are fast.
     */
    size_t next = system->space == NULL ? (size_t)sqrt((double)system->distinct_points / 1.3) : 1;
    for (size_t step = 1; l.low + 1 < l.high && l.result == AUR_OK;) {
        if (next >= l.high || next <= l.low)
            next = l.low + (l.high - l.low) / 2;
        if (climbs(&l, next)) {
            next = l.low + step; /* sets differ little above the guess: small steps first */
            step *= 2;
        } else {
            next = l.low + (l.high - l.low) / 2;
        }
    }
    const size_t top = l.low;
    for (size_t more = top + 2; more <= top + 3 && more < l.ceiling && l.result == AUR_OK; ++more)
        climbs(&l, more);
    memcpy(weights, l.best, count * sizeof *weights);
    free(storage);
    return l.result;
}

static aur_result judge(const aur_exact_options *o, const aur_exact_system *system,
                        const aur_exact_found *found, aur_error *error) {
    const size_t count = system->points.count;
    if (!found->exact)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "no weights were found for these %zu points (%zu distinct) that integrate all %zu %s "
                        "of degree %zu "
                        "to %g: use the largest degree that has weights",
                        count, system->distinct_points, aur_exact_functions(system, found->degree),
                        system->space != NULL && system->space->domain == AUR_DOMAIN_ROTATIONS
                            ? "functions"
                            : "polynomials",
                        found->degree, fmax(AUR_EXACT_TOLERANCE, system->tolerance));
    if (found->least <= 0.0 && !o->negative)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "degree %zu needs negative weights, the least of them %.4g/N: allow them, or use "
                        "the largest degree with positive ones",
                        found->degree, found->least * (double)count);
    return AUR_OK;
}

/* Solves by the factorisation; if rounding hid that a degree has no exact weights, with the next lower
 * degree. */
static aur_result factor(const aur_exact_system *system, size_t degree, bool search, double *weights,
                         aur_exact_found *found, aur_error *error) {
    for (;;) {
        aur_result result = aur_exact_direct(system, degree, search, weights, found, error);
        if (result != AUR_OK || !found->exact)
            return result;
        result = aur_exact_residual(system, found->degree, weights, found, error);
        found->exact = found->residual <= AUR_EXACT_TOLERANCE;
        if (result != AUR_OK || found->exact || !search || found->degree == 0)
            return result;
        degree = found->degree - 1;
    }
}

/* Most searches end at low degrees, which need fewer nodes. */
static aur_result weigh_ggx(const aur_exact_options *o, const aur_exact_system *system, const double *xyz,
                            size_t degree, bool search, double *weights, aur_exact_found *found,
                            aur_error *error) {
    aur_exact_factoring factoring = {.earlier = 0.0};
    for (size_t first = 16;; first *= 2) {
        const size_t last = search ? least_of(degree, first) : degree;
        aur_exact_nodes nodes;
        aur_result result = aur_exact_ggx_nodes(&o->lobe, last, &nodes, error);
        if (result != AUR_OK)
            return result;
        result = aur_exact_measured(system, xyz, &nodes, last, search, &factoring, weights, found, error);
        free(nodes.xyz);
        if (result != AUR_OK || last == degree || found->degree + AUR_EXACT_PATIENCE < last)
            return result;
    }
}

static aur_result solve(const aur_exact_options *o, const aur_exact_system *system, const double *xyz,
                        double *weights, aur_exact_report *report, aur_error *error) {
    const bool largest = o->degree == AUR_DEGREE_LARGEST;
    const size_t bound = degree_bound(system);
    aur_exact_found found = {.degree = largest ? 0 : o->degree};
    aur_result result = AUR_OK;
    if (!largest && o->degree > bound)
        return judge(o, system, &found, error);
    if (o->lobe.kind == AUR_LOBE_GGX)
        result = weigh_ggx(o, system, xyz, largest ? least_of(bound, AUR_EXACT_GGX_DEGREE_MAX) : o->degree,
                           largest, weights, &found, error);
    else if (system->space == NULL && system->points.count <= AUR_EXACT_DIRECT_POINTS)
        result = factor(system, largest ? bound : o->degree, largest, weights, &found, error);
    else if (largest)
        result = search(system, room_bound(system, bound), weights, &found, error);
    else
        result = aur_exact_iterate(system, o->degree, AUR_EXACT_STEPS, weights, &found, error);
    if (result == AUR_OK && found.exact)
        aur_exact_positive(system, weights, &found);
    if (result == AUR_OK)
        result = judge(o, system, &found, error);
    size_t hidden_count = 0;
    for (size_t i = 0; i < system->points.count; ++i)
        hidden_count += hidden(o, xyz + 3 * i);
    const size_t weighed = system->points.count - hidden_count;
    const double count = (double)weighed;
    if (report != NULL)
        *report = (aur_exact_report){.degree = found.degree,
                                     .residual = found.residual,
                                     .least = found.least * count,
                                     .largest = found.largest * count,
                                     .points = weighed,
                                     .distinct_points = system->distinct_points,
                                     .iterations = found.iterations};
    return result;
}

/* All images of a point share its weight equally: functions without the symmetry are then integrated as their
 * means over the group. Axes have the group of x and -x. */
static aur_result weigh_orbits(size_t count, const double *xyz, const aur_exact_options *options,
                               const aur_point_group *group, double *weights, aur_exact_report *report,
                               aur_error *error) {
    const size_t order = group->order;
    double *const images =
        count <= SIZE_MAX / (64 * order) ? malloc((5 * order * count + 1) * sizeof *images) : NULL;
    if (images == NULL)
        return aur_fail_memory(error);
    double *const found = images + 3 * order * count, *const near = found + order * count;
    for (size_t g = 0; g < order; ++g) {
        memcpy(images + 3 * g * count, xyz, 3 * count * sizeof *xyz);
        aur_rotation_apply(&group->elements[g], count, images + 3 * g * count);
        for (size_t i = 0; i < count && options->near != NULL; ++i)
            near[g * count + i] = options->near[i];
    }
    aur_exact_options whole = *options;
    whole.domain = AUR_DOMAIN_SPHERE;
    whole.group = NULL;
    whole.near = options->near != NULL ? near : NULL;
    aur_exact_report of_images = {0};
    const aur_result result =
        aur_weights_exact(order * count, images, &whole, order * count, found, &of_images, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        weights[i] = 0.0;
        for (size_t g = 0; g < order; ++g)
            weights[i] += found[g * count + i];
    }
    of_images.points = count;
    of_images.distinct_points = (of_images.distinct_points + order - 1) / order;
    if (result == AUR_OK && report != NULL)
        *report = of_images;
    free(images);
    return result;
}

/* Weights nearest to those of the options or to equal ones, for checked points. */
static aur_result weigh(size_t count, const double *points, const aur_exact_options *o, double lowest,
                        aur_exact_space *space, double *weights, aur_exact_report *report, aur_error *error) {
    double *const storage = calloc(6 * count, sizeof *storage);
    located_point *const order = malloc(count * sizeof *order);
    aur_result result = AUR_OK;
    if (storage == NULL || order == NULL) {
        result = aur_fail_memory(error);
    } else {
        double *const near = storage + 4 * count, *const found = near + count;
        const aur_exact_system system = {
            .points = space != NULL ? (aur_polar_points){.count = count}
                                    : aur_polar_points_make(count, points, storage),
            .space = space,
            .distinct_points = share(count, space != NULL ? space->dimension : 3, points, o, order, near),
            .near = near,
            .lowest = lowest,
            .exponent = o->lobe.exponent,
            .tolerance = o->tolerance > 0.0 ? o->tolerance : AUR_EXACT_TOLERANCE_DEFAULT,
            .threads = o->threads,
            .progress = o->progress};
        result = solve(o, &system, points, found, report, error);
        if (result == AUR_OK)
            memcpy(weights, found, count * sizeof *weights);
    }
    free(storage);
    free(order);
    return result;
}

static aur_result weigh_space(size_t count, const double *points, const aur_exact_options *o, double *weights,
                              aur_exact_report *report, aur_error *error) {
    aur_exact_space space;
    aur_result result = check_degree(o, AUR_BASIS_DEGREE_MAX, error);
    if (result == AUR_OK)
        result = aur_exact_space_open(count, points, o, &space, error);
    if (result != AUR_OK)
        return result;
    result = check_near(count, o, error);
    if (result == AUR_OK)
        result = weigh(count, space.points, o, -1.0, &space, weights, report, error);
    aur_exact_space_release(&space);
    return result;
}

/* For axes and with a point group. */
static aur_result weigh_symmetric(size_t count, const double *xyz, const aur_exact_options *o,
                                  double *weights, aur_exact_report *report, aur_error *error) {
    static const aur_point_group ends = {
        .order = 2, .elements = {{{1, 0, 0, 0, 1, 0, 0, 0, 1}}, {{-1, 0, 0, 0, -1, 0, 0, 0, -1}}}};
    const bool axes = o->domain == AUR_DOMAIN_AXES;
    if (o->cap_degrees != 0.0 || (!axes && o->domain != AUR_DOMAIN_SPHERE) || (axes && o->group != NULL))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        o->cap_degrees != 0.0
                            ? "a cap is for the sphere and the hemisphere without a symmetry"
                            : "a point group is for directions of the whole sphere");
    const aur_point_group *const group = axes ? &ends : o->group;
    if (group->order < 1 || group->order > AUR_POINT_GROUP_ORDER_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a point group has between 1 and %d elements, not %zu",
                        AUR_POINT_GROUP_ORDER_MAX, group->order);
    return weigh_orbits(count, xyz, o, group, weights, report, error);
}

aur_result aur_weights_exact(size_t count, const double *points, const aur_exact_options *options,
                             size_t capacity, double *weights, aur_exact_report *report, aur_error *error) {
    aur_exact_options copy = {.size = sizeof copy};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &copy, NULL);
    double lowest = -1.0;
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_exact_options", error);
    if (result == AUR_OK)
        result = aur_check_capacity(count, capacity, error);
    if (result == AUR_OK && (copy.domain == AUR_DOMAIN_AXES || copy.group != NULL))
        return weigh_symmetric(count, points, &copy, weights, report, error);
    if (result == AUR_OK && aur_exact_space_has(copy.domain))
        return weigh_space(count, points, &copy, weights, report, error);
    if (result == AUR_OK)
        result = check_options(&copy, &lowest, error);
    if (result == AUR_OK)
        result = check_points(count, points, &copy, lowest, error);
    return result == AUR_OK ? weigh(count, points, &copy, lowest, NULL, weights, report, error) : result;
}

aur_result aur_exact_options_init(aur_domain domain, aur_exact_options *options, aur_error *error) {
    static const aur_exact_options defaults = {.size = sizeof defaults, .degree = AUR_DEGREE_LARGEST};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_exact_options", error);
    if (result == AUR_OK)
        options->domain = domain;
    return result;
}
