#!/usr/bin/env python3
"""lab_numbers.py check|fill: whether the numbers on the pages of docs are those of the lab's kept tables, or puts them there.

docs/papers/numbers.py binds them: it writes lines of the pages with values of docs/report/results in the place of numbers. A number is
right when it is the value, rounded to its digits; fill writes the others with as many digits. A line that is not on its page is an error,
so a changed sentence changes its binding. check prints the wrong ones and returns 1."""
import csv
import functools
import pathlib
import re
import runpy
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
PAGES, KEPT = TOP / "docs/papers", TOP / "docs/report/results"
NUMBER = r"[-+]?(?:\d[\d,]*)?\.?\d+(?:e[-+]?\d+)?"


@functools.lru_cache(None)
def read(name):
    """The lines of "EXPERIMENT" or "EXPERIMENT/TABLE", and its notes."""
    experiment, _, further = name.partition("/")
    path = KEPT / experiment / f"{experiment}{'-' if further else ''}{further}.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if line[0] != "#")), [line[2:] for line in lines if line[0] == "#"]


def same(cell, wanted):
    try:
        return abs(float(cell) - float(wanted)) <= 1e-9 * abs(float(wanted))
    except ValueError:
        return cell == str(wanted)


def rows(name, **where):
    """The rows whose columns have these values; a value may be a function of the cell."""
    return [row for row in read(name)[0]
            if all(is_(row[c]) if callable(is_) else same(row[c], is_) for c, is_ in where.items())]


def put(value):
    """A number in a line."""
    return f"\x01{float(value)!r}\x02"


def value(name, column, by=1.0, plus=0.0, **where):
    """The cell of the one row, times `by`, plus `plus`."""
    found = rows(name, **where)
    if len(found) != 1:
        sys.exit(f"numbers.py: {name} has {len(found)} rows of {where}")
    return put(float(found[0][column]) * by + plus)


def cell(name, form, **where):
    """The one row's values in a text: "{ratio} ({low} to {high})", "{shares*100}"."""
    return re.sub(r"\{([\w.]+)\*?([^}]*)\}", lambda m: value(name, m.group(1), float(m.group(2) or 1), **where), form)


def count(name, **where):
    return put(len(rows(name, **where)))


def verdicts(name, **where):
    """The counts of published values, those that agree, those within the factor, and those that differ."""
    found = [row["verdict"] for row in rows(name, **where) if row["verdict"] != "not published"]
    return [put(n) for n in (len(found), found.count("agrees"), sum(v.startswith("within") for v in found), found.count("differs"))]


def note(name, pattern):
    """The numbers that the groups of a pattern find in the notes."""
    found = [match for line in read(name)[1] for match in [re.search(pattern, line)] if match]
    if len(found) != 1:
        sys.exit(f"numbers.py: {len(found)} notes of {name} have '{pattern}'")
    return [put(group) for group in found[0].groups()]


def right(text, wanted):
    if "e" in text:
        return float(rounded(text, wanted)) == float(text)
    digits = len(text.partition(".")[2])
    return abs(float(text.replace(",", "")) - wanted) <= 0.5001 * 10.0**-digits


def rounded(text, wanted):
    """The value with the digits of a text: after the point, or significant ones where either is below .1."""
    if "e" in text:
        return f"{wanted:.{len(text.partition('e')[0].partition('.')[2])}e}"
    digits = len(text.partition(".")[2])
    if digits and min(abs(wanted), abs(float(text))) < 0.1 and wanted:
        significant = len(text.partition(".")[2].lstrip("0"))
        digits = max(digits, significant - 1 - int(f"{wanted:e}".partition("e")[2]))
    new = f"{wanted:,.{digits}f}" if "," in text or abs(wanted) >= 1e4 else f"{wanted:.{digits}f}"
    return re.sub(r"^(-?)0\.", r"\1.", new) if re.match(r"-?\.", text) else new


class Pages:
    def __init__(self):
        self.texts, self.wrong, self.bound = {}, [], 0

    def line(self, page, template):
        """Binds a line, or a part of one, of a page."""
        path = PAGES / page
        text = self.texts.setdefault(path, path.read_text(encoding="utf-8"))
        values = [float(v) for v in re.findall("\x01(.*?)\x02", template)]
        parts = [re.sub(r"(\\ |\\\n)+", r"\\s+", re.escape(part)) for part in re.split("\x01.*?\x02", template)]
        found = list(re.finditer(rf"\**({NUMBER})\**".join(parts), text))  # bold or not
        if len(found) != 1:
            plain = re.sub("\x01.*?\x02", "#", template)
            self.wrong.append(f"{page}: {len(found)} places are as numbers.py has: {plain}")
            return
        out, at = [], 0
        for k, wanted in enumerate(values):
            begin, end = found[0].span(k + 1)
            old = text[begin:end]
            if not right(old, wanted):
                row = text.count("\n", 0, begin) + 1
                self.wrong.append(f"{page}:{row}: {old} is {rounded(old, wanted)} in the kept table: {text.splitlines()[row - 1][:60]}")
                old = rounded(old, wanted)
            out += [text[at:begin], old]
            at = end
        self.bound += len(values)
        self.texts[path] = "".join(out) + text[at:]


def main():
    if sys.argv[1:] not in (["check"], ["fill"]):
        sys.exit(__doc__)
    pages = Pages()
    runpy.run_path(str(PAGES / "numbers.py"), {
        "line": pages.line, "value": value, "cell": cell, "count": count, "verdicts": verdicts, "note": note, "rows": rows, "put": put})
    print(*pages.wrong, f"{pages.bound} numbers of {len(pages.texts)} pages", sep="\n")
    if sys.argv[1] == "fill":
        for path, text in pages.texts.items():
            path.write_text(text, encoding="utf-8")
    sys.exit(1 if pages.wrong and (sys.argv[1] == "check" or any("places" in w for w in pages.wrong)) else 0)


main()
