"""The largest friction of brushes with other elastic parameters, over k_r, under both local friction laws."""

from ..plotting.curves import PANEL_INCHES, draw_points, legend_below, log_axis, read_curve, title_axis, with_symbol
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page, reading_name, readings
from ..plotting.style import looks
from ..results import axis_values, dataset

AXES = ["friction", "nominal_friction", "sample"]
VARIABLES = ["R_x"]
NOTE = "Each point is a brush of the sample. Open marks: the lower local friction. Bars are the errors of the values."
MARKS = NOTE  # of the caption
LEGEND_INCHES = 0.3


@one_page
def draw(file):
    shown, stiffness = lettered(readings(file)), dataset(file, "k_r")
    below = LEGEND_INCHES if paper_width() is None else 0  # of the legend
    cell, columns = across(len(shown), Cell(5.1, PANEL_INCHES[1] + 0.95, 0.8, 0.7, *PANEL_INCHES), 0.62)
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(shown) // columns) + below, NOTE)
    entries, first = {}, None
    for (letter, reading), corner in zip(shown, corners(len(shown), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell, sharey=first)
        first = first or axes
        heading(axes, letter, reading_name(reading))
        entries |= draw_brushes(axes, file, reading, stiffness)
        log_axis(axes, "x", stiffness)
        title_axis(axes, "y", dataset(file, VARIABLES[0]))
    first.set_ylim(bottom=0)
    legend_below(first, entries, bottom + LEGEND_INCHES / 2)
    return figure


def draw_brushes(axes, file, reading, stiffness):
    """The brushes of the sample under each law, at each local friction; returns legend entries of the statuses."""
    entries, laws, intensities = {}, dataset(file, "friction"), dataset(file, "nominal_friction")
    for law, look in looks(axis_values(file, "friction")):
        for intensity in axis_values(file, "nominal_friction"):
            curve = read_curve(file, VARIABLES[0], "sample", friction=law, nominal_friction=intensity, **reading)
            text = f"{with_symbol(laws, law)}, {with_symbol(intensities, intensity)}"
            entries |= draw_points(axes, curve._replace(x=stiffness.values), look.colour, text, look.marker,
                                   filled=intensity != min(intensities.values))
    return entries
