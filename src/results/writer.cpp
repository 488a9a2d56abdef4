#include "results/writer.hpp"

#include "experiment/input_error.hpp"
#include "experiment/parameters_table.hpp"
#include "results/variables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace bristle {
namespace fs = std::filesystem;
namespace {

void describe(hid_t dataset, const std::string& long_name, const std::string& symbol,
              const std::string& equation, const std::string& units = "1") {
  h5::write_attribute(dataset, "long_name", long_name);
  h5::write_attribute(dataset, "units", units);
  h5::write_attribute(dataset, "symbol", symbol);
  h5::write_attribute(dataset, "equation", equation);
}

void describe_flags(hid_t dataset, const std::vector<std::string>& names) {
  std::vector<signed char> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.push_back(static_cast<signed char>(i));
  h5::write_attribute(dataset, "flag_values", values);
  h5::write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(names, " ")));
}

// Position of a point in the sweep's grid.
h5::Shape unravel(std::size_t index, const h5::Shape& shape) {
  h5::Shape at(shape.size());
  for (std::size_t d = shape.size(); d-- > 0; index /= shape[d]) at[d] = index % shape[d];
  return at;
}

// Creates the temporary file if need be and locks it; fails before anything is computed rather than after.
// NOTE: HDF5 truncates before it locks, so its own lock comes too late for the other run.
int lock_output(const std::string& path, const std::string& partial) {
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  const std::string reason = error ? error.message() : "";
  if (fs::is_directory(path)) throw InputError(fmt::format("-o {}: is a folder; give a file name", path));
  const int descriptor = open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw InputError(fmt::format("-o {}: cannot be written: {}; give another place with -o", path,
                                 reason.empty() ? std::strerror(errno) : reason));
  struct flock whole {};
  whole.l_type = F_WRLCK;
  if (fcntl(descriptor, F_OFD_SETLK, &whole) != 0) {
    ::close(descriptor);
    throw RunError(
        fmt::format("{}: another run is writing it; wait for that, or give another place with -o", path));
  }
  return descriptor;
}

}  // namespace

std::string axis_variable(const std::string& name) {
  return name == "R_n" || name == "z_0" ? name + "_target" : name;
}

ResultWriter::ResultWriter(const Experiment& experiment, const std::string& path)
    : experiment_(experiment), path_(path), partial_(path + ".partial") {
  lock_ = lock_output(path_, partial_);
  try {
    create();
  } catch (...) {
    discard();
    throw;
  }
}

void ResultWriter::create() {
  file_ = h5::create_file(partial_);
  for (const std::size_t n : experiment_.shape()) shape_.push_back(n);
  for (const Axis& axis : experiment_.axes) {
    const std::string name = axis_variable(axis.name);
    h5::Handle scale = h5::create_dataset(file_, name, H5T_NATIVE_DOUBLE, {axis.values.size()});
    h5::write_part(scale, H5T_NATIVE_DOUBLE, {0}, {axis.values.size()}, axis.values.data());
    const AxisLabel label = axis_label(axis.name);
    h5::make_scale(scale, name);
    describe(scale, label.description, label.symbol, "", label.units);
    axes_.push_back(std::move(scale));
  }
  create_variables();
  if (experiment_.record_bristles) create_bristles();
}

ResultWriter::~ResultWriter() { discard(); }

void ResultWriter::discard() {
  std::error_code ignored;
  if (!published_) fs::remove(partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
}

h5::Handle ResultWriter::create_variable(const std::string& name, hid_t type, const std::string& long_name,
                                         const std::string& symbol, const std::string& equation) {
  h5::Handle dataset = h5::create_dataset(file_, name, type, shape_);
  describe(dataset, long_name, symbol, equation);
  for (unsigned d = 0; d < axes_.size(); ++d) h5::attach_scale(dataset, axes_[d], d);
  return dataset;
}

void ResultWriter::create_variables() {
  for (const ResultVariable& v : result_variables()) {
    variables_[v.name] = create_variable(v.name, H5T_NATIVE_DOUBLE, v.long_name, v.symbol, v.equation);
    if (v.error)
      variables_[v.name + "_err"] =
          create_variable(v.name + "_err", H5T_NATIVE_DOUBLE, "estimated numerical error of " + v.name,
                          R"(\delta )" + v.symbol, v.equation);
  }
  variables_["passages"] =
      create_variable("passages", H5T_NATIVE_LONG, "bristles integrated for the point", "N", "");
  variables_["status"] = create_variable("status", H5T_NATIVE_SCHAR, "how the point ended", "", "");
  describe_flags(variables_["status"], kPointStatusNames);
}

void ResultWriter::create_bristles() {
  bristles_ = h5::create_group(file_, "bristles");
  const h5::Shape open{H5S_UNLIMITED};
  const auto create = [&](const std::string& name, hid_t type, const std::string& long_name,
                          const std::string& symbol, const std::string& equation) {
    h5::Handle dataset = h5::create_dataset(bristles_, name, type, open);
    describe(dataset, long_name, symbol, equation);
    bristle_fields_[name] = std::move(dataset);
  };
  create("bristle", H5T_NATIVE_LONG, "number of the passage", "", "");
  h5::make_scale(bristle_fields_["bristle"], "bristle");
  create("point", H5T_NATIVE_LONG, "index of the sweep point, the last axis fastest", "", "");
  create("status", H5T_NATIVE_SCHAR, "how the passage ended", "", "");
  describe_flags(bristle_fields_["status"], kOutcomeNames);
  for (const BristleVariable& v : bristle_variables())
    create(v.name, H5T_NATIVE_DOUBLE, v.long_name, v.symbol, v.equation);
  for (const auto& [name, dataset] : bristle_fields_)
    if (name != "bristle") h5::attach_scale(dataset, bristle_fields_["bristle"], 0);
}

void ResultWriter::write_point(std::size_t index, const PointResult& result,
                               const std::vector<Passage>& bristles) {
  const h5::Shape at = unravel(index, shape_), one(shape_.size(), 1);
  const auto put = [&](const std::string& name, double value) {
    h5::write_part(variables_.at(name), H5T_NATIVE_DOUBLE, at, one, &value);
  };
  for (const ResultVariable& v : result_variables()) {
    put(v.name, v.value(result));
    if (v.error) put(v.name + "_err", v.error(result));
  }
  h5::write_part(variables_.at("passages"), H5T_NATIVE_LONG, at, one, &result.passages);
  const auto status = static_cast<signed char>(result.status);
  h5::write_part(variables_.at("status"), H5T_NATIVE_SCHAR, at, one, &status);
  if (experiment_.record_bristles && !bristles.empty()) append_bristles(index, bristles);
}

void ResultWriter::append_bristles(std::size_t index, const std::vector<Passage>& bristles) {
  const h5::Shape from{bristle_count_}, count{bristles.size()};
  std::vector<long> number, point(bristles.size(), long(index));
  std::vector<signed char> status;
  for (const Passage& b : bristles) {
    number.push_back(long(bristle_count_++));
    status.push_back(static_cast<signed char>(b.outcome));
  }
  h5::write_part(bristle_fields_.at("bristle"), H5T_NATIVE_LONG, from, count, number.data());
  h5::write_part(bristle_fields_.at("point"), H5T_NATIVE_LONG, from, count, point.data());
  h5::write_part(bristle_fields_.at("status"), H5T_NATIVE_SCHAR, from, count, status.data());
  for (const BristleVariable& v : bristle_variables()) {
    std::vector<double> values;
    for (const Passage& b : bristles) values.push_back(v.value(b));
    h5::write_part(bristle_fields_.at(v.name), H5T_NATIVE_DOUBLE, from, count, values.data());
  }
}

void ResultWriter::close(const std::map<std::string, std::string>& provenance) {
  h5::Handle group = h5::create_group(file_, "provenance");
  for (const auto& [name, text] : provenance) h5::write_attribute(group, name, text);
  group.close("closing /provenance");
  const std::string digest = payload_sha256(file_);
  h5::write_attribute(file_, "payload_sha256", digest);
  for (auto* handles : {&variables_, &bristle_fields_})
    for (auto& [name, handle] : *handles) handle.close("closing " + name);
  for (h5::Handle& axis : axes_) axis.close("closing an axis");
  bristles_.close("closing /bristles");
  file_.close("closing " + partial_);
  annotate(partial_, experiment_);
  if (payload_sha256(h5::open_file(partial_, false)) != digest)
    throw RunError(fmt::format("{}: reads back differently from what was written", partial_));
}

void ResultWriter::publish() {
  std::error_code error;
  fs::rename(partial_, path_, error);
  if (error) throw RunError(fmt::format("{}: cannot be renamed to {}: {}", partial_, path_, error.message()));
  published_ = true;
}

}  // namespace bristle
