/* Placeholder translation unit until the room is filled. */
#include <aureole/image.h>
