#!/usr/bin/env bash
# Writes docs/architecture.svg, the folders of src from top to bottom as tests/house/check_includes.sh has them, to standard output.
# A folder's own folders are one with it: where they stand on several lines, the folder stands on the highest of them.
set -eu
sed -n "/^floors='/,/^'/p" "$(dirname "$0")/../tests/house/check_includes.sh" | sed '1d;$d' | awk '
  { split("", new); count = 0
    for (i = 1; i <= NF; ++i) {
      split($i, part, "/")
      name = part[1] "/" part[2]
      if (!(name in known)) { known[name] = 1; new[++count] = name }
    }
    if (count == 0) next
    ++rows
    library[rows] = part[1]
    for (i = 1; i <= count; ++i) { sub(/.*\//, "", new[i]); text[rows] = text[rows] (i > 1 ? "|" : "") new[i] }
  }
  END {
    WIDTH = 640; ROW = 30; LEFT = 190
    color["program"] = "#ecd9c6"; color["lighting"] = "#f5e7a8"; color["render"] = "#c9dcf0"; color["points"] = "#cfe8cf"
    label["program"] = "aureole"; label["lighting"] = "libaureole-lighting"; label["render"] = "libaureole-render"; label["points"] = "libaureole"
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"13\">\n", WIDTH, rows * ROW + 8
    print "<title>The folders of src: each includes only what stands below it</title>"
    printf "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n", WIDTH, rows * ROW + 8
    for (r = 1; r <= rows; ++r) {
      y = 4 + (r - 1) * ROW
      if (library[r] != library[r - 1]) {
        for (last = r; library[last + 1] == library[r]; ++last);
        printf "<rect x=\"4\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", y, WIDTH - 8, (last - r + 1) * ROW - 2, color[library[r]]
        printf "<text x=\"14\" y=\"%d\" font-weight=\"bold\">src/%s</text>\n", y + 19, library[r]
        if (last > r) printf "<text x=\"14\" y=\"%d\">%s</text>\n", y + 38, label[library[r]]
      }
      n = split(text[r], names, "|")
      for (i = 1; i <= n; ++i) {
        width = (WIDTH - LEFT - 8) / n
        x = LEFT + (i - 1) * width
        printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"#fff\" stroke=\"#888\"/>", x, y + 3, width - 6, ROW - 8
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n", x + width / 2 - 3, y + 18, names[i]
      }
    }
    print "</svg>"
  }'
