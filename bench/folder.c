#include "folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench.h"

bool bench_folder_create(bench_folder *folder) {
    strcpy(folder->path, "/tmp/aureole-bench-XXXXXX");
    return mkdtemp(folder->path) != NULL || bench_fail("no folder for files in /tmp");
}

void bench_folder_remove(const bench_folder *folder) {
    DIR *const entries = opendir(folder->path);
    if (entries == NULL)
        return;
    for (const struct dirent *entry; (entry = readdir(entries)) != NULL;)
        if (entry->d_name[0] != '.')
            unlinkat(dirfd(entries), entry->d_name, 0);
    closedir(entries);
    rmdir(folder->path);
}
