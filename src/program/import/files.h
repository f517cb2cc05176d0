/* Files that assimp opens: the library reads them. */
#pragma once

#include <assimp/cfileio.h>

/* Replaces %XX by the bytes that are meant, in names of glTF. */
void files_decode_address(char *text);
/* As aiFileIO has them; UserData: the name of a model that names others by addresses, or NULL. */
struct aiFile *files_open(struct aiFileIO *io, const char *name, const char *mode);
void files_close(struct aiFileIO *io, struct aiFile *file);
