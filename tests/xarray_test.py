"""A result file opens in plain xarray with labelled axes and described variables."""
import sys

import numpy as np
import xarray

data = xarray.open_dataset(sys.argv[1])
assert data["R_x_norm"].dims == ("azimuth_rate", "k_r", "k_theta"), data["R_x_norm"].dims
assert data["k_r"].shape == (5,) and data["k_r"].attrs["units"] == "1"
assert np.isclose(data["k_r"][0], 3) and np.isclose(data["k_r"][-1], 100)
names = ["z_0", "R_n", "R_x", "R_y", "R_x_norm", "R_y_norm", "N_c_ratio", "gamma_1", "gamma_2", "gamma_3",
         "pinned_fraction", "pinned_share_R_n", "pinned_share_R_x", "energy_residual"]
for name in names:
    for variable in (name, name + "_err"):
        assert data[variable].dims == ("azimuth_rate", "k_r", "k_theta"), variable
        for attribute in ("long_name", "units", "symbol", "equation"):
            assert attribute in data[variable].attrs, (variable, attribute)
point = data.isel(azimuth_rate=0, k_theta=0).sel(k_r=3, method="nearest")
assert abs(float(point["R_n"]) - 2) < 0.005, float(point["R_n"])
assert (data["R_x_norm_err"] < 0.02 * data["R_x_norm"]).all()
meanings = data["status"].attrs["flag_meanings"].split()
assert len(meanings) == len(np.atleast_1d(data["status"].attrs["flag_values"]))
assert data.attrs["schema_version"] == "bristle-result/1"
assert len(data.attrs["payload_sha256"]) == 64 and len(data.attrs["experiment_sha256"]) == 64
print(data)
