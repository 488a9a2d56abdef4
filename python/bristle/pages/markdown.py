"""Documents in Markdown."""

import re
import textwrap

from ..errors import BristleError
from ..files import write_text

COLUMNS = 100


def table(head, *rows):
    """Lines of a table; cells are text."""
    lines = ["| " + " | ".join(cells) + " |" for cells in (head, *rows)]
    lines.insert(1, "|" + "---|" * len(head))
    return "\n".join(lines)


def filled(text):
    """The text with its paragraphs and list items (of two levels) wrapped; headings, tables, images and blocks of code stay."""
    return "\n\n".join(fill_block(block) for block in text.rstrip("\n").split("\n\n")) + "\n"


def replace_between(path, begin, end, text):
    """Replaces what stands between two marks in a document; the marks stay."""
    with open(path, encoding="utf-8") as file:
        page = file.read()
    pattern = f"({re.escape(begin)}\n).*?({re.escape(end)})"
    if not re.search(pattern, page, re.S):
        raise BristleError(f"{path}: has no place to write to; it begins with {begin} and ends with {end}")
    write_text(path, re.sub(pattern, lambda marks: marks[1] + text + marks[2], page, flags=re.S))


def fill_block(block):
    if re.match(r"[#|!]|```", block):
        return block
    items = [re.sub(r"\n\s+", "\n", item) for item in re.split(r"\n(?=(?:  )?- )", block)]
    # No break within formulas, code and links, nor before a word that would begin a list or a heading.
    unbroken = r"\$[^$]+\$|`[^`]+`|\[[^]]+\]\([^)]*\)|\s(?=(?:[-+*#]|\d+[.)])\s)"
    kept = [re.sub(unbroken, lambda found: re.sub(r"\s", "\0", found.group()), item) for item in items]
    return "\n".join(fill_item(item) for item in kept).replace("\0", " ")


def fill_item(item):
    """A paragraph, or one item of a list. Its continuation lines are indented as far as its text."""
    bullet = re.match(r"(?:[ \0]*- )?", item).group()  # \0: see fill_block
    return textwrap.fill(item, COLUMNS, break_long_words=False, break_on_hyphens=False,
                         subsequent_indent=" " * len(bullet))
