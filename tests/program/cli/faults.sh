#!/usr/bin/env bash
# The short form of scripts/faults.sh: one kill each of renders, a table of weights and an experiment.
exec bash "$2/scripts/faults.sh" "$1" 6 3
