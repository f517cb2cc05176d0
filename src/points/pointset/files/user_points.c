/* The sets of the user: file:PATH, a file for each size (file:NAME-%d.csv or a folder), and callback:NAME. */
#include <dirent.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "points/base/text.h"
#include "points/pointset/files/points_file.h"
#include "points/pointset/points.h"

static const char file_prefix[] = "file:", callback_prefix[] = "callback:", size_mark[] = "%d";

bool aur_set_is_user(const char *set) {
    return strncmp(set, file_prefix, sizeof file_prefix - 1) == 0 ||
           strncmp(set, callback_prefix, sizeof callback_prefix - 1) == 0;
}

/* --- registered functions: scenes, integrators and experiments refer to them by name, so the table is global
 * to the process */

static pthread_mutex_t table_lock = PTHREAD_MUTEX_INITIALIZER;
static aur_set_callback *table;
static size_t table_count;

/* Letters that have no meaning in a SET or a list of them. */
static bool is_plain_name(const char *name) {
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    return name != NULL && name[0] != '\0' && name[strspn(name, allowed)] == '\0';
}

static size_t find(const char *name) {
    size_t index = 0;
    while (index < table_count && strcmp(table[index].name, name) != 0)
        ++index;
    return index;
}

/* Call it with the lock held. */
static aur_result replace(const aur_set_callback *callback, aur_error *error) {
    const size_t index = find(callback->name);
    if (callback->generate == NULL) {
        if (index == table_count)
            return AUR_OK;
        free((char *)table[index].name);
        table[index] = table[--table_count];
        return AUR_OK;
    }
    if (index == table_count) {
        aur_set_callback *const larger = realloc(table, (table_count + 1) * sizeof *table);
        char *const name = strdup(callback->name);
        table = larger != NULL ? larger : table;
        if (larger == NULL || name == NULL) {
            free(name);
            return aur_fail_memory(error);
        }
        table[table_count++] = (aur_set_callback){.name = name};
    }
    const char *const name = table[index].name;
    table[index] = *callback;
    table[index].name = name;
    return AUR_OK;
}

aur_result aur_set_register(const aur_set_callback *callback, aur_error *error) {
    aur_set_callback copy = {.size = sizeof copy};
    const aur_result read = aur_options_read(callback, sizeof copy, &copy, "aur_set_callback", error);
    if (read != AUR_OK)
        return read;
    if (!is_plain_name(copy.name))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the name of a set must be letters, digits, '-', '_' and '.', not '%s'",
                        copy.name != NULL ? copy.name : "");
    if (aur_domain_name(copy.domain) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown domain %d", (int)copy.domain);
    pthread_mutex_lock(&table_lock);
    const aur_result result = replace(&copy, error);
    pthread_mutex_unlock(&table_lock);
    return result;
}

static size_t coordinates_of(aur_domain domain, size_t requested) {
    static const size_t dimensions[] = {2, 0, 2, 3, 3, 3, 4};
    return dimensions[domain] != 0 ? dimensions[domain] : requested != 0 ? requested : 2;
}

/* Calls the function, and copies its points and weights into rows. */
static aur_result call(const aur_set_callback *callback, const aur_user_request *request, aur_matrix *matrix,
                       aur_error *error) {
    aur_error unseen = {0};
    const size_t dimension = coordinates_of(callback->domain, request->dimension);
    const size_t count = request->count, columns = dimension + callback->weighted;
    aur_points *generated = NULL;
    aur_result result =
        aur_points_create(callback->domain, count, dimension, callback->weighted, &generated, error);
    if (result == AUR_OK)
        result = callback->generate(callback->user, count, dimension, generated->coordinates,
                                    generated->weights, error != NULL ? error : &unseen);
    *matrix = (aur_matrix){.row_count = count,
                           .column_count = columns,
                           .declared = true,
                           .domain = callback->domain,
                           .weighted = callback->weighted};
    if (result == AUR_OK && (matrix->values = malloc(count * columns * sizeof(double))) == NULL)
        result = aur_fail_memory(error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        memcpy(matrix->values + i * columns, generated->coordinates + i * dimension,
               dimension * sizeof(double));
        if (callback->weighted)
            matrix->values[i * columns + dimension] = generated->weights[i];
    }
    aur_points_destroy(generated);
    return result;
}

static aur_result from_callback(const aur_user_request *request, aur_points **points, aur_error *error) {
    const char *const name = request->set + sizeof callback_prefix - 1;
    pthread_mutex_lock(&table_lock);
    const size_t index = find(name);
    const bool found = index < table_count;
    const aur_set_callback callback = found ? table[index] : (aur_set_callback){0};
    pthread_mutex_unlock(&table_lock);
    if (!found)
        return aur_fail(error, AUR_ERROR_NAME,
                        "unknown set '%s': no function was registered under this name (aur_set_register)",
                        request->set);
    if (request->count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s': a number of points is needed", request->set);
    aur_matrix matrix = {0};
    aur_result result = call(&callback, request, &matrix, error);
    if (result == AUR_OK)
        result = aur_points_interpret(request->set, request->domain, &matrix, points, error);
    free(matrix.values);
    return result;
}

/* --- a file for each size */

/* Whether the last number of a file's name, before the extension of points, is `count`. */
static bool is_of_size(const char *name, uint64_t count) {
    const char *const end = strrchr(name, '.');
    if (end == NULL || (strcmp(end, ".csv") != 0 && strcmp(end, ".npy") != 0))
        return false;
    const char *digits = end;
    while (digits > name && digits[-1] >= '0' && digits[-1] <= '9')
        --digits;
    uint64_t number;
    return digits < end && aur_read_integer(digits, UINT64_MAX, &number) == end && number == count;
}

/* The file of a folder, into path[capacity]. */
static aur_result find_in_folder(const char *folder, uint64_t count, size_t capacity, char *path,
                                 aur_error *error) {
    size_t found = 0;
    DIR *const list = opendir(folder);
    for (const struct dirent *entry; list != NULL && (entry = readdir(list)) != NULL;) {
        if (!is_of_size(entry->d_name, count))
            continue;
        ++found;
        snprintf(path, capacity, "%s%s%s", folder, folder[strlen(folder) - 1] == '/' ? "" : "/",
                 entry->d_name);
    }
    if (list != NULL)
        closedir(list);
    const aur_location where = {.file = folder};
    if (found == 0)
        return aur_fail_at(error, where, AUR_ERROR_OPEN,
                           "no file of %llu points: expected a name that ends in %llu.csv or %llu.npy",
                           (unsigned long long)count, (unsigned long long)count, (unsigned long long)count);
    if (found > 1)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT,
                           "%zu files have names that end in %llu: expected one file for each size", found,
                           (unsigned long long)count);
    return AUR_OK;
}

/* Whether the set has a file for each size. */
static bool has_files(const char *set) {
    struct stat status;
    if (strncmp(set, file_prefix, sizeof file_prefix - 1) != 0)
        return false;
    const char *const path = set + sizeof file_prefix - 1;
    if (stat(path, &status) == 0)
        return S_ISDIR(status.st_mode);
    return strstr(path, size_mark) != NULL;
}

/* The path of the file of that size. */
static aur_result find_path(const char *path, uint64_t count, size_t capacity, char *found,
                            aur_error *error) {
    if (count == 0)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                           "there is a file for each size: a number of points is needed");
    const char *const mark = strstr(path, size_mark);
    struct stat status;
    if (stat(path, &status) == 0 || mark == NULL)
        return find_in_folder(path, count, capacity, found, error);
    const int length = snprintf(found, capacity, "%.*s%llu%s", (int)(mark - path), path,
                                (unsigned long long)count, mark + sizeof size_mark - 1);
    if (length < 0 || (size_t)length >= capacity)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_OPEN, "the path is too long");
    return AUR_OK;
}

static aur_result from_files(const aur_user_request *request, aur_points **points, aur_error *error) {
    char path[4096];
    aur_result result =
        find_path(request->set + sizeof file_prefix - 1, request->count, sizeof path, path, error);
    if (result == AUR_OK)
        result = aur_points_read(path, request->domain, points, error);
    if (result == AUR_OK && (*points)->view.count != request->count) {
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                             "expected %llu points, as its name says (found %zu)",
                             (unsigned long long)request->count, (*points)->view.count);
        aur_points_destroy(*points);
        *points = NULL;
    }
    return result;
}

aur_result aur_user_points(const aur_user_request *request, aur_points **points, aur_error *error) {
    *points = NULL;
    if (strncmp(request->set, callback_prefix, sizeof callback_prefix - 1) == 0)
        return from_callback(request, points, error);
    if (has_files(request->set))
        return from_files(request, points, error);
    return aur_points_read(request->set + sizeof file_prefix - 1, request->domain, points, error);
}
