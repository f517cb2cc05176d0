#!/usr/bin/env python3
"""Writes data/sobol.txt from Joe and Kuo's direction numbers.

usage: scripts/sobol_table.py _sobol_direction_numbers.npz

The archive is part of Debian's python3-scipy
(/usr/lib/python3/dist-packages/scipy/stats/_sobol_direction_numbers.npz). It is read without NumPy.
"""
import re
import struct
import sys
import zipfile

import tables

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
CODES = {"u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q"}


def read_array(archive, name):
    data = archive.read(name)
    if data[:6] != b"\x93NUMPY":
        raise SystemExit(f"{name} is not a NumPy array")
    length_format, start = ("<H", 10) if data[6] == 1 else ("<I", 12)
    length = struct.unpack_from(length_format, data, 8)[0]
    header = data[start:start + length].decode("latin-1")
    kind = re.search(r"'descr': '[<|]([ui]\d)'", header).group(1)
    shape = [int(n) for n in re.search(r"'shape': \(([^)]*)\)", header).group(1).split(",") if n.strip()]
    fortran = "'fortran_order': True" in header
    count = 1
    for n in shape:
        count *= n
    values = struct.unpack_from(f"<{count}{CODES[kind]}", data, start + length)
    if len(shape) == 1:
        return list(values)
    rows, columns = shape
    if fortran:
        return [[values[c * rows + r] for c in range(columns)] for r in range(rows)]
    return [list(values[r * columns:(r + 1) * columns]) for r in range(rows)]


def pack(polynomial, degree, numbers):
    """The letter of the degree, then the bits that are not always 1, from the lowest on, six a letter."""
    bits, count = polynomial >> 1 & (1 << (degree - 1)) - 1, degree - 1
    for k, m in enumerate(numbers):
        bits |= m >> 1 << count
        count += k
    return LETTERS[degree] + "".join(LETTERS[bits >> at & 63] for at in range(0, count, 6))


def main():
    with zipfile.ZipFile(sys.argv[1]) as archive:
        polynomials = read_array(archive, "poly.npy")
        initial = read_array(archive, "vinit.npy")
    rows = []
    for polynomial, row in zip(polynomials[1:], initial[1:]):
        degree = polynomial.bit_length() - 1
        if any(m % 2 == 0 or m >= 2 << k for k, m in enumerate(row[:degree])):
            raise SystemExit("a direction number is not an odd number below its power of two")
        rows.append(f'"{pack(polynomial, degree, row[:degree])}"')
    tables.write("sobol", rows)


if __name__ == "__main__":
    main()
