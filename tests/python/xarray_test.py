"""A result file opens in plain xarray with labelled axes and described variables.

xarray_test.py RESULT POINT: a result of fig4's smoke tier, and one without a sweep.
"""
import sys

import numpy as np
import xarray

NAMES = ["z_0", "R_n", "R_x", "R_y", "R_x_norm", "R_y_norm", "N_c_ratio", "gamma_1", "gamma_2", "gamma_3",
         "pinned_fraction", "pinned_share_R_n", "pinned_share_R_x", "energy_residual"]


def check_axes(data):
    assert data["R_x_norm"].dims == ("bending", "k_r", "k_theta"), data["R_x_norm"].dims
    assert data["k_r"].shape == (5,) and data["k_r"].attrs["units"] == "1"
    assert np.isclose(data["k_r"][0], 5) and np.isclose(data["k_r"][-1], 100)
    point = data.sel(bending="polar").isel(k_theta=0).sel(k_r=3, method="nearest")
    assert abs(float(point["R_n"]) - 2) < 0.005, float(point["R_n"])
    codes = data["bending_code"]
    words = codes.attrs["flag_meanings"].split()
    assert [words[code] for code in codes.values] == data["bending"].values.tolist() == ["polar", "polar_as_printed", "rod"]


def check_variables(data):
    for name in NAMES:
        for variable in (name, name + "_err"):
            assert data[variable].dims == ("bending", "k_r", "k_theta"), variable
            for attribute in ("long_name", "units", "symbol", "equation"):
                assert attribute in data[variable].attrs, (variable, attribute)
            assert np.isnan(data[variable].encoding["_FillValue"]), variable
        assert data[name].attrs["ancillary_variables"] == f"{name}_err status", name
        assert data[name].attrs["units"] == data[name + "_err"].attrs["units"], name
    for name in data.variables:
        for other in data[name].attrs.get("ancillary_variables", "").split():
            assert other in data, (name, other)
    assert data["incomplete_theta_0"].attrs["units"] == "rad"
    assert "ln(k_phi)" in data["lift_off_load"].attrs["formula"] and "formula" not in data["z_0"].attrs
    assert (data["R_x_norm_err"] < 0.05 * data["R_x_norm"]).where(data["R_x_norm"].notnull(), True).all()
    meanings = data["status"].attrs["flag_meanings"].split()
    assert len(meanings) == len(np.atleast_1d(data["status"].attrs["flag_values"]))


def check_attributes(attributes):
    assert attributes["schema_version"] == "bristle-result/2"
    assert len(attributes["payload_sha256"]) == 64 and len(attributes["experiment_sha256"]) == 64
    assert attributes["Conventions"] == "CF-1.10" and "Menga" in attributes["references"]
    assert "bristle run " in attributes["history"] and attributes["history"].startswith("20"), attributes["history"]
    assert attributes["source"].startswith("numerical model, bristle "), attributes["source"]
    assert "institution" not in attributes


def check_frames(data, point):
    frame = data.to_dataframe()
    assert len(frame) == data["status"].size
    assert frame.loc["polar"].shape[0] == frame.loc["polar_as_printed"].shape[0] == len(frame) / 3
    assert point["R_x"].shape == ()
    frame = point.expand_dims("point").to_dataframe()  # as docs/results-format.md says
    assert len(frame) == 1 and np.isfinite(frame["R_x"][0])


for engine in ("netcdf4", "h5netcdf"):
    result, one = (xarray.open_dataset(path, engine=engine) for path in sys.argv[1:])
    check_axes(result)
    check_variables(result)
    check_attributes(result.attrs)
    check_frames(result, one)
    assert one.attrs["institution"] == "Example Laboratory"
    checks = xarray.open_dataset(sys.argv[1], engine=engine, group="checks").to_dataframe()
    assert len(checks) > 5 and {*checks["verdict"]} <= {"supported", "refuted", "undecided"}, checks
print(result)
