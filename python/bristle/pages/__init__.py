"""Documents written from results, and what they share: python3 -m bristle.pages.findings, and so on.

findings, assumptions, performance, accuracy: the pages of these names in docs/.
tutorial: docs/tutorial.ipynb, with what its cells print and draw.
zenodo: .zenodo.json, from CITATION.cff.
schematics: the drawings of a bristle and a rod in docs/model.md.
"""

from ..needs import load

load("..command_line", __name__)
