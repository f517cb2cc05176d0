#!/usr/bin/env bash
# Answers do not depend on how a model is written: its format, order, corners, comments (tests/invariance/writing.py).
exec python3 "$2/tests/invariance/invariance.py" "$1" "$2" writing ${AUREOLE_FULL_INVARIANCE:+full}
