/* Whether what was measured agrees with what is published. */
#pragma once

#include "program/lab/lab.h"

/* The numbers of a row; those that are not there are NaN. */
lab_verdict lab_judge(double measured, double low, double high, double published, double factor);
/* "agrees", "within a factor of 1.5", "differs", "not published". */
void lab_verdict_text(lab_verdict verdict, double factor, char text[64]);
