#include "results/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <numeric>

namespace bristle::results {

void describe(hid_t dataset, const std::string& long_name, const std::string& symbol,
              const std::string& equation, const std::string& units) {
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

Table::Table(hid_t file, const std::string& group, const std::string& row, const std::vector<Column>& columns)
    : name_(group), group_(h5::create_group(file, group)) {
  const h5::Shape open{H5S_UNLIMITED};
  h5::Handle rows = h5::create_dataset(group_, row, H5T_NATIVE_LONG, open);
  describe(rows, "row number", "", "");
  h5::make_scale(rows, row);
  const bool has_status = std::ranges::find(columns, "status", &Column::name) != columns.end();
  for (const Column& column : columns) {
    h5::Handle dataset = h5::create_dataset(group_, column.name, column.type, open);
    describe(dataset, column.long_name, column.symbol, column.equation, column.units);
    if (!column.flags.empty()) describe_flags(dataset, column.flags);
    else if (has_status) h5::write_attribute(dataset, "ancillary_variables", "status");
    for (const auto& [name, value] : column.constants) h5::write_attribute(dataset, name, value);
    h5::attach_scale(dataset, rows, 0);
    columns_.emplace_back(std::move(dataset), open, 0);
  }
  columns_.emplace(columns_.begin(), std::move(rows), open, 0);
}

void Table::append(const std::vector<std::vector<double>>& columns) {
  std::vector<double> numbers(columns.front().size());
  std::iota(numbers.begin(), numbers.end(), double(length_));
  columns_[0].add(length_, numbers);
  for (std::size_t i = 0; i < columns.size(); ++i) columns_[i + 1].add(length_, columns[i]);
  length_ += numbers.size();
}

void Table::flush() {
  for (BlockWriter& column : columns_) column.flush();
}

void Table::close() {
  for (BlockWriter& column : columns_) column.close("closing a column of /" + name_);
  group_.close("closing /" + name_);
}

}  // namespace bristle::results
