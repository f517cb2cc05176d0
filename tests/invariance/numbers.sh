#!/usr/bin/env bash
# Answers do not depend on the order, rotation, format or scale of points and light where arithmetic says so (tests/invariance/numbers_of_points.py).
exec python3 "$2/tests/invariance/invariance.py" "$1" "$2" numbers ${AUREOLE_FULL_INVARIANCE:+full}
