#!/usr/bin/env bash
# Every file of fuzz/corpus belongs to a harness and is replayed by its test, and all of them stay small.
set -u
tests=$(dirname "$1")/fuzz/CTestTestfile.cmake
source_tree=$2
grep -q 'fuzz/scene' "$tests" 2>/dev/null || { echo "skipped: this build has an engine of its own"; exit 77; }
status=0
for folder in "$source_tree"/fuzz/corpus/*/; do
  name=$(basename "$folder")
  [ -f "$source_tree/fuzz/fuzz_$name.c" ] || { echo "$folder belongs to no harness"; status=1; }
  replayed=$(grep "^add_test(.*fuzz/$name\\]" "$tests")
  for file in "$folder"*; do
    [[ $replayed == *"/fuzz/corpus/$name/${file##*/}"* ]] || { echo "$file is not replayed"; status=1; }
  done
done
bytes=$(find "$source_tree/fuzz/corpus" -type f -printf '%s\n' | awk '{ all += $1 } END { print all + 0 }')
[ "$bytes" -gt 0 ] && [ "$bytes" -le 400000 ] || { echo "the corpus has $bytes bytes: 1 to 400000 are wanted"; status=1; }
exit $status
