/* The analytical cases: scenes, receivers and their two reference solutions. */
#pragma once

#include "references.h"

enum { LAB_CASE_POINTS = 32, LAB_CASE_SCENE = 6000 };

typedef struct lab_case {
    char scene[LAB_CASE_SCENE]; /* XML, without the element <scene>; +z is up */
    size_t scene_size;
    size_t more; /* multiplier of the number of directions per point */
    size_t count;
    lab_receiver receivers[LAB_CASE_POINTS];
    double closed[LAB_CASE_POINTS], smooth[LAB_CASE_POINTS]; /* irradiances by two derivations */
} lab_case;

typedef struct lab_case_row {
    const char *name, *derivations;
    void (*build)(lab_case *test_case, double parameter);
    double parameter;
} lab_case_row;

/* Appends to the scene's text. */
void lab_case_put(lab_case *test_case, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A quadrilateral; the XML states its material or emission. */
void lab_case_patch(lab_case *test_case, const lab_patch *patch, const char *inside);
void lab_case_point(lab_case *test_case, const lab_receiver *receiver, double closed, double smooth);

/* NULL past the end. */
const lab_case_row *lab_case_at(size_t index);

extern const lab_case_row lab_source_cases[], lab_room_cases[], lab_sky_cases[];
extern const size_t lab_source_case_count, lab_room_case_count, lab_sky_case_count;
