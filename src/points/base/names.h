/* Tables with named rows: finding a row, suggesting the nearest name, listing all in an error message. */
#pragma once

#include "points/base/error.h"

/* The names of a table. `at` returns the name of row `index` < count; `table` is its first argument. */
typedef struct aur_names {
    size_t count;
    const char *(*at)(const void *table, size_t index);
    const void *table;
} aur_names;

/* The names of an array of strings, which must outlive the result. */
AUR_INTERNAL aur_names aur_names_of(size_t count, const char *const *strings);

/* The index of the row called `given`, or names.count. */
AUR_INTERNAL size_t aur_names_find(aur_names names, const char *given);

/* The nearest name by edit distance, or NULL when none is near enough. */
const char *aur_names_nearest(aur_names names, const char *given);

enum { AUR_HINT_CAPACITY = 96 };

/* The end of a message about an unknown name, written into `hint` and returned: "; did you mean 'NAME'?",
 * with the two characters of `quotes` around it, or nothing when no name is near. */
AUR_INTERNAL const char *aur_names_hint(aur_names names, const char *given, const char *quotes,
                                        char hint[AUR_HINT_CAPACITY]);

/* The end of a message about an unknown name, written into `text` and returned: "; did you mean 'NAME'?", or
 * "; OTHERS: a, b, c" when no name is near. */
const char *aur_names_suggest(aur_names names, const char *given, const char *others,
                              char text[AUR_ERROR_MESSAGE_CAPACITY]);

enum { AUR_SORTED_NAMES = 256 };

typedef struct aur_sorted_names {
    aur_names names;
    size_t order[AUR_SORTED_NAMES];
} aur_sorted_names;

/* The names by their edit distance from `given`, and then in the order of the table; tables of more than
 * AUR_SORTED_NAMES are not sorted. `sorted` must outlive the result. */
aur_names aur_names_by_distance(aur_names names, const char *given, aur_sorted_names *sorted);

/* Writes "a, b, c" into text[capacity], always terminated; returns the length of the whole list, as snprintf
 * does. */
AUR_INTERNAL size_t aur_names_list(aur_names names, size_t capacity, char *text);

/* AUR_OK with the index of the row called `given`, or AUR_ERROR_NAME with "unknown KIND 'WANTED'; did you
 * mean 'NAME'?" or, when nothing is near, "unknown KIND 'WANTED'; there are: a, b, c". */
AUR_INTERNAL aur_result aur_names_choose(aur_names names, const char *kind, const char *given,
                                         aur_location location, size_t *index, aur_error *error);
