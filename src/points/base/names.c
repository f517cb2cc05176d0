#include "points/base/names.h"

#include <string.h>
#include <strings.h>

#include "points/base/text.h"

enum { LONGEST_NAME = 63 };

/* Names are compared without case, and '_' equals '-'. */
static char fold(char c) {
    if (c >= 'A' && c <= 'Z')
        return (char)(c - 'A' + 'a');
    return c == '_' ? '-' : c;
}

/* Levenshtein distance of two short names. */
static size_t edit_distance(const char *a, const char *b) {
    size_t row[LONGEST_NAME + 1];
    const size_t length_a = strlen(a);
    const size_t length_b = strlen(b);
    for (size_t j = 0; j <= length_b; ++j)
        row[j] = j;
    for (size_t i = 1; i <= length_a; ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= length_b; ++j) {
            const size_t substitute = diagonal + (fold(a[i - 1]) != fold(b[j - 1]));
            diagonal = row[j];
            size_t best = substitute < row[j] + 1 ? substitute : row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            row[j] = best;
        }
    }
    return row[length_b];
}

static const char *string_at(const void *table, size_t index) {
    const char *const *const strings = table;
    return strings[index];
}

aur_names aur_names_of(size_t count, const char *const *strings) {
    return (aur_names){.count = count, .at = string_at, .table = strings};
}

size_t aur_names_find(aur_names names, const char *given) {
    size_t i = 0;
    while (i < names.count && strcmp(names.at(names.table, i), given) != 0)
        ++i;
    return i;
}

/* Whether words of one or two letters, separated by '_' or '-', agree: a different short word is another
 * name, not a misspelling, as sigma_a and sigma_t. */
static bool short_words_agree(const char *a, const char *b) {
    for (;;) {
        const size_t length_a = strcspn(a, "_-"), length_b = strcspn(b, "_-");
        const bool last_a = a[length_a] == '\0', last_b = b[length_b] == '\0';
        if (last_a != last_b)
            return true;
        if (length_a <= 2 && length_b <= 2 && (length_a != length_b || strncasecmp(a, b, length_a) != 0))
            return false;
        if (last_a)
            return true;
        a += length_a + 1;
        b += length_b + 1;
    }
}

const char *aur_names_nearest(aur_names names, const char *given) {
    const size_t length = strlen(given);
    if (length == 0 || length > LONGEST_NAME)
        return NULL;
    const char *best = NULL;
    size_t best_distance = length < 4 ? 2 : length < 6 ? 3 : length / 2;
    for (size_t i = 0; i < names.count; ++i) {
        const char *const name = names.at(names.table, i);
        if (strlen(name) > LONGEST_NAME || (strpbrk(name, "_-") != NULL && !short_words_agree(given, name)))
            continue;
        const size_t distance = edit_distance(given, name);
        if (distance < best_distance) {
            best = name;
            best_distance = distance;
        }
    }
    return best;
}

const char *aur_names_hint(aur_names names, const char *given, const char *quotes,
                           char hint[AUR_HINT_CAPACITY]) {
    const char *const nearest = aur_names_nearest(names, given);
    hint[0] = '\0';
    if (nearest != NULL)
        snprintf(hint, AUR_HINT_CAPACITY, "; did you mean %c%s%c?", quotes[0], nearest, quotes[1]);
    return hint;
}

static const char *sorted_at(const void *table, size_t index) {
    const aur_sorted_names *const self = table;
    return self->names.at(self->names.table, self->order[index]);
}

aur_names aur_names_by_distance(aur_names names, const char *given, aur_sorted_names *sorted) {
    size_t distance[AUR_SORTED_NAMES];
    if (names.count > AUR_SORTED_NAMES || strlen(given) > LONGEST_NAME)
        return names;
    sorted->names = names;
    for (size_t i = 0; i < names.count; ++i) {
        const char *const name = names.at(names.table, i);
        const size_t here = strlen(name) <= LONGEST_NAME ? edit_distance(given, name) : SIZE_MAX;
        size_t at = i;
        for (; at > 0 && distance[at - 1] > here; --at) {
            distance[at] = distance[at - 1];
            sorted->order[at] = sorted->order[at - 1];
        }
        distance[at] = here;
        sorted->order[at] = i;
    }
    return (aur_names){names.count, sorted_at, sorted};
}

size_t aur_names_list(aur_names names, size_t capacity, char *text) {
    size_t used = 0;
    if (capacity > 0)
        text[0] = '\0';
    for (size_t i = 0; i < names.count; ++i) {
        const size_t left = used < capacity ? capacity - used : 0;
        used += (size_t)snprintf(left > 0 ? text + used : NULL, left, "%s%s", i > 0 ? ", " : "",
                                 names.at(names.table, i));
    }
    return used;
}

const char *aur_names_suggest(aur_names names, const char *given, const char *others,
                              char text[AUR_ERROR_MESSAGE_CAPACITY]) {
    if (aur_names_hint(names, given, "''", text)[0] == '\0') {
        const size_t used = (size_t)snprintf(text, AUR_ERROR_MESSAGE_CAPACITY, "; %s: ", others);
        /* A list that does not fit here does not fit the message either. */
        aur_names_list(names, AUR_ERROR_MESSAGE_CAPACITY - used, text + used);
    }
    return text;
}

aur_result aur_names_choose(aur_names names, const char *kind, const char *given, aur_location location,
                            size_t *index, aur_error *error) {
    const size_t found = aur_names_find(names, given);
    if (found < names.count) {
        *index = found;
        return AUR_OK;
    }
    char help[AUR_ERROR_MESSAGE_CAPACITY];
    return aur_fail_at(error, location, AUR_ERROR_NAME, "unknown %s '%s'%s", kind, given,
                       error != NULL ? aur_names_suggest(names, given, "there are", help) : "");
}

const char *aur_nearest_name(const char *given, size_t count, const char *const *names) {
    return aur_names_nearest(aur_names_of(count, names), given);
}

size_t aur_list_names(size_t count, const char *const *names, size_t capacity, char *text) {
    return aur_names_list(aur_names_of(count, names), capacity, text);
}
