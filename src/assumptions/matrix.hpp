#pragma once

#include "checks/checks.hpp"
#include "assumptions/assumption.hpp"

#include <string>
#include <vector>

namespace bristle {

constexpr const char* kMatrixSchema = "bristle-assumptions/1";

// One check of a claim under one alternative.
struct Cell {
  CheckResult check;
  bool affected =
      true;  // false: the alternative leaves this experiment as it is, and the numbers are the settled ones
};

// Every check of every experiment under every alternative; the first is the settled one.
struct Matrix {
  struct Row {
    std::string experiment, claim, statement;
    std::vector<Cell> cells;  // one for each alternative
  };
  std::string tier;
  std::vector<Alternative> alternatives;
  std::vector<Row> rows;
};

// What a row says: "robust" if no alternative changes the verdict, "weakened" if some leave it undecided,
// "hangs" if some reverse it, "open" if the settled assumptions do not decide it.
const char* conclusion(const Matrix::Row& row);

// schema, tier, program, checks, alternatives, cells, conclusions: docs/assumptions.md has an account of it.
// NaN is null.
Json matrix_json(const Matrix& matrix);

}  // namespace bristle
