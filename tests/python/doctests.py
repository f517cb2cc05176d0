"""doctests.py SOURCE_TREE: runs the examples of every module of the package and of docs/python.md, and says how many."""

import doctest
import importlib
import pkgutil
import sys

import aureole

OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
PUBLIC = {name: getattr(aureole, name) for name in aureole.__all__}

attempted = failed = 0
for module in pkgutil.iter_modules(aureole.__path__, "aureole."):
    if module.name in ("aureole._native", "aureole._library"):
        continue
    try:
        loaded = importlib.import_module(module.name)
    except ModuleNotFoundError as error:
        if error.name not in ("scipy", "matplotlib"):
            raise
        print(f"{module.name} is left out: there is no {error.name}")
        continue
    result = doctest.testmod(loaded, optionflags=OPTIONS, extraglobs=PUBLIC)
    attempted, failed = attempted + result.attempted, failed + result.failed
for name in ("docs/python.md",):
    result = doctest.testfile(f"{sys.argv[1]}/{name}", module_relative=False, optionflags=OPTIONS)
    attempted, failed = attempted + result.attempted, failed + result.failed
    if result.attempted == 0:
        sys.exit(f"{name} has no example")
print(f"{attempted} examples")
missing = [name for name in aureole.__all__ if not (getattr(aureole, name).__doc__ or "").strip()]
if missing:
    sys.exit(f"no docstring: {missing}")
sys.exit(failed != 0)
