#!/usr/bin/env bash
# Answers do not depend on threads, ranks, shards, instruction sets, caches and locales (tests/invariance/execution.py).
exec python3 "$2/tests/invariance/invariance.py" "$1" "$2" execution ${AUREOLE_FULL_INVARIANCE:+full}
