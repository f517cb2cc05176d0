/* Expands the arguments of `aureole measure`: ranges of sizes, and all measures of a domain. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/measure.h"

enum { SIZE_LIMIT = 10000 }; /* sizes per command */

/* first, first * ratio, ... or first, first + step, ... up to last. */
typedef struct size_range {
    uint64_t first, last, step; /* 0: geometric */
    double ratio;
} size_range;

static bool read_size(const char *text, uint64_t *size) {
    return aur_parse_integer(text, SIZE_MAX, size) && *size > 0;
}

/* Parses N, A:B, A:B:xR or A:B:S. */
static bool read_range(const char *text, size_range *range) {
    char parts[3][32] = {"", "", ""};
    size_t count = 0;
    for (const char *part = text; part != NULL; ++count) {
        const char *const colon = strchr(part, ':');
        const size_t length = colon != NULL ? (size_t)(colon - part) : strlen(part);
        if (count == 3 || length >= sizeof parts[0])
            return false;
        memcpy(parts[count], part, length);
        part = colon != NULL ? colon + 1 : NULL;
    }
    *range = (size_range){.ratio = 2.0};
    if (!read_size(parts[0], &range->first))
        return false;
    range->last = range->first;
    if (count == 1)
        return true;
    if (!read_size(parts[1], &range->last) || range->last < range->first)
        return false;
    if (count == 2)
        return true;
    if (parts[2][0] == 'x')
        return aur_parse_double(parts[2] + 1, &range->ratio) && range->ratio > 1.0 && isfinite(range->ratio);
    return read_size(parts[2], &range->step);
}

/* The size after this one, 0 after the last; `index` counts from the first. */
static uint64_t next_size(const size_range *range, size_t *index, uint64_t size) {
    if (range->step > 0)
        return range->last - size >= range->step ? size + range->step : 0;
    /* Ratios near 1 may round to the same size several times. */
    uint64_t next = size;
    while (next == size) {
        const double exact = rint((double)range->first * pow(range->ratio, (double)++*index));
        if (exact > (double)range->last)
            return 0;
        next = (uint64_t)exact;
    }
    return next;
}

aur_result cli_check_sizes(const char *text, void *field, aur_error *error) {
    (void)field;
    size_range range;
    if (read_range(text, &range))
        return AUR_OK;
    return aur_fail(
        error, AUR_ERROR_ARGUMENT,
        "--count: must be a size N of at least 1, A:B (each twice the one before), A:B:xR (R times) or "
        "A:B:S (in steps of S) with A <= B and R > 1, not '%s'",
        text);
}

/* Appends an item; false when out of memory. */
typedef struct growing_list {
    cli_list list;
    char *text;
    size_t used, capacity;
} growing_list;

static bool append(growing_list *items, const char *item) {
    const size_t length = strlen(item) + 1;
    if (items->used + length > items->capacity) {
        const size_t capacity = 2 * (items->used + length) + 256;
        char *const text = realloc(items->text, capacity);
        if (text == NULL)
            return false;
        items->text = text;
        items->capacity = capacity;
    }
    memcpy(items->text + items->used, item, length);
    items->used += length;
    ++items->list.count;
    items->list.text = items->text;
    return true;
}

static aur_result finish(growing_list *items, aur_result result, cli_list *list, char **storage) {
    *storage = items->text;
    *list = items->list;
    return result;
}

aur_result cli_expand_sizes(cli_list *sizes, char **storage, aur_error *error) {
    growing_list items = {.used = 0};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < sizes->count && result == AUR_OK; ++i) {
        size_range range = {0};
        size_t index = 0;
        read_range(cli_list_at(sizes, i), &range);
        for (uint64_t size = range.first; size > 0 && result == AUR_OK;
             size = next_size(&range, &index, size)) {
            char text[32];
            snprintf(text, sizeof text, "%llu", (unsigned long long)size);
            if (items.list.count == SIZE_LIMIT)
                result = aur_fail(error, AUR_ERROR_ARGUMENT, "--count: more than %d sizes", SIZE_LIMIT);
            else if (!append(&items, text))
                result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
        }
    }
    return finish(&items, result, sizes, storage);
}

/* Whether a word is in a list such as "sphere, hemisphere, caps". */
static bool is_listed(const char *list, const char *word) {
    const size_t length = strlen(word);
    for (const char *found = list; (found = strstr(found, word)) != NULL; found += length)
        if ((found == list || found[-1] == ' ') && (found[length] == ',' || found[length] == '\0'))
            return true;
    return false;
}

/* An exact measure with a bound in the table is slow: the bound replaces it. */
static bool has_bound(const aur_measure_description *measure) {
    char name[64];
    snprintf(name, sizeof name, "%s-bound", measure->row.name);
    for (size_t i = 0; i < aur_measure_count(); ++i)
        if (strcmp(aur_measure_at(i)->row.name, name) == 0)
            return true;
    return false;
}

aur_result cli_all_metrics(aur_domain domain, bool cap, cli_list *metrics, char **storage, aur_error *error) {
    growing_list items = {.used = 0};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < aur_measure_count() && result == AUR_OK; ++i) {
        const aur_measure_description *const measure = aur_measure_at(i);
        const bool accepts = measure->parameter != NULL && measure->parameter[0] == ':';
        if (measure->series || accepts || has_bound(measure) ||
            !is_listed(measure->domains, aur_domain_name(domain)) ||
            (cap && !is_listed(measure->domains, "caps")))
            continue;
        if (!append(&items, measure->row.name))
            result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    if (result == AUR_OK && items.list.count == 0)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED, "--metric all: no measure for the %s",
                          aur_domain_name(domain));
    return finish(&items, result, metrics, storage);
}
