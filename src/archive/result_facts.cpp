#include "archive/result_facts.hpp"

#include "assumptions/matrix.hpp"
#include "claims/checks.hpp"
#include "results/digest.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/process.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

// Evaluating the checks of a result takes milliseconds, once it has been inspected.
constexpr Limits kFactsLimits{60, std::size_t(2) << 30};

void require(bool condition, const std::string& what) {
  if (!condition) throw MalformedError(what);
}

void check_digests(const results::ResultReader& result) {
  require(result.damage().empty(), fmt::format("{}", fmt::join(result.damage(), "; ")));
  const Json experiment = parse_untrusted(result.raw_text("experiment"));
  require(experiment.is_object() && results::inputs_sha256(experiment) == result.text("inputs_sha256"),
          "its experiment does not match the attribute inputs_sha256");
}

}  // namespace

Json parse_untrusted(const std::string& text) {
  try {
    return parse_json(text);
  } catch (const InputError& e) {
    throw MalformedError(e.what());
  }
}

namespace {

// Returns each claim with the statement of its first main check and the verdict under each reading.
Json claims_of(const std::vector<claims::CheckResult>& checks) {
  Json claims = Json::array();
  for (const claims::ClaimVerdict& one : claims::claim_verdicts(checks)) {
    const auto known =
        std::ranges::find_if(claims, [&](const Json& claim) { return claim["claim"] == one.claim; });
    Json& claim = known == claims.end() ? claims.emplace_back() : *known;
    claim["claim"] = one.claim;
    claim["verdicts"][one.reading] = word(one.verdict);
    const auto first = std::ranges::find_if(
        checks, [&](const auto& c) { return c.check.claim == one.claim && c.check.main; });
    claim["statement"] = first == checks.end() ? "" : first->check.statement;
  }
  return claims;
}

}  // namespace

Json result_facts(const results::ResultReader& result) {
  const results::Array& status = result.variable("status");
  Json facts;
  for (const char* name : {"name", "title", "figure", "tier", "payload_sha256"})
    facts[name] = result.text(name);
  facts["numerics_version"] = result.integer("numerics_version");
  facts["points"] = status.values.size();
  facts["provenance"] = Json(result.provenance());
  facts["claims"] = claims_of(claims::evaluate_checks(result));
  return facts;
}

Json checked_result_facts(const std::string& bytes) {
  const auto facts = [&] {
    const results::ResultReader result("the file", bytes);
    check_digests(result);
    return result_facts(result).dump();
  };
  return parse_untrusted(run_isolated(facts, kFactsLimits));
}

Json checked_matrix_facts(const std::string& bytes) {
  const auto facts = [&] {
    const Json matrix = parse_untrusted(bytes);
    require(matrix.is_object() && matrix.value("schema", Json()) == assumptions::kMatrixSchema,
            fmt::format("not a matrix of the schema {}", assumptions::kMatrixSchema));
    for (const char* key : {"numerics_version", "inputs_sha256", "payload_sha256"})
      require(matrix.contains(key), fmt::format("lacks {}: it was written by an earlier version", key));
    try {
      require(matrix["payload_sha256"] == assumptions::matrix_payload_sha256(matrix),
              "payload_sha256 DOES NOT MATCH the content");
    } catch (const Json::exception& e) {
      throw MalformedError(fmt::format("not a matrix: {}", json_error(e.what())));
    }
    Json out;
    for (const char* key : {"numerics_version", "inputs_sha256", "payload_sha256", "tier", "only", "program"})
      out[key] = matrix.value(key, Json());
    return out.dump();
  };
  return parse_untrusted(run_isolated(facts, kFactsLimits));
}

}  // namespace bristle::archive
