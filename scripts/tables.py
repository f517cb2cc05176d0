"""Reading and writing tables of numbers in data/, for the scripts that compute them."""
import pathlib


def path_of(name):
    return pathlib.Path(__file__).resolve().parent.parent / "data" / f"{name}.txt"


def read(name):
    """The lines of data/NAME.txt below its head."""
    return [line for line in path_of(name).read_text().splitlines() if not line.startswith("#")]


def write(name, rows):
    """Replaces the lines of data/NAME.txt below its head."""
    path = path_of(name)
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    path.write_text("\n".join([*head, *rows]) + "\n")
