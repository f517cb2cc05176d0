#include "lighting/viewfactors/closed_pairs.h"

#include <string.h>

#include "points/base/vector.h"
#include "points/base/vector3d.h"

/* The nonnegative nodes of the Gauss rules (0 first if the count is odd) and their weights. */
typedef struct rule {
    size_t count;
    double nodes[5], weights[5];
} rule;

static const rule rules[] = {
    {3, {0.0, 0.7745966692414834}, {0.88888888888888884, 0.55555555555555569}},
    {4, {0.33998104358485626, 0.86113631159405257}, {0.65214515486254643, 0.34785484513745357}},
    {5,
     {0.0, 0.53846931010568311, 0.90617984593866396},
     {0.56888888888888867, 0.4786286704993663, 0.23692688505618928}},
    {8,
     {0.18343464249564978, 0.52553240991632899, 0.79666647741362673, 0.96028985649753618},
     {0.36268378337836166, 0.31370664587788688, 0.22238103445337443, 0.10122853629037706}},
    {10,
     {0.14887433898163122, 0.43339539412924721, 0.67940956829902444, 0.86506336668898454,
      0.97390652851717174},
     {0.29552422471475281, 0.26926671930999652, 0.21908636251598201, 0.14945134915058039,
      0.066671344308688138}},
};

enum { THREE, FOUR, FIVE, EIGHT, TEN, MOST_NODES = 10 };

/* An edge of `length` from `start` along the unit vector `along`, with midpoint `middle`. The unit of length
 * is the distance between the polygons' means; the first mean is the origin. */
typedef struct edge {
    double start[3], along[3], middle[3];
    double length;
} edge;

static edge make_edge(const double a[3], const double b[3], const double origin[3], double unit) {
    edge e;
    for (int d = 0; d < 3; ++d) {
        e.start[d] = (a[d] - origin[d]) / unit;
        e.along[d] = (b[d] - a[d]) / unit;
        e.middle[d] = (0.5 * (a[d] + b[d]) - origin[d]) / unit;
    }
    e.length = aur_normalize3(e.along);
    return e;
}

/* t/2 ln(t^2 + h^2), 0 at t = 0. */
static double half_log(double t, double h2) {
    const double r2 = t * t + h2;
    return r2 > 0.0 ? 0.5 * t * log(r2) : 0.0;
}

/* The integral of ln |p - q| over the points q of the edge. */
static double integrate_log(const double p[3], const edge *e) {
    double way[3];
    for (int d = 0; d < 3; ++d)
        way[d] = p[d] - e->start[d];
    const double a = aur_dot3(way, e->along), b = e->length - a;
    for (int d = 0; d < 3; ++d)
        way[d] -= a * e->along[d];
    const double h2 = aur_dot3(way, way), h = sqrt(h2);
    /* The angle under which the edge is seen: atan(a / h) + atan(b / h). */
    return half_log(a, h2) + half_log(b, h2) - e->length + h * atan2(h * e->length, h2 - a * b);
}

/* Singularities of a function on a line: at position + i height, in the line's complex coordinate. */
typedef struct singularity {
    double position, height;
} singularity;

typedef struct outer {
    const edge *from, *to;
    size_t count;
    singularity singularities[3];
    double smallest; /* shortest interval that is halved: the remaining error is below 1e-15 */
} outer;

static singularity seen_from(const edge *line, const double point[3]) {
    double way[3];
    for (int d = 0; d < 3; ++d)
        way[d] = point[d] - line->start[d];
    const double position = aur_dot3(way, line->along);
    for (int d = 0; d < 3; ++d)
        way[d] -= position * line->along[d];
    return (singularity){position, aur_length3(way)};
}

/* The inner integral is singular where the line passes the ends of the other edge, and where it intersects or
 * passes it in between. */
static void find_singularities(outer *o) {
    const edge *const p = o->from, *const q = o->to;
    double end[3], way[3];
    for (int d = 0; d < 3; ++d) {
        end[d] = q->start[d] + q->length * q->along[d];
        way[d] = q->start[d] - p->start[d];
    }
    o->singularities[0] = seen_from(p, q->start);
    o->singularities[1] = seen_from(p, end);
    o->count = 2;
    double normal[3];
    aur_cross3(p->along, q->along, normal);
    const double sine = aur_normalize3(normal);
    if (sine < 1e-7)
        return; /* the singularity between the ends is as weak as the sine */
    const double cosine = aur_dot3(p->along, q->along);
    const double foot = (aur_dot3(way, p->along) - cosine * aur_dot3(way, q->along)) / (sine * sine);
    const double other = cosine * foot - aur_dot3(way, q->along);
    if (other > 0.0 && other < q->length)
        o->singularities[o->count++] = (singularity){foot, fabs(aur_dot3(way, normal)) / sine};
}

static double apply_rule(const outer *o, const rule *g, double a, double b) {
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = 0.0;
    for (size_t i = 0; i < (g->count + 1) / 2; ++i)
        for (int side = g->nodes[i] == 0.0 ? 1 : -1; side <= 1; side += 2) {
            const double x = middle + side * half * g->nodes[i];
            double p[3];
            for (int d = 0; d < 3; ++d)
                p[d] = o->from->start[d] + x * o->from->along[d];
            sum += g->weights[i] * integrate_log(p, o->to);
        }
    return half * sum;
}

/* Halves intervals longer than their distance from a singularity. */
static double integrate_piece(const outer *o, double a, double b) {
    const double length = b - a;
    if (length > o->smallest)
        for (size_t i = 0; i < o->count; ++i) {
            const singularity *const s = &o->singularities[i];
            const double distance = fmax(fmax(a - s->position, s->position - b), 0.0);
            if (distance * distance + s->height * s->height < length * length)
                return integrate_piece(o, a, 0.5 * (a + b)) + integrate_piece(o, 0.5 * (a + b), b);
        }
    return apply_rule(o, &rules[TEN], a, b);
}

/* The nodes of a rule on an edge, relative to the edge's polygon's mean `center`. */
static size_t place_nodes(const edge *e, const rule *g, const double center[3], double (*nodes)[3],
                          double *weights) {
    size_t count = 0;
    for (size_t i = 0; i < (g->count + 1) / 2; ++i)
        for (int side = g->nodes[i] == 0.0 ? 1 : -1; side <= 1; side += 2) {
            const double x = 0.5 * side * e->length * g->nodes[i];
            for (int d = 0; d < 3; ++d)
                nodes[count][d] = e->middle[d] - center[d] + x * e->along[d];
            weights[count++] = 0.5 * e->length * g->weights[i];
        }
    return count;
}

/* Distant edges: Gauss rule along both. ln r is computed from the small difference between r^2 and 1 (the
 * squared distance of the means). This preserves the digits of the sum over all edges, which is smaller than
 * its terms. */
static double integrate_far(const edge *p, const edge *q, const rule *g, const double way[3]) {
    static const double origin[3] = {0.0, 0.0, 0.0};
    double a[MOST_NODES][3], b[MOST_NODES][3], u[MOST_NODES], v[MOST_NODES];
    const size_t count = place_nodes(p, g, origin, a, u);
    place_nodes(q, g, way, b, v);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < count; ++k) {
            double difference[3], excess = 0.0;
            for (int d = 0; d < 3; ++d) {
                difference[d] = b[k][d] - a[i][d];
                excess += (2.0 * way[d] + difference[d]) * difference[d];
            }
            sum += u[i] * v[k] * 0.5 * log1p(excess);
        }
    return sum;
}

/* The integral of ln r along both edges. */
static double integrate_edges(const edge *p, const edge *q, const double way[3]) {
    double between[3];
    for (int d = 0; d < 3; ++d)
        between[d] = q->middle[d] - p->middle[d];
    const double longer = fmax(p->length, q->length);
    const double apart = aur_length3(between) - 0.5 * (p->length + q->length);
    /* The error of Gauss quadrature is rho^(-2 count), rho = y + sqrt(1 + y^2) for a singularity at y half
     * lengths. */
    if (apart > 1000.0 * longer)
        return integrate_far(p, q, &rules[THREE], way);
    if (apart > 32.0 * longer)
        return integrate_far(p, q, &rules[FOUR], way);
    if (apart > 8.0 * longer)
        return integrate_far(p, q, &rules[FIVE], way);
    outer o = {.from = p, .to = q, .smallest = 0x1p-20 * p->length};
    if (apart > 2.0 * longer)
        return apply_rule(&o, &rules[EIGHT], 0.0, p->length);
    find_singularities(&o);
    return integrate_piece(&o, 0.0, p->length);
}

static void find_mean(size_t count, const double (*corners)[3], double mean[3]) {
    mean[0] = mean[1] = mean[2] = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (int d = 0; d < 3; ++d)
            mean[d] += corners[i][d] / (double)count;
}

double aur_contour_exchange(size_t first_count, const double (*first)[3], size_t second_count,
                            const double (*second)[3]) {
    double origin[3], way[3];
    find_mean(first_count, first, origin);
    find_mean(second_count, second, way);
    for (int d = 0; d < 3; ++d)
        way[d] -= origin[d];
    const double unit = aur_normalize3(way);
    if (!(unit > 0.0))
        return 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < first_count; ++i) {
        const edge p = make_edge(first[i], first[(i + 1) % first_count], origin, unit);
        if (p.length == 0.0)
            continue;
        for (size_t k = 0; k < second_count; ++k) {
            const edge q = make_edge(second[k], second[(k + 1) % second_count], origin, unit);
            const double cosine = aur_dot3(p.along, q.along);
            if (q.length > 0.0 && cosine != 0.0)
                sum += cosine * integrate_edges(&p, &q, way);
        }
    }
    return fmax(sum * unit * unit / (2.0 * AUR_PI), 0.0);
}
