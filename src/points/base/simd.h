/* The one place that asks which instructions the processor has. A SIMD routine is one body (*_body.h, on
 * points/base/simd_lanes.h or in loops without branches) that is compiled in a file for each instruction set
 * (*_avx2.c,
 * *_avx512.c, and a portable one), and its room chooses between them by AUR_KERNEL_HERE. */
#pragma once

#include "points/base/error.h"

typedef enum aur_isa { AUR_ISA_PORTABLE = 0, AUR_ISA_AVX2 = 2, AUR_ISA_AVX512 = 5 } aur_isa;

/* The widest set that both the processor and the environment variable AUREOLE_ISA (portable, avx2, avx512; a
 * limit, for tests and measurements) allow. AVX2 implies FMA; AVX-512 means F, DQ, BW and VL. */
aur_isa aur_isa_available(void);

/* Lets the next call look at the environment again: for tests of several instruction sets in one process. */
void aur_isa_ask_again(void);

/* The same for Embree's kernels, with AUREOLE_EMBREE_ISA in the place of AUREOLE_ISA where it is set.
 * Embree's hits differ in the last bits between its kernels; ours do not, so a test of our bits holds
 * Embree's kernels fixed. */
aur_isa aur_isa_of_rays(void);

const char *aur_isa_name(aur_isa isa);

/* AUR_OK where the processor has the set called `name`, whatever the environment says. Errors: NAME where no
 * set is called so, with the nearest; UNSUPPORTED where the processor is without it. */
aur_result aur_isa_check(const char *name, aur_error *error);

/* Of kernel_portable, kernel_avx2 and kernel_avx512, functions or tables of functions which one body makes in
 * files that are compiled for these instruction sets, the one to use here. Builds for other processors than
 * x86-64 (and with AUREOLE_PORTABLE) have the first one only. */
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
