#!/usr/bin/env bash
# Runs a script test in a folder that is empty, so that what an earlier run left there is not taken for its own:
# fresh_folder.sh FOLDER SCRIPT ARGUMENT...
set -euo pipefail
folder=$1
shift
rm -rf -- "$folder"
mkdir -p -- "$folder"
cd -- "$folder"
exec bash "$@"
