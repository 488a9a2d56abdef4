#include "compare/deviation.hpp"

#include "compare/comparison.hpp"
#include "results/datasets.hpp"
#include "util/grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::compare {
namespace {

std::string names(const std::vector<experiment::Axis>& axes) {
  std::vector<std::string> out;
  for (const experiment::Axis& axis : axes) out.push_back(axis.name);
  return out.empty() ? "none" : fmt::format("{}", fmt::join(out, ", "));
}

// Index in the file of each value of an axis of the reference.
std::vector<std::size_t> match_axis(const experiment::Axis& reference, const experiment::Axis& now,
                                    DeviationReport& report) {
  std::vector<std::size_t> at;
  for (const double value : reference.values) {
    const auto found = std::find(now.values.begin(), now.values.end(), value);
    if (found == now.values.end())
      report.failures.push_back(
          fmt::format("axis {}: {} = {} of the reference is not among the {} values of the file", now.name,
                      now.name, value, now.values.size()));
    at.push_back(std::size_t(found - now.values.begin()));
  }
  return at;
}

// Index in the file of each point of the reference. Reports missing points as failures.
std::vector<std::size_t> match_points(const Reference& reference, const Reference& now,
                                      DeviationReport& report) {
  if (names(reference.axes) != names(now.axes)) {
    report.failures.push_back(fmt::format("different axes: the file has {}, the reference has {}",
                                          names(now.axes), names(reference.axes)));
    return {};
  }
  std::vector<std::vector<std::size_t>> matched;
  for (std::size_t d = 0; d < reference.axes.size(); ++d)
    matched.push_back(match_axis(reference.axes[d], now.axes[d], report));
  std::vector<std::size_t> points;
  if (!report.failures.empty()) return points;
  for (std::size_t p = 0; p < reference.points(); ++p) {
    auto at = unravel(p, reference.shape());
    for (std::size_t d = 0; d < at.size(); ++d) at[d] = matched[d][at[d]];
    points.push_back(ravel(at, now.shape()));
  }
  return points;
}

// Compares quantities of the same name. Reports as failures quantities that only one side has or that do not
// have the dimensions of the sweep.
template <class Quantity, class Compare>
void compare_by_name(const std::vector<Quantity>& reference, const std::vector<Quantity>& now,
                     DeviationReport& report, Compare compare) {
  const auto find = [](const std::vector<Quantity>& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  };
  for (const Quantity& r : reference) {
    const auto n = find(now, r.name);
    if (n == now.end()) report.failures.push_back(fmt::format("{}: missing in the file", r.name));
    else if (!n->misfit.empty()) report.failures.push_back(fmt::format("{}: {}", r.name, n->misfit));
    else compare(r, *n);
  }
  for (const Quantity& n : now)
    if (find(reference, n.name) == reference.end())
      report.failures.push_back(fmt::format("{}: not in the reference", n.name));
}

void compare_variable(const ReferenceVariable& r, const ReferenceVariable& n,
                      const std::vector<std::size_t>& points, DeviationReport& report) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double a = r.values[p], b = n.values[points[p]];
    ++report.values;
    if (!results::same_bits(a, b))
      report.deviations.push_back({r.name, points[p], a, b, in_tolerances(a, b, r.tolerance(p))});
  }
}

void compare_flags(const ReferenceFlags& r, const ReferenceFlags& n, const std::vector<std::size_t>& points,
                   DeviationReport& report) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const long a = r.values[p], b = n.values[points[p]];
    ++report.values;
    if (a != b) report.deviations.push_back({r.name, points[p], double(a), double(b), INFINITY});
  }
}

std::string described(const ReferenceClaim& c) {
  const std::string reading = c.reading.empty() ? "" : fmt::format(" ({})", c.reading);
  return fmt::format("claim {}{} \"{}\"", c.claim, reading, c.statement);
}

// Requires equal sets of points, because verdicts may depend on them.
void compare_claims(const Reference& reference, const Reference& now, DeviationReport& report) {
  if (reference.claims.size() != now.claims.size())
    report.failures.push_back(
        fmt::format("different checks: the experiment of the file has {}, the reference {}",
                    now.claims.size(), reference.claims.size()));
  for (std::size_t i = 0; i < std::min(reference.claims.size(), now.claims.size()); ++i) {
    const ReferenceClaim &r = reference.claims[i], &n = now.claims[i];
    if (r.claim != n.claim || r.reading != n.reading || r.statement != n.statement)
      report.failures.push_back(
          fmt::format("check {}: {}, in the reference {}", i, described(n), described(r)));
    else if (r.verdict != n.verdict)
      report.failures.push_back(fmt::format("{}: {}, was {}", described(n), n.verdict, r.verdict));
  }
}

void note_other_origin(const Reference& reference, const Reference& now, DeviationReport& report) {
  if (reference.numerics_version != now.numerics_version)
    report.notes.push_back(fmt::format("numerics_version is {}, that of the reference is {}",
                                       now.numerics_version, reference.numerics_version));
  if (report.points == report.points_in_file && reference.inputs_sha256 != now.inputs_sha256)
    report.notes.emplace_back("computed from different inputs than the reference (inputs_sha256)");
}

}  // namespace

std::size_t DeviationReport::above(double tolerances) const {
  return std::size_t(std::count_if(deviations.begin(), deviations.end(),
                                   [=](const Deviation& d) { return d.tolerances > tolerances; }));
}

DeviationReport compare_with_reference(const Reference& reference, const Reference& now) {
  DeviationReport report;
  report.points_in_file = now.points();
  const auto points = match_points(reference, now, report);
  if (points.empty()) return report;
  report.points = points.size();
  note_other_origin(reference, now, report);
  compare_by_name(reference.variables, now.variables, report,
                  [&](const auto& r, const auto& n) { compare_variable(r, n, points, report); });
  compare_by_name(reference.flags, now.flags, report,
                  [&](const auto& r, const auto& n) { compare_flags(r, n, points, report); });
  if (report.points == report.points_in_file) compare_claims(reference, now, report);
  std::stable_sort(report.deviations.begin(), report.deviations.end(),
                   [](const Deviation& a, const Deviation& b) { return a.tolerances > b.tolerances; });
  return report;
}

}  // namespace bristle::compare
