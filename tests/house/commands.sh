#!/usr/bin/env bash
# What the pages show as a command, the program and the tree know: in blocks of code every command and every option of `aureole`, every
# experiment of `aureole lab run`, every bench, every script. (pages.sh runs the commands of the README and the guide.)
set -u
program=$1
cd "$2" || exit 1
"$program" help command --format csv | tail -n +2 | cut -d, -f1 | while read -r verb; do
  echo "$verb"
  "$program" help command "$verb" --format csv | tail -n +2 | grep -oE '^"?(-[a-zA-Z]|-[a-zA-Z], )?-?-[a-z][a-z-]*' | grep -oE '(^|[ "])--?[a-zA-Z][a-z-]*' |
    sed "s/[ \"]//g; s/^/$verb /"
done >"$OLDPWD/known"
"$program" lab list --format csv 2>/dev/null | tail -n +2 | cut -d, -f1 | sed 's/^/experiment /' >>"$OLDPWD/known"
cat bench/bench_*.c | tr '\n' ' ' | grep -oE 'const bench bench_[a-z_]+ = \{ *"[a-z-]+"' | sed 's/.*"\(.*\)"/bench \1/' >>"$OLDPWD/known"
for name in scripts/*; do echo "script ${name#scripts/}"; done >>"$OLDPWD/known"
find . -name '*.md' -not -path './build/*' -not -path './out/*' -not -path './CHANGELOG.md' -print0 | sort -z | xargs -0 awk -v known="$OLDPWD/known" '
  BEGIN { while ((getline line < known) > 0) is[line] }
  function wrong(what) { printf "%s:%d: %s\n", FILENAME, FNR, what; status = 1 }
  FNR == 1 { fenced = 0; rest = "" }
  /^ *```/ { fenced = !fenced; next }
  !fenced && !/^    / { rest = ""; next }
  {
    line = rest $0
    if (line ~ /\\$/) { sub(/\\$/, " ", line); rest = line; next }
    rest = ""
    sub(/(^|  )#.*/, "", line)
    gsub(/"[^"]*"|\047[^\047]*\047/, "TEXT", line)
    count = split(line, part, /[|;&<>]+|\$\(|`/)
    for (i = 1; i <= count; ++i) {
      words = split(part[i], word, /[ \t()]+/)
      for (at = 1; at <= words && (word[at] == "" || word[at] ~ /^[$+]$|=|^(mpirun|time|nice|exec|apptainer)$/); ++at) {}
      if (word[at] ~ /(^|\/)scripts\/[a-z_]+\.(sh|py)$/) { name = word[at]; sub(/.*scripts\//, "", name); if (!(("script " name) in is)) wrong("there is no scripts/" name) }
      if (word[at] ~ /(^|\/)aureole-bench$/ && word[at + 1] ~ /^[a-z]+$/ && word[at + 1] != "list" && !(("bench " word[at + 1]) in is)) wrong("there is no bench " word[at + 1])
      if (word[at] !~ /(^|\/)aureole$/) continue
      verb = word[at + 1]
      if (verb !~ /^[a-z]/ || verb == "help") continue
      if (!(verb in is)) { wrong("aureole has no command " verb); continue }
      ++seen
      name = word[at + 3]
      if (verb " " word[at + 2] == "lab run" && name ~ /^[a-z0-9-]+$/ && name !~ /^-/ && $0 !~ /--module/ && !(("experiment " name) in is)) wrong("there is no experiment " name)
      for (j = at + 2; j <= words; ++j) {
        if (word[j] ~ /^--[a-z]/) { option = word[j]; sub(/[=\[\].].*/, "", option); if (!((verb " " option) in is)) wrong("aureole " verb " has no option " option) }
      }
    }
  }
  END { if (seen < 60) { print "only " seen + 0 " commands were found"; status = 1 }; exit status }'
