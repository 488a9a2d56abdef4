"""The report, one page in HTML: python3 -m bristle.report RESULT.h5..."""

from ..needs import need

need("jinja2", "yaml")
