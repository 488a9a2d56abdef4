"""pandas reads exported tables, whose numbers are those of the result; so are those of info --json.

export_test.py BRISTLE FOLDER RESULT RECORDED: results of fig4's and fig2's smoke tiers.
"""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np
import pandas
import xarray

bristle, folder, result, recorded = sys.argv[1], pathlib.Path(sys.argv[2]), *sys.argv[3:]
experiments = pathlib.Path(__file__).parents[2] / "experiments"
folder.mkdir(parents=True, exist_ok=True)


def run(*command, code=0):
    done = subprocess.run([bristle, *map(str, command)], capture_output=True, text=True)
    assert done.returncode == code, (command, done.returncode, done.stderr)
    return done.stdout + done.stderr


def computed(name, experiment, *options):
    run("run", experiments / experiment, "--force", "--quiet", "--tier", "smoke", "-o", folder / name, *options)
    return folder / name


def exported(path, *options):
    run("export", path, "-o", folder / "table.csv", *options)
    return pandas.read_csv(folder / "table.csv", comment="#", float_precision="round_trip")  # all bits


def check_variables(path, data):
    table = exported(path)
    assert len(table) == data["status"].size
    for name in data.data_vars:
        if name.endswith("_code"):
            continue
        values = data[name].values.ravel()
        if "flag_meanings" in data[name].attrs:
            values = np.array(data[name].attrs["flag_meanings"].split())[values]
            assert table[name].tolist() == values.tolist(), name
        else:
            assert np.array_equal(table[name].astype(float), values, equal_nan=True), name
    index = data["status"].to_dataframe().index.to_frame()
    for name in data["status"].dims:
        assert table[name].tolist() == index[name].tolist(), name
    assert run("export", path, "-o", "-") == (folder / "table.csv").read_text()
    columns = list(table)
    assert columns.index("R_x_err") == columns.index("R_x") + 1
    header = (folder / "table.csv").read_text().splitlines()
    assert any(line.startswith("# incomplete_theta_0 [rad]: ") for line in header), header


def check_checks(path):
    table = exported(path, "--group", "checks")
    checks = xarray.open_dataset(path, group="checks")
    assert table["statement"].tolist() == checks["statement"].values.tolist()
    assert table["verdict"].tolist() == checks["verdict"].values.tolist()
    assert np.array_equal(table["measured"], checks["measured"].values)
    # Another question to the same numbers.
    one = {"claim": "4a", "statement": "level", "predicate": "level", "variable": "R_x", "along": "k_r", "is": "at_least", "threshold": 0}
    (folder / "checks.json").write_text(json.dumps({"checks": [one]}))
    table, data = exported(path, "--group", "checks", "--checks", folder / "checks.json"), xarray.open_dataset(path)
    assert np.allclose(table["measured"], data["R_x"].mean(["k_r", "k_theta"])), table
    (folder / "checks.json").write_text("{}")
    assert "has no /checks" in run("export", path, "-o", folder / "table.csv", "--group", "checks", "--checks", folder / "checks.json", code=2)
    assert "--checks needs --group checks" in run("export", path, "--checks", folder / "checks.json", code=2)


def check_tables(path):
    table, data = exported(path, "--group", "trajectories"), xarray.open_dataset(path, group="trajectories")
    assert np.array_equal(table["x"], data["x"].values)
    sweep = xarray.open_dataset(path)["bending"].values
    assert table["bending"].tolist() == sweep[data["point"].values].tolist()
    assert {*table["phase"]} <= {"off_slab", "stick", "side_slip", "slip"}
    text = run("export", path, "--group", "trajectory", code=2)
    assert "there is no table trajectory (did you mean trajectories?); it has: " in text, text


def check_jumps():
    path = computed("jumps.h5", "paper.json", "--set", "/locate_jumps=k_r", "--set", '/sweep={"k_r":{"values":[16,30]}}',
                    "--set", "/orientation/rtol=0.02")
    table, data = exported(path, "--group", "jumps"), xarray.open_dataset(path, group="jumps")
    assert len(table) and np.array_equal(table["before"], data["before"].values)
    assert np.all(table["after"] <= 1.021 * table["before"]) and {*table["k_r"]} == {16}  # the point before the jump
    assert data.attrs["along"] == "k_r"
    path = computed("jumps2.h5", "paper.json", "--set", "/locate_jumps=k_r", "--set", "/orientation/rtol=0.02",
                    "--set", '/sweep={"bending":{"values":["polar"]},"k_theta":{"values":[1,2]},"k_r":{"values":[16,30]}}')
    run("export", path, "--group", "jumps", "-o", folder / "table.csv")
    head = next(line for line in (folder / "table.csv").read_text().splitlines() if not line.startswith("#")).split(",")
    assert len(head) == len(set(head)) and {"k_theta", "bending"} <= set(head), head
    assert {*exported(path, "--group", "jumps")["bending"]} == {"polar"}
    # Words of an axis are those that it has.
    assert "bending has the words polar\n" in run("value", path, "R_x", "--at", "bending=rod", code=2)


def check_outputs(path):
    """Only exported tables are replaced; the default name is that of the result."""
    (folder / "mine.csv").write_text("a,b\n1,2\n")
    assert "is not a table exported by bristle" in run("export", path, "-o", folder / "mine.csv", code=2)
    assert (folder / "mine.csv").read_text() == "a,b\n1,2\n"
    assert "is not a table exported by bristle" in run("export", path, "-o", path, code=2)
    (folder / "jumps.csv").unlink(missing_ok=True)
    run("export", folder / "jumps.h5")
    run("export", folder / "jumps.h5")
    with open(folder / "jumps.csv", encoding="utf-8") as stream:
        assert stream.readline().startswith("# bristle export: ")
        rows = [row for row in csv.reader(stream) if not row[0].startswith("#")]
    assert len({len(row) for row in rows}) == 1, "rows of different lengths"


def check_info(path, data):
    info = json.loads(run("info", "--json", path))
    assert all(info[name] == data.attrs[name] for name in ("payload_sha256", "inputs_sha256")) and info["damage"] == []
    assert info["axes"]["bending"] == ["polar", "polar_as_printed", "rod"]
    assert info["axes"]["k_r"] == data["k_r"].values.tolist()
    assert info["points"] == {"ok": 39, "ambiguous": 2, "unreachable": 4} and info["failures"] == {}
    assert info["variables"]["R_x"]["max"] == float(data["R_x"].max())
    assert info["variables"]["R_x"]["dimensions"] == ["bending", "k_r", "k_theta"]
    assert info["variables"]["incomplete_theta_0"]["missing"] == 45
    assert "run" in info["provenance"]["command_line"]


opened = xarray.open_dataset(result)
check_variables(result, opened)
check_checks(result)
check_tables(recorded)
check_jumps()
check_outputs(result)
check_info(result, opened)
