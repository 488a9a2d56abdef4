#pragma once

#include "checks/checks.hpp"

#include <array>

namespace bristle {

// A quantity over the points, row-major, the last axis fastest, with what its value leaves open: a change
// within the sum of the parts is none. docs/reference.md derives them. NaN: the point has no value.
struct ReferenceVariable {
  std::string name;
  std::vector<double> values;
  std::vector<double> quadrature, load_control, integrator, libm;
  std::string misfit;  // why the values are not over the sweep's axes; empty where they are

  double tolerance(std::size_t point) const;
};

struct TolerancePart {
  const char* name;
  std::vector<double> ReferenceVariable::*values;
};
inline constexpr std::array<TolerancePart, 4> kToleranceParts = {{
    {"quadrature", &ReferenceVariable::quadrature},
    {"load_control", &ReferenceVariable::load_control},
    {"integrator", &ReferenceVariable::integrator},
    {"libm", &ReferenceVariable::libm},
}};

// Codes over the points, compared exactly.
struct ReferenceFlags {
  std::string name;
  std::vector<long> values;
  std::string misfit;
};

struct ReferenceClaim {
  std::string claim, statement, verdict;
};

// The numbers of an experiment that a later program is held against.
struct Reference {
  std::string name, tier, inputs_sha256, payload_sha256, commit;
  long numerics_version = 0;
  std::vector<Axis> axes;  // in the order of the dimensions, named as in the result file
  std::vector<ReferenceVariable> variables;
  std::vector<ReferenceFlags> flags;
  std::vector<ReferenceClaim> claims;

  std::vector<std::size_t> shape() const;
  std::size_t points() const;
};

// What a result file with these verdicts would be as a reference. Left out: errors (they are the tolerance),
// axes, and counts without meanings such as passages, which are cost, not result.
Reference make_reference(const ResultReader& result, const std::vector<CheckResult>& checks);

}  // namespace bristle
