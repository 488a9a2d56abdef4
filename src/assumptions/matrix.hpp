#pragma once

#include "assumptions/alternative.hpp"
#include "claims/checks.hpp"
#include "util/file.hpp"

#include <string>
#include <vector>

namespace bristle::assumptions {

constexpr const char* kMatrixSchema = "bristle-assumptions/3";

// Result of one check under one alternative.
struct Cell {
  claims::CheckResult result;
  // False if the alternative does not change this experiment: then the result is that of the baseline.
  bool affected = true;
};

// Every check of every experiment under every alternative; the first alternative is the baseline.
struct Matrix {
  struct Row {
    std::string experiment;
    std::vector<Cell> cells;  // by alternative, then by window
  };
  std::string tier, inputs_sha256;
  std::vector<std::string> only;  // the experiments that were chosen; empty: all
  std::vector<Alternative> alternatives;
  std::vector<Window> windows;
  std::vector<Row> rows;
};

// The conclusion about a claim: "robust" if no alternative changes the verdict, "weakened" if some leave it
// undecided, "assumption-dependent" if some reverse it, "open" if the baseline does not decide it. If there
// are windows, the verdicts are those of the first.
const char* conclusion(const Matrix& matrix, const Matrix::Row& row);

// The files that a matrix may replace: matrices of any version.
FileKind replaceable_by_matrix();

// The document that `bristle assumptions` writes (docs/experiments.md). NaN is null.
Json matrix_json(const Matrix& matrix);

// SHA-256 of the checks, alternatives, cells and conclusions of such a document. Throws Json::exception if it
// is none.
std::string matrix_payload_sha256(const Json& document);

}  // namespace bristle::assumptions
