#include "results/digest.hpp"

#include "results/hdf5.hpp"
#include "results/version.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <algorithm>

namespace bristle::results {
namespace {

// Adds the values of a dataset to the digest, in blocks of rows.
void add_values(Digest& digest, hid_t dataset, const h5::Shape& shape) {
  const h5::Handle type = h5::type_of(dataset);
  const std::size_t bytes = H5Tget_size(type);
  hsize_t row = 1;
  for (std::size_t d = 1; d < shape.size(); ++d) row *= shape[d];
  const hsize_t rows = shape.empty() ? 1 : shape[0];
  const hsize_t block = std::max<hsize_t>(1, 65536 / std::max<hsize_t>(1, row));
  std::vector<char> buffer;
  for (hsize_t from = 0; from < rows; from += block) {
    h5::Shape start(shape.size(), 0), count = shape;
    if (!shape.empty()) {
      start[0] = from;
      count[0] = std::min(block, rows - from);
    }
    buffer.resize(std::size_t(shape.empty() ? 1 : count[0] * row) * bytes);
    h5::read_part(dataset, type, start, count, buffer.data());
    digest.add(buffer.data(), buffer.size());
  }
}

void collect(hid_t group, const std::string& prefix, std::vector<std::string>& paths) {
  for (const std::string& name : h5::children(group)) {
    const std::string path = prefix + name;
    if (path == "checks" || path == "provenance" || path == kFailures) continue;
    if (h5::is_group(group, name)) collect(h5::open_group(group, name), path + "/", paths);
    else paths.push_back(path);
  }
}

void add_dataset(Digest& digest, hid_t file, const std::string& path) {
  const h5::Handle dataset = h5::open_dataset(file, path);
  const h5::Handle type = h5::type_of(dataset);
  const h5::Shape shape = h5::shape_of(dataset);
  const bool text = h5::is_text(dataset);
  std::string head =
      text ? fmt::format("/{} s", path)
           : fmt::format("/{} {}{}", path, H5Tget_class(type) == H5T_FLOAT ? "f" : "i", H5Tget_size(type));
  for (const hsize_t n : shape) head += fmt::format(" {}", n);
  digest.add(head + "\n");
  for (const char* name : {"units", "flag_meanings"})
    if (h5::has_attribute(dataset, name))
      digest.add(fmt::format("{} {}\n", name, h5::read_text_attribute(dataset, name)));
  if (!text) return add_values(digest, dataset, shape);
  for (const std::string& one : h5::read_texts(dataset)) digest.add(one.c_str(), one.size() + 1);
}

}  // namespace

std::string payload_sha256(hid_t file) {
  Digest digest(Sha::bits_256);
  for (const std::string& path : payload_datasets(file)) add_dataset(digest, file, path);
  return digest.hex();
}

std::vector<std::string> payload_datasets(hid_t file) {
  std::vector<std::string> paths;
  collect(file, "", paths);
  return paths;
}

nlohmann::json without_trials(const Json& document) {
  nlohmann::json out = document;
  if (!document.contains("design") || !document.contains("sweep")) return out;
  out["sweep"].erase("sample");
  if (out["sweep"].empty()) out.erase("sweep");
  return out;
}

std::string inputs_sha256(const Json& document) {
  nlohmann::json inputs = without_trials(document);
  for (const char* name : {"name", "title", "figure", "institution", "notes", "checks", "checks_for_each"})
    inputs.erase(name);
  // The order of the axes matters: it is that of the dimensions.
  nlohmann::json axes = nlohmann::json::array();
  if (document.contains("sweep"))
    for (const auto& [name, axis] : document["sweep"].items()) axes.push_back(name);
  inputs["axes"] = axes;
  if (document.contains("design")) std::erase(inputs["axes"].get_ref<nlohmann::json::array_t&>(), "sample");
  if (inputs.contains("sweep") && inputs["sweep"].empty()) inputs.erase("sweep");
  return sha256_of(inputs.dump());
}

}  // namespace bristle::results
