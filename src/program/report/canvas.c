#include "program/report/canvas.h"

#include <string.h>

/* Widths of " " to "~" in thousandths of the font size (Adobe's metrics of Helvetica). */
static const unsigned short widths[] = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};

uint32_t report_next_letter(const char **text) {
    static const uint32_t least[] = {0, 0x80, 0x800, 0x10000};
    const unsigned char *const c = (const unsigned char *)*text;
    const size_t more = c[0] < 0xc0 ? 0 : c[0] < 0xe0 ? 1 : c[0] < 0xf0 ? 2 : 3;
    *text += c[0] != '\0';
    if (c[0] < 0x80)
        return c[0];
    uint32_t letter = c[0] & (0x3fU >> more);
    for (size_t i = 1; i <= more; ++i) {
        if ((c[i] & 0xc0) != 0x80)
            return 0xfffd;
        letter = letter << 6 | (c[i] & 0x3f);
    }
    const bool surrogate = letter >= 0xd800 && letter < 0xe000, none = (letter & 0xfffe) == 0xfffe;
    if (more == 0 || c[0] > 0xf4 || letter < least[more] || letter > 0x10ffff || surrogate || none)
        return 0xfffd;
    *text += more;
    return letter;
}

double report_text_width(const char *text) {
    double width = 0.0;
    for (uint32_t letter; (letter = report_next_letter(&text)) != 0;)
        width += letter >= ' ' && letter < 127 ? widths[letter - ' '] : 556;
    return 0.001 * REPORT_TEXT_SIZE * width;
}

report_pen report_pen_of(unsigned ink, double width) {
    /* The colors of series are distinguishable in print and by the color-blind (Okabe and Ito 2008). */
    static const uint32_t colors[REPORT_INK_SERIES + 8] = {0x0d0d0d, 0xc7c7c7, 0xdddddd, 0x999999, 0,
                                                           0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0x000000,
                                                           0x56b4e9, 0xe69f00, 0x666666};
    const bool series = ink >= REPORT_INK_SERIES;
    return (report_pen){ink, colors[series ? REPORT_INK_SERIES + (ink - REPORT_INK_SERIES) % 8 : ink], width,
                        series && ink >= REPORT_INK_SERIES + 8};
}

uint32_t report_scale_color(const report_scale *scale, double value) {
    const double part = (value - scale->low) / (scale->high - scale->low);
    const double at = (part > 0.0 ? part < 1.0 ? part : 1.0 : 0.0) * (double)(scale->stop_count - 1);
    const size_t below = (size_t)at + 2 > scale->stop_count ? scale->stop_count - 2 : (size_t)at;
    uint32_t color = 0;
    for (unsigned shift = 0; shift < 24; shift += 8) {
        const double a = (double)(scale->stops[below] >> shift & 255),
                     b = (double)(scale->stops[below + 1] >> shift & 255);
        color |= (uint32_t)(a + (at - (double)below) * (b - a) + 0.5) << shift;
    }
    return color;
}
