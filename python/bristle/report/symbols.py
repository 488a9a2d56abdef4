"""Mathematics in HTML: the symbols of the result files (LaTeX), alone and within sentences."""

import re

from markupsafe import Markup, escape

from ..plotting.verdicts import in_symbols

GREEK = dict(zip("alpha beta gamma delta epsilon zeta theta lambda mu nu sigma tau varphi phi xi kappa omega rho Delta".split(),
                 "αβγδεζθλμνστφφξκωρΔ"))
SIGNS = {"propto": "∝", "cdot": "·", "pm": "±", "le": "≤", "ge": "≥", "infty": "∞", ",": " ", "times": "×",
         "angle": "∠", "perp": "⊥", "langle": "⟨", "rangle": "⟩"}
ACCENTS = {"tilde": "\u0303", "check": "\u030c", "breve": "\u0306", "dot": "\u0307", "bar": "\u0304"}
TOKEN = re.compile(r"\\[a-zA-Z]+|\\.|.", re.DOTALL)


def html(latex):
    """A formula as HTML: italic letters, sub- and superscripts, accents."""
    tokens = TOKEN.findall(latex)
    return Markup('<i class="math">') + sequence(tokens) + Markup("</i>")


def sequence(tokens, closing=None):
    out = Markup()
    while tokens:
        if tokens[0] == closing:
            tokens.pop(0)
            break
        out += item(tokens)
    return out


def item(tokens):
    """The HTML of the next item: a group, a command with its argument, or one character."""
    token = tokens.pop(0)
    if token == "{":
        return sequence(tokens, "}")
    if token in "_^" and tokens:
        name = "sub" if token == "_" else "sup"
        return Markup(f"<{name}>") + item(tokens) + Markup(f"</{name}>")
    if not token.startswith("\\"):
        return escape({"-": "\u2212"}.get(token, token))
    word = token[1:]
    if word in ACCENTS and tokens:
        return item(tokens) + ACCENTS[word]
    if word == "mathrm" and tokens:
        return Markup('<span class="upright">') + item(tokens) + Markup("</span>")
    if word == "ln":
        return Markup('<span class="upright">ln</span>')
    return escape(GREEK.get(word, SIGNS.get(word, word)))


def prose(sentence, symbols=None):
    """A sentence as HTML, with $...$ and exponents in parentheses set as mathematics; of an experiment's sentences the
    names of quantities, too, whose symbols are given."""
    out = Markup()
    for i, part in enumerate(in_symbols(sentence, symbols).split("$") if symbols else sentence.split("$")):
        out += html(part) if i % 2 else Markup(re.sub(r"\^\(([^)]*)\)", r"<sup>\1</sup>", str(escape(part))))
    return out


def emphasised(sentence, symbols=None):
    """The same, with what stands between ** set strong."""
    parts = [prose(part, symbols) for part in sentence.split("**")]
    return Markup().join(Markup(f"<strong>{part}</strong>") if i % 2 else part for i, part in enumerate(parts))


def plain(sentence, symbols=None):
    """The same without markup, for titles and descriptions that are read aloud."""
    return prose(sentence, symbols).striptags()
