#pragma once

#include "assumptions/alternative.hpp"
#include "claims/checks.hpp"
#include "util/file.hpp"

#include <string>
#include <vector>

namespace bristle::assumptions {

constexpr const char* kMatrixSchema = "bristle-assumptions/4";

// Result of one check under one alternative.
struct Cell {
  claims::CheckResult result;
  // False if the alternative does not change this experiment: the result is then the result of the baseline.
  bool affected = true;
};

// Every check of every experiment under every alternative; the first alternative is the baseline.
struct Matrix {
  struct Row {
    std::string experiment;
    std::vector<Cell> cells;  // by alternative
  };
  std::string tier, inputs_sha256;
  std::vector<std::string> only;  // the experiments that were chosen; empty: all
  std::vector<Alternative> alternatives;
  std::vector<Row> rows;
};

// Returns the conclusion about the check of a row: "robust" if no alternative changes the verdict, "weakened"
// if some leave it undecided, "assumption-dependent" if some reverse it, "open" if the baseline does not
// decide it.
const char* conclusion(const Matrix& matrix, const Matrix::Row& row);

// Returns the kind of file that a matrix may replace: matrices of any version.
FileKind replaceable_by_matrix();

// Returns the document that `bristle assumptions` writes (docs/experiments.md). NaN is null.
Json matrix_json(const Matrix& matrix);

// Returns the SHA-256 of the checks, alternatives, cells and conclusions of the document of a matrix. Throws
// Json::exception for another document.
std::string matrix_payload_sha256(const Json& document);

}  // namespace bristle::assumptions
