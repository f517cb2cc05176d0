#include <aureole/statistics.h>
#include <math.h>
#include <stdbool.h>

void aur_moments_add(aur_moments *moments, double value) {
    const double difference = value - moments->mean;
    ++moments->count;
    moments->mean += difference / (double)moments->count;
    moments->squares += difference * (value - moments->mean);
}

double aur_moments_variance(const aur_moments *moments) {
    return moments->count < 2 ? 0.0 : moments->squares / (double)(moments->count - 1);
}

double aur_moments_standard_error(const aur_moments *moments) {
    return moments->count < 2 ? 0.0 : sqrt(aur_moments_variance(moments) / (double)moments->count);
}

double aur_moments_interval(const aur_moments *moments, double confidence) {
    if (moments->count < 2)
        return 0.0;
    return aur_moments_standard_error(moments) *
           aur_student_quantile(moments->count - 1, 0.5 * (1.0 + confidence));
}

/* P(|T| < t) of Student's t for a whole number of degrees, by its finite series in the angle whose tangent is
 * t / sqrt(degrees) (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4). */
static double probability_within(size_t degrees, double angle) {
    const double c = cos(angle), s = sin(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? c : 1.0;
    double sum = degrees > 1 ? term : 0.0;
    for (size_t k = odd ? 3 : 2; k + 1 < degrees && term > 1e-18 * sum; k += 2) {
        term *= c * c * (double)(k - 1) / (double)k;
        sum += term;
    }
    return odd ? (angle + s * sum) / acos(0.0) : s * sum;
}

double aur_student_quantile(size_t degrees, double probability) {
    enum { MOST_DEGREES = 1000000 }; /* from there on the quantile is the normal's within 1e-5 */
    if (degrees == 0 || !(probability > 0.0 && probability < 1.0))
        return (double)NAN;
    degrees = degrees < MOST_DEGREES ? degrees : MOST_DEGREES;
    const double within = fabs(2.0 * probability - 1.0);
    double low = 0.0, high = acos(0.0);
    for (int i = 0; i < 64; ++i) {
        const double middle = 0.5 * (low + high);
        if (probability_within(degrees, middle) < within)
            low = middle;
        else
            high = middle;
    }
    return copysign(tan(low) * sqrt((double)degrees), probability - 0.5);
}
