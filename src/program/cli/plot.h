/* Pictures of figures by gnuplot. */
#pragma once

#include <stdbool.h>
#include <stdio.h>

typedef struct cli_plot {
    FILE *script; /* write gnuplot's commands and data here */
    const char *path;
} cli_plot;

/* Whether a picture can be drawn into `path`, which must end in .svg, .pdf or .png; else says so. */
bool cli_plot_can(const char *path);
/* Begins a script with a terminal for `path`, which ends in .svg, .pdf or .png, of that many pixels. On
 * failure prints the error and returns false. */
bool cli_plot_open(const char *path, int width, int height, cli_plot *plot);
/* Writes text that stands between single quotes in a command: quotes are doubled, and control characters,
 * which would end the command, become question marks. */
void cli_plot_text(cli_plot *plot, const char *text);
/* Runs gnuplot and replaces the file by the picture, whole or not at all; returns the exit status, after
 * printing what went wrong. */
int cli_plot_close(cli_plot *plot);
