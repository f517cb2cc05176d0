"""Writing tables of numbers to data/, for the scripts that compute them."""
import pathlib


def write(name, rows):
    """Replaces the lines of data/NAME.txt below its head."""
    path = pathlib.Path(__file__).resolve().parent.parent / "data" / f"{name}.txt"
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    path.write_text("\n".join([*head, *rows]) + "\n")
