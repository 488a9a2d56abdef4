#include "assumptions/matrix.hpp"

#include "run/provenance.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

bool contrary(Verdict a, Verdict b) { return a != b && a != Verdict::undecided && b != Verdict::undecided; }

Json check_json(const Matrix::Row& row) {
  const CheckResult& c = row.cells.front().check;
  return {{"experiment", row.experiment}, {"claim", row.claim},    {"statement", row.statement}, {"is", c.is},
          {"threshold", c.threshold},     {"band", number(c.band)}};
}

Json cell_json(std::size_t check, std::size_t alternative, const Cell& cell) {
  const CheckResult& c = cell.check;
  return {{"check", check},
          {"alternative", alternative},
          {"verdict", to_string(c.verdict)},
          {"measured", number(c.measured.value)},
          {"uncertainty", number(c.measured.uncertainty)},
          {"margin", number(c.margin)},
          {"missing", c.measured.missing},
          {"affected", cell.affected}};
}

// The alternatives under which the verdict is another, by name.
Json conclusion_json(const Matrix& matrix, std::size_t index) {
  const Matrix::Row& row = matrix.rows[index];
  const Verdict settled = row.cells.front().check.verdict;
  Json decided = Json::array(), undecided = Json::array(), choices = Json::array();
  for (std::size_t a = 1; a < row.cells.size(); ++a) {
    const Verdict verdict = row.cells[a].check.verdict;
    if (verdict == settled) continue;
    const Alternative& alternative = matrix.alternatives[a];
    (verdict == Verdict::undecided ? undecided : decided).push_back(alternative.name);
    if (std::find(choices.begin(), choices.end(), alternative.choice) == choices.end())
      choices.push_back(alternative.choice);
  }
  return {{"check", index},
          {"settled", to_string(settled)},
          {"conclusion", conclusion(row)},
          {"hangs_on", choices},
          {"other", decided},
          {"undecided", undecided}};
}

}  // namespace

const char* conclusion(const Matrix::Row& row) {
  const Verdict settled = row.cells.front().check.verdict;
  if (settled == Verdict::undecided) return "open";
  const char* out = "robust";
  for (const Cell& cell : row.cells) {
    if (contrary(cell.check.verdict, settled)) return "hangs";
    if (cell.check.verdict != settled) out = "weakened";
  }
  return out;
}

Json matrix_json(const Matrix& matrix) {
  Json out = {{"schema", kMatrixSchema},
              {"tier", matrix.tier},
              {"program", {{"version", kVersion}, {"commit", kCommit}}},
              {"checks", Json::array()},
              {"alternatives", Json::array()},
              {"cells", Json::array()},
              {"conclusions", Json::array()}};
  for (const Alternative& a : matrix.alternatives)
    out["alternatives"].push_back(
        {{"name", a.name}, {"choice", a.choice}, {"description", a.description}, {"members", a.members}});
  for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
    out["checks"].push_back(check_json(matrix.rows[i]));
    for (std::size_t a = 0; a < matrix.rows[i].cells.size(); ++a)
      out["cells"].push_back(cell_json(i, a, matrix.rows[i].cells[a]));
    out["conclusions"].push_back(conclusion_json(matrix, i));
  }
  return out;
}

}  // namespace bristle
