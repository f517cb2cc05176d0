#include "cases.h"

#include <stdarg.h>
#include <stdio.h>

void lab_case_put(lab_case *test_case, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const size_t room = sizeof test_case->scene - test_case->scene_size;
    const int used = vsnprintf(test_case->scene + test_case->scene_size, room, format, arguments);
    va_end(arguments);
    if (used > 0)
        test_case->scene_size += (size_t)used < room ? (size_t)used : room - 1;
}

void lab_case_patch(lab_case *test_case, const lab_patch *patch, const char *inside) {
    lab_case_put(test_case, "<shape type='polygon'><string name='vertices' value='");
    for (size_t k = 0; k < 4; ++k)
        for (size_t d = 0; d < 3; ++d)
            lab_case_put(test_case, "%.17g ",
                         patch->corner[d] + (k == 1 || k == 2 ? patch->a[d] : 0.0) +
                             (k >= 2 ? patch->b[d] : 0.0));
    lab_case_put(test_case, "'/>%s</shape>", inside);
}

void lab_case_point(lab_case *test_case, const lab_receiver *receiver, double closed, double smooth) {
    test_case->receivers[test_case->count] = *receiver;
    test_case->closed[test_case->count] = closed;
    test_case->smooth[test_case->count++] = smooth;
}
