/* The program's side of render/scene/importers/model/message.h. What cannot be sent or received ends the
 * program: nobody is there to be told. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"
#include "render/scene/importers/model/message.h"

void stream_send(aur_import_kind kind, uint32_t value, size_t size, const void *data);
/* In two pieces, one after the other. */
void stream_send_two(aur_import_kind kind, size_t head_size, const void *head, size_t size, const void *data);
/* The next message, of this kind. *data is malloc'ed, with a zero byte after it; returns the value. */
uint32_t stream_receive(aur_import_kind kind, size_t *size, char **data);
/* Sends what has gone wrong, and ends the program. */
_Noreturn void stream_fail(aur_result result, const char *format, ...) AUR_PRINTF(2, 3);
_Noreturn void stream_fail_memory(void);
