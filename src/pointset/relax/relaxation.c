#include "pointset/relax/relaxation.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "core/random.h"

enum { PATH_CAPACITY = 4096 };

bool aur_site_grid_create(aur_site_grid *grid, size_t count) {
    grid->side = 1;
    while ((grid->side + 1) * (grid->side + 1) <= count)
        ++grid->side;
    grid->start = malloc((grid->side * grid->side + 2) * sizeof *grid->start);
    grid->sites = malloc(count * sizeof *grid->sites);
    return grid->start != NULL && grid->sites != NULL;
}

void aur_site_grid_destroy(aur_site_grid *grid) {
    free(grid->start);
    free(grid->sites);
    *grid = (aur_site_grid){0};
}

static size_t cell_of(const aur_site_grid *grid, aur_point2 p) {
    const double side = (double)grid->side;
    return (size_t)(p.y * side) * grid->side + (size_t)(p.x * side);
}

void aur_site_grid_fill(aur_site_grid *grid, size_t count, const aur_point2 *sites) {
    const size_t cells = grid->side * grid->side;
    uint32_t *const start = grid->start;
    memset(start, 0, (cells + 2) * sizeof *start);
    for (size_t i = 0; i < count; ++i)
        ++start[cell_of(grid, sites[i]) + 2];
    for (size_t c = 0; c <= cells; ++c)
        start[c + 1] += start[c];
    /* start[c + 1] is where cell c begins; placing its sites moves it to where the cell ends. */
    for (size_t i = 0; i < count; ++i)
        grid->sites[start[cell_of(grid, sites[i]) + 1]++] = (uint32_t)i;
}

/* The folder of the cache; false when there is none. */
static bool cache_folder(char folder[PATH_CAPACITY]) {
    const char *const own = getenv("AUREOLE_CACHE");
    const char *const shared = getenv("XDG_CACHE_HOME");
    const char *const home = getenv("HOME");
    int length = -1;
    if (own != NULL)
        length = snprintf(folder, PATH_CAPACITY, "%s", own);
    else if (shared != NULL && shared[0] == '/')
        length = snprintf(folder, PATH_CAPACITY, "%s/aureole", shared);
    else if (home != NULL && home[0] == '/')
        length = snprintf(folder, PATH_CAPACITY, "%s/.cache/aureole", home);
    return length > 0 && length < PATH_CAPACITY;
}

static void make_folders(const char *folder) {
    char part[PATH_CAPACITY];
    for (size_t i = 1; folder[i - 1] != '\0'; ++i) {
        if (folder[i] != '/' && folder[i] != '\0')
            continue;
        memcpy(part, folder, i);
        part[i] = '\0';
        /* What exists already or cannot be made shows when the file is opened. */
        (void)mkdir(part, 0777);
    }
}

static bool cache_path(const aur_pointset *set, unsigned version, const char *folder,
                       char path[PATH_CAPACITY]) {
    const int length = snprintf(path, PATH_CAPACITY, "%s/%s-%u-%" PRIu64 "-%016" PRIx64 ".points", folder,
                                set->kind->description.row.name, version, set->size, set->seed);
    return length > 0 && length < PATH_CAPACITY;
}

/* A hash of the points, and of what they follow from: a file of the cache is 8 bytes of it and the points, in
 * the machine's own order of bytes. */
static uint64_t check_sum(const aur_pointset *set, unsigned version, const aur_point2 *sites) {
    uint64_t sum = aur_hash3(version, set->size, set->seed);
    for (const char *c = set->kind->description.row.name; *c != '\0'; ++c)
        sum = aur_hash2(sum, (unsigned char)*c);
    for (size_t i = 0; i < set->size; ++i) {
        uint64_t bits[2];
        memcpy(bits, &sites[i], sizeof bits);
        sum = aur_hash3(sum, bits[0], bits[1]);
    }
    return sum;
}

/* The points of a file; false when it is not the one that was written. */
static bool read_cache(const char *path, const aur_pointset *set, unsigned version, aur_point2 *sites) {
    const size_t bytes = set->size * sizeof *sites;
    uint64_t sum;
    char *data;
    size_t size;
    if (aur_file_read(path, sizeof sum + bytes, &data, &size, NULL) != AUR_OK)
        return false;
    const bool whole = size == sizeof sum + bytes;
    if (whole) {
        memcpy(&sum, data, sizeof sum);
        memcpy(sites, data + sizeof sum, bytes);
    }
    free(data);
    return whole && sum == check_sum(set, version, sites);
}

static void write_cache(const char *path, const aur_pointset *set, unsigned version,
                        const aur_point2 *sites) {
    const uint64_t sum = check_sum(set, version, sites);
    aur_file_writer writer;
    if (aur_file_open(path, &writer, NULL) != AUR_OK)
        return;
    fwrite(&sum, sizeof sum, 1, writer.stream);
    fwrite(sites, sizeof *sites, set->size, writer.stream);
    (void)aur_file_commit(&writer, NULL);
}

aur_result aur_prepare_relaxed(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    const aur_relaxation *const how = set->kind->own;
    char folder[PATH_CAPACITY];
    char path[PATH_CAPACITY];
    const bool cached = cache_folder(folder) && cache_path(set, how->version, folder, path);
    aur_point2 *const sites = malloc(set->size * sizeof *sites);
    if (sites == NULL)
        return aur_fail_memory(error);
    set->data = sites;
    if (cached && read_cache(path, set, how->version, sites))
        return AUR_OK;
    const aur_result result = how->relax(set->seed, (size_t)set->size, sites, error);
    if (result == AUR_OK && cached) {
        make_folders(folder);
        write_cache(path, set, how->version, sites);
    }
    return result;
}
