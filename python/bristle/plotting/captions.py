"""A caption in LaTeX for each page of a figure, with the values of the result."""

import re
import unicodedata
from functools import partial
from types import SimpleNamespace

from ..results import (CHOICE_NAMES, as_text, attribute, axis_names, axis_values, dataset, experiment, readable,
                       status_counts, status_words)
from .curves import with_symbol
from .page import drawn_on
from .readings import AXIS, reading_name, readings
from .remarks import pinned_note, validity_note
from .style import described

# Signs of the result's own texts that mean something to LaTeX, as characters that no text has until in_latex().
SPECIAL = {"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "^": r"\^{}",
           "~": r"\textasciitilde{}"}
HELD = {sign: chr(0xE000 + ord(sign)) for sign in SPECIAL}
# What symbols of quantities are made of. Another command would be executed.
SYMBOL = re.compile(r"(\\(tilde|check|mathrm|langle|rangle|angle|min|times|Delta|alpha|beta|gamma|delta|epsilon|zeta|theta|kappa|"
                    r"lambda|mu|nu|xi|rho|sigma|tau|varphi|phi|omega)(?![A-Za-z])|[^\\$%#&~])*")
CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]")
CONTACTS = {"wall": "exponential wall, Eq. (3)", "hertz": "Hertz"}
LATEX = {"%": r"\%", "\u2013": "--", "\u00b0": r"$^\circ$", "theta_0 ": r"$\theta_0$ "}


def captions(module, file, y=None, panels=None):
    """\\caption{...} for each page of the module's main figure, then of its further figures; of chosen panels, the former."""
    if module.__name__.endswith((".curve", ".map")):
        name = y or "R_x_norm"
        dataset(file, name)  # must be there
        module = SimpleNamespace(**{**vars(module), "VARIABLES": [name], "TITLES": {"": attribute(file[name], "long_name")},
                                    "draw": partial(module.draw, y=name)})
    out = []
    for ending, draw in {"": module.draw, **({} if panels else getattr(module, "FURTHER", {}))}.items():
        shown = draw.shown(file) if hasattr(draw, "shown") else [{}]
        for i, reading in enumerate(shown):
            chosen = panels_of(draw(file, **({"reading": reading} if reading else {}), panels=panels)) if panels else []
            with drawn_on(panels=panels):
                text = caption(module, file, reading, i + 1 if len(shown) > 1 else 0, ending, chosen)
            out.append(f"% {ending}\n" * bool(ending) + text)
    return out


def panels_of(figure):
    """(letter, what it shows) of each panel of a drawn figure."""
    return [(letter, list(filter(None, labels))) for letter, labels in
            (axes.panel for axes in figure.axes if hasattr(axes, "panel"))]


def title_of(module, file, ending=""):
    """Of the module's main figure, or of a further one."""
    return getattr(module, "TITLES", {}).get(ending) or as_text(file.attrs.get("title", ""))


def caption(module, file, reading, page, ending="", chosen=()):
    """chosen: the panels, as of `panels_of`, that the figure has instead of all."""
    title = re.sub(r"^(Figure|Appendix) \w+(, continued)?: ", "", plain(title_of(module, file, ending)))
    labels = [label for _, found in chosen for label in found]
    names = [name for name in getattr(module, "VARIABLES", []) if name in file and not ending]
    if any(described(file[name]) in labels for name in names):
        names = []
    shown = [f"{plain(attribute(file[name], 'long_name'))}, {latex_symbol(attribute(file[name], 'symbol'))}" for name in names]
    if len(names) > 1 and hasattr(module.draw, "shown"):  # a panel for each
        shown = [f"({letter}) {text}" for letter, text in zip("abcdefg", shown)]
    shown += [f"({letter}) " * bool(letter) + with_symbols(", ".join(found)) for letter, found in chosen]
    part = of_labels(file.sel({axis: [value] for axis, value in {**getattr(module, "CHOSEN", {}), **reading}.items()}), labels)
    axes = [name for name in axis_names(dataset(part, "status")) if name not in (AXIS, "sample")]
    over, fixed = ([axis_range(part, name) for name in axes if (part.sizes[name] > 1) == several] for several in (True, False))
    models = [name for name in model_names(part) if name not in labels]
    if shown and shown[0].startswith(f"{title},"):
        title = ""
    sentences = [title, "; ".join(shown), f"Plotted over {'; '.join(over)}" if over else "",
                 f"Fixed: {'; '.join([*fixed, with_symbols(file.attrs.get('caption', ''))])}",
                 f"Model{'s' * (len(models) > 1)} of bending: {', '.join(models)}" if models else "", contact(part),
                 marks(module, file, ending), *remarks(part), statuses(part) if getattr(module, "STATUSES", True) else ""]
    text = in_latex(". ".join(sentence[0].upper() + sentence[1:] for sentence in sentences if sentence))
    return f"% page {page}\n" * bool(page) + f"\\caption{{{text}.}}"


def model_names(file):
    """The models of bending, also the one of a result that has no axis of them."""
    names = list(filter(None, map(reading_name, readings(file))))
    own = experiment(file).get("model", {}).get("bending")
    return names or ([CHOICE_NAMES.get(own, readable(own))] if own else [])


def contact(file):
    """The contact with the slab, in words; empty if it is an axis of the result."""
    own = experiment(file).get("model", {}).get("contact")
    return f"Contact: {CONTACTS.get(own, readable(own))}" if own and "contact" not in file.dims else ""


def of_labels(file, labels):
    """The part of the result that the panels with these labels show: of axes whose values are among them, only these."""
    for axis in axis_names(dataset(file, "status")):
        if found := [value for value in axis_values(file, axis) if with_symbol(dataset(file, axis), value) in labels]:
            file = file.sel({axis: found})
    return file


def axis_range(file, name):
    data, line = dataset(file, name), axis_values(file, name)
    if isinstance(line[0], str):
        return f"{readable(name)}: {', '.join(CHOICE_NAMES.get(word, readable(word)) for word in line)}"
    title = plain(data.attrs.get("long_name", readable(name)))
    symbol, units = as_text(data.attrs.get("symbol", "")), plain(data.attrs.get("units", "1"))
    values = f"{line[0]:.4g} to {line[-1]:.4g}" if len(line) > 5 else ", ".join(f"{value:.4g}" for value in line)
    values += "" if units == "1" else f" {units}"
    return f"{title}, {latex_symbol(symbol + ' =')} {values}" if symbol not in ("", name) else f"{title}, {values}"


def remarks(file):
    """What the notes of the standard figure say of the result: pinned bristles, and where the model is beyond its limits."""
    return [plain(note(file)).removesuffix(".") for note in (pinned_note, validity_note)]


def marks(module, file, ending):
    """What the figure's marks mean, in LaTeX."""
    return with_symbols(marks_of(module, file, ending).removesuffix("."))


def marks_of(module, file, ending):
    """What the figure's marks mean: MARKS of its module, a text or a function of the result, or of several by ending."""
    found = module.MARKS[ending] if isinstance(module.MARKS, dict) else module.MARKS
    return " ".join((found(file) if callable(found) else found).split())


def statuses(file):
    found = [f"{status_words(status)} ({count} point{'s' * (count > 1)})" for status, count in status_counts(file)
             if status != "ok"]
    return f"Marked: {', '.join(found)}" if found else ""


def plain(text):
    """A text of the result, which may be a stranger's, without a meaning to LaTeX and to a terminal."""
    shown = CONTROL.sub(lambda one: " " if one[0].isspace() else f"\\x{ord(one[0]):02x}", as_text(text))
    return shown.translate(str.maketrans(HELD))


def with_symbols(text):
    """The same, but the symbols of quantities in it, between dollar signs, are set as such."""
    parts = as_text(text).split("$")
    if len(parts) % 2 == 0:
        return plain(text)
    return "".join(latex_symbol(part) if i % 2 else plain(part) for i, part in enumerate(parts))


def latex_symbol(symbol):
    symbol = re.sub("(\\w)\u030c", r"\\check{\1}", unicodedata.normalize("NFD", symbol))  # undoes with_carons()
    return f"${symbol}$" if SYMBOL.fullmatch(symbol) and symbol.count("{") == symbol.count("}") else plain(symbol)


def in_latex(sentence):
    """The sentence with the signs that LaTeX needs outside $...$."""
    for sign, latex in LATEX.items():
        sentence = sentence.replace(sign, latex)
    parts = sentence.split("$")
    parts[::2] = [part.replace("_", r"\_") for part in parts[::2]]
    return "$".join(parts).translate(str.maketrans({HELD[sign]: latex for sign, latex in SPECIAL.items()}))
