/* Checks of statements on the lattice of spherical Fibonacci grids. */
#pragma once

#include "program/lab/lab.h"

/* The values of one statement over all its cases, and its exceptions. */
typedef struct lattice_check {
    const char *item, *statement;
    double at_least, at_most; /* NaN: no bound */
    size_t cases, exceptions;
    double least, most;
    double first_exception; /* the case, such as N */
    bool ours;              /* not a claim of the paper */
} lattice_check;

lattice_check lattice_begin(const char *item, const char *statement, double at_least, double at_most);
/* Adds the value of the case `which`, such as N. */
void lattice_count(lattice_check *check, double which, double value);
/* Adds its row and its claim. */
void lattice_end(lab_run *run, const lattice_check *check);

enum { LATTICE_MOST_INDEX = 70 };   /* of a basis vector */
double lattice_fibonacci(size_t k); /* F_k, exact for k <= 78 */
extern const double lattice_golden;
/* b_k of a grid of n points (eq. 5). */
void lattice_vector(size_t k, double n, double vector[2]);
/* The index of the shortest basis vector, by comparison of lengths (eq. 22) in a plane stretched by sx in x.
 */
size_t lattice_shortest(double n, double sx);
double lattice_length2(size_t k, double n, double sx); /* squared length */

/* Checks the library's points. */
aur_result lattice_check_points(lab_run *run, aur_error *error);
