/* Files that assimp opens: the library reads them. */
#pragma once

#include <assimp/cfileio.h>

/* As aiFileIO has them. */
struct aiFile *files_open(struct aiFileIO *io, const char *name, const char *mode);
void files_close(struct aiFileIO *io, struct aiFile *file);
