#include "render/adaptive/choose.h"

#include <math.h>

#include "render/film/film.h"
#include <aureole/statistics.h>

enum { BLOCK = 4 };

static double value_of(const aur_replicas *replicas, size_t r, size_t pixel, size_t channel) {
    if (replicas == NULL)
        return 0.0;
    const aur_film *const film = aur_render_film(replicas->renders[r]);
    return film->counts[pixel] > 0
               ? film->sums[pixel * film->layout.channel_count + channel] / (double)film->counts[pixel]
               : 0.0;
}

/* The sum over a block's values of the mean of D_r D_s over r != s. */
static double products_of_block(const aur_replicas *biased, const aur_replicas *unbiased, size_t first,
                                size_t x0, size_t y0) {
    const aur_film_layout *const layout = &aur_render_film(biased->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    double products = 0.0;
    for (size_t y = y0; y < y0 + BLOCK && y < height; ++y)
        for (size_t x = x0; x < x0 + BLOCK && x < width; ++x)
            for (size_t channel = 0; channel < 3; ++channel) {
                double sum = 0.0, squares = 0.0;
                for (size_t r = 0; r < biased->count; ++r) {
                    const double d = value_of(biased, r, y * width + x, first + channel) -
                                     value_of(unbiased, r, y * width + x, channel);
                    sum += d;
                    squares += d * d;
                }
                products += sum * sum - squares;
            }
    return products / ((double)biased->count * (double)(biased->count - 1));
}

/* Of three channels from `first` on. */
static aur_bias bias_of(const aur_replicas *biased, const aur_replicas *unbiased, size_t first, double mean,
                        double confidence) {
    const aur_film_layout *const layout = &aur_render_film(biased->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    double sum = 0.0, squares = 0.0;
    size_t count = 0;
    for (size_t y = 0; y < height; y += BLOCK)
        for (size_t x = 0; x < width; x += BLOCK, ++count) {
            const double products = products_of_block(biased, unbiased, first, x, y);
            sum += products;
            squares += products * products;
        }
    const double blocks = (double)count;
    const double scale = 1.0 / (3.0 * (double)(width * height) * mean * mean);
    const double spread =
        blocks > 1.0 ? sqrt(fmax(squares - sum * sum / blocks, 0.0) * blocks / (blocks - 1.0)) : fabs(sum);
    const double quantile = blocks > 1.0 ? aur_student_quantile(count - 1, 0.5 * (1.0 + confidence)) : 2.0;
    return (aur_bias){.estimate = scale * sum,
                      .low = fmax(scale * (sum - quantile * spread), 0.0),
                      .high = scale * (fmax(sum, 0.0) + quantile * spread)};
}

aur_bias aur_replicas_bias(const aur_replicas *biased, const aur_replicas *unbiased, double mean,
                           double confidence) {
    return bias_of(biased, unbiased, 0, mean, confidence);
}

aur_bias aur_replicas_sharing_bias(const aur_replicas *replicas, double mean, double confidence) {
    const aur_film *const film = aur_render_film(replicas->renders[0]);
    enum { COLOURS = 3 };
    return film->layout.channel_count < 2 * COLOURS ? (aur_bias){0}
                                                    : bias_of(replicas, NULL, COLOURS, mean, confidence);
}

aur_bias aur_bias_of_both(aur_bias a, aur_bias b) {
    const double least = fmax(sqrt(a.low) - sqrt(b.high), sqrt(b.low) - sqrt(a.high));
    const double most = sqrt(a.high) + sqrt(b.high);
    return (aur_bias){
        .estimate = a.estimate + b.estimate, .low = least > 0.0 ? least * least : 0.0, .high = most * most};
}
