/* Sine and cosine of an eighth of a turn to either side, for a double and for the lanes of a vector,
 * bit-identical: a file that includes this defines REAL, the type, and NAME, the function's name. The
 * polynomials on t in [-1,1], in powers of t^2, give sin(pi t/4) to 4e-17 and cos(pi t/4) to 2e-17 (minimax),
 * in plain multiplications and additions. */
static inline void NAME(REAL t, REAL *sine, REAL *cosine) {
    const REAL q = t * t, q2 = q * q, q4 = q2 * q2;
    /* by pairs (Estrin), whose chains of dependent operations are half as long as Horner's */
    const REAL s01 = -0x1.4abbce625be52p-4 * q + 0x1.921fb54442d18p-1;
    const REAL s23 = -0x1.32d2cce500387p-15 * q + 0x1.466bc6775a476p-9;
    const REAL s45 = -0x1.e3027dea82bd7p-30 * q + 0x1.50783208843ebp-22;
    const REAL s46 = 0x1.e4a9d9166f052p-38 * q2 + s45;
    *sine = (s46 * q4 + (s23 * q2 + s01)) * t;
    const REAL c01 = -0x1.3bd3cc9be45dep-2 * q + 1.0;
    const REAL c23 = -0x1.55d3c7e3cb241p-12 * q + 0x1.03c1f081b5ac0p-6;
    const REAL c45 = -0x1.a6d1eef479be1p-26 * q + 0x1.e1f5068688d5bp-19;
    const REAL c67 = -0x1.b2f3eb054afcdp-42 * q + 0x1.f9ce245cada0bp-34;
    *cosine = (c67 * q2 + c45) * q4 + (c23 * q2 + c01);
}
#undef REAL
#undef NAME
