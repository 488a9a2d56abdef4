"""The bristles recorded through the jump of Figure 4, drawn as Fig. 2 at the first k_r behind the jump of the gap."""

import numpy as np

from ..plotting.readings import page_for_each_reading
from ..results import dataset, point_numbers
from . import fig2

AXES = ["k_r"]
MARKS = fig2.MARKS


@page_for_each_reading
def draw(file, reading):
    gaps = dataset(file, "z_0").sel(reading).squeeze()
    behind = 1 + int(np.argmax(np.diff(gaps)))
    return fig2.passages_page(file, reading, point_numbers(file).sel(reading).squeeze()[behind],
                              f"\nHere $\\tilde{{k}}_r$ = {float(gaps['k_r'][behind]):.3g}, the first recorded value behind the "
                              "jump of the gap.")
