#!/usr/bin/env python3
"""Writes src/render/scene/load/cie_table.c: the CIE 1931 2 degree observer and the illuminant D65, every 5 nm.

usage: scripts/cie_table.py > src/render/scene/load/cie_table.c

Needs colour-science (PyPI), which has the CIE's data.
"""
import warnings

warnings.simplefilter("ignore")
import colour  # noqa: E402

observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
daylight = colour.SDS_ILLUMINANTS["D65"]

print("""/* Made by scripts/cie_table.py; do not edit.
 *
 * The colour-matching functions of the CIE 1931 standard observer (CIE 15:2004, table T.4), and the standard
 * illuminant D65 (table T.1), relative to 100 at 560 nm. */
#include "scene/load/cie_table.h"

/* clang-format off */
const aur_cie_row aur_cie_table[AUR_CIE_COUNT] = {""")
for wavelength in range(360, 831, 5):
    x, y, z = (float(v) for v in observer[wavelength])
    # The CIE's functions have seven significant digits; more are left over from its spline.
    print(f"    {{{{{x:.7g}, {y:.7g}, {abs(z) if abs(z) > 1e-15 else 0:.7g}}}, {float(daylight[wavelength]):.7g}}},")
print("};\n/* clang-format on */")
