"""Drawings in SVG, as matplotlib writes them, made small for a page that has many."""

import base64
import io
import re

from PIL import Image
from markupsafe import Markup, escape

COLOURS = 64  # of a map that is an image
STEP = re.compile(r"([MLQCz])([^MLQCz]*)")  # of a path: what is drawn, and the numbers of its points
PATH = re.compile(r' d="([^"]*)"')
PLACE = re.compile(r'translate\([^)]*\)| [xy]="[^"]*"')
LONG_NUMBER = re.compile(r"-?\d+\.\d{2,}")  # of an SVG's units, 1/72 inch
IMAGE = re.compile(r"data:image/png;base64,([^\"]*)")
EQUAL_LINES = re.compile(r'<path d="[^"]*"( clip-path="[^"]*" style="fill: none;[^"]*"/>)(?:\s*<path d="[^"]*"\1)+')
FIRST_POINT, LAST_POINT = re.compile(r"(?:\s*M (\S+ \S+)\s*)?"), re.compile(r"([-\d.]+ [-\d.]+)?\s*$")  # of a path that has them
LETTER = re.compile(r'<path id="([^"]*)" d="([^"]*)" transform="scale\(0\.015625\)"/>\s*')


def compact(svg):
    """The same drawing with places in tenths, maps of few colours, and no space between elements."""
    svg = PATH.sub(relative, EQUAL_LINES.sub(joined, svg))
    svg = PLACE.sub(lambda place: LONG_NUMBER.sub(lambda number: f"{float(number[0]):.1f}", place[0]), svg)
    return re.sub(r">\s+<", "><", IMAGE.sub(few_colours, svg))


def relative(path):
    """A path with each point, in tenths, relative to the end of the step before, which needs fewer digits; no steps of no length."""
    words, begin, end = [], (0, 0), (0, 0)
    for letter, numbers in STEP.findall(path[1]):
        tenths = [round(10 * float(number)) for number in numbers.split()]
        points = list(zip(tenths[::2], tenths[1::2]))
        if letter == "M":
            begin = points[0]
            words.append(f"M{pair(*begin)}")
        elif letter == "z":
            words.append("z")
        elif set(points) != {end} or words[-1].startswith("M"):
            words.append(letter.lower() + " ".join(pair(x - end[0], y - end[1]) for x, y in points).replace(" -", "-"))
        end = points[-1] if points else begin
    return f' d="{"".join(words)}"'


def pair(x, y):
    """Two numbers of tenths, as a path has them."""
    x, y = (re.sub(r"\b0\.", ".", f"{number / 10:g}") for number in (x, y))
    return f"{x}{'' if y.startswith('-') else ' '}{y}"


def joined(lines):
    """Lines of one look, one after the other, as one path; an open line that begins where the last one ended continues it."""
    out, end = "", None
    for line in PATH.findall(lines[0]):
        first = FIRST_POINT.match(line)
        out += line[first.end():] if end and first[1] == end and "z" not in line else line
        end = LAST_POINT.search(line)[1]
    return f'<path d="{out}"{lines[1]}'


def few_colours(image):
    """The image with few colours, a sixth of the bytes."""
    buffer = io.BytesIO()
    picture = Image.open(io.BytesIO(base64.b64decode(image[1])))
    picture.quantize(COLOURS, method=Image.Quantize.FASTOCTREE).save(buffer, "png", optimize=True)
    return f"data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}"


def inline(svg, name, title, description):
    """The SVG as an element of a page, and the shapes of its letters by their names, which the page has once for all drawings, with
    ids of `letter-` and the name. Other ids begin with the drawing's name; no style rules affect the rest of the page."""
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<style.*?</style>", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    letters = dict(LETTER.findall(svg))
    svg = re.sub(r"<defs>\s*</defs>", "", LETTER.sub("", svg))
    used = set(re.findall(r'(?:href="|url\()#([^")]*)', svg))
    svg = re.sub(r' id="([^"]*)"',
                 lambda found: f' id="{name}-{found.group(1)}"' if found.group(1) in used else "", svg)
    svg = re.sub(r'href="#([^"]*)', lambda found: f'href="#{"letter" if found[1] in letters else name}-{found[1]}', svg)
    svg = svg.replace("url(#", f"url(#{name}-")
    box = re.search(r'viewBox="([^"]*)"', svg).group(1)
    words = (f'<title id="{name}-title">{escape(title)}</title>'
             f'<desc id="{name}-desc">{escape(description)}</desc>')
    start = (f'<svg xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="{box}" class="plot" role="img" '
             f'aria-labelledby="{name}-title {name}-desc" stroke-linejoin="round" stroke-linecap="butt">')
    return Markup(start + words + svg[svg.index(">") + 1:]), letters
