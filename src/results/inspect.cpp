#include "results/inspect.hpp"

#include "results/digest.hpp"
#include "results/plain_hdf5.hpp"
#include "util/error.hpp"
#include "util/json.hpp"
#include "util/process.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

// Seconds of processor time and bytes of memory beyond those of the file. A result of 1 MB takes 10 ms.
constexpr long kSeconds = 5;
constexpr std::size_t kBytesPerSecond = 20'000'000;
constexpr std::size_t kMemory = std::size_t(256) << 20;

// What is wrong with an attribute that holds a digest; empty if it matches.
std::string mismatch(hid_t file, const char* attribute, const char* what,
                     const std::function<std::string()>& digest) {
  try {
    if (digest() == h5::read_text_attribute(file, attribute)) return "";
  } catch (const RunError& e) {
    return fmt::format("{} cannot be compared with {}: {}", attribute, what, e.what());
  }
  return fmt::format("{} DOES NOT MATCH {}", attribute, what);
}

// Reads all datasets of /checks, which no digest covers.
std::string unreadable_checks(hid_t file) {
  if (!h5::exists(file, "checks")) return "";
  try {
    const h5::Handle group = h5::open_group(file, "checks");
    for (const std::string& name : h5::children(group)) {
      const h5::Handle dataset = h5::open_dataset(group, name);
      const h5::Handle type(H5Dget_type(dataset), H5Tclose, "reading the type of " + name);
      const h5::Shape shape = h5::shape_of(dataset);
      std::vector<char> values(H5Dget_storage_size(dataset));
      if (values.empty()) continue;
      h5::read_part(dataset, type, h5::Shape(shape.size(), 0), shape, values.data());
    }
  } catch (const RunError& e) {
    return fmt::format("/checks cannot be read: {}", e.what());
  }
  return "";
}

Json inspect(hid_t file, std::size_t size) {
  require_plain_hdf5(file, size);
  Json damage = Json::array();
  const auto add = [&](const std::string& what) {
    if (!what.empty()) damage.push_back(what);
  };
  add(mismatch(file, "payload_sha256", "the numbers", [&] { return payload_sha256(file); }));
  add(mismatch(file, "experiment_sha256", "the experiment",
               [&] { return sha256_of(h5::read_text_attribute(file, "experiment")); }));
  add(unreadable_checks(file));
  return damage;
}

}  // namespace

std::vector<std::string> damage_of(const std::function<h5::Handle()>& open, std::size_t size) {
  const Limits limits{kSeconds + long(size / kBytesPerSecond), kMemory + 4 * size};
  const std::string found = run_isolated([&] { return inspect(open(), size).dump(); }, limits);
  return Json::parse(found);
}

}  // namespace bristle::results
