/* The supremum over spherical caps of |mass inside - area|, exactly.
 *
 * The complement of an open cap is a closed one with the same difference, so that closed caps with too much
 * mass are enough. A smallest cap about a set of points has one point at its centre, or two points of its
 * boundary opposite each other, or three points on its boundary. So for each pair all caps through both are
 * turned about it: with u the pair's middle, v = u x (their difference) and w(t) = u cos t + v sin t the
 * centre, h cos t is the height of the boundary (h = u.x_i), and a point x is inside while (u.x - h) cos t +
 * (v.x) sin t >= 0, which is half a turn. Of three points two have indices of the same parity, so that such
 * pairs are enough. The entrances and exits are counted in bins of t, which bounds from above what any event
 * in a bin can give; only caps that could exceed the best one so far are evaluated point by point. */
#include "points/quality/sphere/voronoi.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector3d.h"

/* The tolerance of points on the boundary. A cap larger by this much contains those points, and its area
 * differs by half of it: the value of every evaluated cap is attained to this accuracy. */
static const double boundary_tolerance = 1e-13;
/* Two entrances nearer than this, as diamond angles, are counted as simultaneous. */
static const double angle_tolerance = 1e-9;
/* Points with a smaller half-circle vector lie near the pair's line: no angle is reliable. */
static const double nearby = 1e-3;

typedef struct pencils {
    const aur_axes *axes;
    size_t bin_count;      /* even */
    const double *cosines; /* the greatest cos t in each bin */
    _Atomic double *best;
    double *seen; /* per item: the best so far, for other processes */
} pencils;

typedef struct scratch {
    double *along, *across; /* u.x - h and v.x */
    double *angle;          /* of the entrance, in [0,4) */
    double *entering, *leaving;
} scratch;

/* A measure of the angle of (x, y) that grows with it from 0 to 4. */
static inline double diamond(double x, double y) {
    const double ratio = y / (fabs(x) + fabs(y));
    const double right = ratio < 0.0 ? 4.0 + ratio : ratio;
    return x >= 0.0 ? right : 2.0 - ratio;
}

/* The greatest cosine among directions whose diamond angle is in [first, last]: cos t falls from 0 to 2. */
static double greatest_cosine(double first, double last) {
    if (last >= 4.0 || first <= 0.0)
        return 1.0;
    const double nearest = first <= 2.0 && last >= 2.0 ? (first < 4.0 - last ? first : last)
                           : last <= 2.0               ? first
                                                       : last;
    const double x = nearest <= 2.0 ? 1.0 - nearest : nearest - 3.0;
    const double y = 1.0 - fabs(x);
    return x / sqrt(x * x + y * y);
}

static size_t bin_of(double angle, size_t bins) {
    const double turned = angle < 0.0 ? angle + 4.0 : angle >= 4.0 ? angle - 4.0 : angle;
    const size_t bin = (size_t)(turned * 0.25 * (double)bins);
    return bin < bins ? bin : bins - 1;
}

static void raise_best(_Atomic double *best, double value) {
    double best_so_far = atomic_load_explicit(best, memory_order_relaxed);
    while (value > best_so_far && !atomic_compare_exchange_weak(best, &best_so_far, value))
        ;
}

/* The mass in the cap {x : w.x >= height}, less its area. */
static double value_of_cap(const aur_axes *axes, const double w[3], double height) {
    double mass = 0.0;
    for (size_t k = 0; k < axes->count; ++k) {
        const double above = axes->x[k] * w[0] + axes->y[k] * w[1] + axes->z[k] * w[2] - height;
        mass += above >= 0.0 ? axes->weights[k] : 0.0;
    }
    return mass - 0.5 * (1.0 - height);
}

typedef struct frame {
    size_t i, j;
    double u[3], v[3];
    double height; /* u.x_i, at least 0 */
} frame;

static void point_at(const aur_axes *axes, size_t i, double x[3]) {
    x[0] = axes->x[i];
    x[1] = axes->y[i];
    x[2] = axes->z[i];
}

/* False for coincident points: the other pairs cover them. For opposite points any middle is valid. */
static int make_frame(const aur_axes *axes, size_t i, size_t j, frame *f) {
    f->i = i;
    f->j = j;
    double a[3], b[3], difference[3];
    point_at(axes, i, a);
    point_at(axes, j, b);
    for (int d = 0; d < 3; ++d) {
        f->u[d] = a[d] + b[d];
        difference[d] = a[d] - b[d];
    }
    if (aur_normalize3(difference) == 0.0)
        return 0;
    if (aur_normalize3(f->u) < 1e-8)
        aur_frame3(a, f->u, f->v);
    aur_cross3(f->u, difference, f->v);
    aur_normalize3(f->v);
    f->height = fmax(aur_dot3(f->u, a), 0.0);
    return 1;
}

/* The cap whose boundary passes through i, j (within the tolerance) with the centre w(t). */
static double cap_at(const aur_axes *axes, const frame *f, double cosine, double sine) {
    double w[3], a[3], b[3];
    for (int d = 0; d < 3; ++d)
        w[d] = f->u[d] * cosine + f->v[d] * sine;
    aur_normalize3(w);
    point_at(axes, f->i, a);
    point_at(axes, f->j, b);
    return value_of_cap(axes, w, fmax(fmin(aur_dot3(w, a), aur_dot3(w, b)) - boundary_tolerance, -1.0));
}

/* The half circle of a point near one of the pair, from the difference to it, which has no rounding error. */
static void refine(const aur_axes *axes, const frame *f, size_t k, scratch *s) {
    double x[3], a[3], b[3];
    point_at(axes, k, x);
    point_at(axes, f->i, a);
    point_at(axes, f->j, b);
    const double *const nearest = aur_dot3(x, a) > aur_dot3(x, b) ? a : b;
    for (int d = 0; d < 3; ++d)
        x[d] -= nearest[d];
    s->along[k] = aur_dot3(f->u, x);
    s->across[k] = aur_dot3(f->v, x);
    s->angle[k] = diamond(s->across[k], -s->along[k]);
}

/* Enters all points into the bins. Returns the mass inside at t = 0 or too near to the pair's line to decide;
 * points that enter or leave at the seam count as inside. */
static double fill_bins(const pencils *work, const frame *f, scratch *s) {
    const aur_axes *const axes = work->axes;
    const size_t count = axes->count;
    for (size_t k = 0; k < count; ++k) {
        s->along[k] = axes->x[k] * f->u[0] + axes->y[k] * f->u[1] + axes->z[k] * f->u[2] - f->height;
        s->across[k] = axes->x[k] * f->v[0] + axes->y[k] * f->v[1] + axes->z[k] * f->v[2];
    }
    /* Entrance at the direction (across, -along), half a turn before the exit. */
    for (size_t k = 0; k < count; ++k)
        s->angle[k] = diamond(s->across[k], -s->along[k]);
    for (size_t b = 0; b < work->bin_count; ++b)
        s->entering[b] = s->leaving[b] = 0.0;
    const double per_angle = 0.25 * (double)work->bin_count;
    double inside = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const double weight = axes->weights[k];
        if (fabs(s->along[k]) + fabs(s->across[k]) < nearby) {
            inside += weight;
            refine(axes, f, k, s);
            continue;
        }
        /* Enter early, leave late: the counts of the bins are upper bounds. */
        const double first = s->angle[k] - angle_tolerance;
        double last = s->angle[k] + 2.0 + angle_tolerance;
        last -= last >= 4.0 ? 4.0 : 0.0;
        /* Inside at the seam: the interval contains the angle 0. */
        inside += first < 0.0 || last <= first ? weight : 0.0;
        const size_t in = first < 0.0 ? work->bin_count - 1 : (size_t)(first * per_angle);
        const size_t out = (size_t)(last * per_angle);
        s->entering[in < work->bin_count ? in : work->bin_count - 1] += weight;
        s->leaving[out < work->bin_count ? out : work->bin_count - 1] += weight;
    }
    return inside;
}

/* Evaluates every entrance or exit in one bin. */
static void search_bin(const pencils *work, const frame *f, const scratch *s, size_t bin) {
    const size_t bins = work->bin_count;
    for (size_t k = 0; k < work->axes->count; ++k) {
        const double length = sqrt(s->along[k] * s->along[k] + s->across[k] * s->across[k]);
        if (k == f->i || k == f->j || length == 0.0)
            continue;
        const double cosine = s->across[k] / length;
        const double sine = -s->along[k] / length;
        if (bin_of(s->angle[k], bins) == bin)
            raise_best(work->best, cap_at(work->axes, f, cosine, sine));
        if (bin_of(s->angle[k] + 2.0, bins) == bin)
            raise_best(work->best, cap_at(work->axes, f, -cosine, -sine));
    }
}

static void turn_about_pair(const pencils *work, size_t i, size_t j, scratch *s) {
    frame f;
    if (!make_frame(work->axes, i, j, &f))
        return;
    /* The cap with the pair on a diameter. */
    raise_best(work->best, cap_at(work->axes, &f, 1.0, 0.0));
    if ((i + j) % 2 == 1)
        return;
    double mass = fill_bins(work, &f, s);
    for (size_t b = 0; b < work->bin_count; ++b) {
        mass += s->entering[b];
        const double bound = mass - 0.5 * (1.0 - f.height * work->cosines[b]) + 1e-12;
        mass -= s->leaving[b];
        if (bound > atomic_load_explicit(work->best, memory_order_relaxed))
            search_bin(work, &f, s, b);
    }
}

static aur_result turn_about_pairs_of(void *context, size_t index) {
    const pencils *const work = context;
    const size_t count = work->axes->count;
    double *const room = malloc((3 * count + 2 * work->bin_count) * sizeof *room);
    if (room == NULL)
        return AUR_ERROR_MEMORY;
    scratch s = {room, room + count, room + 2 * count, room + 3 * count, room + 3 * count + work->bin_count};
    for (size_t j = 0; j < index; ++j)
        turn_about_pair(work, index, j, &s);
    work->seen[index] = atomic_load(work->best);
    free(room);
    return AUR_OK;
}

/* Caps about each point and its opposite: among them those with one point at the centre, and a start for the
 * bounds. */
static double best_about_points(const aur_axes *axes, aur_height *room) {
    double best = 0.0;
    for (size_t i = 0; i < axes->count; ++i) {
        double centre[3];
        point_at(axes, i, centre);
        best = fmax(best, aur_cap_best_about(axes, centre, room));
        for (int d = 0; d < 3; ++d)
            centre[d] = -centre[d];
        best = fmax(best, aur_cap_best_about(axes, centre, room));
    }
    return best;
}

static aur_result cap(const aur_measure_request *request, double *value, aur_error *error) {
    const size_t bins = 2 * ((request->points->count + 63) / 64) * 32;
    double *const cosines = aur_arena_allocate(request->arena, bins * sizeof *cosines);
    aur_height *const room = aur_arena_allocate(request->arena, request->points->count * sizeof *room);
    double *const seen = aur_arena_allocate(request->arena, request->points->count * sizeof *seen);
    if (cosines == NULL || room == NULL || seen == NULL)
        return aur_fail_memory(error);
    aur_axes axes;
    aur_result result = aur_axes_create(request->points, &axes, error);
    if (result != AUR_OK)
        return result;
    for (size_t b = 0; b < bins; ++b)
        cosines[b] = greatest_cosine(4.0 * (double)b / (double)bins, 4.0 * (double)(b + 1) / (double)bins);
    _Atomic double best;
    atomic_init(&best, best_about_points(&axes, room));
    pencils work = {&axes, bins, cosines, &best, seen};
    result = aur_measure_items(&request->options, "turning caps", axes.count, turn_about_pairs_of, &work,
                               (aur_parallel_slice){seen, sizeof *seen, axes.count * sizeof *seen}, error);
    *value = atomic_load(&best);
    for (size_t i = 0; i < axes.count && result == AUR_OK; ++i)
        *value = fmax(*value, seen[i]);
    aur_axes_release(&axes);
    return result;
}

const aur_measure_row aur_measure_cap = {
    {.row =
         {.name = "cap",
          .summary =
              "supremum over spherical caps of |share of points - share of area|, exact; time grows as N^3",
          .source = "Marques 2013 sec. 2.1"},
     .domains = "sphere, axes"},
    .masses = 1,
    .compute = cap};
