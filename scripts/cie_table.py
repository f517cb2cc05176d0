#!/usr/bin/env python3
"""Writes data/cie.txt: the CIE 1931 2 degree observer and the illuminant D65, every 5 nm.

usage: scripts/cie_table.py

Needs colour-science (PyPI), which has the CIE's data.
"""
import warnings

warnings.simplefilter("ignore")
import colour  # noqa: E402
import tables  # noqa: E402

observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
daylight = colour.SDS_ILLUMINANTS["D65"]

rows = []
for wavelength in range(360, 831, 5):
    x, y, z = (float(v) for v in observer[wavelength])
    # The CIE's functions have seven significant digits; more are left over from its spline.
    rows.append(f"{x:.7g} {y:.7g} {abs(z) if abs(z) > 1e-15 else 0:.7g} {float(daylight[wavelength]):.7g}")
tables.write("cie", rows)
