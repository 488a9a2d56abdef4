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
  if (const auto& trace = experiment_.base.loading.trace) {
    std::vector<double> numbers(std::size_t(trace->nodes));
    std::iota(numbers.begin(), numbers.end(), 0.0);
    create_scale({"node", "index of the node, from first contact down", "node", "", H5T_NATIVE_LONG},
                 numbers);
  }
  create_variables();
  for (const std::string& name : PointLayout(experiment_).tables) tables_.try_emplace(name, file_, name);
}

void ResultWriter::create_axis(const experiment::Axis& axis) {
  const experiment::Sweepable& what = *experiment::find_sweepable(axis.name);
  const Column scale{.name = axis_variable(axis.name),
                     .long_name = what.description,
                     .symbol = what.symbol,
                     .equation = "",
                     .units = what.units};
  if (what.options.empty()) return create_scale(scale, axis.values);
  // The dimension scale contains the words, so that programs select by them. The codes are a variable over
  // it.
  std::vector<std::string> words;
  for (const double value : axis.values) words.push_back(what.text(value));
  h5::Handle dataset = create_texts(file_, axis.name, words);
  describe(dataset, scale);
  add_scale(std::move(dataset), axis.name);
  const std::string code = code_variable(axis.name);
  h5::Handle codes = create_column(
      file_, {code, "code of " + axis.name, "", "", H5T_NATIVE_SCHAR, what.options}, {words.size()});
  h5::write_part(codes, H5T_NATIVE_DOUBLE, {0}, {words.size()}, axis.values.data());
  h5::attach_scale(codes, axes_.back(), 0);
  codes.close("closing " + code);
}

void ResultWriter::create_scale(const Column& column, const std::vector<double>& values) {
  h5::Handle scale = create_column(file_, column, {values.size()});
  h5::write_part(scale, H5T_NATIVE_DOUBLE, {0}, {values.size()}, values.data());
  add_scale(std::move(scale), column.name);
}

void ResultWriter::add_scale(h5::Handle dataset, const std::string& name) {
  h5::make_scale(dataset, name);
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

void ResultWriter::add_variable(const Column& column, double missing, const std::string& group) {
  h5::Handle dataset = create_column(group.empty() ? file_ : load_error_, column, shape_);
  for (unsigned d = 0; d < axes_.size(); ++d) h5::attach_scale(dataset, axes_[d], d);
  variables_.emplace(group + column.name, OverSweep{BlockWriter(std::move(dataset), shape_), missing});
}

void ResultWriter::create_variables() {
  if (searched_) load_error_ = h5::create_group(file_, "load_error");
  for (const ResultVariable& v : result_variables(experiment_)) {
    Column column{.name = v.name,
                  .long_name = v.long_name,
                  .symbol = v.symbol,
                  .equation = v.equation,
                  .units = v.units,
                  .ancillary = v.error ? v.name + "_err status" : "status"};
    add_variable(column, kMissing);
    column.symbol = R"(\delta )" + v.symbol;
    column.ancillary = "";
    if (searched_ && v.load_error) {
      column.long_name = "part of " + v.name + "_err due to the deviation of the load from its target";
      add_variable(column, kMissing, "load_error/");
    }
    column.name = v.name + "_err";
    column.long_name = "estimated numerical error of " + v.name;
    if (v.error) add_variable(column, kMissing);
  }
  add_variable({"passages", "number of passages computed for the point", "N", "", H5T_NATIVE_LONG}, 0);
  add_variable({"status", "outcome of the point", "", "", H5T_NATIVE_SCHAR, kPointStatusNames},
               double(PointStatus::absent));
  if (curves_)
    add_variable(
        {"branch", "paths of the slab on which the node lies", "", "", H5T_NATIVE_SCHAR, kBranchNames},
        double(Branch::absent));
}

void ResultWriter::write(std::size_t index, const PointRecord& record) {
  h5::in_file(partial_, [&] { write_values(index, record); });
}

void ResultWriter::write_values(std::size_t index, const PointRecord& record) {
  for (auto& [name, variable] : variables_) {
    std::vector<double> values = record.values.at(name);
    values.resize(curves_ ? std::size_t(shape_.back()) : 1, variable.missing);
    variable.values.append(values);
  }
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
    tables_.try_emplace("jumps", file_, "jumps").first->second.append(rows);
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
  for (auto& [name, variable] : variables_) variable.values.flush();
  for (auto& [name, table] : tables_) table.flush();
  const std::string digest = payload_sha256(file_);
  h5::write_attribute(file_, "payload_sha256", digest);
  for (auto& [name, variable] : variables_) variable.values.close("closing " + name);
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
