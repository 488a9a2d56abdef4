#include "compare/reference.hpp"

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
namespace {

using results::Array;
using results::Number;

// Allowance of the tolerance for an error of the integrator, in units of rtol. The estimated errors of means
// include the integrator's error (docs/generated/accuracy.md has up to 60 rtol); the allowance is for
// variables without an estimate.
constexpr double kIntegrator = 10;

// Returns the dimensions of the points: the dimensions of the variable status, or the dimensions of
// the sweep if a damaged file has no status.
std::vector<std::string> dimensions_of(const results::ResultReader& result) {
  return result.has("status") ? result.variable("status").dimensions : result.axes();
}

// Returns the names of the variables that a reference has: codes and real numbers. Leaves out the parameters
// of a sample, because the numbers of its points stand for them.
std::vector<std::string> variables_of(const results::ResultReader& result) {
  const std::vector<std::string> axes = dimensions_of(result), parameters = result.sample_columns();
  std::vector<std::string> out;
  for (const std::string& name : result.variables()) {
    if (std::ranges::count(parameters, name) > 0 || std::ranges::count(axes, name) > 0 ||
        name.ends_with("_err"))
      continue;
    const Array& array = result.variable(name);
    if (!array.coordinate && array.about.number != Number::integer) out.push_back(name);
  }
  return out;
}

// Returns the estimated error of each value; 0 if there is none. Adds the allowed distance of the load from
// its target, orientation.rtol, which the error of R_n does not include.
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
      for (const double value : result.variable("R_n_target").values) target = std::max(target, value);
    distance = experiment.value(JsonPointer("/orientation/rtol"), 0.0) * target;
  }
  for (double& error : errors) error = (std::isfinite(error) ? error : 0) + distance;
  return errors;
}

// Returns x rounded down to two digits, by its text: "1.2" and "e-05" of 1.2345e-05. Returns at most the
// largest finite number, because JSON has no infinity, and 0 below the smallest normal number.
double rounded_down(double x) {
  using Limits = std::numeric_limits<double>;
  if (!(x >= Limits::min())) return 0;
  const std::string text = fmt::format("{:.17e}", std::min(x, Limits::max()));
  return *number_in(text.substr(0, 3) + text.substr(text.find('e')));
}

// Returns the tolerance of each value: twice the estimated error, because both runs may be off by it, and an
// allowance for the integrator. The allowance is relative to the largest value of the variable, because a
// value near zero is not more accurate than its neighbours. energy_residual is itself an error of the
// integrator.
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

Json claims_json(const std::vector<claims::CheckResult>& checks) {
  Json out = Json::array();
  for (const claims::CheckResult& c : checks)
    out.push_back({{"claim", c.check.claim},
                   {"reading", c.check.reading},
                   {"verdict", word(c.verdict)},
                   {"statement", c.check.statement}});
  return out;
}

// Returns the commit of the program that computed the points; a list of commits if several programs did.
std::string commit_of(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  for (const char* name : {"points_commits", "commit"})
    if (const auto found = provenance.find(name); found != provenance.end()) return found->second;
  return "unknown";
}

// Returns an axis, or a column of a sample, with the codes that its words have in the result.
Array with_codes_of(const results::ResultReader& result, Array array, const char* kind,
                    const std::string& label) {
  if (array.about.words.empty()) return array;
  const std::string& name = array.about.name;
  const std::vector<std::string> words =
      result.has(name) ? result.variable(name).about.words : std::vector<std::string>();
  for (double& value : array.values) {
    const std::string word = array.text(value);
    const auto found = std::ranges::find(words, word);
    if (found == words.end())
      throw InputError(fmt::format("{}: /{}/{}: the result {} does not know {}; it knows {}", label, kind,
                                   name, result.path(), Json(word).dump(),
                                   words.empty() ? "no words" : fmt::format("{}", fmt::join(words, ", "))));
    value = double(found - words.begin());
  }
  array.about.words = words;
  return array;
}

Side result_side(const results::ResultReader& result) {
  Side side{result.path()};
  for (const std::string& name : dimensions_of(result))
    if (result.has(name)) side.arrays[name] = &result.variable(name);
  for (const std::string& name : variables_of(result)) side.arrays[name] = &result.variable(name);
  side.sample.emplace();
  for (const std::string& name : result.sample_columns()) side.sample->push_back(&result.variable(name));
  return side;
}

// Returns a reference as one side of a comparison. own: storage for the arrays that the side does not take
// from the reference as they are
Side reference_side(const Reference& reference, const std::string& label, const results::ResultReader& result,
                    std::vector<Array>& own) {
  Side side{label};
  own.reserve(reference.numbers.dimensions().size() + (reference.sample ? reference.sample->size() : 0));
  for (const Array& axis : reference.numbers.dimensions())
    side.arrays[axis.about.name] = &own.emplace_back(with_codes_of(result, axis, "axes", label));
  for (const Array& array : reference.numbers.arrays()) side.arrays[array.about.name] = &array;
  for (const auto& [name, tolerance] : reference.tolerances) side.tolerances[name] = &tolerance;
  if (!reference.sample) return side;
  side.sample.emplace();
  for (const Array& column : *reference.sample)
    side.sample->push_back(&own.emplace_back(with_codes_of(result, column, "sample", label)));
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

Reference make_reference(const results::ResultReader& result,
                         const std::vector<claims::CheckResult>& checks) {
  Reference out;
  out.about = {{"schema", "bristle-reference/1"},
               {"name", result.text("name")},
               {"tier", result.has_text("tier") ? result.text("tier") : "unknown"},
               {"inputs_sha256", result.text("inputs_sha256")},
               {"numerics_version", result.integer("numerics_version")},
               {"payload_sha256", result.text("payload_sha256")},
               {"commit", commit_of(result)},
               {"claims", claims_json(checks)}};
  const std::vector<std::string> axes = dimensions_of(result);
  for (const std::string& name : axes) out.numbers.add_dimension(result.variable(name));
  const std::vector<std::size_t> shape = out.numbers.shape();
  for (const std::string& name : variables_of(result)) {
    const Array& array = result.variable(name);
    if (array.dimensions != axes || array.shape != shape)
      throw InputError(
          fmt::format("{}: {}: different shape: ({}) over ({}), but the points are ({}) over ({})",
                      result.path(), name, fmt::join(array.shape, ", "), fmt::join(array.dimensions, ", "),
                      fmt::join(shape, ", "), fmt::join(axes, ", ")));
    out.numbers.add(array);
    if (array.about.number == Number::real) out.tolerances[name] = tolerances_of(result, name, array.values);
  }
  if (const auto columns = result.sample_columns(); !columns.empty()) {
    out.sample.emplace();
    for (const std::string& name : columns) out.sample->push_back(result.variable(name));
  }
  return out;
}

std::string reference_path(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".json")).string();
}

Comparison compare_with_reference(const results::ResultReader& result,
                                  const std::vector<claims::CheckResult>& checks, const Reference& reference,
                                  const std::string& label) {
  const bool same_inputs = reference.text("inputs_sha256") == result.text("inputs_sha256");
  Comparison none;
  none.label = label;
  none.points_in_file = grid_size(result.sweep_shape());
  if (!same_inputs && result.experiment().contains("design")) {
    none.notes.emplace_back(
        "the trials of a design follow from all of its inputs, and the reference has other inputs, "
        "such as the inputs of the smoke tier: there are no common points");
    return none;
  }
  if (!same_inputs && !reference.sample && !result.sample_columns().empty()) {
    none.failures.push_back(fmt::format(
        "{} does not state the rows of its sample, so that rows of other inputs cannot be compared with it; "
        "`bristle reference update` writes it again",
        label));
    return none;
  }
  std::vector<Array> own;
  Comparison out = compare_sides(result, result_side(result), reference_side(reference, label, result, own));
  const long version = result.integer("numerics_version"), before = reference.about.at("numerics_version");
  if (before != version)
    out.notes.push_back(fmt::format("numerics_version is {}, in the reference it is {}", version, before));
  if (!out.subsets.empty()) return out;
  if (!same_inputs)
    out.notes.emplace_back("computed from different inputs than the reference (inputs_sha256)");
  compare_claims(claims_json(checks), reference.about.at("claims"), out);
  return out;
}

}  // namespace bristle::compare
