"""invariance.py PROGRAM SOURCE PART [full]: runs the rows of a part of the table, or of all, in the current folder.

Prints a Markdown table, and each row to standard error as it ends; the status is 1 where a relation does not hold."""

import sys
import traceback

import execution  # noqa: F401  each file adds its rows
import integrals  # noqa: F401
import numbers_of_points  # noqa: F401
import position  # noqa: F401
import writing  # noqa: F401
from relations import ROWS
from runs import Context


def print_table(rows):
    """Rows of one change and one expectation are one line, with all of their commands."""
    lines = {}
    for command, change, expectation, seen in rows:
        commands, found = lines.setdefault((change, expectation), ([], []))
        commands.append(command)
        if seen not in found:
            found.append(seen)
    print("| what changes | of | must hold | seen |\n|---|---|---|---|")
    for (change, expectation), (commands, found) in lines.items():
        print(f"| {change} | {', '.join(f'`{c}`' for c in dict.fromkeys(commands))} | {expectation} | {'; '.join(found)} |")


def main():
    program, source, part = sys.argv[1:4]
    context = Context(program, source, sys.argv[4:] == ["full"])
    rows = [row for row in ROWS if part in ("all", row[0])]
    assert rows, f"no part {part}: expected one of {sorted({row[0] for row in ROWS})}"
    results = []
    for _, command, change, expectation, function in rows:
        try:
            seen = function(context)
        except AssertionError as error:
            seen = f"FAILED: {error}"
        except Exception:  # a defect of the row itself
            seen = f"FAILED: {traceback.format_exc()}"
        results.append((command, change, expectation, seen))
        print(f"{command}: {change}: {seen}", file=sys.stderr, flush=True)
    failures = sum(seen.startswith("FAILED") for *_, seen in results)
    print_table(results)
    print(f"{len(rows)} relations, {failures} failed", file=sys.stderr)
    return failures != 0


sys.exit(main())
