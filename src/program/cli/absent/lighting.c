/* Replaces the commands of libaureole-lighting in a program that is built without it. The lab requires all
 * libraries. */
#include "program/cli/options.h"

#define ABSENT(name_)                                                                                        \
    const cli_command cli_command_##name_ = {                                                                \
        .name = #name_, .summary = "(needs libaureole-lighting)", .absent = "libaureole-lighting"};
ABSENT(irradiance)
ABSENT(viewfactors)
ABSENT(lab)
