#include "run/provenance.hpp"

#include "results/journal.hpp"
#include "results/writer.hpp"
#include "bristle/simd/dispatch.hpp"
#include "util/process.hpp"
#include "util/text.hpp"

#include <boost/version.hpp>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>
#include <openssl/opensslv.h>
#include <sys/utsname.h>
#include <fstream>
#include <gnu/libc-version.h>

namespace bristle::run {

namespace {

// Returns the instruction sets for vectors that the processor supports.
std::string cpu_features() {
  std::string out;
  for (const Kernels* kernels : available_kernels())
    if (kernels->width > 1) out += fmt::format("{}{}", out.empty() ? "" : " ", kernels->target);
  return out;
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string system_text() {
  utsname names{};
  return uname(&names) == 0 ? fmt::format("{} {} {}", names.sysname, names.release, names.machine)
                            : "unknown";
}

}  // namespace

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::map<std::string, std::string> provenance(const std::vector<std::string>& arguments, int threads) {
  return {
      {"version", kVersion},
      {"commit", kCommit},
      {"dirty",
       results::is_dirty(kCommit) ? "yes: built from uncommitted changes, or of an unknown commit" : "no"},
      {"compiler", BRISTLE_COMPILER},
      {"flags", BRISTLE_FLAGS},
      {"eigen", BRISTLE_EIGEN},
      {"boost",
       fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"hdf5", results::hdf5_version()},
      {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                    NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"highway", BRISTLE_HIGHWAY},
      {"sleef", BRISTLE_SLEEF},
      {"openssl", OPENSSL_VERSION_STR},
      {"c_library", gnu_get_libc_version()},
      {"instruction_set", best_kernels().target},
      {"cpu_features", cpu_features()},
      {"cpu", cpu_model()},
      {"system", system_text()},
      {"host", host_name()},
      {"threads", fmt::format("{}", threads)},
      {"command_line", shell_command(arguments)},
  };
}

}  // namespace bristle::run
