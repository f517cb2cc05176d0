#include "program/lab/verdict.h"

#include <aureole/text.h>
#include <math.h>

lab_verdict lab_judge(double measured, double low, double high, double published, double factor) {
    if (isnan(published))
        return LAB_UNPUBLISHED;
    if (published == measured || (published >= low && published <= high))
        return LAB_AGREES;
    const double ratio = published / measured;
    return ratio <= factor && ratio >= 1.0 / factor ? LAB_WITHIN : LAB_DIFFERS;
}

void lab_verdict_text(lab_verdict verdict, double factor, char text[64]) {
    static const char *const names[LAB_VERDICTS] = {"agrees", "within a factor of %g", "differs",
                                                    "not published"};
    aur_format(text, 64, names[verdict], factor);
}
