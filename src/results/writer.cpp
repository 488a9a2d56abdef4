#include "results/writer.hpp"

#include "results/annotate.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "results/texts.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <numeric>
#include <unistd.h>

namespace bristle::results {
namespace fs = std::filesystem;
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ResultWriter::ResultWriter(const Experiment& experiment, const std::string& path)
    : experiment_(experiment),
      path_(path),
      partial_(path + ".partial"),
      curves_(experiment.base.loading.trace.has_value()),
      searched_(!curves_ && !experiment.base.loading.z_0) {
  require_replaceable(path_, result_file());
  lock_ = lock_file(path_, partial_);
  try {
    create();
  } catch (...) {
    discard();
    throw;
  }
}

void ResultWriter::create() {
  file_ = h5::create_file(partial_);
  for (const experiment::Axis& axis : experiment_.axes) create_axis(axis);
  if (curves_) {
    const std::size_t nodes = std::size_t(experiment_.base.loading.trace->nodes);
    std::vector<double> numbers(nodes);
    std::iota(numbers.begin(), numbers.end(), 0.0);
    create_scale("node", H5T_NATIVE_LONG, numbers,
                 {"node", "index of the node, from first contact down", "1"});
  }
  create_variables();
  for (const std::string& name : PointLayout(experiment_).tables)
    tables_.emplace(name, create_table(file_, name));
}

void ResultWriter::create_axis(const experiment::Axis& axis) {
  const experiment::Sweepable& what = *experiment::find_sweepable(axis.name);
  if (!what.options.empty()) return create_choice(axis, what);
  create_scale(axis_variable(axis.name), H5T_NATIVE_DOUBLE, axis.values,
               {what.symbol, what.description, what.units});
}

// The dimension scale contains the words, so that programs select by them. The codes are a variable over it.
void ResultWriter::create_choice(const experiment::Axis& axis, const experiment::Sweepable& what) {
  std::vector<std::string> words;
  for (const double value : axis.values) words.push_back(what.text(value));
  const hsize_t size = words.size();
  add_scale(create_texts(file_, axis.name, words), axis.name, {what.symbol, what.description, what.units});
  h5::Handle codes = h5::create_dataset(file_, code_variable(axis.name), H5T_NATIVE_SCHAR, {size});
  h5::write_part(codes, H5T_NATIVE_DOUBLE, {0}, {size}, axis.values.data());
  describe(codes, "code of " + axis.name, "", "");
  describe_flags(codes, what.options);
  h5::attach_scale(codes, axes_.back(), 0);
  codes.close("closing " + code_variable(axis.name));
}

void ResultWriter::create_scale(const std::string& name, hid_t type, const std::vector<double>& values,
                                const std::array<std::string, 3>& label) {
  h5::Handle scale = h5::create_dataset(file_, name, type, {values.size()});
  h5::write_part(scale, H5T_NATIVE_DOUBLE, {0}, {values.size()}, values.data());
  add_scale(std::move(scale), name, label);
}

void ResultWriter::add_scale(h5::Handle dataset, const std::string& name,
                             const std::array<std::string, 3>& label) {
  h5::make_scale(dataset, name);
  describe(dataset, label[1], label[0], "", label[2]);
  shape_.push_back(h5::length_of(dataset));
  axes_.push_back(std::move(dataset));
}

ResultWriter::~ResultWriter() { discard(); }

void ResultWriter::discard() {
  std::error_code ignored;
  if (!published_) fs::remove(partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
}

h5::Handle ResultWriter::create_variable(hid_t parent, const std::string& name, hid_t type,
                                         const std::string& long_name, const std::string& symbol,
                                         const std::string& equation, const std::string& units,
                                         const std::string& ancillary) {
  h5::Handle dataset = h5::create_dataset(parent, name, type, shape_);
  describe(dataset, long_name, symbol, equation, units);
  if (!ancillary.empty()) h5::write_attribute(dataset, "ancillary_variables", ancillary);
  for (unsigned d = 0; d < axes_.size(); ++d) h5::attach_scale(dataset, axes_[d], d);
  return dataset;
}

void ResultWriter::add_variable(const std::string& name, h5::Handle dataset, double missing) {
  variables_.try_emplace(name, std::move(dataset), shape_, missing);
}

void ResultWriter::create_variables() {
  if (searched_) load_error_ = h5::create_group(file_, "load_error");
  for (const ResultVariable& v : result_variables(experiment_)) {
    add_variable(v.name,
                 create_variable(file_, v.name, H5T_NATIVE_DOUBLE, v.long_name, v.symbol, v.equation, v.units,
                                 v.error ? v.name + "_err status" : "status"),
                 kMissing);
    const std::string symbol = R"(\delta )" + v.symbol;
    if (v.error)
      add_variable(v.name + "_err",
                   create_variable(file_, v.name + "_err", H5T_NATIVE_DOUBLE,
                                   "estimated numerical error of " + v.name, symbol, v.equation, v.units),
                   kMissing);
    if (searched_ && v.load_error)
      add_variable(
          "load_error/" + v.name,
          create_variable(load_error_, v.name, H5T_NATIVE_DOUBLE,
                          "part of " + v.name + "_err due to the deviation of the load from its target",
                          symbol, v.equation, v.units),
          kMissing);
  }
  add_variable("passages",
               create_variable(file_, "passages", H5T_NATIVE_LONG,
                               "number of passages computed for the point", "N", ""),
               0);
  create_flags("status", "outcome of the point", kPointStatusNames, int(PointStatus::absent));
  if (curves_)
    create_flags("branch", "paths of the slab on which the node lies", kBranchNames, int(Branch::absent));
}

// Creates a flag variable that is filled with the code absent.
void ResultWriter::create_flags(const std::string& name, const std::string& long_name,
                                const std::vector<std::string>& meanings, int absent) {
  h5::Handle flags = create_variable(file_, name, H5T_NATIVE_SCHAR, long_name, "", "");
  describe_flags(flags, meanings);
  std::size_t size = 1;
  for (const hsize_t n : shape_) size *= std::size_t(n);
  const std::vector<signed char> fill(size, static_cast<signed char>(absent));
  h5::write_part(flags, H5T_NATIVE_SCHAR, h5::Shape(shape_.size(), 0), shape_, fill.data());
  add_variable(name, std::move(flags), absent);
}

void ResultWriter::write(std::size_t index, const PointRecord& record) {
  h5::in_file(partial_, [&] { write_values(index, record); });
}

void ResultWriter::write_values(std::size_t index, const PointRecord& record) {
  const std::size_t place = curves_ ? index * std::size_t(shape_.back()) : index;
  for (auto& [name, variable] : variables_) variable.add(place, record.values.at(name));
  if (!record.failure.empty()) failures_[index] = record.failure;
  for (auto& [name, table] : tables_) {
    const Rows& rows = record.tables.at(name);
    Rows numbered{std::vector<double>(rows.front().size(), double(index))};
    numbered.insert(numbered.end(), rows.begin(), rows.end());
    table.append(numbered);
  }
}

void ResultWriter::write_jumps(const std::string& along, const Rows& rows) {
  h5::in_file(partial_, [&] {
    tables_.emplace("jumps", create_table(file_, "jumps")).first->second.append(rows);
    h5::write_attribute(h5::open_group(file_, "jumps"), "along", axis_variable(along));
  });
}

void ResultWriter::close(const std::map<std::string, std::string>& provenance) {
  h5::in_file(partial_, [&] { finish(provenance); });
}

void ResultWriter::finish(const std::map<std::string, std::string>& provenance) {
  h5::Handle group = h5::create_group(file_, "provenance");
  for (const auto& [name, text] : provenance) h5::write_attribute(group, name, text);
  group.close("closing /provenance");
  if (!failures_.empty()) {
    const h5::Handle failures = h5::create_group(file_, kFailures);
    for (const auto& [index, error] : failures_) h5::write_attribute(failures, failure_name(index), error);
  }
  for (auto& [name, variable] : variables_) variable.flush();
  for (auto& [name, table] : tables_) table.flush();
  const std::string digest = payload_sha256(file_);
  h5::write_attribute(file_, "payload_sha256", digest);
  for (auto& [name, variable] : variables_) variable.close("closing " + name);
  for (h5::Handle& axis : axes_) axis.close("closing an axis");
  for (auto& [name, table] : tables_) table.close();
  load_error_.close("closing /load_error");
  file_.close("closing the file");
  annotate(partial_, experiment_);
  if (payload_sha256(h5::open_file(partial_, false)) != digest)
    throw RunError("reads back differently from what was written");
}

void ResultWriter::publish() {
  replace_file(partial_, path_);
  published_ = true;
}

}  // namespace bristle::results
