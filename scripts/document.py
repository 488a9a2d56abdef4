"""Documents that are written from results."""

import os


def table(head, *rows):
    """Lines of a table; cells are text."""
    lines = ["| " + " | ".join(cells) + " |" for cells in (head, *rows)]
    lines.insert(1, "|" + "---|" * len(head))
    return "\n".join(lines)


def write(path, text):
    """The whole file, or none."""
    with open(path + ".part", "w", encoding="utf-8") as part:
        part.write(text)
    os.replace(path + ".part", path)
