#pragma once

#include "design/design.hpp"
#include "experiment/experiment.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "scratch.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <string>

namespace bristle::design_test {
using namespace testing;

// A folder with the paper's experiment, in which each trial is a few bristles.
struct Folder {
  Folder() {
    std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/paper.json", s.path("paper.json"));
  }
  Experiment load(const std::string& design, const std::string& more = "",
                  const std::string& name = "e") const {
    return experiment::load_experiment(
        s.write(name + ".json", fmt::format(R"({{"extends": "paper.json", "name": "{}", "design": {}{}}})",
                                            name, design, more)),
        {});
  }
  results::ResultReader run(const Experiment& e, int threads = 1) const {
    design::run_design(e, {.output = s.path(e.name + ".h5"), .threads = threads, .quiet = true});
    return results::ResultReader(s.path(e.name + ".h5"));
  }
  std::string error(const std::string& design, const std::string& more = "") const {
    return input_error(
        s, [&] { design::run_design(load(design, more), {.output = s.path("e.h5"), .quiet = true}); });
  }
  Scratch s;
};

inline constexpr const char* kFew = R"(, "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150]})";

inline double first(const results::ResultReader& file, const std::string& name) {
  return file.variable(name).values.front();
}

// What the design found, in words.
inline std::string summary(const results::ResultReader& file) { return file.lines("trials", "summary"); }

}  // namespace bristle::design_test
