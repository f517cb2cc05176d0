/* Ranges of axes and positions of ticks. */
#include "program/report/figure.h"

#include <math.h>

double report_pixel_of(const report_ruler *r, double value) {
    const double at = r->log ? log10(value) : value;
    return r->from + (at - r->low) / (r->high - r->low) * (r->to - r->from);
}

bool report_drawable(const report_panel *panel, const report_point *p) {
    return isfinite(p->x) && isfinite(p->y) && !(panel->x.log && p->x <= 0.0) &&
           !(panel->y.log && p->y <= 0.0);
}

static void widen(report_ruler *r, double value) {
    const double at = r->log ? log10(value) : value;
    r->low = fmin(r->low, at);
    r->high = fmax(r->high, at);
}

/* Intervals that nearly reach 0 do not extend a logarithmic axis. */
static void widen_by_bar(report_ruler *r, const report_point *p) {
    if (isfinite(p->high))
        widen(r, p->high);
    if (isfinite(p->low) && (!r->log || p->low > 0.1 * p->y))
        widen(r, p->low);
}

report_ruler report_make_ruler(const report_panel *panel, bool of_y, double from, double to) {
    const report_axis *const axis = of_y ? &panel->y : &panel->x;
    report_ruler r = {axis->low, axis->high, axis->log, from, to};
    if (axis->low < axis->high) {
        r.low = axis->log ? log10(axis->low) : axis->low;
        r.high = axis->log ? log10(axis->high) : axis->high;
        return r;
    }
    bool cells = false;
    r.low = INFINITY;
    r.high = -INFINITY;
    for (size_t s = 0; s < panel->series_count; ++s) {
        const report_series *const series = &panel->series[s];
        const double half = (series->parts & REPORT_CELLS) != 0 ? 0.5 * series->cell[of_y] : 0.0;
        cells = cells || half > 0.0;
        for (size_t i = 0; i < series->count; ++i) {
            const report_point *const p = &series->points[i];
            if (!report_drawable(panel, p))
                continue;
            widen(&r, (of_y ? p->y : p->x) - half);
            widen(&r, (of_y ? p->y : p->x) + half);
            if (of_y && (series->parts & REPORT_BARS) != 0)
                widen_by_bar(&r, p);
        }
    }
    if (cells && r.low < r.high)
        return r;
    if (!(r.low <= r.high))
        r.low = r.high = 0.0;
    const double margin = r.high > r.low ? 0.05 * (r.high - r.low) : r.log ? 0.1 : 0.05 * fabs(r.high) + 1e-9;
    r.low -= margin;
    r.high += margin;
    return r;
}

void report_make_equal(report_ruler *x, report_ruler *y) {
    const double of_x = (x->high - x->low) / fabs(x->to - x->from);
    const double of_y = (y->high - y->low) / fabs(y->to - y->from);
    report_ruler *const wider = of_x < of_y ? x : y;
    const double more = 0.5 * (fmax(of_x, of_y) / fmin(of_x, of_y) - 1.0) * (wider->high - wider->low);
    wider->low -= more;
    wider->high += more;
}

size_t report_find_ticks(const report_ruler *r, double ticks[REPORT_TICK_LIMIT]) {
    static const double digits[] = {1.0, 2.0, 5.0};
    size_t count = 0;
    if (r->log && r->high - r->low > 0.8) {
        const size_t each = r->high - r->low < 2.2 ? 3 : 1;
        const double skip = fmax(1.0, ceil((r->high - r->low) / 6.0));
        for (double decade = floor(r->low); decade <= r->high; decade += skip)
            for (size_t i = 0; i < each && count < REPORT_TICK_LIMIT; ++i) {
                const double value = digits[i] * pow(10.0, decade);
                if (log10(value) >= r->low && log10(value) <= r->high)
                    ticks[count++] = value;
            }
        return count;
    }
    const double low = r->log ? pow(10.0, r->low) : r->low, high = r->log ? pow(10.0, r->high) : r->high;
    const double rough = (high - low) / 5.0, power = pow(10.0, floor(log10(rough))), part = rough / power;
    const double step = power * (part > 5.0 ? 10.0 : part > 2.0 ? 5.0 : part > 1.0 ? 2.0 : 1.0);
    for (double k = ceil(low / step); k * step <= high && count < REPORT_TICK_LIMIT; ++k)
        ticks[count++] = fabs(k) < 0.5 ? 0.0 : k * step;
    return count;
}

size_t report_legend_entries(const report_figure *figure, size_t panel, size_t capacity,
                             const report_series **entries) {
    const bool shared = figure->legend == REPORT_LEGEND_SHARED;
    const report_panel *const of = &figure->panels[panel];
    size_t count = 0;
    for (size_t s = 0; s < of->series_count && count < capacity && figure->legend != REPORT_LEGEND_NONE;
         ++s) {
        const char *const label = of->series[s].label;
        if (label != NULL && label[0] != '\0' && (shared || of->series[s].count > 0))
            entries[count++] = &of->series[s];
    }
    return count;
}
