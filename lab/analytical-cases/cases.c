#include "cases.h"

const lab_case_row *lab_case_at(size_t index) {
    const lab_case_row *const tables[] = {lab_source_cases, lab_room_cases, lab_sky_cases};
    const size_t counts[] = {lab_source_case_count, lab_room_case_count, lab_sky_case_count};
    for (size_t i = 0; i < 3; ++i) {
        if (index < counts[i])
            return &tables[i][index];
        index -= counts[i];
    }
    return NULL;
}
