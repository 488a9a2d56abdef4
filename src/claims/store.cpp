#include "claims/store.hpp"

#include "results/hdf5.hpp"

#include <cmath>
#include <numeric>

namespace bristle::claims {
namespace {

template <class Value>
struct CheckColumn {
  const char* name;
  const char* long_name;
  Value (*value)(const CheckResult&);
};

using C = const CheckResult&;

const CheckColumn<std::string> kTexts[] = {
    {"claim", "identifier of the claim", [](C c) { return c.check.claim; }},
    {"statement", "text of the claim", [](C c) { return c.check.statement; }},
    {"reading", "value of the choice at which the check is evaluated", [](C c) { return c.check.reading; }},
    {"role", "main checks decide the verdict on the claim",
     [](C c) { return std::string(c.check.main ? "main" : "further"); }},
    {"is", "required relation of the measured number to the threshold",
     [](C c) { return std::string(word(c.check.criterion)); }},
    {"verdict", "verdict of the check", [](C c) { return std::string(word(c.verdict)); }},
    {"claim_verdict", "verdict on the claim under this reading, by its main checks",
     [](C c) { return std::string(word(c.claim_verdict)); }},
};

const CheckColumn<double> kNumbers[] = {
    {"declared", "number of the check in the experiment", [](C c) { return double(c.check.number); }},
    {"measured", "measured number", [](C c) { return c.measured.value; }},
    {"uncertainty", "uncertainty of the measured number", [](C c) { return c.measured.uncertainty; }},
    {"threshold", "required number", [](C c) { return c.check.threshold; }},
    {"band", "greatest distance from the threshold that counts as near",
     [](C c) { return c.check.band.value_or(NAN); }},
    {"margin", "distance from the threshold or from the end of the band, positive if the claim holds",
     [](C c) { return c.margin; }},
    {"significance", "two-sided p-value of a trend", [](C c) { return c.measured.significance; }},
};

// The numbers of the checks, a dimension scale.
h5::Handle write_rows(hid_t group, std::size_t size) {
  h5::Handle rows = h5::create_dataset(group, "check", H5T_NATIVE_LONG, {size});
  h5::write_attribute(rows, "long_name", "number of the check");
  std::vector<double> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  h5::write_part(rows, H5T_NATIVE_DOUBLE, {0}, {size}, numbers.data());
  h5::make_scale(rows, "check");
  return rows;
}

h5::Handle create_column(hid_t group, const std::string& name, const std::vector<std::string>& values) {
  return h5::create_texts(group, name, values);
}

h5::Handle create_column(hid_t group, const std::string& name, const std::vector<double>& values) {
  h5::Handle dataset = h5::create_dataset(group, name, H5T_NATIVE_DOUBLE, {values.size()});
  h5::write_part(dataset, H5T_NATIVE_DOUBLE, {0}, {values.size()}, values.data());
  return dataset;
}

template <class Value>
void write_column(hid_t group, hid_t rows, const CheckColumn<Value>& column,
                  const std::vector<CheckResult>& checks) {
  std::vector<Value> values;
  for (const CheckResult& c : checks) values.push_back(column.value(c));
  const h5::Handle dataset = create_column(group, column.name, values);
  h5::write_attribute(dataset, "long_name", column.long_name);
  h5::attach_scale(dataset, rows, 0);
}

}  // namespace

void write_checks(const std::string& path, const std::vector<CheckResult>& checks) {
  h5::in_file(path, [&] {
    h5::Handle file = h5::open_file(path, true);
    if (h5::exists(file, "checks")) h5::check(H5Ldelete(file, "checks", H5P_DEFAULT), "replacing /checks");
    if (!checks.empty()) {
      h5::Handle group = h5::create_group(file, "checks");
      const h5::Handle rows = write_rows(group, checks.size());
      for (const auto& column : kTexts) write_column(group, rows, column, checks);
      for (const auto& column : kNumbers) write_column(group, rows, column, checks);
      group.close("closing /checks");
    }
    file.close("closing the file");
  });
}

std::vector<results::CsvColumn> csv_columns(const std::vector<CheckResult>& checks) {
  std::vector<results::CsvColumn> columns;
  for (const auto& text : kTexts) {
    std::vector<std::string> texts;
    for (const CheckResult& c : checks) texts.push_back(text.value(c));
    columns.push_back(results::text_column(text.name, text.long_name, texts));
  }
  for (const auto& number : kNumbers) {
    columns.push_back({number.name, "", number.long_name, {}, {}});
    for (const CheckResult& c : checks) columns.back().values.push_back(number.value(c));
  }
  return columns;
}

}  // namespace bristle::claims
