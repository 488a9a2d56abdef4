#include "assumptions/matrix.hpp"

#include "results/version.hpp"
#include "run/provenance.hpp"
#include "util/sha.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::assumptions {
namespace {

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

// Returns true if one verdict is supported and the other refuted.
bool reversed(Verdict a, Verdict b) { return a != b && a != Verdict::undecided && b != Verdict::undecided; }

Json check_json(const Matrix::Row& row) {
  const claims::Check& c = row.cells.front().result.check;
  return {{"experiment", row.experiment},
          {"claim", c.claim},
          {"role", c.main ? "main" : "further"},
          {"statement", c.statement},
          {"is", word(c.criterion)},
          {"threshold", c.threshold},
          {"band", number(c.band.value_or(NAN))}};
}

// What is stored of each cell, in this order.
const std::vector<std::string> kCellKeys = {"claim_verdict", "verdict", "measured",
                                            "uncertainty",   "margin",  "missing"};

// Returns the values of kCellKeys; null if the alternative does not change the experiment, so that the cell
// repeats the cell of the baseline.
Json cell_json(const Cell& cell) {
  const claims::CheckResult& c = cell.result;
  if (!cell.affected) return nullptr;
  return {word(c.claim_verdict),    word(c.verdict),  number(c.measured.value),
          number(c.measured.error), number(c.margin), c.measured.missing};
}

// Returns the cells of a document, each with its place and with the names of its values.
Json named_cells(const Json& document) {
  Json out = Json::array();
  const Json& keys = document.at("cell_keys");
  for (const Json& row : document.at("cells")) {
    const Json& under = row.at("under");
    for (std::size_t i = 0; i < under.size(); ++i) {
      Json one = {{"check", row.at("check")}, {"alternative", i}};
      const Json& cell = under[i].is_null() ? under.at(0) : under[i];
      for (std::size_t k = 0; k < keys.size(); ++k) one[keys[k].get<std::string>()] = cell.at(k);
      one["affected"] = !under[i].is_null();
      out.push_back(one);
    }
  }
  return out;
}

Verdict verdict_under(const Matrix::Row& row, std::size_t alternative) {
  return row.cells[alternative].result.verdict;
}

// Returns the conclusion about one check, with the names of the alternatives that change its verdict.
Json conclusion_json(const Matrix& matrix, std::size_t index) {
  const Matrix::Row& row = matrix.rows[index];
  const Verdict baseline = verdict_under(row, 0);
  Json reversing = Json::array(), undecided = Json::array(), choices = Json::array();
  for (std::size_t a = 1; a < matrix.alternatives.size(); ++a) {
    const Verdict verdict = verdict_under(row, a);
    if (verdict == baseline) continue;
    const Alternative& alternative = matrix.alternatives[a];
    (verdict == Verdict::undecided ? undecided : reversing).push_back(alternative.name);
    if (std::find(choices.begin(), choices.end(), alternative.choice) == choices.end())
      choices.push_back(alternative.choice);
  }
  return {{"check", index},        {"baseline", word(baseline)}, {"conclusion", conclusion(matrix, row)},
          {"depends_on", choices}, {"other", reversing},         {"undecided", undecided}};
}

}  // namespace

const char* conclusion(const Matrix& matrix, const Matrix::Row& row) {
  const Verdict baseline = verdict_under(row, 0);
  if (baseline == Verdict::undecided) return "open";
  const char* out = "robust";
  for (std::size_t a = 1; a < matrix.alternatives.size(); ++a) {
    const Verdict verdict = verdict_under(row, a);
    if (reversed(verdict, baseline)) return "assumption-dependent";
    if (verdict != baseline) out = "weakened";
  }
  return out;
}

FileKind replaceable_by_matrix() { return {"a matrix of assumptions", "{", {"\"bristle-assumptions/"}}; }

Json matrix_json(const Matrix& matrix) {
  Json out = {{"schema", kMatrixSchema},
              {"tier", matrix.tier},
              {"only", matrix.only},
              {"numerics_version", results::kNumericsVersion},
              {"inputs_sha256", matrix.inputs_sha256},
              {"payload_sha256", ""},
              {"program", {{"version", run::kVersion}, {"commit", run::kCommit}}},
              {"checks", Json::array()},
              {"alternatives", Json::array()},
              {"cell_keys", kCellKeys},
              {"cells", Json::array()},
              {"conclusions", Json::array()}};
  for (const Alternative& a : matrix.alternatives)
    out["alternatives"].push_back(
        {{"name", a.name}, {"choice", a.choice}, {"description", a.description}, {"members", a.members}});
  for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
    out["checks"].push_back(check_json(matrix.rows[i]));
    Json under = Json::array();  // by alternative
    for (const Cell& cell : matrix.rows[i].cells) under.push_back(cell_json(cell));
    out["cells"].push_back({{"check", i}, {"under", under}});
    out["conclusions"].push_back(conclusion_json(matrix, i));
  }
  out["payload_sha256"] = matrix_payload_sha256(out);
  return out;
}

std::string matrix_payload_sha256(const Json& document) {
  std::string text;
  for (const char* key : {"checks", "alternatives", "cells", "conclusions"})
    text += (key == std::string("cells") ? named_cells(document) : document.at(key)).dump() + "\n";
  return sha256_of(text);
}

}  // namespace bristle::assumptions
