#pragma once

#include "claims/checks.hpp"

#include <array>

namespace bristle::compare {

// A variable at all points in row-major order, with the parts of its tolerance: a value may change by the sum
// of the parts (derived in docs/reference.md). NaN: the point has no value.
struct ReferenceVariable {
  std::string name;
  std::vector<double> values;
  std::vector<double> quadrature, load_control, integrator, libm;
  std::string misfit;  // difference between the variable's dimensions and those of the sweep; empty if equal

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

// Codes at all points, compared exactly.
struct ReferenceFlags {
  std::string name;
  std::vector<long> values;
  std::string misfit;
};

struct ReferenceClaim {
  std::string claim, reading, statement, verdict;
};

// The numbers and verdicts of an experiment that later results are compared with.
struct Reference {
  std::string name, tier, inputs_sha256, payload_sha256, commit;
  long numerics_version = 0;
  std::vector<experiment::Axis> axes;  // in the order of the dimensions, named as in the result file
  std::vector<ReferenceVariable> variables;
  std::vector<ReferenceFlags> flags;
  std::vector<ReferenceClaim> claims;

  std::vector<std::size_t> shape() const;
  std::size_t points() const;
};

// The reference made from a result file and its verdicts. Errors are omitted because they become tolerances,
// and counts such as passages because they are cost, not result.
Reference make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks);

}  // namespace bristle::compare
