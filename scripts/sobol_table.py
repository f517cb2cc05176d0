#!/usr/bin/env python3
"""Writes src/points/pointset/generators/sobol_table.c from Joe and Kuo's direction numbers.

usage: scripts/sobol_table.py _sobol_direction_numbers.npz > src/points/pointset/generators/sobol_table.c

The archive is part of Debian's python3-scipy
(/usr/lib/python3/dist-packages/scipy/stats/_sobol_direction_numbers.npz). It is read without NumPy.
"""
import re
import struct
import sys
import zipfile

DIMENSIONS = 1024
NOTICE = """/* Made by scripts/sobol_table.py; do not edit.
 *
 * Direction numbers of S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional
 * projections", SIAM J. Sci. Comput. 30 (2008), 2635-2654: the first dimensions of their table
 * new-joe-kuo-6.21201, as it comes with SciPy.
 *
 * Copyright (c) 2008, Frances Y. Kuo and Stephen Joe. All rights reserved.
 *
 * Redistribution and use in source and binary forms, with or without modification, are permitted provided
 * that the following conditions are met:
 *
 * - Redistributions of source code must retain the above copyright notice, this list of conditions and the
 *   following disclaimer.
 * - Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the
 *   following disclaimer in the documentation and/or other materials provided with the distribution.
 * - Neither the names of the copyright holders nor the names of the University of New South Wales and the
 *   University of Waikato and its contributors may be used to endorse or promote products derived from this
 *   software without specific prior written permission.
 *
 * THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES, INCLUDING,
 * BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
 * DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDERS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL,
 * EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
 * SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF
 * LIABILITY, WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY
 * WAY OUT OF THE USE OF THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE. */"""
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


def print_array(name, values):
    print(f"const uint16_t {name}[] = {{")
    line = "   "
    for value in values:
        text = f" {value},"
        if len(line) + len(text) > 110:
            print(line)
            line = "   "
        line += text
    print(line)
    print("};")


def main():
    with zipfile.ZipFile(sys.argv[1]) as archive:
        polynomials = read_array(archive, "poly.npy")[:DIMENSIONS]
        initial = read_array(archive, "vinit.npy")[:DIMENSIONS]
    numbers = []
    for polynomial, row in zip(polynomials[1:], initial[1:]):
        degree = polynomial.bit_length() - 1
        if any(m % 2 == 0 or m >= 2 << k for k, m in enumerate(row[:degree])):
            raise SystemExit("a direction number is not an odd number below its power of two")
        numbers += row[:degree]
    print(NOTICE)
    print('#include "pointset/sobol_table.h"')
    print()
    print("/* clang-format off */")
    print_array("aur_sobol_polynomials", polynomials[1:])
    print()
    print_array("aur_sobol_numbers", numbers)
    print("/* clang-format on */")


if __name__ == "__main__":
    main()
