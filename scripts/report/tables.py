"""The numbers of a result as CSV files, in the layout of `bristle export`: one for its points, one for each recorded
table that a figure draws."""

import base64
import gzip

import numpy as np

from bristle_plots.results import as_text, axis_names, dataset, flags, table

RECORDED = ["trajectories", "slab_force"]
DIGITS = "%.7g"  # of recorded tables, which are long


def read(file):
    """For each table: the name of its file, and the gzip file in base64."""
    name = as_text(file.attrs["name"])
    found = [(f"{name}.csv", csv(file, points_of(file)))]
    found += [(f"{name}-{group}.csv", csv(file, recorded(file, group), group, DIGITS))
              for group in RECORDED if table(file, group) is not None]
    return [{"name": name, "gzip": packed(text)} for name, text in found]


def points_of(file):
    """A row for each point, the last axis fastest, without the nodes that a traced curve does not have."""
    status = dataset(file, "status")
    names = [name for name, data in file.data_vars.items() if data.dims == status.dims]
    part = with_words(file[names].reset_coords(drop=True))
    frame = (part if status.dims else part.expand_dims("point")).to_dataframe()
    frame = frame.reset_index()[[*status.dims, *names]]
    return frame[frame["status"] != "absent"]


def recorded(file, group):
    """The rows of a table, each with the coordinates of its point."""
    found = table(file, group)
    frame = with_words(found).to_dataframe().reset_index()
    status = dataset(file, "status")
    places = np.unravel_index(found["point"].values, status.shape) if status.dims else ()
    for i, (name, place) in enumerate(zip(axis_names(status), places)):
        frame.insert(i, name, file[name].values[place])
    return frame


def with_words(data):
    """The variables with words instead of codes."""
    found = {name: flags(line) for name, line in data.variables.items() if "flag_meanings" in line.attrs}
    return data.assign({name: (data[name].dims, np.array(words)[numbers].reshape(data[name].shape))
                        for name, (words, numbers) in found.items()})


def csv(file, frame, group="", digits=None):
    lines = [f"# {as_text(file.attrs['title'])}", f"# payload_sha256 {as_text(file.attrs.get('payload_sha256', ''))}"]
    for name in frame.columns:
        holder = table(file, group) if group and name in table(file, group).variables else file
        found = holder[name].attrs if name in holder.variables else {}
        units = f" [{as_text(found['units'])}]" if "units" in found else ""
        lines.append(f"# {name}{units}: {as_text(found.get('long_name', ''))}")
    return "\n".join([*lines, frame.to_csv(index=False, float_format=digits, lineterminator="\n")])


def packed(text):
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
