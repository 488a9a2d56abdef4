"""The report, one static page in HTML: python3 -m bristle.report RESULT.h5..."""

from ..needs import load, need

need("jinja2")
load("..command_line", __name__)
