"""Fig. 4: friction and its three causes over the radial and azimuthal stiffness (NSS law)."""

from matplotlib.figure import Figure

from grid import read_grid
from maps import COLUMN_INCHES, column
from style import draw_header, header_height, run
from verdicts import draw_strip, read_claims, strip_height

PANELS = {"a": "R_x_norm", "b": "gamma_1", "c": "gamma_2", "d": "gamma_3"}
LEGEND_INCHES = 0.4


def draw(file):
    grid = read_grid(file, "k_r", "k_theta")
    claims = read_claims(file)
    column_width, column_height = COLUMN_INCHES
    width = column_width * len(PANELS) + 0.1
    bottom = strip_height(claims, width) + LEGEND_INCHES
    height = bottom + column_height + header_height(file, width)
    figure = Figure(figsize=(width, height))
    draw_header(figure, file)
    entries = {}
    for position, (letter, name) in enumerate(PANELS.items()):
        entries.update(column(figure, file, grid, name, letter, position * column_width, bottom))
    if entries:
        figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=len(entries),
                      bbox_to_anchor=(0.5, (bottom - 0.8 * LEGEND_INCHES) / height), borderaxespad=0)
    draw_strip(figure, claims)
    return figure


if __name__ == "__main__":
    run("fig4", __doc__, ["k_r", "k_theta", "status", *PANELS.values()], draw)
