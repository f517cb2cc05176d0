/* Text for LaTeX, for tables and TikZ. */
#include <string.h>

#include "program/report/canvas.h"
#include "program/report/report.h"

void report_escape_latex(FILE *to, const char *text) {
    static const char special[] = "\\{}$&#^_%~";
    static const char *const names[] = {
        "\\textbackslash{}", "\\{", "\\}", "\\$", "\\&", "\\#", "\\textasciicircum{}", "\\_", "\\%",
        "\\textasciitilde{}"};
    for (const char *from = text; *text != '\0'; from = text) {
        const uint32_t letter = report_next_letter(&text);
        const char *const found = letter < 0x7f ? strchr(special, (int)letter) : NULL;
        if (found != NULL)
            fputs(names[found - special], to);
        else if (letter < ' ' || letter == 0x7f || letter == 0xfffd)
            fputc('?', to);
        else
            fwrite(from, 1, (size_t)(text - from), to);
    }
}
