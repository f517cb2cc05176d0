#include "pointset/relax/relaxation.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "core/random.h"

enum { PATH_CAPACITY = 4096 };

void aur_random_sites(uint64_t seed, size_t count, aur_point2 *sites) {
    for (size_t i = 0; i < count; ++i)
        sites[i] =
            (aur_point2){aur_unit_double(aur_hash3(seed, i, 0)), aur_unit_double(aur_hash3(seed, i, 1))};
}

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

/* What stands before the points in a file of the cache, in the machine's own order of bytes. */
typedef struct cache_header {
    uint64_t magic, key, check_sum;
} cache_header;

static const uint64_t cache_magic = UINT64_C(0x61757265706f696e);

/* What the points follow from. */
static uint64_t cache_key(const aur_pointset *set, unsigned version) {
    uint64_t key = aur_hash3(version, set->size, set->seed);
    for (const char *c = set->kind->description.row.name; *c != '\0'; ++c)
        key = aur_hash2(key, (unsigned char)*c);
    return key;
}

static uint64_t check_sum(size_t count, const aur_point2 *sites) {
    uint64_t sum = count;
    for (size_t i = 0; i < count; ++i) {
        uint64_t bits[2];
        memcpy(bits, &sites[i], sizeof bits);
        sum = aur_hash3(sum, bits[0], bits[1]);
    }
    return sum;
}

/* The points of a file, or NULL when it is not the one that was written. */
static aur_point2 *read_cache(const char *path, uint64_t key, size_t count) {
    const size_t bytes = count * sizeof(aur_point2);
    cache_header header;
    char *data;
    size_t size;
    if (aur_file_read(path, sizeof header + bytes, &data, &size, NULL) != AUR_OK)
        return NULL;
    aur_point2 *sites = size == sizeof header + bytes ? malloc(bytes) : NULL;
    if (sites != NULL) {
        memcpy(&header, data, sizeof header);
        memcpy(sites, data + sizeof header, bytes);
        if (header.magic != cache_magic || header.key != key || header.check_sum != check_sum(count, sites)) {
            free(sites);
            sites = NULL;
        }
    }
    free(data);
    return sites;
}

static void write_cache(const char *path, uint64_t key, size_t count, const aur_point2 *sites) {
    const cache_header header = {cache_magic, key, check_sum(count, sites)};
    aur_file_writer writer;
    if (aur_file_open(path, &writer, NULL) != AUR_OK)
        return;
    fwrite(&header, sizeof header, 1, writer.stream);
    fwrite(sites, sizeof *sites, count, writer.stream);
    (void)aur_file_commit(&writer, NULL);
}

aur_result aur_prepare_relaxed(aur_pointset *set, unsigned version, aur_relaxation relax, aur_error *error) {
    const size_t count = (size_t)set->size;
    char folder[PATH_CAPACITY];
    char path[PATH_CAPACITY];
    const bool cached = cache_folder(folder) && cache_path(set, version, folder, path);
    const uint64_t key = cache_key(set, version);
    set->data = cached ? read_cache(path, key, count) : NULL;
    if (set->data != NULL)
        return AUR_OK;
    aur_point2 *const sites = malloc(count * sizeof *sites);
    if (sites == NULL)
        return aur_fail_memory(error);
    set->data = sites;
    const aur_result result = relax(set->seed, count, sites, error);
    if (result == AUR_OK && cached) {
        make_folders(folder);
        write_cache(path, key, count, sites);
    }
    return result;
}
