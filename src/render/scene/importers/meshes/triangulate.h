/* Plane polygons of any outline, cut into triangles. Corners may lie on a line, repeat or touch other parts
 * of the outline: holes are reached by seams that go there and back, as in Radiance. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What is odd about a face. All but BENT have no triangles. */
typedef enum aur_face_flaw {
    AUR_FACE_GOOD,
    AUR_FACE_BENT,    /* a corner is farther from the plane than 1e-3 of the face's size */
    AUR_FACE_EMPTY,   /* its area is below 1e-10 of its size squared */
    AUR_FACE_CROSSED, /* its outline crosses itself */
    AUR_FACE_FLAW_COUNT
} aur_face_flaw;

/* A face in the order that its triangles were cut in, which does not depend on where the outline begins or
 * which way it goes round. */
typedef struct aur_face_cut {
    aur_face_flaw flaw;
    double area;           /* by Newell's formula */
    double normal[3];      /* unit length, right-handed about the outline as given; 0 for EMPTY */
    size_t first;          /* the corner that comes first, by x, y and z */
    size_t triangle_count; /* count - 2, or some more or fewer where corners touch sides or each other */
    const uint32_t
        *indices; /* 3 triangle_count, of corners, turning as the outline does; until the next call */
} aur_face_cut;

/* Memory that is used again for the next face. Begins as {0}. */
typedef struct aur_triangulator {
    size_t capacity;
    void *memory;
} aur_triangulator;

/* Cuts ears off (Meisters 1975) that exact orientations find, after projection along the axis nearest to
 * Newell's normal. Corners that touch the outline within rounding, 1e-6 of the face's size, are taken as they
 * are meant. corners[count][3], each within 1e100; count below 2^31. Time about O(count log count), at worst
 * its square. False: out of memory. */
bool aur_triangulate(aur_triangulator *self, size_t count, const double (*corners)[3], aur_face_cut *cut);
void aur_triangulator_release(aur_triangulator *self);

/* Flawed faces: of each flaw how many, the first, and its line in the file, 0 where it has none. */
typedef struct aur_face_flaws {
    size_t face_count;
    size_t counts[AUR_FACE_FLAW_COUNT], first[AUR_FACE_FLAW_COUNT], lines[AUR_FACE_FLAW_COUNT];
} aur_face_flaws;

/* Counts the next face. */
void aur_face_flaws_count(aur_face_flaws *flaws, aur_face_flaw flaw, size_t line);
/* What a flaw means for faces, after their number: "have no area and are left out". */
const char *aur_face_flaw_text(aur_face_flaw flaw);
