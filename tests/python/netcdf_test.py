"""Programs of netCDF read and extend result files: ncdump, nccopy, netCDF4-python and xarray.

netcdf_test.py BRISTLE FOLDER RESULT...: of these, and of a result with all recorded tables of single bristles.
"""
import pathlib
import shutil
import subprocess
import sys

import netCDF4
import numpy as np
import xarray

bristle, folder = sys.argv[1], pathlib.Path(sys.argv[2])
experiments = pathlib.Path(__file__).parents[2] / "experiments"
folder.mkdir(parents=True, exist_ok=True)


def run(*command):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True)
    assert done.returncode == 0, (command, done.returncode, done.stderr)
    return done.stdout


def computed(name, experiment, *options):
    run(bristle, "run", experiments / experiment, "--force", "--quiet", "-o", folder / name, *options)
    return folder / name


def contents(group, path="/"):
    """(path, dimensions, attributes, values) of every variable, and (path, attributes) of every group."""
    yield path, {name: group.getncattr(name) for name in group.ncattrs()}
    for name, variable in group.variables.items():
        attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
        yield path + name, variable.dimensions, attributes, np.asarray(variable[...])
    for name, inner in group.groups.items():
        yield from contents(inner, f"{path}{name}/")


def read(path):
    with netCDF4.Dataset(path) as file:
        return list(contents(file))


def values(found):
    return {entry[0]: entry[3] for entry in found if len(entry) == 4}


def append(path):
    """Adds attributes to all groups and variables, and changes the title."""
    with netCDF4.Dataset(path, "a") as file:
        file.note = "read again"
        file.title = "A title that is longer than the one that the file had before it was changed"
        for group in [file, *file.groups.values()]:
            group.setncattr("note", "of the group")
            for variable in group.variables.values():
                variable.setncattr("note", "of the variable")
    with netCDF4.Dataset(path) as file:
        for group in file.groups.values():
            assert group.note == "of the group"
            assert all(variable.note == "of the variable" for variable in group.variables.values())


def check_xarray(path, groups):
    for engine in ("netcdf4", "h5netcdf"):
        for group in groups:
            with xarray.open_dataset(path, group=group or None, engine=engine) as data:
                data.load()
                if data.data_vars:
                    rows = (data if data.sizes else data.expand_dims("point")).to_dataframe()
                    assert len(rows) == np.prod(list(data.sizes.values()), dtype=int), (path, group)
                if group == "checks":
                    assert data.verdict.dims == ("check",), data
                    assert {*data.verdict.values} <= {"supported", "refuted", "undecided"}, data.verdict
                    assert all(isinstance(text, str) and text for text in data.statement.values), data.statement


def check(path):
    run("ncdump", path)
    found = read(path)
    run("nccopy", path, folder / "copy.nc")
    np.testing.assert_equal(read(folder / "copy.nc"), found)
    check_xarray(path, [entry[0].strip("/") for entry in found if len(entry) == 2])
    shutil.copy(path, folder / "appended.h5")
    append(folder / "appended.h5")
    run("ncdump", folder / "appended.h5")
    np.testing.assert_equal(values(read(folder / "appended.h5")), values(found))
    assert "(verified)" in run(bristle, "info", folder / "appended.h5")
    print(f"{path}: {len(found)} groups and variables")


for result in sys.argv[3:]:
    check(result)
check(computed("recorded.h5", "fig2.json", "--tier", "smoke",
               "--set", '/record=["observables","bristles","trajectories"]'))
