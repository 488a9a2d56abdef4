#include "results/reader.hpp"

#include "results/digest.hpp"
#include "results/hdf5.hpp"
#include "results/inspect.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace bristle::results {
namespace {

constexpr const char* kRemedy = "restore the file, or compute it again with `bristle run`";

// Returns the coordinate at index i of a dimension, in words. Coordinates are datasets in the folder of the
// variable or, for the axes of the sweep, in the root.
std::string coordinate(const ResultReader& result, const std::string& folder, const std::string& dimension,
                       std::size_t i) {
  if (dimension.empty()) return fmt::format("row {}", i);
  const std::string name = result.has(folder + dimension) ? folder + dimension : dimension;
  if (!result.has(name)) return fmt::format("{}[{}]", dimension, i);
  const Array& array = result.variable(name);
  if (i >= array.values.size()) return fmt::format("{}[{}]", dimension, i);
  const double value = array.values[i];
  return fmt::format("{} = {}", dimension,
                     array.about.words.empty() ? fmt::format("{:.6g}", value) : array.text(value));
}

// Returns what the attributes of a dataset of numbers say about it.
Column read_column(hid_t dataset, const std::string& name) {
  const auto text = [&](const char* attribute) {
    return h5::has_attribute(dataset, attribute) ? printable(h5::read_text_attribute(dataset, attribute))
                                                 : "";
  };
  Column out{
      .name = name, .long_name = text("long_name"), .symbol = "", .equation = "", .units = text("units")};
  if (H5Tget_class(h5::type_of(dataset)) != H5T_INTEGER) return out;
  out.number = h5::has_attribute(dataset, "flag_meanings") ? Number::code : Number::integer;
  std::istringstream words(text("flag_meanings"));
  for (std::string word; words >> word;) out.words.push_back(word);
  return out;
}

// Reads a dataset of numbers, with its name in the file.
Array read_array(hid_t dataset, const std::string& name) {
  Array out{read_column(dataset, name), {}, {}, {}, h5::is_scale(dataset)};
  const h5::Shape shape = h5::shape_of(dataset);
  for (unsigned d = 0; d < shape.size(); ++d) {
    out.shape.push_back(shape[d]);
    out.dimensions.push_back(out.coordinate ? name : h5::scale_name(dataset, d));
  }
  out.values.resize(grid_size(out.shape));
  h5::read_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, out.values.data());
  return out;
}

}  // namespace

struct ResultReader::Open {
  h5::Handle root;
};

ResultReader::ResultReader(const std::string& path) : path_(path) {
  if (const std::string what = not_a_file(path); !what.empty())
    throw InputError(fmt::format("{}: {}", path, what));
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file; create it with `bristle run EXPERIMENT.json -o {}`", path,
                                 path.ends_with(".h5") ? path : path + ".h5"));
  open_input(path);  // throws the reason if it cannot be read
  if (H5Fis_hdf5(path.c_str()) <= 0) throw InputError(fmt::format("{}: not an HDF5 file", path));
  const auto open = [&] { return h5::open_file(path, false); };
  try {
    damage_ = damage_of(open, std::filesystem::file_size(path));
  } catch (const MalformedError& e) {
    throw InputError(fmt::format("{}: damaged, or not written by bristle: {}; {}", path, e.what(), kRemedy));
  }
  file_ = std::make_shared<const Open>(Open{open()});
  require_schema();
}

ResultReader::ResultReader(const std::string& name, const std::string& bytes) : path_(name) {
  if (!bytes.starts_with(result_file().start)) throw MalformedError("not an HDF5 file");
  const auto open = [&] { return h5::open_image(bytes); };
  damage_ = damage_of(open, bytes.size());
  file_ = std::make_shared<const Open>(Open{open()});
  require_schema();
}

void ResultReader::require_intact() const {
  if (!damage_.empty())
    throw InputError(fmt::format("{}: damaged: {}; {}", path_, fmt::join(damage_, "; "), kRemedy));
}

void ResultReader::require_schema() const {
  if (!has_text("schema_version"))
    throw InputError(
        fmt::format("{}: not a result of bristle: the attribute schema_version is missing", path_));
  if (const std::string version = text("schema_version"); version != kResultSchema)
    throw InputError(fmt::format(
        "{}: schema version {}, but this program reads {} only; compute it again with `bristle run`", path_,
        version, kResultSchema));
}

std::vector<std::string> ResultReader::variables() const {
  std::vector<std::string> names = datasets();
  std::erase_if(names, [](const std::string& name) { return name.find('/') != std::string::npos; });
  return names;
}

std::vector<std::string> ResultReader::datasets() const {
  std::vector<std::string> names = payload_datasets(file_->root);
  for (const std::string& name : std::vector(names))
    if (h5::is_text(h5::open_dataset(file_->root, name)) && std::erase(names, code_variable(name)) == 0)
      std::erase(names, name);
  return names;
}

const Array& ResultReader::variable(const std::string& name) const {
  if (const auto found = read_.find(name); found != read_.end()) return found->second;
  const hid_t root = file_->root;
  if (!h5::exists(root, name) || h5::is_group(root, name))
    throw InputError(
        fmt::format("{}: there is no variable {}{}", path_, name, did_you_mean(name, variables())));
  const std::string leaf = name.substr(name.rfind('/') + 1);
  const h5::Handle dataset = h5::open_dataset(root, name);
  if (!h5::is_text(dataset)) return read_[name] = read_array(dataset, leaf);
  Array codes = read_array(h5::open_dataset(root, code_variable(name)), leaf);
  const Column words = read_column(dataset, leaf);
  codes.about.long_name = words.long_name;
  codes.about.units = words.units;
  codes.coordinate = h5::is_scale(dataset);
  return read_[name] = std::move(codes);
}

std::vector<std::string> ResultReader::names(const std::string& group) const {
  return h5::children(h5::open_group(file_->root, group.empty() ? "/" : group));
}

bool ResultReader::is_group(const std::string& name) const { return h5::is_group(file_->root, name); }

bool ResultReader::has_text(const std::string& attribute) const {
  return h5::has_attribute(file_->root, attribute);
}

long ResultReader::integer(const std::string& attribute) const {
  return h5::read_integer_attribute(file_->root, attribute);
}

std::string ResultReader::raw_text(const std::string& attribute) const {
  if (!has_text(attribute)) throw InputError(fmt::format("{}: there is no attribute {}", path_, attribute));
  return h5::read_text_attribute(file_->root, attribute);
}

std::string ResultReader::text(const std::string& attribute) const { return printable(raw_text(attribute)); }

bool up_to_date(const std::string& path, const Experiment& experiment) {
  if (!std::filesystem::is_regular_file(path)) return false;
  try {
    const ResultReader file(path);
    return file.damage().empty() && file.integer("numerics_version") == kNumericsVersion &&
           file.text("inputs_sha256") == inputs_sha256(*experiment.document);
  } catch (const InputError&) {
    return false;  // unreadable, or of another version: to be computed again
  } catch (const SystemError&) {
    throw;  // says nothing of the file
  } catch (const RunError&) {
    return false;
  }
}

std::string place(const ResultReader& result, const std::string& name, std::size_t index) {
  const Array& v = result.variable(name);
  if (v.shape.empty()) return "the only point";
  const auto slash = name.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : name.substr(0, slash + 1);
  const auto at = unravel(index, v.shape);
  std::vector<std::string> parts;
  for (std::size_t d = 0; d < at.size(); ++d)
    parts.push_back(coordinate(result, folder, v.dimensions[d], at[d]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string axis_variable(const std::string& name) {
  return name == "R_n" || name == "z_0" ? name + "_target" : name;
}

std::string code_variable(const std::string& choice) { return choice + "_code"; }

FileKind result_file() { return {"a result of bristle", "\x89HDF\r\n\x1a\n", {"bristle-result/"}}; }

bool ResultReader::has(const std::string& name) const { return h5::exists(file_->root, name); }

std::map<std::string, std::string> ResultReader::text_attributes(const std::string& name) const {
  std::map<std::string, std::string> out;
  if (!has(name)) return out;
  const h5::Handle group = h5::open_group(file_->root, name);
  for (const std::string& attribute : h5::attribute_names(group))
    out[printable(attribute)] = printable(h5::read_text_attribute(group, attribute));
  return out;
}

std::string ResultReader::lines(const std::string& group, const std::string& name) const {
  if (!has(group)) return "";
  const h5::Handle open = h5::open_group(file_->root, group);
  return h5::has_attribute(open, name) ? printable(h5::read_text_attribute(open, name), "\n") : "";
}

std::vector<std::string> ResultReader::axes() const {
  std::vector<std::string> names;
  const Json& document = experiment();
  if (document.contains("sweep"))
    for (const auto& [name, axis] : document["sweep"].items()) names.push_back(axis_variable(name));
  return names;
}

std::vector<std::string> ResultReader::sample_columns() const {
  std::vector<std::string> names;
  const JsonPointer table("/sweep/sample/table/columns"), distributions("/sweep/sample/over");
  const Json& document = experiment();
  if (document.contains(table))
    for (const std::string name : document[table]) names.push_back(axis_variable(name));
  else if (document.contains(distributions))
    for (const auto& [name, distribution] : document[distributions].items())
      names.push_back(axis_variable(name));
  return names;
}

std::vector<std::string> ResultReader::coordinates() const {
  std::vector<std::string> names = axes();
  std::ranges::copy(sample_columns(), std::back_inserter(names));
  return names;
}

std::vector<std::size_t> ResultReader::sweep_shape() const {
  std::vector<std::size_t> shape;
  for (const std::string& axis : axes()) shape.push_back(variable(axis).values.size());
  return shape;
}

const Json& ResultReader::experiment() const {
  if (experiment_) return *experiment_;
  try {
    Json document = parse_json(raw_text("experiment"));
    if (!document.is_object()) throw InputError(fmt::format("{} is not an object", shown(document)));
    experiment_ = std::make_shared<const Json>(std::move(document));
    return *experiment_;
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: attribute experiment: {}", path_, e.what()));
  }
}

}  // namespace bristle::results
