/* The inside of the inverse map: the lattice of a spherical Fibonacci set and its kernels. */
#ifndef AUR_SPHERE_INVERSE_H
#define AUR_SPHERE_INVERSE_H

#include <stddef.h>
#include <stdint.h>

/* Point j has 1 - z = (j + 1/2) step, for 0 <= j < limit of the `whole` points of the sphere. */
typedef struct aur_sphere_lattice {
    double step, whole, limit;
} aur_sphere_lattice;

enum { AUR_SPHERE_LATTICE_VECTORS = 48 };

/* F_k and (-1)^{k-1} Phi^-k, the basis vectors b_k in units of an index and of a turn (Marques 2019 eq. 5).
 */
extern const double aur_sphere_lattice_fibonacci[AUR_SPHERE_LATTICE_VECTORS];
extern const double aur_sphere_lattice_turns[AUR_SPHERE_LATTICE_VECTORS];

/* atan t / (2 pi t) in powers of t^2 up to tan(pi/8), within 1.2e-13; log2 of 1 + m within 7.5e-4; highest
 * power first. */
#define AUR_AZIMUTH_COEFFICIENTS                                                                             \
    -0x1.88c1caeb27e21p-8, 0x1.6bb7b4d15bff6p-7, -0x1.d4fa8886f2df6p-7, 0x1.21887bf45caf7p-6,                \
        -0x1.7481457da6f11p-6, 0x1.04c265f437c13p-5, -0x1.b2995e6f24801p-5, 0x1.45f306dc9b798p-3
#define AUR_ZONE_COEFFICIENTS                                                                                \
    0.15270028479752112, -0.5687040530057504, 1.415653190432735, 8.254628229341662e-4
/* sqrt 5 pi, and 1 / (2 log2 Phi). */
#define AUR_ZONE_SCALE 7.0248147310407263
#define AUR_ZONE_PACE 0.72021004203696985

/* The nearest point of each direction as an index, or -1 where the four corners of its cell do not decide
 * (near the limit). Both kernels give the same. */
void aur_sphere_lattice_nearest_portable(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                         double *indices);
void aur_sphere_lattice_nearest_avx512(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices);

#endif
