#!/usr/bin/env bash
# What the libraries show: every function of the public headers, each in one library and in the version that stays; besides
# those only names of this release, and none twice. A program finds all public functions in the two libraries alone.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
status=0
bash "$source_tree/cmake/symbols.sh" "$source_tree"/include/aureole/*.h >public.txt
[ "$(wc -l <public.txt)" -gt 100 ] || { echo "only $(wc -l <public.txt) public functions were read"; exit 1; }
for library in aureole aureole-render; do
  nm -D --defined-only --with-symbol-versions "$build/lib$library.so" | awk '$2 != "A" { print $3 }' >"$library.txt"
done
cat aureole.txt aureole-render.txt >shown.txt
grep '@@AUREOLE_0$' shown.txt | sed 's/@.*//' | sort | diff public.txt - ||
  { echo "< declared and not shown, or > shown twice or declared by no header"; status=1; }
grep -vE '^aur_[a-z0-9_]+@@AUREOLE_(0|PRIVATE_.*)$' shown.txt && { echo "names that are not the libraries' own"; status=1; }
sed 's/@.*//' shown.txt | sort | uniq -d | grep . && { echo "both libraries have these"; status=1; }

{
  sed -n 's|.*/\(aureole/.*\.h\)$|#include <\1>|p' < <(ls "$source_tree"/include/aureole/*.h)
  echo '#include <stdio.h>'
  echo 'typedef void function(void);'
  echo 'int main(void) {'
  echo '    function *const all[] = {'
  sed 's/.*/        (function *)&,/' public.txt
  echo '    };'
  echo '    size_t found = 0;'
  echo '    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) found += all[i] != NULL;'
  echo '    printf("%zu %s\\n", found, aur_version());'
  echo '    return 0;'
  echo '}'
} >all.c
cc=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
flags=
grep -q '^AUREOLE_SANITIZE:BOOL=ON' "$build/CMakeCache.txt" && flags=-fsanitize=address,undefined
"$cc" -std=c17 -Wall -Wextra -Werror $flags -I "$source_tree/include" all.c -o all -L "$build" -laureole-render -laureole \
  -Wl,-rpath,"$build" || exit 1
./all >found.txt || status=1
[ "$(cut -d' ' -f1 found.txt)" = "$(wc -l <public.txt)" ] || { echo "found $(cat found.txt)"; status=1; }
exit $status
