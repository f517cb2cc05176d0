#!/usr/bin/env bash
# Answers do not depend on where a model stands, how it is turned, or its unit (tests/invariance/position.py).
exec python3 "$2/tests/invariance/invariance.py" "$1" "$2" position ${AUREOLE_FULL_INVARIANCE:+full}
