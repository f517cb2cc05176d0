#!/usr/bin/env bash
# Runs a test in a folder of its own that is empty, so that it reads no file of an earlier run or of another test that runs
# beside it: fresh_folder.sh FOLDER COMMAND ARGUMENT...
set -euo pipefail
folder=$1
shift
rm -rf -- "$folder"
mkdir -p -- "$folder"
cd -- "$folder"
exec "$@"
