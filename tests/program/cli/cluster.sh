#!/usr/bin/env bash
# The batch script of docs/cluster, a task after another as Slurm starts them, makes the image of one render.
set -euo pipefail
aureole=$1 source=$2
rm -rf cluster
mkdir -p cluster/bin
cd cluster
ln -s "$aureole" bin/aureole
export PATH=$PWD/bin:$PATH SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=2
cp -r "$source/scenes/cornell-box" box
sed -i 's/<default name="spp" value="[0-9]*"/<default name="spp" value="2"/' box/cornell-box.xml
for task in 1 2 3; do
  SLURM_ARRAY_TASK_ID=$task bash "$source/docs/cluster/render-array.slurm" box/cornell-box.xml
done
aureole merge cornell-box.*-of-3.part -o parts.exr
AUREOLE_ISA=avx2 aureole render box/cornell-box.xml -o whole.exr -q
cmp whole.exr parts.exr || { echo "three tasks make another image" >&2; exit 1; }
