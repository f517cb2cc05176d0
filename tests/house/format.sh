#!/usr/bin/env bash
# Every C and C++ file is as clang-format 14 (Debian 12's) leaves it; other versions differ, so they are not asked.
set -u
cd "$2" || exit 1
formatter=
for candidate in clang-format-14 clang-format; do
  if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then formatter=$candidate; break; fi
done
[ -n "$formatter" ] || { echo "skipped: clang-format 14 is not installed"; exit 77; }
find include src lab scenes tests bench fuzz examples python -type f \( -name '*.c' -o -name '*.h' -o -name '*.cpp' \) -print0 2>/dev/null |
  xargs -0 "$formatter" --dry-run -Werror
