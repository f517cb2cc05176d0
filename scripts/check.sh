#!/usr/bin/env bash
# Set-up, release and sanitizer builds, and every test in both. The first and only command after a clone.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/deps.sh --all
jobs=$(nproc)
for preset in release asan; do
  echo "== build, $preset"
  cmake --preset "$preset" --log-level=WARNING
  cmake --build --preset "$preset" -j "$jobs"
done
for preset in release asan; do
  echo "== tests, $preset"
  ctest --preset "$preset" -j "$jobs" </dev/null
done
