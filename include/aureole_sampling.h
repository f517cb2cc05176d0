/* Aureole's sample points in one header: copy it, include it. C99 or later and C++11 or later; no state, no
 * memory, no library to link but the mathematical one. Every point is a function of its index, so any thread
 * may ask for any of them.
 *
 * Made by scripts/single_header.py from the library's sources, whose points these are to the last bit where
 * the compiler fuses no multiplication with an addition (-ffp-contract=off, or a processor without such
 * instructions).
 *
 *     aureole_sampler sampler = aureole_sampler_begin(seed, x, y, sample);   for one sample of one pixel
 *     float u[2];
 *     aureole_draw_2d(&sampler, u);                                          the next pair, Owen-scrambled
 * Sobol
 *
 * In CUDA (nvcc, clang) every function is for the host and for the device. Sets of the square and the sampler
 * take operations on integers and exact ones on numbers, and so have the same bits on both. So have maps and
 * sets of the sphere where the compilers fuse nothing (nvcc -fmad=false): each of their operations is rounded
 * to nearest. aureole_grid_first_shift takes pow, which is not. examples/cuda/sampling.cu compares host and
 * device. ISPC takes the macros below, and has not been tried. */
#ifndef AUREOLE_SAMPLING_H
#define AUREOLE_SAMPLING_H

/* Before each function, and before each table of constants. Define both before the header to choose others.
 */
#ifndef AUREOLE_INLINE
#if defined(__CUDACC__) || defined(__CUDA__)
#define AUREOLE_INLINE static inline __host__ __device__
#ifdef __CUDA_ARCH__ /* the processor reads a table of its own */
#define AUREOLE_TABLE static __device__ const
#else
#define AUREOLE_TABLE static const
#endif
#else
#define AUREOLE_INLINE static inline
#define AUREOLE_TABLE static const
#endif
#endif

#ifdef ISPC
typedef uint32 uint32_t;
typedef int64 int64_t;
typedef uint64 uint64_t;
typedef uint64 size_t;
#define UINT64_C(number) number##ULL
#else
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#endif

/* --- hashes: counter-based random numbers
 *
 * The mixer is the 64-bit finalizer of SplitMix (Steele, Lea, Flood 2014, with Stafford's "Mix13" constants).
 */

AUREOLE_INLINE uint64_t aureole_mix64(uint64_t x) {
    x ^= x >> 30;
    x *= UINT64_C(0xbf58476d1ce4e5b9);
    x ^= x >> 27;
    x *= UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return x;
}

/* A hash of a pair. Chain it for more: aureole_hash2(aureole_hash2(a, b), c). The order matters. */
AUREOLE_INLINE uint64_t aureole_hash2(uint64_t a, uint64_t b) {
    return aureole_mix64(aureole_mix64(a + UINT64_C(0x9e3779b97f4a7c15)) ^
                         (b * UINT64_C(0xd6e8feb86659fd93)));
}

AUREOLE_INLINE uint64_t aureole_hash3(uint64_t a, uint64_t b, uint64_t c) {
    return aureole_hash2(aureole_hash2(a, b), c);
}

/* The top 53 bits as a double in [0,1). */
AUREOLE_INLINE double aureole_unit_double(uint64_t hash) {
    return (double)(hash >> 11) * 0x1p-53;
}

/* 24 bits as a float in [0,1). */
AUREOLE_INLINE float aureole_unit_float(uint32_t bits) {
    return (float)(bits >> 8) * 0x1p-24f;
}

/* --- words: the coordinate x / 2^32 or x / 2^64 as an integer x */

AUREOLE_INLINE uint32_t aureole_reverse_bits(uint32_t x) {
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__CUDA__)
    x = __builtin_bswap32(x);
#else
    x = x >> 24 | (x >> 8 & 0xff00u) | (x & 0xff00u) << 8 | x << 24;
#endif
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

/* Sobol's first dimension: the radical inverse in base 2 (van der Corput). */
AUREOLE_INLINE uint32_t aureole_sobol_first(uint32_t index) {
    return aureole_reverse_bits(index);
}

/* Sobol's second dimension: its generator matrix is Pascal's triangle modulo 2. By Lucas' theorem the entry
 * (i, j) is 1 exactly when the bits of i are among those of j, so the product is a superset sum over the five
 * bits of a bit's position: five masked steps in place of up to 32 rows. The result's bits are reversed. */
AUREOLE_INLINE uint32_t aureole_sobol_second_reversed(uint32_t index) {
    uint32_t x = index;
    x ^= x >> 1 & 0x55555555u;
    x ^= x >> 2 & 0x33333333u;
    x ^= x >> 4 & 0x0f0f0f0fu;
    x ^= x >> 8 & 0x00ff00ffu;
    return x ^ x >> 16;
}

AUREOLE_INLINE uint32_t aureole_sobol_second(uint32_t index) {
    return aureole_reverse_bits(aureole_sobol_second_reversed(index));
}

/* A permutation of words in which a bit depends on the lower bits only (Laine and Karras 2011, with constants
 * selected by the criteria of Burley 2020). */
AUREOLE_INLINE uint32_t aureole_nested_hash(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Nested uniform (Owen) scrambling by hashing: every bit is flipped by a hash of the bits above it. */
AUREOLE_INLINE uint32_t aureole_owen_scramble(uint32_t x, uint32_t seed) {
    return aureole_reverse_bits(aureole_nested_hash(aureole_reverse_bits(x), seed));
}

/* The largest double below 1. */
#define AUREOLE_BELOW_ONE (1.0 - 0x1p-53)

/* Truncated to 53 binary digits, never rounded: a point stays in its elementary interval and below 1. */
AUREOLE_INLINE double aureole_word_to_double(uint64_t word) {
    return (double)(int64_t)(word >> 11) * 0x1p-53;
}

/* The key of a scrambling: independent for each seed and dimension. */
AUREOLE_INLINE uint64_t aureole_scramble_key(uint64_t seed, size_t dimension) {
    return aureole_hash3(UINT64_C(0x5363726d626c6531), seed, dimension);
}

AUREOLE_INLINE uint64_t aureole_reverse64(uint64_t x) {
    return (uint64_t)aureole_reverse_bits((uint32_t)x) << 32 | aureole_reverse_bits((uint32_t)(x >> 32));
}

/* The flips of digits beyond the 32nd: a hash of the 32 scrambled digits before them (the two rounds of
 * Wellons' lowbias32). */
AUREOLE_INLINE uint32_t aureole_nested_tail(uint32_t reversed_head, uint32_t key_high) {
    uint32_t x = reversed_head ^ key_high;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/* Owen's nested uniform scrambling in base 2 by hashing: each of the first 32 binary digits is flipped by a
 * hash of the digits before it, the others by one hash of the first 32. */
AUREOLE_INLINE uint64_t aureole_owen_word(uint64_t word, uint64_t key) {
    const uint32_t head = aureole_nested_hash(aureole_reverse_bits((uint32_t)(word >> 32)), (uint32_t)key);
    const uint32_t tail = (uint32_t)word ^ aureole_nested_tail(head, (uint32_t)(key >> 32));
    return (uint64_t)aureole_reverse_bits(head) << 32 | tail;
}

/* index / count < 1, rounded, but never to 1. */
AUREOLE_INLINE double aureole_fraction(uint64_t index, uint64_t count) {
    const double x = (double)index / (double)count;
    return x < 1.0 ? x : AUREOLE_BELOW_ONE;
}

/* --- sets of the square: point `index`
 *
 * The set `sobol`, its first two dimensions; indices below 2^32. */
AUREOLE_INLINE void aureole_sobol_2d(uint32_t index, double point[2]) {
    point[0] = aureole_word_to_double((uint64_t)aureole_sobol_first(index) << 32);
    point[1] = aureole_word_to_double((uint64_t)aureole_sobol_second(index) << 32);
}

/* The same with Owen's scrambling, every seed another one. */
AUREOLE_INLINE void aureole_sobol_2d_owen(uint32_t index, uint64_t seed, double point[2]) {
    point[0] = aureole_word_to_double(
        aureole_owen_word((uint64_t)aureole_sobol_first(index) << 32, aureole_scramble_key(seed, 0)));
    point[1] = aureole_word_to_double(
        aureole_owen_word((uint64_t)aureole_sobol_second(index) << 32, aureole_scramble_key(seed, 1)));
}

/* The set `hammersley` of `count` points: index/count, and the radical inverse in base 2. */
AUREOLE_INLINE void aureole_hammersley_2d(uint64_t index, uint64_t count, double point[2]) {
    point[0] = aureole_fraction(index, count);
    point[1] = aureole_word_to_double(aureole_reverse64(index));
}

/* high / 2^64 + low / 2^128 */
typedef struct aureole_fraction128 {
    uint64_t high, low;
} aureole_fraction128;

/* 1/Phi = (sqrt 5 - 1)/2, the golden ratio minus 1, truncated to 128 bits: the only copy in this project.
 * Code with 64 bits uses AUREOLE_GOLDEN_PHASE of points/sphere/phase.h, which is derived from it. */
#define AUREOLE_GOLDEN_HIGH UINT64_C(0x9e3779b97f4a7c15)

#define AUREOLE_GOLDEN_LOW UINT64_C(0xf39cc0605cedc834)

/* The upper half of a product; by halves if the compiler has no 128-bit integers. */
AUREOLE_INLINE uint64_t aureole_multiply_high(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
    __extension__ typedef unsigned __int128 wide;
    return (uint64_t)((wide)a * b >> 64);
#else
    const uint64_t half = 0xffffffffu;
    const uint64_t low = (a & half) * (b & half), cross = (a >> 32) * (b & half) + (low >> 32);
    const uint64_t other = (a & half) * (b >> 32) + (cross & half);
    return (a >> 32) * (b >> 32) + (cross >> 32) + (other >> 32);
#endif
}

/* floor(index fraction 2^64) modulo 2^64, as a 64-bit word. */
AUREOLE_INLINE uint64_t aureole_phase(aureole_fraction128 fraction, uint64_t index) {
    return fraction.high * index + aureole_multiply_high(fraction.low, index);
}

/* Kronecker's sequences: start + index step modulo 1, in words, exact for every index. */
AUREOLE_INLINE double aureole_kronecker(uint64_t start, aureole_fraction128 step, uint64_t index) {
    return aureole_word_to_double(start + aureole_phase(step, index));
}

/* The set `golden`, of one dimension: (index + 1)/Phi modulo 1 (Schretter 2012). */
AUREOLE_INLINE double aureole_golden(uint64_t index) {
    const aureole_fraction128 step = {AUREOLE_GOLDEN_HIGH, AUREOLE_GOLDEN_LOW};
    return aureole_kronecker(aureole_phase(step, 1), step, index);
}

/* The set `r2` of two dimensions: 1/2 + index/p and 1/2 + index/p^2 with the plastic number p (Roberts 2018).
 */
AUREOLE_INLINE void aureole_r2_2d(uint64_t index, double point[2]) {
    const aureole_fraction128 first = {UINT64_C(0xc13fa9a902a6328f), UINT64_C(0x434ff71b2d97724b)};
    const aureole_fraction128 second = {UINT64_C(0x91e10da5c79e7b1c), UINT64_C(0xd438a0a8e6c9c0fb)};
    point[0] = aureole_kronecker(UINT64_C(1) << 63, first, index);
    point[1] = aureole_kronecker(UINT64_C(1) << 63, second, index);
}

/* --- maps of the square to the disk, the hemisphere and the sphere */

/* The golden angle, 1/Phi turns, rounded to the nearest phase: 2.6e-21 turn too much. (The constant without
 * the rounding, ...7c15, is 5.2e-20 turn short: at 43,000 points the azimuths differ by more than a double's
 * last digits.) */
#define AUREOLE_GOLDEN_PHASE (AUREOLE_GOLDEN_HIGH + (AUREOLE_GOLDEN_LOW >> 63))

/* The fraction of `turns`, exact to 2^-64 turn. Any finite number is allowed. */
AUREOLE_INLINE uint64_t aureole_phase_from_turns(double turns) {
    const double fraction = turns - floor(turns);
    return fraction < 1.0 ? (uint64_t)(fraction * 0x1p64) : 0;
}

/* Sine and cosine of an eighth of a turn to either side, t in [-1,1], to 4e-17. */
AUREOLE_INLINE void aureole_phase_eighth(double t, double *sine, double *cosine) {
    const double q = t * t, q2 = q * q, q4 = q2 * q2;
    /* by pairs (Estrin), whose chains of dependent operations are half as long as Horner's */
    const double s01 = -0x1.4abbce625be52p-4 * q + 0x1.921fb54442d18p-1;
    const double s23 = -0x1.32d2cce500387p-15 * q + 0x1.466bc6775a476p-9;
    const double s45 = -0x1.e3027dea82bd7p-30 * q + 0x1.50783208843ebp-22;
    const double s46 = 0x1.e4a9d9166f052p-38 * q2 + s45;
    *sine = (s46 * q4 + (s23 * q2 + s01)) * t;
    const double c01 = -0x1.3bd3cc9be45dep-2 * q + 1.0;
    const double c23 = -0x1.55d3c7e3cb241p-12 * q + 0x1.03c1f081b5ac0p-6;
    const double c45 = -0x1.a6d1eef479be1p-26 * q + 0x1.e1f5068688d5bp-19;
    const double c67 = -0x1.b2f3eb054afcdp-42 * q + 0x1.f9ce245cada0bp-34;
    *cosine = (c67 * q2 + c45) * q4 + (c23 * q2 + c01);
}

/* Sine and cosine of a phase to 2e-16: exact reduction to an eighth of a turn, then the polynomials. */
AUREOLE_INLINE void aureole_phase_sincos(uint64_t phase, double *sine, double *cosine) {
    const uint64_t quadrant = (phase + (UINT64_C(1) << 61)) >> 62;
    const double t = (double)(int64_t)(phase - (quadrant << 62)) * 0x1p-61;
    double s, c;
    aureole_phase_eighth(t, &s, &c);
    const double turned_sine = (quadrant & 1) != 0 ? c : s;
    const double turned_cosine = (quadrant & 1) != 0 ? s : c;
    *sine = (quadrant & 2) != 0 ? -turned_sine : turned_sine;
    *cosine = ((quadrant + 1) & 2) != 0 ? -turned_cosine : turned_cosine;
}

/* Maps from the unit square. All except POLAR preserve area, so that uniform points stay uniform. LAMBERT:
 * the cylindrical equal-area map, z = 1 - u (hemisphere) or 1 - 2u (sphere), phi = 2 pi v. CONCENTRIC:
 * Shirley and Chiu 1997, square to disk, then z = 1 - r^2 (sphere 1 - 2 r^2). AZIMUTHAL: Lambert's azimuthal
 * equal-area map by polar coordinates, r = sqrt u; once lifted it is LAMBERT. POLAR: Schretter 2012 fig. 3, r
 * = u, phi = 2 pi v, no square root; points are denser near the pole and have the weight aureole_map_weight.
 */
typedef enum aureole_map {
    AUREOLE_MAP_LAMBERT,
    AUREOLE_MAP_CONCENTRIC,
    AUREOLE_MAP_AZIMUTHAL,
    AUREOLE_MAP_POLAR
} aureole_map;

/* A point of the disk by polar coordinates. The radius may be negative. */
typedef struct aureole_polar_point {
    double radius, area; /* area is the radius squared */
    double sine, cosine;
} aureole_polar_point;

/* Shirley and Chiu 1997: squares about the centre become circles. */
AUREOLE_INLINE aureole_polar_point aureole_polar_concentric(const double square[2]) {
    const double a = 2.0 * square[0] - 1.0;
    const double b = 2.0 * square[1] - 1.0;
    aureole_polar_point point = {fabs(a) > fabs(b) ? a : b, 0.0, 0.0, 1.0};
    if (point.radius == 0.0)
        return point;
    const double turns = fabs(a) > fabs(b) ? b / a / 8.0 : 0.25 - a / b / 8.0;
    point.area = point.radius * point.radius;
    aureole_phase_sincos(aureole_phase_from_turns(turns), &point.sine, &point.cosine);
    return point;
}

AUREOLE_INLINE aureole_polar_point aureole_polar_of_square(aureole_map map, const double square[2]) {
    if (map == AUREOLE_MAP_CONCENTRIC)
        return aureole_polar_concentric(square);
    const double u = square[0];
    aureole_polar_point point = {map == AUREOLE_MAP_POLAR ? u : sqrt(u), map == AUREOLE_MAP_POLAR ? u * u : u,
                                 0.0, 0.0};
    aureole_phase_sincos(aureole_phase_from_turns(square[1]), &point.sine, &point.cosine);
    return point;
}

AUREOLE_INLINE void aureole_point_to_disk(aureole_map map, const double square[2], double disk[2]) {
    const aureole_polar_point point = aureole_polar_of_square(map, square);
    disk[0] = point.radius * point.cosine;
    disk[1] = point.radius * point.sine;
}

AUREOLE_INLINE void aureole_point_to_cap(aureole_map map, double height, const double square[2],
                                         double direction[3]) {
    const aureole_polar_point point = aureole_polar_of_square(map, square);
    const double depth = height * point.area;
    const double radius = copysign(sqrt(depth * (2.0 - depth)), point.radius);
    direction[0] = radius * point.cosine;
    direction[1] = radius * point.sine;
    direction[2] = 1.0 - depth;
}

AUREOLE_INLINE void aureole_point_to_hemisphere(aureole_map map, const double square[2],
                                                double direction[3]) {
    aureole_point_to_cap(map, 1.0, square, direction);
}

AUREOLE_INLINE void aureole_point_to_sphere(aureole_map map, const double square[2], double direction[3]) {
    aureole_point_to_cap(map, 2.0, square, direction);
}

/* --- sets of the sphere: unit vectors x,y,z with z up */

/* Point j has 1 - z = (j + offset) * step and the azimuth phase + j/Phi. */
typedef struct aureole_fibonacci {
    double step, offset;
    uint64_t phase;
} aureole_fibonacci;

/* Azimuths are added by one complex product: point j is point j - (j mod 64) turned by (j mod 64)/Phi, from a
 * table. Any point is computed from its index to 4.5e-16, and a sine costs a product. */
enum { AUREOLE_FIBONACCI_BLOCK = 64, AUREOLE_FIBONACCI_WRAPPED = 7 };

/* clang-format off */
AUREOLE_TABLE double aureole_golden_cosines[AUREOLE_FIBONACCI_BLOCK + AUREOLE_FIBONACCI_WRAPPED] = {
    1.0, -0x1.798869e0de834p-1, 0x1.66188447d0aa7p-4, 0x1.37854c630a165p-1,
    -0x1.f82c5daeb84a5p-1, 0x1.b000b1aa1798bp-1, -0x1.09d5b5fdcf94dp-2, -0x1.d7f802d68ff4ep-2,
    0x1.e0eeb8904bfc4p-1, -0x1.d943d21ba12ecp-1, 0x1.b204af3d15dfcp-2, 0x1.327778280b7b5p-2,
    -0x1.bafcf6b40ba06p-1, 0x1.f40ed8d50e99fp-1, -0x1.26775d523ea28p-1, -0x1.07309ccefc01ep-3,
    0x1.878012b8ce4efp-1, -0x1.ff901253c7077p-1, 0x1.6aebb061c0866p-1, -0x1.7a667bb5671a5p-5,
    -0x1.480b076fbbfe1p-1, 0x1.fb6d7337827bcp-1, -0x1.a4478b3fd5bb4p-1, 0x1.c17f72b7f4cc6p-3,
    0x1.fd1cfbb8b0b68p-2, -0x1.e7c7590263f00p-1, 0x1.d0c9ffdcafff3p-1, -0x1.8b5398a94e566p-2,
    -0x1.5a933bfe674f6p-2, 0x1.c5378cc8d2a73p-1, -0x1.ef16b14938889p-1, 0x1.14e8af1d6165bp-1,
    0x1.5ae1e50d01882p-3, -0x1.94cc8f8fad776p-1, 0x1.fe407a3f141f7p-1, -0x1.5bb049c0cebe0p-1,
    0x1.3fb3e8e0bd01ap-8, 0x1.580155254e26ep-1, -0x1.fdd0ad31a57b3p-1, 0x1.97d6a39f39accp-1,
    -0x1.6e8ef1e029ce4p-3, -0x1.10b1ae2fab49ep-1, 0x1.edcab5292ff63p-1, -0x1.c784f6841d18ap-1,
    0x1.63f5a9cffcea9p-2, 0x1.8217783a493d0p-2, -0x1.ceabfb023b15ep-1, 0x1.e9461341702a0p-1,
    -0x1.02e0eeeee2580p-1, -0x1.adfb834c38658p-3, 0x1.a1680fe298e54p-1, -0x1.fc11ca7c69d1ap-1,
    0x1.4bdcdee3c642dp-1, 0x1.2a8afa778b5bfp-5, -0x1.67613ae64bdbdp-1, 0x1.ff55005f85f3ep-1,
    -0x1.8ab36b499720ep-1, 0x1.1afe2cbc8f13bp-3, 0x1.225da44c853a6p-1, -0x1.f2f62bfa9353fp-1,
    0x1.bd78c39c1bfc2p-1, -0x1.3bfc18f823d51p-2, -0x1.a8f2e5d591e62p-2, 0x1.d7561f1d53a86p-1,
    1.0, -0x1.798869e0de834p-1, 0x1.66188447d0aa7p-4, 0x1.37854c630a165p-1,
    -0x1.f82c5daeb84a5p-1, 0x1.b000b1aa1798bp-1, -0x1.09d5b5fdcf94dp-2,
};

AUREOLE_TABLE double aureole_golden_sines[AUREOLE_FIBONACCI_BLOCK + AUREOLE_FIBONACCI_WRAPPED] = {
    0.0, -0x1.59d9dd253cc11p-1, 0x1.fe0a21737932bp-1, -0x1.9652d671c1faep-1,
    0x1.64b981a3760d6p-3, 0x1.12ce04f1c06b7p-1, -0x1.ee7234cb6576ep-1, 0x1.c65fa3f8fd68bp-1,
    -0x1.5f4584d379bf0p-2, -0x1.86b6b91fea8d2p-2, 0x1.cfbc670efc442p-1, -0x1.e88833177a625p-1,
    0x1.00b87e96b831ap-1, 0x1.b7bed1ec6244ap-3, -0x1.a2d9142fc3172p-1, 0x1.fbc12accea63dp-1,
    -0x1.49f4f476fbdbcp-1, -0x1.5279c3084e108p-5, 0x1.69278f453d6d8p-1, -0x1.ff74182f05a82p-1,
    0x1.891af18cbaef8p-1, -0x1.111839bb9aeb9p-3, -0x1.246b64d709abdp-1, 0x1.f38407ee0eb59p-1,
    -0x1.bc3c3792ad69ap-1, 0x1.373abb42c465dp-2, 0x1.ad7d1974136a3p-2, -0x1.d84e68eae66e9p-1,
    0x1.e1c898c6a8988p-1, -0x1.dc6573ca94ab7p-2, -0x1.0501ef1a6549dp-2, 0x1.aea830f144bdcp-1,
    -0x1.f89a33fd61539p-1, 0x1.397fc83cfb0aep-1, 0x1.522fc4834e6b1p-4, -0x1.77d759f1887dap-1,
    0x1.fffe70bd87846p-1, -0x1.7b372d0290a9ep-1, 0x1.79ff158f21e34p-4, 0x1.3588eaaf7418bp-1,
    -0x1.f7bb751000854p-1, 0x1.b15690a1aa0cbp-1, -0x1.0ea7de481d03cp-2, -0x1.d387b1cc72c0fp-2,
    0x1.e011ea48fdd36p-1, -0x1.da365930c53d4p-1, 0x1.b689a02019bc0p-2, 0x1.2db257158b417p-2,
    -0x1.b9bb02f21fa07p-1, 0x1.f4969dd7135dep-1, -0x1.28818a8cf3c9cp-1, -0x1.fa8ecad284968p-4,
    0x1.85e2d14e9d3a7p-1, -0x1.ffa8eea227eedp-1, 0x1.6cad9b7ab025ap-1, -0x1.a250e63a84d1bp-5,
    -0x1.461f1aca1e4dap-1, 0x1.fb16a43ec2f82p-1, -0x1.a5b372d746187p-1, 0x1.cb3d56792d1f0p-3,
    0x1.f8c5e03f93a08p-2, -0x1.e703862ef2cd0p-1, 0x1.d1d4c3c6df1e2p-1, -0x1.8fee0fa4c1944p-2,
    0.0, -0x1.59d9dd253cc11p-1, 0x1.fe0a21737932bp-1, -0x1.9652d671c1faep-1,
    0x1.64b981a3760d6p-3, 0x1.12ce04f1c06b7p-1, -0x1.ee7234cb6576ep-1,
};
/* clang-format on */

/* One point, bit-identical to the kernels. */
AUREOLE_INLINE void aureole_fibonacci_point(const aureole_fibonacci *set, uint64_t index, double xyz[3]) {
    const uint64_t k = index % AUREOLE_FIBONACCI_BLOCK;
    double sine, cosine;
    aureole_phase_sincos(set->phase + (index - k) * AUREOLE_GOLDEN_PHASE, &sine, &cosine);
    const double turn_cosine = aureole_golden_cosines[k], turn_sine = aureole_golden_sines[k];
    const double depth = ((double)index + set->offset) * set->step;
    const double radius = sqrt(depth * (2.0 - depth));
    xyz[0] = radius * (cosine * turn_cosine - sine * turn_sine);
    xyz[1] = radius * (sine * turn_cosine + cosine * turn_sine);
    xyz[2] = 1.0 - depth;
}

/* The set `spherical-fibonacci` of `count` points on the cap of that height: 1 is the hemisphere z >= 0, 2
 * the sphere. Each point has the weight 1/count. */
AUREOLE_INLINE void aureole_spherical_fibonacci(uint64_t count, double height, uint64_t index,
                                                double xyz[3]) {
    const aureole_fibonacci set = {2.0 / (2.0 / height * (double)count), 0.5, 0};
    aureole_fibonacci_point(&set, index, xyz);
}

/* b_s/2^level, s below 3 and level at least 1, as its change of the index (x times N) and of the phase. */
typedef struct aureole_grid_shift {
    double index;
    uint64_t phase;
} aureole_grid_shift;

AUREOLE_INLINE aureole_grid_shift aureole_grid_shift_of(size_t s, size_t level) {
    const uint64_t turn = UINT64_C(1) << (64 - level);
    const uint64_t golden = AUREOLE_GOLDEN_PHASE >> level;
    const aureole_grid_shift half = {s == 0 ? 0.0 : ldexp(1.0, -(int)level),
                                     s == 0 ? 0 - turn : golden - (s == 1 ? 0 : turn)};
    return half;
}

/* The set `esfg`, an extensible grid (Marques 2019): the first 1, 2, 3, 4, 8, 12, 16, ... times `base` of
 * base 4^levels points are as even as a set of that size alone. `first`, 0 to 2, is the sub-grid that comes
 * first: the set's key first-shift=paper takes the one of aureole_grid_first_shift. */
AUREOLE_INLINE void aureole_grid_point(uint64_t base, uint64_t levels, uint64_t first, double height,
                                       uint64_t index, double xyz[3]) {
    aureole_fibonacci copy = {height / (double)base, ldexp(0.5, -(int)levels), 0};
    const uint64_t block = index / base;
    for (uint64_t level = 1; level <= levels; ++level) {
        const uint64_t digit = block >> (2 * (level - 1)) & 3;
        if (digit == 0)
            continue;
        const aureole_grid_shift moved =
            aureole_grid_shift_of((size_t)((first + digit - 1) % 3), (size_t)level);
        copy.offset += moved.index;
        copy.phase += moved.phase;
    }
    aureole_fibonacci_point(&copy, index % base, xyz);
}

AUREOLE_TABLE double aureole_inverse_phi = 0.61803398874989484820;

/* Squared length of b_k. */
AUREOLE_INLINE double aureole_squared_length(size_t k, uint64_t base, double stretch) {
    double previous = 1.0; /* F_{-1}, F_0 */
    double fibonacci = 0.0;
    for (size_t i = 0; i < k; ++i) {
        const double next = fibonacci + previous;
        previous = fibonacci;
        fibonacci = next;
    }
    const double x = fibonacci / (double)base;
    const double y = stretch * pow(aureole_inverse_phi, (double)k);
    return x * x + y * y;
}

AUREOLE_INLINE size_t aureole_grid_shortest_vector(uint64_t base, double stretch) {
    size_t k = 0;
    while (aureole_squared_length(k + 1, base, stretch) < aureole_squared_length(k, base, stretch))
        ++k;
    return k;
}

AUREOLE_INLINE size_t aureole_grid_first_shift(uint64_t base, double stretch) {
    const size_t k = aureole_grid_shortest_vector(base, stretch);
    if (k == 0)
        return 1;
    const double below = aureole_squared_length(k - 1, base, stretch);
    const double above = aureole_squared_length(k + 1, base, stretch);
    return (below > above ? k - 1 : k + 1) % 3;
}

/* --- a sampler for renderers: the pairs of numbers of one sample of one pixel
 *
 * Pairs are padded: each is a point of its own Owen-scrambled and -shuffled Sobol net, so that all samples of
 * a pixel are even in each pair. They are those that the renderer's sampler `sobol` draws. */

/* The pair of floats in [0,1) of a sample, from its bit-reversed index and a hash of pixel and dimension. The
 * index is scrambled so that aligned blocks of a power of two are shuffled: every such block remains a net
 * (Burley 2020). In bit-reversed form the first coordinate is the index itself. */
AUREOLE_INLINE void aureole_sobol_pair(uint32_t reversed_index, uint64_t hash, float *u, float *v) {
    const uint32_t index =
        aureole_reverse_bits(aureole_nested_hash(reversed_index, (uint32_t)aureole_mix64(hash + 1)));
    const uint32_t x = aureole_nested_hash(index, (uint32_t)hash);
    const uint32_t y = aureole_nested_hash(aureole_sobol_second_reversed(index), (uint32_t)(hash >> 32));
    *u = aureole_unit_float(aureole_reverse_bits(x));
    *v = aureole_unit_float(aureole_reverse_bits(y));
}

typedef struct aureole_sampler {
    uint64_t pixel;
    uint32_t index, pair;
} aureole_sampler;

AUREOLE_INLINE aureole_sampler aureole_sampler_begin(uint64_t seed, uint32_t x, uint32_t y, uint32_t index) {
    const aureole_sampler sampler = {aureole_hash3(seed, y, x), index, 0};
    return sampler;
}

/* A sampler whose numbers depend on no other's: for a part of the program that draws as many as it likes. */
AUREOLE_INLINE aureole_sampler aureole_sampler_branch(const aureole_sampler *sampler, uint64_t key) {
    const aureole_sampler branch = {aureole_hash2(sampler->pixel, key), sampler->index, 0};
    return branch;
}

/* Pair number `pair`, each number in [0,1). */
AUREOLE_INLINE void aureole_sampler_pair(const aureole_sampler *sampler, uint32_t pair, float u[2]) {
    aureole_sobol_pair(aureole_reverse_bits(sampler->index), aureole_hash2(sampler->pixel, pair), &u[0],
                       &u[1]);
}

/* The next pair, and the next single number, which takes a pair of its own. */
AUREOLE_INLINE void aureole_draw_2d(aureole_sampler *sampler, float u[2]) {
    aureole_sampler_pair(sampler, sampler->pair++, u);
}

AUREOLE_INLINE float aureole_draw_1d(aureole_sampler *sampler) {
    float u[2];
    aureole_draw_2d(sampler, u);
    return u[0];
}

#endif
