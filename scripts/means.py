#!/usr/bin/env python3
"""means.py TABLE.csv COLUMN BY...: the mean, least and greatest of a column of a table of the lab over the rows that agree in the
columns BY, such as the averages that the papers' pages quote: means.py docs/report/results/NAME/NAME.csv ratio scene pattern.
Rows without a number are left out, COLUMN=TEXT takes only those with the text, COLUMN!=TEXT those without it."""
import csv
import sys

if len(sys.argv) < 4:
    sys.exit(__doc__)
path, column, words = sys.argv[1], sys.argv[2], [word.partition("=") for word in sys.argv[3:]]
with open(path, newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
for name in [column, *(word[0].rstrip("!") for word in words)]:
    if not rows or name not in rows[0]:
        sys.exit(f"{path}: no column '{name}': there are {', '.join(rows[0]) if rows else 'no rows'}")
by = [name for name, equals, _ in words if not equals]
groups = {}
for row in rows:
    kept = all(name.endswith("!") != (row[name.rstrip("!")] == text) for name, equals, text in words if equals)
    try:
        value = float(row[column])
    except ValueError:
        continue
    if kept:
        groups.setdefault(tuple(row[name] for name in by), []).append(value)
print(*by, "rows", "mean", "least", "greatest", sep=",")
for key, values in groups.items():
    print(*key, len(values), *(f"{v:.4g}" for v in (sum(values) / len(values), min(values), max(values))), sep=",")
