"""Documents that are written from results."""

from style import write_whole


def table(head, *rows):
    """Lines of a table; cells are text."""
    lines = ["| " + " | ".join(cells) + " |" for cells in (head, *rows)]
    lines.insert(1, "|" + "---|" * len(head))
    return "\n".join(lines)


def write(path, text):
    write_whole(path, text.encode())
