#include "run/provenance.hpp"

#include "dynamics/lanes/kernels.hpp"

#include <Eigen/Core>
#include <boost/version.hpp>
#include <ctime>
#include <fmt/format.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace bristle {

namespace {

// Of the fast engine's kernels.
std::string instruction_set() {
  const auto available = available_kernels();
  return available.empty() ? "none with fused multiply-add" : available.front()->target;
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::map<std::string, std::string> provenance(const std::string& command_line, int threads) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return {
      {"version", kVersion},
      {"commit", kCommit},
      {"compiler", BRISTLE_COMPILER},
      {"flags", BRISTLE_FLAGS},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"boost", BOOST_LIB_VERSION},
      {"hdf5", H5_VERS_INFO},
      {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                    NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt", fmt::format("{}", FMT_VERSION)},
      {"instruction_set", instruction_set()},
      {"host", host},
      {"threads", fmt::format("{}", threads)},
      {"command_line", command_line},
  };
}

}  // namespace bristle
