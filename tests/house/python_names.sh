#!/usr/bin/env bash
# Names in Python files exist: what a file takes from another file beside it is defined there, and what a function reads is a parameter, a
# variable, a name of its file or Python's. Most comparisons with other programs run in no test, because they need these programs.
set -u
cat >names.py <<'END'
import ast, builtins, pathlib, symtable, sys

KNOWN = set(dir(builtins)) | {"__file__", "__name__", "__doc__", "__path__", "__spec__", "__class__"}

def scopes(table):
    yield table
    for child in table.get_children():
        yield from scopes(child)

def defined(text, path):  # names of the whole file
    table = symtable.symtable(text, str(path), "exec")
    names = {symbol.get_name() for symbol in table.get_symbols() if symbol.is_assigned() or symbol.is_imported() or symbol.is_namespace()}
    for scope in scopes(table):
        names |= {symbol.get_name() for symbol in scope.get_symbols() if symbol.is_declared_global() and symbol.is_assigned()}
    return table, names

def mistakes(path):
    text = path.read_text()
    tree = ast.parse(text)
    if any(isinstance(node, ast.ImportFrom) and node.names[0].name == "*" for node in ast.walk(tree)):
        return
    table, names = defined(text, path)
    missing = {symbol.get_name() for scope in scopes(table) for symbol in scope.get_symbols()
               if symbol.is_referenced() and symbol.is_global() and symbol.get_name() not in names | KNOWN}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id in missing:
            yield f"{path}:{node.lineno}: there is no '{node.id}'"
        if isinstance(node, ast.ImportFrom) and node.level == 0 and (other := path.parent / f"{node.module}.py").is_file():
            for alias in node.names:
                if alias.name not in defined(other.read_text(), other)[1]:
                    yield f"{path}:{node.lineno}: {other.name} has no '{alias.name}'"

files = [pathlib.Path(name) for name in sys.argv[1:]]
found = [text for path in files for text in mistakes(path)]
print(*found, sep="\n")
sys.exit(bool(found) or not files)
END
mkdir wrong && printf 'def half():\n    return 1\n' >wrong/given.py && printf 'from given import half, whole\n\ndef f(x):\n    return half() + x + y\n' >wrong/taker.py
python3 names.py wrong/*.py >said && { echo "a wrong import and an undefined name pass"; exit 1; }
[ "$(grep -c "has no 'whole'\|there is no 'y'" said)" = 2 ] || { echo "other mistakes are named:"; cat said; exit 1; }
cd "$2" || exit 1
# scripts/lab_numbers.py gives docs/papers/numbers.py names.
find bench docs examples python scripts tests -name '*.py' -not -path docs/papers/numbers.py -print0 | xargs -0 python3 "$OLDPWD/names.py"
