#include "compare/reference.hpp"

#include "results/datasets.hpp"
#include "util/grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::compare {
namespace {

// The relative error of a mean due to the integrator is below 6 rtol (docs/numerics.md, gamma_2 at 1e-5). The
// larger factor allows for points that are harder than the three measured there.
constexpr double kIntegrator = 10;
// Allowance for a different libm (measured in docs/reference.md): last bits, amplified along a trajectory,
// relative to the size of the variable; and, as the quadrature or the load search may decide differently, the
// estimated error once more, or three times for the pinned bristles' variables, whose accuracy is not
// controlled.
constexpr double kLibm = 1e-8;
double decision_factor(const std::string& name) { return name.rfind("pinned_", 0) == 0 ? 3 : 1; }

bool has_suffix(const std::string& text, const std::string& suffix) {
  return text.size() > suffix.size() && text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

// Largest absolute value of the variable, to which the parts are relative: a value near zero is not more
// accurate than its neighbours.
double scale_of(const std::vector<double>& values) {
  double scale = 0;
  for (const double v : values)
    if (std::isfinite(v)) scale = std::max(scale, std::abs(v));
  return scale;
}

// Values of an error variable; zero if the variable is missing or not finite.
std::vector<double> errors_of(const results::ResultReader& result, const std::string& name,
                              std::size_t size) {
  std::vector<double> values(size, 0);
  if (!result.has(name)) return values;
  const auto stored = result.variable(name).values;
  for (std::size_t i = 0; i < std::min(size, stored.size()); ++i)
    if (std::isfinite(stored[i])) values[i] = stored[i];
  return values;
}

std::string misfit(const results::Variable& v, const std::vector<std::string>& axes,
                   const std::vector<std::size_t>& shape) {
  if (v.dimensions == axes && v.shape == shape) return "";
  return fmt::format("different shape: ({}) over ({}), but the sweep is ({}) over ({})",
                     fmt::join(v.shape, ", "), fmt::join(v.dimensions, ", "), fmt::join(shape, ", "),
                     fmt::join(axes, ", "));
}

void add_to(std::vector<double>& values, double what) {
  for (double& value : values) value += what;
}

// Allowed deviation of R_n from the target load, orientation.rtol times the target; 0 without a load search.
double search_error(const results::ResultReader& result) {
  const Json experiment = result.experiment();
  if (!result.has("load_error")) return 0;
  double largest = experiment["load"].value("R_n", 0.0);
  if (result.has("R_n_target"))
    for (const double target : result.variable("R_n_target").values) largest = std::max(largest, target);
  return experiment["orientation"].value("rtol", 0.0) * largest;
}

ReferenceVariable make_variable(const results::ResultReader& result, const std::string& name,
                                const std::vector<double>& values, double rtol, const std::string& misfit) {
  ReferenceVariable out{name, values, {}, {}, {}, {}, misfit};
  const std::size_t size = out.values.size();
  const double scale = scale_of(out.values);
  out.quadrature = errors_of(result, name + "_err", size);
  out.load_control.assign(size, 0);
  if (result.has("load_error")) out.load_control = errors_of(result, "load_error/" + name, size);
  // energy_residual is itself an error of the integrator.
  out.integrator.assign(size, (name == "energy_residual" ? 1 : kIntegrator * rtol) * scale);
  out.libm.assign(size, kLibm * scale);
  if (name == "R_n") add_to(out.load_control, search_error(result));
  for (std::size_t i = 0; i < size; ++i) {
    const double load_error = name == "R_n" ? 0 : out.load_control[i];  // not included in R_n_err
    out.quadrature[i] = std::max(0.0, out.quadrature[i] - load_error);
    out.libm[i] += decision_factor(name) * (out.quadrature[i] + out.load_control[i]);
    if (std::isfinite(out.values[i])) continue;
    for (const TolerancePart& part : kToleranceParts) (out.*part.values)[i] = 0;
  }
  return out;
}

// Dimensions of the points: those of the variable status, including nodes; those of the sweep if a damaged
// file has no status.
std::vector<std::string> dimensions_of(const results::ResultReader& result) {
  return result.has("status") ? result.variable("status").dimensions : result.axes();
}

// Commit of the program that computed the points; a list of commits if several programs did.
std::string commit_of(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  for (const char* name : {"points_commits", "commit"})
    if (const auto found = provenance.find(name); found != provenance.end()) return found->second;
  return "unknown";
}

}  // namespace

double ReferenceVariable::tolerance(std::size_t point) const {
  double sum = 0;
  for (const TolerancePart& part : kToleranceParts) sum += (this->*part.values)[point];
  return sum;
}

std::vector<std::size_t> Reference::shape() const {
  std::vector<std::size_t> s;
  for (const experiment::Axis& axis : axes) s.push_back(axis.values.size());
  return s;
}

std::size_t Reference::points() const { return grid_size(shape()); }

Reference make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks) {
  const Json experiment = result.experiment();
  Reference out;
  out.name = result.text("name");
  out.tier = h5::has_attribute(result.file(), "tier") ? result.text("tier") : "unknown";
  out.inputs_sha256 = result.text("inputs_sha256");
  out.payload_sha256 = result.text("payload_sha256");
  out.commit = commit_of(result);
  out.numerics_version = h5::read_integer_attribute(result.file(), "numerics_version");
  const std::vector<std::string> axes = dimensions_of(result);
  for (const std::string& name : axes) out.axes.push_back({name, result.variable(name).values});
  const double rtol = experiment["integrator"]["rtol"];
  for (const std::string& name : numeric_datasets(result)) {
    const results::DatasetKind kind = results::kind_of(result, name);
    const bool coordinate =
        kind == results::DatasetKind::coordinate || std::count(axes.begin(), axes.end(), name) > 0;
    if (coordinate || kind == results::DatasetKind::integer || has_suffix(name, "_err") ||
        name.find('/') != std::string::npos)
      continue;
    const results::Variable v = result.variable(name);
    const std::string wrong = misfit(v, axes, out.shape());
    if (kind == results::DatasetKind::real)
      out.variables.push_back(make_variable(result, name, v.values, rtol, wrong));
    else out.flags.push_back({name, std::vector<long>(v.values.begin(), v.values.end()), wrong});
  }
  for (const claims::CheckResult& c : checks)
    out.claims.push_back({c.check.claim, c.check.reading, c.check.statement, claims::to_string(c.verdict)});
  return out;
}

}  // namespace bristle::compare
