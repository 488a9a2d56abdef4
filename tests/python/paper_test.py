"""A figure for a paper has its page's width, letters of at least 7 points, and no images of pixels; nothing is cut off.

paper_test.py SCRIPTS FIGURE RESULT
"""
import io
import re
import sys

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

sys.path.insert(0, sys.argv[1])
import bristle_plots  # noqa: E402
from bristle_plots.layout import HEADER  # noqa: E402
from bristle_plots.page import LEAST_POINTS  # noqa: E402
from bristle_plots.verdicts import STRIP  # noqa: E402


def bare(figure):
    """Whether the figure has neither header nor table of verdicts."""
    return not {artist.get_gid() for artist in figure.findobj()} & {HEADER, STRIP}


def check_edges(figure):
    """Nothing is cut off."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    box, (width, height) = figure.get_tightbbox(renderer), figure.get_size_inches()
    assert min(box.x0, box.y0, width - box.x1, height - box.y1) > -0.01, f"cut off: {box} of {width} x {height}"


def check_apart(figure):
    """No tick's text is over one of another axis or of its own axis, and no axis title is over a tick's text."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    lines = [line for axes in figure.axes if axes.axison for name in "xyz" if (line := getattr(axes, f"{name}axis", None))]
    texts = [text for line in lines for text in (*(tick.label1 if tick.label1.get_visible() else tick.label2
                                                    for tick in line._update_ticks()), line.label)]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts if text.get_visible() and text.get_text()]
    over = [(one, other) for i, (one, a) in enumerate(boxes) for other, b in boxes[:i] if a.padded(-1).overlaps(b.padded(-1))]
    assert len(boxes) > 5 and not over, f"texts over each other: {over}"


def check(figure, inches):
    width, height = figure.get_size_inches()
    assert width == inches and height < 10, (width, height)
    assert bare(figure)
    check_edges(figure)
    check_apart(figure)
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    small = [text.get_text() for text in texts if text.get_fontsize() < LEAST_POINTS]
    assert len(texts) > 5 and not small, f"smaller than {LEAST_POINTS} points: {small}"
    pdf = io.BytesIO()
    figure.savefig(pdf, format="pdf")
    page = [float(number) for number in re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", pdf.getvalue()).groups()]
    assert abs(page[0] - 72 * inches) < 0.01, page
    assert b"/Subtype /Image" not in pdf.getvalue(), "pixels in the PDF"


module = getattr(bristle_plots, sys.argv[2])
with bristle_plots.open_result(sys.argv[3]) as ds:
    for draw in (module.draw, *getattr(module, "FURTHER", {}).values()):
        standard = draw(ds)
        assert not bare(standard) and bare(draw(ds, plain=True))
        check_edges(standard)
        for width, inches in (("3.5in", 3.5), ("17.78cm", 7)):
            for _, _, figure in bristle_plots.pages(draw, ds, width=width):
                check(figure, inches)

# A part of a map: its short axes have ticks that do not touch.
if "k_theta" in ds.sizes and "gamma_1" in getattr(module, "VARIABLES", []):
    for part in (ds.isel(k_theta=slice(0, 2)), ds.isel(k_theta=slice(-2, None)), ds.isel(k_r=slice(1, 3))):
        for width in (3.5, 7):
            check(module.draw(part, width=width), width)
