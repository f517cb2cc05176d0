/* Triangulation of planar polygons of any outline. Corners may be collinear, repeat or touch other parts of
 * the outline; holes are connected by seams, as in Radiance. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Defects of a face. All but BENT yield no triangles. */
typedef enum aur_face_flaw {
    AUR_FACE_GOOD,
    AUR_FACE_BENT,    /* a corner is farther than 1e-3 of the face's size from the plane */
    AUR_FACE_EMPTY,   /* its area is below 1e-10 of its size squared */
    AUR_FACE_CROSSED, /* its outline crosses itself */
    AUR_FACE_FLAW_COUNT
} aur_face_flaw;

/* A triangulated face. Triangles depend neither on the first corner nor on the winding of the outline. */
typedef struct aur_face_cut {
    aur_face_flaw flaw;
    double area;           /* by Newell's formula */
    double normal[3];      /* unit length, right-handed for the given winding; 0 for EMPTY */
    size_t first;          /* the first corner in the order of x, y and z */
    size_t triangle_count; /* about count - 2; corners that touch edges or each other change it */
    const uint32_t
        *indices; /* 3 triangle_count corner indices, with the outline's winding; valid until the next call */
} aur_face_cut;

/* Reusable buffers. Initialise to {0}. */
typedef struct aur_triangulator {
    size_t capacity;
    void *memory;
} aur_triangulator;

/* Cuts off ears (Meisters 1975) by exact orientation tests, after projection along the axis nearest to
 * Newell's normal. Corners within rounding of the outline, 1e-6 of the face's size, are treated as on it.
 * corners[count][3], each within 1e100; count below 2^31. Time about O(count log count), at worst quadratic.
 * False: out of memory. */
bool aur_triangulate(aur_triangulator *self, size_t count, const double (*corners)[3], aur_face_cut *cut);
void aur_triangulator_release(aur_triangulator *self);

/* Flawed faces: for each flaw the count, the first face, and its line in the file (0: none). */
typedef struct aur_face_flaws {
    size_t face_count;
    size_t counts[AUR_FACE_FLAW_COUNT], first[AUR_FACE_FLAW_COUNT], lines[AUR_FACE_FLAW_COUNT];
} aur_face_flaws;

/* Records a face. */
void aur_face_flaws_count(aur_face_flaws *flaws, aur_face_flaw flaw, size_t line);
/* Message for a flaw, after the face's number: "have no area and are left out". */
const char *aur_face_flaw_text(aur_face_flaw flaw);
