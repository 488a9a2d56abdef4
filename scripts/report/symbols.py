"""Mathematics in HTML: the symbols of the result files (LaTeX), and names such as k_r within sentences."""

import re

from markupsafe import Markup, escape

GREEK = dict(zip("alpha beta gamma delta epsilon zeta theta lambda mu nu tau varphi phi xi kappa".split(),
                 "αβγδεζθλμντφφξκ"))
SIGNS = {"propto": "∝", "cdot": "·", "pm": "±", "le": "≤", "ge": "≥", "infty": "∞", ",": " ", "times": "×",
         "angle": "∠", "langle": "⟨", "rangle": "⟩"}
ACCENTS = {"tilde": "\u0303", "check": "\u030c", "breve": "\u0306", "dot": "\u0307", "bar": "\u0304"}
TOKEN = re.compile(r"\\[a-zA-Z]+|\\.|.", re.DOTALL)

# Names of quantities in the sentences of the experiments.
NAMES = {
    "R_x_norm": r"\check{R}_x", "R_y_norm": r"\check{R}_y", "R_n": "R_n", "R_x": "R_x", "R_y": "R_y",
    "k_r": "k_r", "k_theta": r"k_\theta", "k_phi": r"k_\varphi", "z_0": "z_0", "phi_0": r"\varphi_0",
    "theta_0": r"\theta_0", "gamma_1": r"\gamma_1", "gamma_2": r"\gamma_2", "gamma_3": r"\gamma_3",
    "N_c0": "N_{c,0}", "N_c": "N_c", "N_0": "N_0", "V_s": "V_s", "mu_c": r"\mu_c", "L_y": "L_y",
}
NAMED = re.compile(r"(?<![\w/])(?:" + "|".join(sorted(NAMES, key=len, reverse=True)) + r")(?!\w)"
                   r"|(?<=/)(?:N_c0|N_c|z_0|R_n)(?!\w)")


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


def prose(sentence):
    """A sentence as HTML, with $...$, the names above and exponents in parentheses set as mathematics."""
    out = Markup()
    for i, part in enumerate(sentence.split("$")):
        out += html(part) if i % 2 else names(part)
    return out


def names(part):
    marked = NAMED.sub(lambda found: f"\0{NAMES[found.group()]}\0", part)
    out = Markup()
    for i, piece in enumerate(marked.split("\0")):
        out += html(piece) if i % 2 else escape(piece)
    return Markup(re.sub(r"\^\(([^)]*)\)", r"<sup>\1</sup>", str(out)))


def plain(sentence):
    """The same without markup, for titles and descriptions that are read aloud."""
    return prose(sentence).striptags()
