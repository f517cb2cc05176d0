/* The one place that asks which instructions the processor has. A SIMD routine is one file (*_kernel.c, on
 * points/base/simd_lanes.h or in loops without branches) that CMake compiles once for every processor, once
 * for AVX2 and once for AVX-512. It defines AUR_KERNEL(name), AUR_KERNELS declares the three, and
 * AUR_KERNEL_HERE chooses between them. */
#pragma once

#include "points/base/error.h"

typedef enum aur_isa { AUR_ISA_PORTABLE = 0, AUR_ISA_AVX2 = 2, AUR_ISA_AVX512 = 5 } aur_isa;

/* The widest set that both the processor and the environment variable AUREOLE_ISA (portable, avx2, avx512; a
 * limit, for tests and measurements) allow. AVX2 implies FMA; AVX-512 means F, DQ, BW and VL. */
AUR_INTERNAL aur_isa aur_isa_available(void);

/* Lets the next call look at the environment again: for tests of several instruction sets in one process. */
void aur_isa_ask_again(void);

/* The same for Embree's kernels, with AUREOLE_EMBREE_ISA in the place of AUREOLE_ISA where it is set.
 * Embree's hits differ in the last bits between its kernels; ours do not, so a test of our bits holds
 * Embree's kernels fixed. */
AUR_INTERNAL aur_isa aur_isa_of_rays(void);

AUR_INTERNAL const char *aur_isa_name(aur_isa isa);

/* AUR_OK where the processor has the set called `name`, whatever the environment says. Errors: NAME where no
 * set is called so, with the nearest; UNSUPPORTED where the processor is without it. */
aur_result aur_isa_check(const char *name, aur_error *error);

/* The instruction set that a file *_kernel.c is compiled for, and whether its registers are wider than those
 * of every processor. */
#if !defined(AUR_KERNEL_ISA)
#define AUR_KERNEL_ISA portable
#define AUR_KERNEL_WIDE 0
#endif

/* name_portable, name_avx2 or name_avx512: the function or table of functions that this compilation makes. */
#define AUR_KERNEL_OF(name, isa) name##_##isa
#define AUR_KERNEL_OF_ISA(name, isa) AUR_KERNEL_OF(name, isa)
#define AUR_KERNEL(name) AUR_KERNEL_OF_ISA(name, AUR_KERNEL_ISA)
#define AUR_KERNELS(type, name) extern type name##_portable, name##_avx2, name##_avx512

/* Of the three, the one to use here. Builds for other processors than x86-64 (and with AUREOLE_PORTABLE) have
 * the first one only. */
#if !defined(AUR_PORTABLE)
#define AUR_KERNEL_HERE(kernel)                                                                              \
    (*(aur_isa_available() == AUR_ISA_AVX512 ? &kernel##_avx512                                              \
       : aur_isa_available() == AUR_ISA_AVX2 ? &kernel##_avx2                                                \
                                             : &kernel##_portable))
#else
#define AUR_KERNEL_HERE(kernel) kernel##_portable
#endif

/* Stands before a loop whose rounds do not read what other rounds write, which the compiler cannot see by
 * itself. */
#if defined(__GNUC__) && !defined(__clang__)
#define AUR_INDEPENDENT_LOOP _Pragma("GCC ivdep")
#else
#define AUR_INDEPENDENT_LOOP
#endif
