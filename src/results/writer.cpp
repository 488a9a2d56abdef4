#include "results/writer.hpp"

#include "results/annotate.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>

namespace bristle::results {
namespace {

Column axis_column(const experiment::Axis& axis) {
  const experiment::Sweepable& what = axis.quantity();
  return {.name = axis_variable(axis.name),
          .long_name = what.description,
          .symbol = what.symbol,
          .equation = "",
          .type = axis.columns.empty() ? H5T_NATIVE_DOUBLE : H5T_NATIVE_LONG,
          .units = what.units};
}

Column code_column(const std::string& name, const std::vector<std::string>& options) {
  return {code_variable(name), "code of " + name, "", "", H5T_NATIVE_SCHAR, options};
}

// A dimension scale of words, so that programs select by them. The codes are a variable over it.
h5::Handle create_words(hid_t parent, const Column& column, const std::vector<std::string>& words,
                        const Column& code, const std::vector<double>& values) {
  h5::Handle scale = h5::create_texts(parent, column.name, words);
  describe(scale, column);
  h5::make_scale(scale, column.name);
  const h5::Handle codes = create_column(parent, code, {words.size()});
  h5::write_part(codes, H5T_NATIVE_DOUBLE, {0}, {words.size()}, values.data());
  h5::attach_scale(codes, scale, 0);
  return scale;
}

h5::Handle create_numbers(hid_t parent, const Column& column, const std::vector<double>& values) {
  h5::Handle scale = create_column(parent, column, {values.size()});
  h5::write_part(scale, H5T_NATIVE_DOUBLE, {0}, {values.size()}, values.data());
  h5::make_scale(scale, column.name);
  return scale;
}

}  // namespace

ResultWriter::ResultWriter(const Experiment& experiment, const std::string& path)
    : experiment_(experiment), layout_(experiment.sweep), whole_(path, result_file()) {
  whole_.close();  // HDF5 opens it itself
  file_ = h5::create_file(partial());
  for (const experiment::Axis& axis : experiment_.sweep.axes) create_axis(axis);
  if (layout_.nodes) {
    std::vector<double> numbers(*layout_.nodes);
    std::iota(numbers.begin(), numbers.end(), 0.0);
    add_scale(create_numbers(
        file_, {"node", "index of the node, from first contact down", "node", "", H5T_NATIVE_LONG}, numbers));
  }
  create_variables();
  for (const std::string& name : layout_.tables) tables_.try_emplace(name, file_, name);
}

GroupDimension word_dimension(const std::string& name, const std::string& meaning,
                              const std::vector<std::string>& words) {
  std::vector<double> codes(words.size());
  std::iota(codes.begin(), codes.end(), 0.0);
  return {{name, meaning, "", ""}, words, codes};
}

std::vector<Column> jump_columns(const Sweep& sweep, const std::string& along) {
  std::vector<Column> columns = {
      {"before", "value of the axis before the jump", "", ""},
      {"after", "value of the axis after the jump", "", ""},
      {"z_0_before", "gap before the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""},
      {"z_0_after", "gap after the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""},
      {"from", "least value of the axis around the jump with an ambiguous gap, or before", "", ""},
      {"to", "greatest value of the axis around the jump with an ambiguous gap, or after", "", ""}};
  for (const experiment::Axis& axis : sweep.axes)
    if (axis.name != along)
      columns.push_back(axis.quantity().options.empty() ? axis_column(axis)
                                                        : code_column(axis.name, axis.quantity().options));
  return columns;
}

void ResultWriter::create_axis(const experiment::Axis& axis) {
  const experiment::Sweepable& what = axis.quantity();
  const Column scale = axis_column(axis);
  if (what.options.empty()) {
    add_scale(create_numbers(file_, scale, axis.values));
    if (!axis.columns.empty()) create_sample(axis);
    return;
  }
  std::vector<std::string> words;
  for (const double value : axis.values) words.push_back(what.text(value));
  add_scale(create_words(file_, scale, words, code_column(axis.name, what.options), axis.values));
}

// The quantities that the sample varies, as variables over it.
void ResultWriter::create_sample(const experiment::Axis& axis) {
  std::vector<std::string> names;
  for (const experiment::Axis& column : axis.columns) {
    Column variable = axis_column(column);
    variable.flags = column.quantity().options;
    if (!variable.flags.empty()) variable.type = H5T_NATIVE_SCHAR;
    const h5::Handle dataset = create_column(file_, variable, {axis.values.size()});
    h5::write_part(dataset, H5T_NATIVE_DOUBLE, {0}, {axis.values.size()}, column.values.data());
    h5::attach_scale(dataset, axes_.back(), 0);
    names.push_back(variable.name);
  }
  h5::write_attribute(file_, "coordinates", fmt::format("{}", fmt::join(names, " ")));
}

void ResultWriter::add_scale(h5::Handle dataset) {
  shape_.push_back(h5::length_of(dataset));
  axes_.push_back(std::move(dataset));
}

void ResultWriter::create_variables() {
  for (const std::string& group : layout_.groups) h5::create_group(file_, group);
  for (const PointLayout::Dataset& variable : layout_.datasets) {
    h5::Handle dataset = create_column(file_, variable, shape_);
    for (unsigned d = 0; d < axes_.size(); ++d) h5::attach_scale(dataset, axes_[d], d);
    variables_.emplace_back(std::move(dataset), shape_);
  }
}

void ResultWriter::write(std::size_t index, const PointRecord& record) {
  h5::in_file(partial(), [&] {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      std::vector<double> values = record.values.at(layout_.datasets[i].name);
      values.resize(layout_.nodes.value_or(1), layout_.datasets[i].missing);
      variables_[i].append(values);
    }
    for (auto& [name, table] : tables_) {
      Rows rows = record.tables.at(name);
      rows.insert(rows.begin(), std::vector<double>(rows.front().size(), double(index)));
      table.append(rows);
    }
  });
  if (!record.failure.empty()) failures_.emplace_back(failure_name(index), record.failure);
}

void ResultWriter::write_jumps(const std::string& along, const Rows& rows) {
  h5::in_file(partial(), [&] {
    tables_.try_emplace("jumps", file_, "jumps", "jump", jump_columns(experiment_.sweep, along))
        .first->second.append(rows);
    h5::write_attribute(h5::open_group(file_, "jumps"), "along", axis_variable(along));
  });
}

void ResultWriter::write_group(const Group& group) {
  h5::in_file(partial(), [&] {
    const h5::Handle parent = h5::create_group(file_, group.name);
    std::vector<h5::Handle> own;
    for (const auto& [column, words, values] : group.dimensions)
      own.push_back(words.empty()
                        ? create_numbers(parent, column, values)
                        : create_words(parent, column, words, code_column(column.name, words), values));
    std::vector<hid_t> scales;
    for (const std::size_t axis : group.axes) scales.push_back(axes_[axis]);
    for (const h5::Handle& scale : own) scales.push_back(scale);
    h5::Shape shape;
    for (const hid_t scale : scales) shape.push_back(h5::length_of(scale));
    for (std::size_t i = 0; i < group.columns.size(); ++i) {
      const h5::Handle dataset = create_column(parent, group.columns[i], shape);
      h5::write_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, group.values[i].data());
      for (unsigned d = 0; d < scales.size(); ++d) h5::attach_scale(dataset, scales[d], d);
    }
  });
}

void ResultWriter::close(const std::map<std::string, std::string>& provenance) {
  h5::in_file(partial(), [&] { finish(provenance); });
}

void ResultWriter::finish(const std::map<std::string, std::string>& provenance) {
  const auto write_texts = [&](const char* name, const auto& texts) {
    const h5::Handle group = h5::create_group(file_, name);
    for (const auto& [key, text] : texts) h5::write_attribute(group, key, text);
  };
  write_texts("provenance", provenance);
  if (!failures_.empty()) write_texts(kFailures, failures_);
  for (BlockWriter& variable : variables_) variable.flush();
  for (auto& [name, table] : tables_) table.flush();
  const std::string digest = payload_sha256(file_);
  h5::write_attribute(file_, "payload_sha256", digest);
  h5::check(H5Fflush(file_, H5F_SCOPE_LOCAL), "writing the file");
  variables_.clear();
  tables_.clear();
  axes_.clear();
  file_.close("closing the file");
  annotate(partial(), experiment_);
  if (payload_sha256(h5::open_file(partial(), false)) != digest)
    throw RunError("reads back differently from what was written");
}

}  // namespace bristle::results
