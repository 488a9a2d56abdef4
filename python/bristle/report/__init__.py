"""The report, one page in HTML: python3 -m bristle.report RESULT.h5..."""

from ..needs import load, need

need("jinja2", "yaml")
load("..command_line", __name__)
