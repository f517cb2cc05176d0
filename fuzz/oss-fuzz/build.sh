#!/bin/bash -eu
# Builds every harness of fuzz/ with its seeds and the dictionary. Run by OSS-Fuzz's base-builder, which sets CC, CFLAGS,
# LIB_FUZZING_ENGINE, SRC, WORK and OUT.
cmake -S "$SRC/aureole" -B "$WORK/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=OFF \
  -DAUREOLE_WERROR=OFF -DAUREOLE_MPI=OFF -DAUREOLE_FUZZING_ENGINE="$LIB_FUZZING_ENGINE"
cmake --build "$WORK/build" --target fuzzers
mkdir -p "$OUT/lib"
for harness in "$WORK"/build/fuzz/fuzz_*; do
  [ -f "$harness" ] && [ -x "$harness" ] || continue
  name=$(basename "$harness")
  cp "$harness" "$OUT/"
  # The machines that fuzz have none of the packages of this one.
  ldd "$harness" | awk '$3 ~ /^\// && $1 !~ /^(libc|libm|libdl|librt|libpthread|ld-linux.*)\.so/ { print $3 }' |
    xargs -r cp -n -L -t "$OUT/lib"
  patchelf --force-rpath --set-rpath '$ORIGIN/lib' "$OUT/$name"
  cp "$SRC/aureole/fuzz/keys.dict" "$OUT/$name.dict"
  # The harness's own seeds, and those of the tree.
  seeds=$WORK/seeds/${name#fuzz_}
  mkdir -p "$seeds"
  (cd "$WORK" && AUREOLE_FUZZ_SEEDS=$seeds "$harness")
  find "$SRC/aureole/fuzz/corpus/${name#fuzz_}" -type f -exec cp -t "$seeds" {} + 2>/dev/null || true
  (cd "$seeds" && zip -q "$OUT/${name}_seed_corpus.zip" ./*)
done
for library in "$OUT"/lib/*; do patchelf --force-rpath --set-rpath '$ORIGIN' "$library"; done
