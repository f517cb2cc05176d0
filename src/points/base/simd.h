/* Detection of the processor's instruction sets. A SIMD routine is one file (*_kernel.c, on
 * points/base/simd_lanes.h or in loops without branches) that CMake compiles once for every processor, once
 * for AVX2 and once for AVX-512. It defines AUR_KERNEL(name), AUR_KERNELS declares the three, and
 * AUR_KERNEL_HERE chooses between them. */
#pragma once

#include "points/base/error.h"

typedef enum aur_isa { AUR_ISA_PORTABLE = 0, AUR_ISA_AVX2 = 2, AUR_ISA_AVX512 = 5 } aur_isa;

/* The widest set that both the processor and the environment variable AUREOLE_ISA (portable, avx2, avx512; a
 * limit, for tests and measurements) allow. AVX2 implies FMA; AVX-512 means F, DQ, BW and VL. */
AUR_INTERNAL aur_isa aur_isa_available(void);

/* Makes the next call read the environment again: for tests of several instruction sets in one process. */
void aur_isa_reset(void);

/* The same for Embree's kernels; AUREOLE_EMBREE_ISA, if set, replaces AUREOLE_ISA. Embree's hits differ in
 * the last bits between its kernels, Aureole's results do not; a test of bit-identity fixes Embree's kernels.
 */
AUR_INTERNAL aur_isa aur_isa_of_rays(void);

AUR_INTERNAL const char *aur_isa_name(aur_isa isa);

/* AUR_OK where the processor has the set called `name`, whatever the environment. Errors: NAME for an unknown
 * name, with the nearest; UNSUPPORTED if the processor lacks the set. */
aur_result aur_isa_check(const char *name, aur_error *error);

/* The instruction set that a file *_kernel.c is compiled for, and whether its registers are wider than those
 * of every processor. */
#if !defined(AUR_KERNEL_ISA)
#define AUR_KERNEL_ISA portable
#define AUR_KERNEL_WIDE 0
#endif

/* name_portable, name_avx2 or name_avx512: the function or table of functions of this compilation. */
#define AUR_KERNEL_OF(name, isa) name##_##isa
#define AUR_KERNEL_OF_ISA(name, isa) AUR_KERNEL_OF(name, isa)
#define AUR_KERNEL(name) AUR_KERNEL_OF_ISA(name, AUR_KERNEL_ISA)
#define AUR_KERNELS(type, name) extern type name##_portable, name##_avx2, name##_avx512

/* Selects one of the three for this processor. Builds for processors other than x86-64 (and with
 * AUREOLE_PORTABLE) have only the first. */
#if !defined(AUR_PORTABLE)
#define AUR_KERNEL_HERE(kernel)                                                                              \
    (*(aur_isa_available() == AUR_ISA_AVX512 ? &kernel##_avx512                                              \
       : aur_isa_available() == AUR_ISA_AVX2 ? &kernel##_avx2                                                \
                                             : &kernel##_portable))
#else
#define AUR_KERNEL_HERE(kernel) kernel##_portable
#endif

/* Asserts that the iterations of the following loop are independent, which the compiler cannot prove. */
#if defined(__GNUC__) && !defined(__clang__)
#define AUR_INDEPENDENT_LOOP _Pragma("GCC ivdep")
#else
#define AUR_INDEPENDENT_LOOP
#endif
