#include "checks/checks.hpp"

#include "experiment/input_error.hpp"
#include "experiment/suggest.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

Measurement measure(const ResultReader& result, const Json& check) {
  const std::string predicate = check["predicate"], variable = check["variable"];
  const Curves along = curves_along(result, variable, check["along"]);
  if (predicate == "trend") return trend(along);
  if (predicate == "end_ratio") return end_ratio(along);
  if (!check.contains("against"))
    throw InputError(
        fmt::format("{}: check of claim {}: range_ratio needs \"against\", the axis to compare with",
                    result.path(), check["claim"].get<std::string>()));
  return range_ratio(along, curves_along(result, variable, check["against"]));
}

Verdict decide(const Measurement& m, double margin) {
  if (!std::isfinite(m.value) || !std::isfinite(m.uncertainty)) return Verdict::undecided;
  if (margin >= m.uncertainty) return Verdict::supported;
  return margin < -m.uncertainty ? Verdict::refuted : Verdict::undecided;
}

// Fixed-length strings, as the other texts of the file.
void write_texts(hid_t group, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string bytes;
  for (std::string text : texts) {
    text.resize(length, '\0');
    bytes += text;
  }
  const h5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "creating a string type");
  h5::check(H5Tset_size(type, length), "sizing a string type");
  h5::check(H5Tset_cset(type, H5T_CSET_UTF8), "choosing UTF-8");
  h5::check(H5Tset_strpad(type, H5T_STR_NULLPAD), "choosing string padding");
  const h5::Handle dataset = h5::create_dataset(group, name, type, {texts.size()});
  h5::write_part(dataset, type, {0}, {texts.size()}, bytes.data());
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::supported: return "supported";
    case Verdict::refuted: return "refuted";
    case Verdict::undecided: return "undecided";
  }
  return "?";
}

void validate_checks(const Experiment& experiment) {
  std::vector<std::string> variables, axes;
  for (const ResultVariable& v : result_variables(experiment)) variables.push_back(v.name);
  for (const Axis& axis : experiment.axes) axes.push_back(axis_variable(axis.name));
  for (std::size_t i = 0; i < experiment.checks.size(); ++i) {
    const Json& check = experiment.checks[i];
    const auto known = [&](const char* key, const std::vector<std::string>& names) {
      const std::string name = check.value(key, "");
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError(fmt::format("{}: /checks/{}/{}: \"{}\" is not in the result{}; allowed: {}",
                                     experiment.path, i, key, name, did_you_mean(name, names),
                                     fmt::join(names, ", ")));
    };
    known("variable", variables);
    known("along", axes);
    if (check["predicate"] == "range_ratio") known("against", axes);
  }
}

std::vector<CheckResult> evaluate_checks(const ResultReader& result) {
  std::vector<CheckResult> out;
  const Json experiment = result.experiment();
  for (const Json& check : experiment.value("checks", Json::array())) {
    CheckResult r;
    r.claim = check["claim"];
    r.statement = check["statement"];
    r.measured = measure(result, check);
    r.at_most = check["is"] == "at_most";
    r.threshold = check.value("threshold", 0.0);
    r.margin = r.at_most ? r.threshold - r.measured.value : r.measured.value - r.threshold;
    r.verdict = decide(r.measured, r.margin);
    out.push_back(r);
  }
  return out;
}

void write_checks(const std::string& path, const std::vector<CheckResult>& checks) {
  h5::Handle file = h5::open_file(path, true);
  if (h5::exists(file, "checks")) h5::check(H5Ldelete(file, "checks", H5P_DEFAULT), "replacing /checks");
  if (!checks.empty()) {
    h5::Handle group = h5::create_group(file, "checks");
    const auto texts = [&](const std::string& name, auto text) {
      std::vector<std::string> all;
      for (const CheckResult& c : checks) all.push_back(text(c));
      write_texts(group, name, all);
    };
    const auto numbers = [&](const std::string& name, auto number) {
      std::vector<double> all;
      for (const CheckResult& c : checks) all.push_back(number(c));
      const h5::Handle dataset = h5::create_dataset(group, name, H5T_NATIVE_DOUBLE, {all.size()});
      h5::write_part(dataset, H5T_NATIVE_DOUBLE, {0}, {all.size()}, all.data());
    };
    texts("claim", [](const CheckResult& c) { return c.claim; });
    texts("statement", [](const CheckResult& c) { return c.statement; });
    texts("is", [](const CheckResult& c) { return std::string(c.at_most ? "at_most" : "at_least"); });
    texts("verdict", [](const CheckResult& c) { return std::string(to_string(c.verdict)); });
    numbers("measured", [](const CheckResult& c) { return c.measured.value; });
    numbers("uncertainty", [](const CheckResult& c) { return c.measured.uncertainty; });
    numbers("threshold", [](const CheckResult& c) { return c.threshold; });
    numbers("margin", [](const CheckResult& c) { return c.margin; });
    group.close("closing /checks");
  }
  file.close("closing " + path);
}

std::string checks_table(const std::vector<CheckResult>& checks) {
  std::string text = fmt::format("{:<5} {:<10} {:>18} {:>14} {:>9}  {}\n", "claim", "verdict", "measured",
                                 "claimed", "margin", "statement");
  for (const CheckResult& c : checks) {
    const std::string measured = fmt::format("{:.3f} +- {:.3f}", c.measured.value, c.measured.uncertainty);
    const std::string claimed = fmt::format("{} {:.3g}", c.at_most ? "at most" : "at least", c.threshold);
    text += fmt::format(
        "{:<5} {:<10} {:>18} {:>14} {:>9.3f}  {}{}\n", c.claim, to_string(c.verdict), measured, claimed,
        c.margin, c.statement,
        c.measured.missing ? fmt::format(" [{} points without a value]", c.measured.missing) : "");
  }
  return text;
}

}  // namespace bristle
