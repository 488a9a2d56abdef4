#include "results/writer.hpp"

#include "results/annotate.hpp"
#include "results/hdf5.hpp"
#include "results/inspect.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>

namespace bristle::results {
namespace {

void describe(hid_t dataset, const Column& column) {
  h5::write_attribute(dataset, "long_name", column.long_name);
  if (!column.units.empty()) h5::write_attribute(dataset, "units", column.units);
  h5::write_attribute(dataset, "symbol", column.symbol);
  h5::write_attribute(dataset, "equation", column.equation);
  if (!column.ancillary.empty()) h5::write_attribute(dataset, "ancillary_variables", column.ancillary);
  for (const auto& [name, text] : column.attributes) h5::write_attribute(dataset, name.c_str(), text);
  for (const auto& [name, value] : column.constants) h5::write_attribute(dataset, name, value);
  if (column.number != Number::code) return;
  std::vector<signed char> values(column.words.size());
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  h5::write_attribute(dataset, "flag_values", values);
  h5::write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(column.words, " ")));
}

hid_t type_of(Number number) {
  return number == Number::code      ? H5T_NATIVE_SCHAR
         : number == Number::integer ? H5T_NATIVE_LONG
                                     : H5T_NATIVE_DOUBLE;
}

// Creates the dataset of a column of numbers or codes, with the attributes that every dataset has.
h5::Handle create_column(hid_t parent, const Column& column, const h5::Shape& shape) {
  h5::Handle dataset = h5::create_dataset(parent, column.name, type_of(column.number), shape);
  describe(dataset, column);
  return dataset;
}

h5::Handle create_texts(hid_t parent, Column column, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(column.words.at(std::size_t(value)));
  column.number = Number::text;
  h5::Handle dataset = h5::create_texts(parent, column.name, texts);
  describe(dataset, column);
  return dataset;
}

h5::Handle create_array(hid_t parent, const Array& array) {
  if (array.about.number == Number::text) return create_texts(parent, array.about, array.values);
  const h5::Shape shape(array.shape.begin(), array.shape.end());
  h5::Handle dataset = create_column(parent, array.about, shape);
  h5::write_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, array.values.data());
  return dataset;
}

Column code_column(const Column& choice) {
  return {code_variable(choice.name), "code of " + choice.name, "", "", Number::code, choice.words};
}

// Creates a dimension scale. The scale of a choice has words, so that programs select by them; their codes
// are a variable over the scale.
h5::Handle create_scale(hid_t parent, const Array& coordinates) {
  const Column& about = coordinates.about;
  const bool choice = about.number == Number::code;
  h5::Handle scale =
      choice ? create_texts(parent, about, coordinates.values) : create_array(parent, coordinates);
  h5::make_scale(scale, about.name);
  if (choice) {
    Array codes = coordinates;
    codes.about = code_column(about);
    h5::attach_scale(create_array(parent, codes), scale, 0);
  }
  return scale;
}

// Returns the coordinates of an axis, with the options of a choice as words.
Array axis_array(const sweep::Axis& axis) {
  const sweep::Sweepable& what = axis.quantity();
  return coordinates({.name = axis_variable(axis.name),
                      .long_name = what.description,
                      .symbol = what.symbol,
                      .equation = "",
                      .number = !what.options.empty()  ? Number::code
                                : axis.columns.empty() ? Number::real
                                                       : Number::integer,
                      .words = what.options,
                      .units = what.units},
                     axis.values);
}

// Writes a table of a result: a group of columns of equal length, with a dimension scale of row numbers.
class TableWriter {
 public:
  // Creates the group of the table. row: the name of the row numbers; columns: all except "point", which
  // becomes the first
  TableWriter(hid_t file, const std::string& name, const std::string& row, std::vector<Column> columns) {
    const h5::Shape open{H5S_UNLIMITED};
    const h5::Handle group = h5::create_group(file, name);
    h5::Handle rows = create_column(group, {row, "row number", "", "", Number::integer}, open);
    h5::make_scale(rows, row);
    columns.insert(columns.begin(),
                   {"point", "index of the sweep point, the last axis fastest", "", "", Number::integer});
    const bool has_status = std::ranges::find(columns, "status", &Column::name) != columns.end();
    for (Column& column : columns) {
      if (has_status && column.number != Number::code) column.ancillary = "status";
      h5::Handle dataset = create_column(group, column, open);
      h5::attach_scale(dataset, rows, 0);
      columns_.emplace_back(std::move(dataset), open);
    }
    columns_.emplace(columns_.begin(), std::move(rows), open);
  }

  // Appends rows, which are in the file after flush(). rows: columns of equal length, "point" first
  void append(const Rows& rows) {
    std::vector<double> numbers(rows.front().size());
    std::iota(numbers.begin(), numbers.end(), double(length_));
    columns_[0].append(numbers);
    for (std::size_t i = 0; i < rows.size(); ++i) columns_[i + 1].append(rows[i]);
    length_ += numbers.size();
  }

  void flush() {
    for (h5::BlockWriter& column : columns_) column.flush();
  }

 private:
  std::vector<h5::BlockWriter> columns_;  // row numbers first
  std::size_t length_ = 0;
};

template <class Texts>
void write_texts(hid_t file, const char* name, const Texts& texts) {
  const h5::Handle group = h5::create_group(file, name);
  for (const auto& [key, text] : texts) h5::write_attribute(group, key, text);
}

// Creates a group. axes: scales of the root, for the dimensions of the dataset that are axes of the sweep
void create_group(hid_t file, const Dataset& data, const std::map<std::string, hid_t>& axes) {
  h5::Handle group = h5::create_group(file, data.name());
  std::vector<h5::Handle> own;
  std::vector<hid_t> scales;
  for (const Array& dimension : data.dimensions())
    if (dimension.values.size() == dimension.shape.front())
      scales.push_back(own.emplace_back(create_scale(group, dimension)));
    else scales.push_back(axes.at(dimension.about.name));
  for (const Array& array : data.arrays()) {
    const h5::Handle dataset = create_array(group, array);
    for (unsigned d = 0; d < scales.size(); ++d) h5::attach_scale(dataset, scales[d], d);
  }
  for (const auto& [name, text] : data.texts()) h5::write_attribute(group, name, text);
  group.close("closing /" + data.name());
}

}  // namespace

struct ResultWriter::Open {
  h5::Handle file;
  h5::Shape shape;  // of the sweep
  std::vector<std::string> names;
  std::vector<h5::Handle> axes;
  std::vector<h5::BlockWriter> variables;  // in the order of the layout
  std::map<std::string, TableWriter> tables;

  Open(const std::string& path, const Sweep& sweep, const PointLayout& layout) : file(h5::create_file(path)) {
    for (const sweep::Axis& axis : sweep.axes) {
      add_scale(axis_array(axis));
      if (!axis.columns.empty()) create_sample(axis);
    }
    for (const std::string& group : layout.groups) h5::create_group(file, group);
    for (const Column& variable : layout.variables) {
      h5::Handle dataset = create_column(file, variable, shape);
      for (unsigned d = 0; d < axes.size(); ++d) h5::attach_scale(dataset, axes[d], d);
      variables.emplace_back(std::move(dataset), shape);
    }
    for (const std::string& name : layout.tables)
      tables.try_emplace(name, file, name, row_name(name), table_columns(name));
  }

  void add_scale(const Array& coordinates) {
    shape.push_back(coordinates.shape.front());
    names.push_back(coordinates.about.name);
    axes.push_back(create_scale(file, coordinates));
  }

  // Creates the quantities that the sample varies, as variables over it.
  void create_sample(const sweep::Axis& axis) {
    std::vector<std::string> columns;
    for (const sweep::Axis& column : axis.columns) {
      const Array array = axis_array(column);
      h5::attach_scale(create_array(file, array), axes.back(), 0);
      columns.push_back(array.about.name);
    }
    h5::write_attribute(file, "coordinates", fmt::format("{}", fmt::join(columns, " ")));
  }
};

std::vector<Column> jump_columns(const Sweep& sweep, const std::string& along) {
  std::vector<Column> columns = {
      {"before", "value of the axis before the jump", "", ""},
      {"after", "value of the axis after the jump", "", ""},
      {"z_0_before", "gap before the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""},
      {"z_0_after", "gap after the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""},
      {"from", "least value of the axis around the jump with an ambiguous gap, or before", "", ""},
      {"to", "greatest value of the axis around the jump with an ambiguous gap, or after", "", ""}};
  for (const sweep::Axis& axis : sweep.axes) {
    if (axis.name == along) continue;
    const Column column = axis_array(axis).about;
    columns.push_back(column.number == Number::code ? code_column(column) : column);
  }
  return columns;
}

ResultWriter::ResultWriter(const Experiment& experiment, const std::string& path)
    : experiment_(experiment), layout_(experiment.sweep), whole_(path, result_file()) {
  whole_.close();  // HDF5 opens the file itself
  open_ = std::make_unique<Open>(partial(), experiment.sweep, layout_);
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::write(std::size_t index, const PointRecord& record) {
  h5::in_file(partial(), [&] {
    for (std::size_t i = 0; i < record.values.size(); ++i) open_->variables[i].append({record.values[i]});
    for (std::size_t i = 0; i < layout_.tables.size(); ++i) {
      Rows rows = record.tables[i];
      rows.insert(rows.begin(), std::vector<double>(rows.front().size(), double(index)));
      open_->tables.at(layout_.tables[i]).append(rows);
    }
  });
  if (!record.failure.empty()) failures_.emplace_back(failure_name(index), record.failure);
}

void ResultWriter::write_jumps(const std::string& along, const Rows& rows) {
  h5::in_file(partial(), [&] {
    const std::vector<Column> columns = jump_columns(experiment_.sweep, along);
    open_->tables.try_emplace("jumps", open_->file, "jumps", "jump", columns).first->second.append(rows);
    h5::write_attribute(h5::open_group(open_->file, "jumps"), "along", axis_variable(along));
  });
}

void ResultWriter::write_group(const Dataset& data) {
  std::map<std::string, hid_t> axes;
  for (std::size_t i = 0; i < open_->axes.size(); ++i) axes[open_->names[i]] = open_->axes[i];
  h5::in_file(partial(), [&] { create_group(open_->file, data, axes); });
}

void ResultWriter::close(const std::map<std::string, std::string>& provenance) {
  h5::in_file(partial(), [&] { finish(provenance); });
}

void ResultWriter::finish(const std::map<std::string, std::string>& provenance) {
  write_texts(open_->file, "provenance", provenance);
  if (!failures_.empty()) write_texts(open_->file, kFailures, failures_);
  for (h5::BlockWriter& variable : open_->variables) variable.flush();
  for (auto& [name, table] : open_->tables) table.flush();
  const std::string digest = payload_sha256(open_->file);
  h5::write_attribute(open_->file, "payload_sha256", digest);
  h5::check(H5Fflush(open_->file, H5F_SCOPE_LOCAL), "writing the file");
  h5::Handle file = std::move(open_->file);
  open_.reset();
  file.close("closing the file");
  annotate(partial(), experiment_, provenance);
  if (payload_sha256(h5::open_file(partial(), false)) != digest)
    throw RunError("reads back differently from what was written");
}

void replace_group(const std::string& path, const Dataset& data) {
  h5::in_file(path, [&] {
    h5::Handle file = h5::open_file(path, true);
    if (h5::exists(file, data.name()))
      h5::check(H5Ldelete(file, data.name().c_str(), H5P_DEFAULT), "replacing /" + data.name());
    if (data.size() > 0) create_group(file, data, {});
    file.close("closing the file");
  });
}

void write_attributes(const std::string& path, const std::vector<Attribute>& attributes) {
  h5::Handle file = h5::open_file(path, true);
  for (const Attribute& attribute : attributes) {
    const h5::Handle object(H5Oopen(file, attribute.object.c_str(), H5P_DEFAULT), H5Oclose,
                            "opening " + attribute.object);
    if (attribute.unless_present && h5::has_attribute(object, attribute.name)) continue;
    std::visit([&](const auto& value) { h5::write_attribute(object, attribute.name, value); },
               attribute.value);
  }
  file.close("closing " + path);
}

std::string hdf5_version() { return fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE); }

void start_hdf5() { h5::silence(); }

}  // namespace bristle::results
