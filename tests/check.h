/* cmocka with the headers that it requires, and further assertions. */
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* |actual - expected| <= tolerance; NaN fails. */
#define assert_near(actual, expected, tolerance)                                                             \
    check_near((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

static inline void check_near(double actual, double expected, double tolerance, const char *what,
                              const char *file, int line) {
    if (fabs(actual - expected) <= tolerance)
        return;
    print_error("%s = %.17g, expected %.17g within %g\n", what, actual, expected, tolerance);
    _fail(file, line);
}

#define assert_relative(actual, expected, tolerance)                                                         \
    check_near((actual), (expected), fabs(expected) * (tolerance), #actual, __FILE__, __LINE__)
