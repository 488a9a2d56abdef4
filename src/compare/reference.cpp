#include "compare/reference.hpp"

#include "experiment/document.hpp"
#include "experiment/sample.hpp"
#include "experiment/schema.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::compare {

const char* reference_schema();  // the text of reference.schema.json, embedded by the build

namespace {

using results::DatasetKind;

// The tolerance allows for an integrator's error of this many rtol. The estimated errors of means include the
// integrator's (docs/accuracy.md has up to 60 rtol); the allowance is for the variables without an estimate.
constexpr double kIntegrator = 10;

// Dimensions of the points: those of the variable status, including nodes; those of the sweep if a damaged
// file has no status.
std::vector<std::string> dimensions_of(const results::ResultReader& result) {
  return result.has("status") ? result.variable("status").dimensions : result.axes();
}

// The variables of a result that a reference has: axes, flags and real numbers. The parameters of a sample,
// which the numbers of its points stand for, are not among them.
std::map<std::string, DatasetKind> kinds_of(const results::ResultReader& result) {
  const std::vector<std::string> axes = dimensions_of(result);
  std::map<std::string, DatasetKind> out;
  const std::vector<std::string> parameters = result.sample_columns();
  for (const std::string& name : results::numeric_datasets(result)) {
    if (std::ranges::find(parameters, name) != parameters.end()) continue;
    const bool axis = std::ranges::count(axes, name) > 0;
    const DatasetKind kind = axis ? DatasetKind::coordinate : results::kind_of(result, name);
    if (name.find('/') == std::string::npos && !name.ends_with("_err") && kind != DatasetKind::integer &&
        (axis || kind != DatasetKind::coordinate))
      out[name] = kind;
  }
  return out;
}

// The estimated error of each value; 0 if there is none. The allowed distance of the load from its target,
// orientation.rtol, is not part of the error of R_n.
std::vector<double> errors_of(const results::ResultReader& result, const std::string& name,
                              std::size_t size) {
  std::vector<double> errors(size, 0);
  if (result.has(name + "_err")) errors = result.variable(name + "_err").values;
  errors.resize(size, 0);
  double distance = 0;
  if (name == "R_n" && result.has("load_error")) {
    const Json& experiment = result.experiment();
    double target = experiment.value(JsonPointer("/load/R_n"), 0.0);
    if (result.has("R_n_target"))
      for (const double one : result.variable("R_n_target").values) target = std::max(target, one);
    distance = experiment.value(JsonPointer("/orientation/rtol"), 0.0) * target;
  }
  for (double& error : errors) error = (std::isfinite(error) ? error : 0) + distance;
  return errors;
}

// Rounded down to two digits, by its text: "1.2" and "e-05" of 1.2345e-05. At most the largest finite number,
// as JSON has no infinity; 0 below the smallest normal one.
double rounded_down(double x) {
  using Limits = std::numeric_limits<double>;
  if (!(x >= Limits::min())) return 0;
  const std::string text = fmt::format("{:.17e}", std::min(x, Limits::max()));
  return *number_in(text.substr(0, 3) + text.substr(text.find('e')));
}

// The estimated error twice, because both runs may be off by it, and an allowance for the integrator. The
// latter is relative to the largest value of the variable: a value near zero is not more accurate than its
// neighbours. energy_residual is itself an error of the integrator.
std::vector<double> tolerances_of(const results::ResultReader& result, const std::string& name,
                                  const std::vector<double>& values) {
  double scale = 0;
  for (const double v : values)
    if (std::isfinite(v)) scale = std::max(scale, std::abs(v));
  const double rtol = result.experiment().at("integrator").at("rtol");
  const double integrator = (name == "energy_residual" ? 1 : kIntegrator * rtol) * scale;
  std::vector<double> out = errors_of(result, name, values.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::isfinite(values[i]) ? rounded_down(2 * out[i] + integrator) : 0;
  return out;
}

// Numbers by rows of the last axis. A row ends after its last value; values: empty if all have one.
template <class T>
Json rows(const std::vector<T>& numbers, std::size_t length, const std::vector<double>& values) {
  Json out = Json::array();
  for (std::size_t first = 0; first < numbers.size(); first += length) {
    std::size_t end = first + length;
    while (end > first && !values.empty() && std::isnan(values[end - 1])) --end;
    out.push_back(std::vector<T>(numbers.begin() + long(first), numbers.begin() + long(end)));
  }
  return out;
}

// One number if it is the same at all points that have a value.
Json tolerance_json(const std::vector<double>& tolerance, std::size_t length,
                    const std::vector<double>& values) {
  std::optional<double> same;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i]) && tolerance[i] != same.value_or(tolerance[i]))
      return rows(tolerance, length, values);
    else if (!std::isnan(values[i])) same = tolerance[i];
  return same.value_or(0);
}

Json claims_json(const std::vector<claims::CheckResult>& checks) {
  Json out = Json::array();
  for (const claims::CheckResult& c : checks)
    out.push_back({{"claim", c.check.claim},
                   {"reading", c.check.reading},
                   {"verdict", word(c.verdict)},
                   {"statement", c.check.statement}});
  return out;
}

// Commit of the program that computed the points; a list of commits if several programs did.
std::string commit_of(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  for (const char* name : {"points_commits", "commit"})
    if (const auto found = provenance.find(name); found != provenance.end()) return found->second;
  return "unknown";
}

std::vector<std::size_t> shape_of(const Json& reference) {
  std::vector<std::size_t> shape;
  for (const auto& [name, values] : reference["axes"].items()) shape.push_back(values.size());
  return shape;
}

// The words of a choice, or numbers.
Json axis_json(const results::ResultReader& result, const std::string& name) {
  const std::vector<double>& values = result.variable(name).values;
  if (result.flag_meanings(name).empty()) return values;
  Json out = Json::array();
  for (const double value : values) out.push_back(results::value_text(result, name, value));
  return out;
}

// Length of the rows, which are along the last axis.
std::size_t row_length(const std::vector<std::size_t>& shape) { return shape.empty() ? 1 : shape.back(); }

// The numbers of rows; NaN where a row ends.
std::vector<double> numbers_of(const Json& rows, std::size_t length) {
  std::vector<double> out;
  for (const Json& row : rows) {
    const std::size_t end = out.size() + length;
    for (const Json& value : row) out.push_back(value.is_null() ? NAN : value.get<double>());
    out.resize(end, NAN);
  }
  return out;
}

// Requires a number for each point, or one less where a row of like ends earlier.
void require_rows(const experiment::Document& document, const JsonPointer& at, bool may_end,
                  const Json& like = {}) {
  const Json& rows = document.json().at(at);
  const auto shape = shape_of(document.json());
  const std::size_t length = row_length(shape), count = grid_size(shape) / length;
  if (rows.size() != count)
    document.fail(at.to_string(), fmt::format("{} rows, but the axes have {}", rows.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t wanted = like.is_array() ? like[i].size() : length;
    if (rows[i].size() > wanted || (rows[i].size() < wanted && !may_end))
      document.fail((at / i).to_string(),
                    fmt::format("{} numbers, but there are {} points with a value", rows[i].size(), wanted));
  }
}

Json read(const std::string& path) {
  const auto document = experiment::Document::stored(read_json_file(path), path);
  experiment::check_schema(document, Json::parse(reference_schema()));
  const Json& json = document.json();
  const JsonPointer sample = JsonPointer("/axes") / experiment::kSample;
  const Json columns = json.value("sample", Json::object());
  for (const auto& [name, column] : columns.items())
    if (const std::size_t rows = json.contains(sample) ? json.at(sample).size() : 0; column.size() != rows)
      document.fail("/sample/" + name,
                    fmt::format("{} values, but the sample has {} rows", column.size(), rows));
  for (const auto& [name, codes] : json["flags"].items())
    require_rows(document, JsonPointer("/flags") / name, false);
  for (const auto& [name, variable] : json["variables"].items()) {
    const JsonPointer at = JsonPointer("/variables") / name;
    require_rows(document, at / "values", true);
    if (variable["tolerance"].is_array()) require_rows(document, at / "tolerance", false, variable["values"]);
  }
  return json;
}

Side result_side(const results::ResultReader& result) {
  const auto read = [&result](const std::string& name) {
    const results::Variable& v = result.variable(name);
    return Numbers{v.dimensions, v.shape, v.values, {}};
  };
  return {result.path(), kinds_of(result), read, result.sample_columns()};
}

// Values of an axis, or a column of a sample, of the reference. A word becomes its code in the result.
std::vector<double> axis_values(const Json& values, const char* axes, const std::string& axis,
                                const std::string& label, const results::ResultReader& result) {
  const std::vector<std::string> words =
      result.has(axis) ? result.flag_meanings(axis) : std::vector<std::string>();
  std::vector<double> out;
  for (const Json& value : values) {
    const auto word = std::ranges::find(words, value.is_string() ? value.get<std::string>() : "");
    if (value.is_string() && word == words.end())
      throw InputError(fmt::format("{}: /{}/{}: the result {} does not know {}; it knows {}", label, axes,
                                   axis, result.path(), value.dump(),
                                   words.empty() ? "no words" : fmt::format("{}", fmt::join(words, ", "))));
    out.push_back(value.is_string() ? double(word - words.begin()) : value.get<double>());
  }
  return out;
}

Side reference_side(const Json& reference, const std::string& label, const results::ResultReader& result) {
  Side side{label, {}, {}};
  std::vector<std::string> axes;
  for (const auto& [name, values] : reference["axes"].items()) axes.push_back(name);
  for (const std::string& name : axes) side.kinds[name] = DatasetKind::coordinate;
  for (const auto& [name, codes] : reference["flags"].items()) side.kinds[name] = DatasetKind::flags;
  for (const auto& [name, variable] : reference["variables"].items()) side.kinds[name] = DatasetKind::real;
  if (reference.contains("sample")) {
    side.sample.emplace();
    for (const auto& [name, values] : reference["sample"].items()) side.sample->push_back(name);
  }
  side.read = [&reference, &result, axes, label](const std::string& name) -> Numbers {
    const std::vector<std::size_t> shape = shape_of(reference);
    const std::size_t length = row_length(shape);
    if (const Json& all = reference["axes"]; all.contains(name))
      return {{name}, {all[name].size()}, axis_values(all[name], "axes", name, label, result), {}};
    if (reference.contains("sample") && reference["sample"].contains(name)) {
      const Json& column = reference["sample"][name];
      return {{experiment::kSample}, {column.size()}, axis_values(column, "sample", name, label, result), {}};
    }
    if (const Json& all = reference["flags"]; all.contains(name))
      return {axes, shape, numbers_of(all[name], length), {}};
    const Json& variable = reference["variables"][name];
    const Json& tolerance = variable["tolerance"];
    return {axes, shape, numbers_of(variable["values"], length),
            tolerance.is_array() ? numbers_of(tolerance, length)
                                 : std::vector<double>(grid_size(shape), tolerance)};
  };
  return side;
}

std::string described(const Json& claim) {
  const std::string reading = claim.value("reading", "");
  return fmt::format("claim {}{} \"{}\"", claim["claim"].get<std::string>(),
                     reading.empty() ? "" : fmt::format(" ({})", reading),
                     claim["statement"].get<std::string>());
}

void compare_claims(const Json& now, const Json& reference, Comparison& out) {
  if (reference.size() != now.size())
    out.failures.push_back(
        fmt::format("different checks: the experiment of the file has {}, the reference {}", now.size(),
                    reference.size()));
  for (std::size_t i = 0; i < std::min(reference.size(), now.size()); ++i) {
    const std::string is = described(now[i]), was = described(reference[i]);
    if (is != was) out.failures.push_back(fmt::format("check {}: {}, in the reference {}", i, is, was));
    else if (now[i]["verdict"] != reference[i]["verdict"])
      out.failures.push_back(fmt::format("{}: {}, was {}", is, now[i]["verdict"].get<std::string>(),
                                         reference[i]["verdict"].get<std::string>()));
  }
}

}  // namespace

Json make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks) {
  Json out = {{"schema", "bristle-reference/1"},
              {"name", result.text("name")},
              {"tier", h5::has_attribute(result.file(), "tier") ? result.text("tier") : "unknown"},
              {"inputs_sha256", result.text("inputs_sha256")},
              {"numerics_version", h5::read_integer_attribute(result.file(), "numerics_version")},
              {"payload_sha256", result.text("payload_sha256")},
              {"commit", commit_of(result)},
              {"claims", claims_json(checks)},
              {"axes", Json::object()},
              {"flags", Json::object()},
              {"variables", Json::object()}};
  const std::vector<std::string> axes = dimensions_of(result);
  for (const std::string& name : axes) out["axes"][name] = axis_json(result, name);
  for (const std::string& name : result.sample_columns()) out["sample"][name] = axis_json(result, name);
  const std::vector<std::size_t> shape = shape_of(out);
  const std::size_t length = row_length(shape);
  for (const auto& [name, kind] : kinds_of(result)) {
    if (kind == DatasetKind::coordinate) continue;
    const results::Variable& v = result.variable(name);
    if (v.dimensions != axes || v.shape != shape)
      throw InputError(
          fmt::format("{}: {}: different shape: ({}) over ({}), but the points are ({}) over ({})",
                      result.path(), name, fmt::join(v.shape, ", "), fmt::join(v.dimensions, ", "),
                      fmt::join(shape, ", "), fmt::join(axes, ", ")));
    if (kind == DatasetKind::flags)
      out["flags"][name] = rows(std::vector<long>(v.values.begin(), v.values.end()), length, {});
    else
      out["variables"][name] = {
          {"values", rows(v.values, length, v.values)},
          {"tolerance", tolerance_json(tolerances_of(result, name, v.values), length, v.values)}};
  }
  return out;
}

Json read_reference(const std::string& path) {
  try {
    return read(path);
  } catch (const InputError& e) {
    throw InputError(
        fmt::format("{}; restore the reference with `git checkout -- {}`, or remove it and write it again "
                    "with `bristle reference update`",
                    e.what(), shell_quoted(path)));
  }
}

std::string reference_path(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".json")).string();
}

Comparison compare_with_reference(const results::ResultReader& result,
                                  const std::vector<claims::CheckResult>& checks, const Json& reference,
                                  const std::string& label) {
  const bool same_inputs = reference["inputs_sha256"] == result.text("inputs_sha256");
  Comparison none;
  none.label = label;
  none.points_in_file = grid_size(result.sweep_shape());
  if (!same_inputs && result.experiment().contains("design")) {
    none.notes.emplace_back(
        "the trials of a design follow from all of its inputs, and those of the reference are others, "
        "such as those of the smoke tier: there are no common points");
    return none;
  }
  if (!same_inputs && !reference.contains("sample") && !result.sample_columns().empty()) {
    none.failures.push_back(fmt::format(
        "{} does not state the rows of its sample, so that those of other inputs cannot be compared with it; "
        "`bristle reference update` writes it again",
        label));
    return none;
  }
  Comparison out = compare_sides(result, result_side(result), reference_side(reference, label, result));
  const long version = h5::read_integer_attribute(result.file(), "numerics_version");
  if (reference["numerics_version"] != version)
    out.notes.push_back(fmt::format("numerics_version is {}, that of the reference is {}", version,
                                    reference["numerics_version"].get<long>()));
  if (!out.subsets.empty()) return out;
  if (!same_inputs)
    out.notes.emplace_back("computed from different inputs than the reference (inputs_sha256)");
  compare_claims(claims_json(checks), reference["claims"], out);
  return out;
}

}  // namespace bristle::compare
