/* Tolerant matching of file names: from systems that ignore letter case, or with paths of another machine. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/file.h"
#include "points/base/io.h"
#include "render/scene/importers/xml/xml.h"

enum { CAPACITY = 4096 };

/* The first name in a folder, in byte order, that equals the `length` bytes of `name` up to letter case;
 * false if there is none. */
static bool find_in_folder(const char *folder, const char *name, size_t length, char found[CAPACITY]) {
    DIR *const entries = opendir(folder[0] != '\0' ? folder : ".");
    found[0] = '\0';
    for (const struct dirent *entry; entries != NULL && (entry = readdir(entries)) != NULL;) {
        const char *const other = entry->d_name;
        if (strlen(other) == length && strncasecmp(other, name, length) == 0 &&
            (found[0] == '\0' || strcmp(other, found) < 0))
            snprintf(found, CAPACITY, "%s", other);
    }
    if (entries != NULL)
        closedir(entries);
    return found[0] != '\0';
}

/* Matches each component of a relative name in the folder of the previous components, after the first
 * `folder` bytes of `path`. The rest of `path` is replaced by the name found. */
static bool find_parts(const char *name, size_t folder, char path[CAPACITY]) {
    for (size_t used = folder;;) {
        const size_t length = strcspn(name, "/");
        char found[CAPACITY];
        path[used] = '\0';
        if (length > 0 && strncmp(name, "..", length) != 0) {
            if (!find_in_folder(path, name, length, found))
                return false;
        } else {
            snprintf(found, sizeof found, "%.*s", (int)length, name);
        }
        const int written =
            snprintf(path + used, CAPACITY - used, "%s%s", found, name[length] != '\0' ? "/" : "");
        if (written < 0 || (size_t)written >= CAPACITY - used)
            return false;
        used += (size_t)written;
        if (name[length] == '\0')
            return true;
        name += length + 1;
    }
}

static void forgive(const char *file, const char *name, char forgiven[CAPACITY]) {
    const char *const slash = strrchr(file, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - file) + 1 : 0;
    const char *const last = strrchr(name, '/');
    char path[CAPACITY];
    forgiven[0] = '\0';
    if (folder >= sizeof path)
        return;
    memcpy(path, file, folder);
    if ((name[0] != '/' && find_parts(name, folder, path)) ||
        (last != NULL && last[1] != '\0' && find_parts(last + 1, folder, path)))
        snprintf(forgiven, CAPACITY, "%s", path + folder);
}

aur_result aur_xml_forgive_name(const aur_xml_document *document, aur_location location, const char *name,
                                char **used, aur_error *error) {
    char *found, forgiven[CAPACITY] = "";
    *used = NULL;
    if (name[0] == '\0')
        return AUR_OK;
    const aur_result result = aur_xml_find_folder(document, location, name, &found, NULL);
    free(found);
    if (result == AUR_OK) {
        *used = strdup(name);
        return *used != NULL ? AUR_OK : aur_fail_memory(error);
    }
    if (aur_io_leads())
        forgive(location.file, name, forgiven);
    (void)aur_io_agree(sizeof forgiven, forgiven, NULL);
    if (forgiven[0] == '\0')
        return AUR_OK;
    *used = strdup(forgiven);
    return *used != NULL ? AUR_OK : aur_fail_memory(error);
}
