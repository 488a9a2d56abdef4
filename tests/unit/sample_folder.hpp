#pragma once

#include "experiment/experiment.hpp"
#include "scratch.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace bristle::testing {

// An experiment with this sweep in a folder with these tables.
struct SampleFolder {
  SampleFolder() {
    std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/paper.json", s.path("paper.json"));
  }
  Experiment load(const std::string& sweep, const std::string& more = "") const {
    // A gap, unless the sample has loads.
    const char* load =
        sweep.find("R_n") == sweep.npos ? R"({"R_n": null, "path": null, "z_0": 0.7})" : R"({"R_n": null})";
    return load_experiment(
        s.write("e.json", fmt::format(R"({{"extends": "paper.json", "name": "e", "load": {},
              "orientation": {{"sampling": "list", "theta_0_deg": [20, 80]}}, "sweep": {}{}}})",
                                      load, sweep, more)),
        {});
  }
  std::string error(const std::string& sweep) const {
    return input_error(s, [&] { load(sweep); });
  }
  Scratch s;
};

// The sweep of a Sobol sample over quantities, which are JSON.
inline std::string sobol(const std::string& over, int points = 8, int seed = 1) {
  return fmt::format(R"({{"sample": {{"sobol": {}, "seed": {}, "over": {{{}}}}}}})", points, seed, over);
}

// The values of a quantity of the sample.
inline const std::vector<double>& column(const Experiment& e, std::string_view name) {
  return std::ranges::find(e.sweep.axes.front().columns, name, &Axis::name)->values;
}

}  // namespace bristle::testing
