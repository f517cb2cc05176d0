/* The standard observer and daylight, every 5 nm. */
#pragma once

enum { AUR_CIE_FIRST = 360, AUR_CIE_LAST = 830, AUR_CIE_STEP = 5, AUR_CIE_COUNT = 95 }; /* nanometres */

typedef struct aur_cie_row {
    double xyz[3]; /* CIE 1931, 2 degrees */
    double d65;    /* 100 at 560 nm */
} aur_cie_row;

extern const aur_cie_row aur_cie_table[AUR_CIE_COUNT];
