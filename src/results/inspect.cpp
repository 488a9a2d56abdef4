#include "results/inspect.hpp"

#include "results/reader.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "json/json.hpp"
#include "util/process.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

// Limits of processor time (s) and memory (bytes), to which damage_of() adds for the size of the file. A
// result of 1 MB takes 10 ms.
constexpr long kSeconds = 5;
constexpr std::size_t kBytesPerSecond = 20'000'000;
constexpr std::size_t kMemory = std::size_t(256) << 20;

constexpr int kMaxGroupDepth = 4;
constexpr std::size_t kMaxObjects = 10000;

class PlainChecker {
 public:
  explicit PlainChecker(std::size_t size) : size_(size) {}

  void check_group(hid_t group, const std::string& path, int depth) {
    if (depth > kMaxGroupDepth) refuse(path, "groups nested too deeply");
    check_attributes(group, path);
    for (const std::string& name : h5::children(group)) {
      const std::string at = path + "/" + name;
      if (++objects_ > kMaxObjects) refuse(at, "too many groups and datasets");
      H5L_info_t link;
      h5::check(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), "reading the link " + at);
      if (link.type != H5L_TYPE_HARD) refuse(at, "a soft or external link");
      const h5::Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose, "opening " + at);
      const H5I_type_t kind = H5Iget_type(object);
      if (kind == H5I_GROUP) check_group(object, at, depth + 1);
      else if (kind == H5I_DATASET)
        check_dataset(object, at, path == "/checks" || h5::exists(group, code_variable(name)));
      else refuse(at, "neither a group nor a dataset");
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& at, const std::string& what) const {
    throw MalformedError(fmt::format("{}: {}; a result file has none", at.empty() ? "/" : at, what));
  }

  // Reads the attributes; rejects an attribute that declares more data than the size of the file.
  void check_attributes(hid_t object, const std::string& path) {
    for (const std::string& name : h5::attribute_names(object)) {
      const h5::Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose,
                                 "opening an attribute");
      const h5::Handle type(H5Aget_type(attribute), H5Tclose, "reading an attribute's type");
      const h5::Handle space(H5Aget_space(attribute), H5Sclose, "reading an attribute's shape");
      const auto count = h5::check(H5Sget_simple_extent_npoints(space), "reading an attribute's shape");
      if (H5Tget_size(type) > size_ || (count > 0 && std::size_t(count) > size_ / H5Tget_size(type)))
        refuse(path + "@" + name, "an attribute larger than the file");
      std::vector<char> bytes(std::size_t(count) * H5Tget_size(type));
      h5::check(H5Aread(attribute, type, bytes.data()), "reading attribute " + path + "@" + name);
      h5::check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, bytes.data()), "freeing an attribute");
    }
  }

  void check_dataset(hid_t dataset, const std::string& path, bool may_be_text) {
    check_attributes(dataset, path);
    const h5::Handle properties(H5Dget_create_plist(dataset), H5Pclose, "reading how a dataset is stored");
    const H5D_layout_t layout = H5Pget_layout(properties);
    if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED && layout != H5D_COMPACT)
      refuse(path, "a virtual dataset");
    if (H5Pget_nfilters(properties) != 0) refuse(path, "a compressed or filtered dataset");
    if (H5Pget_external_count(properties) != 0) refuse(path, "a dataset stored in another file");
    const h5::Handle type = h5::type_of(dataset);
    const H5T_class_t kind = H5Tget_class(type);
    // HDF5 1.10 trusts the lengths of texts of variable length. Only this process, which checks the digests,
    // reads such texts: the words of a choice, and /checks.
    const bool text = kind == H5T_STRING && may_be_text;
    if (kind != H5T_INTEGER && kind != H5T_FLOAT && !text) refuse(path, "a dataset of other than numbers");
    std::size_t left = H5Dget_storage_size(dataset);
    if (left > size_) refuse(path, "a dataset larger than the file");
    // A dataset without stored data has only fill values. It may have one value for each byte of the file,
    // because /status, over as many points, is stored with one byte for each.
    left = left == 0 ? size_ : left / H5Tget_size(type);
    for (const hsize_t n : h5::shape_of(dataset)) {
      if (n > left) refuse(path, "a dataset whose declared size exceeds its stored data");
      if (n > 0) left /= n;
    }
  }

  std::size_t size_, objects_ = 0;
};

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
  for (const std::string& word : h5::read_texts(dataset)) digest.add(word.c_str(), word.size() + 1);
}

// Returns what is wrong with an attribute that holds a digest; empty if it matches. what: names the data
// under the digest
std::string mismatch(hid_t file, const char* attribute, const char* what,
                     const std::function<std::string()>& digest) {
  try {
    if (digest() == h5::read_text_attribute(file, attribute)) return "";
  } catch (const SystemError&) {
    throw;
  } catch (const RunError& e) {
    return fmt::format("{} cannot be compared with {}: {}", attribute, what, e.what());
  }
  return fmt::format("{} DOES NOT MATCH {}", attribute, what);
}

// Reads all datasets of /checks, which no digest covers. Returns why reading fails; empty if it does not.
std::string unreadable_checks(hid_t file) {
  if (!h5::exists(file, "checks")) return "";
  try {
    const h5::Handle group = h5::open_group(file, "checks");
    for (const std::string& name : h5::children(group)) {
      const h5::Handle dataset = h5::open_dataset(group, name);
      const h5::Handle type = h5::type_of(dataset);
      const h5::Shape shape = h5::shape_of(dataset);
      std::vector<char> values(H5Dget_storage_size(dataset));
      if (values.empty()) continue;
      h5::read_part(dataset, type, h5::Shape(shape.size(), 0), shape, values.data());
    }
  } catch (const SystemError&) {
    throw;
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

void require_plain_hdf5(hid_t file, std::size_t size) {
  const h5::Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "opening the root");
  PlainChecker(size).check_group(root, "", 0);
}

std::vector<std::string> damage_of(const std::function<h5::Handle()>& open, std::size_t size) {
  const Limits limits{kSeconds + long(size / kBytesPerSecond), kMemory + 4 * size};
  const std::string found = run_isolated([&] { return inspect(open(), size).dump(); }, limits);
  return parse_json(found);
}

}  // namespace bristle::results
