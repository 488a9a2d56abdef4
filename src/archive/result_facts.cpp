#include "archive/result_facts.hpp"

#include "archive/plain_hdf5.hpp"
#include "checks/checks.hpp"
#include "results/digest.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/process.hpp"
#include "util/sha.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

void require(bool condition, const std::string& what) {
  if (!condition) throw MalformedError(what);
}

void check_digests(const results::ResultReader& result) {
  const std::string document = result.text("experiment");
  const Json experiment = parse_untrusted(document);
  require(sha256_of(document) == result.text("experiment_sha256"),
          "its experiment does not match the attribute experiment_sha256");
  require(experiment.is_object() && results::inputs_sha256(experiment) == result.text("inputs_sha256"),
          "its experiment does not match the attribute inputs_sha256");
  const std::string actual = results::payload_sha256(result.file()), stored = result.text("payload_sha256");
  require(actual == stored, fmt::format("its numbers have the digest {}..., not the {}... of payload_sha256",
                                        actual.substr(0, 16), stored.substr(0, 16)));
}

}  // namespace

Json parse_untrusted(const std::string& text) {
  try {
    return parse_json(text);
  } catch (const InputError& e) {
    throw MalformedError(e.what());
  }
}

Json result_facts(const results::ResultReader& result) {
  const results::Variable status = result.variable("status");
  Json facts;
  for (const char* name : {"name", "title", "figure", "tier", "payload_sha256"})
    facts[name] = result.text(name);
  facts["numerics_version"] = h5::read_number_attribute(result.file(), "numerics_version");
  facts["points"] = long(status.values.size()) -
                    std::count(status.values.begin(), status.values.end(), double(PointStatus::absent));
  facts["sweep_points"] = grid_size(result.sweep_shape());
  facts["provenance"] = Json(result.provenance());
  facts["checks"] = Json::array();
  for (const checks::CheckResult& check : checks::evaluate_checks(result))
    facts["checks"].push_back({{"claim", check.check.claim},
                               {"statement", check.check.statement},
                               {"verdict", checks::to_string(check.verdict)}});
  return facts;
}

Json checked_result_facts(const std::string& bytes) {
  const TemporaryFile file(bytes);
  try {
    return parse_untrusted(run_isolated([&] {
      require_plain_hdf5(file.path(), bytes.size());
      const results::ResultReader result(file.path());
      check_digests(result);
      return result_facts(result).dump();
    }));
  } catch (const MalformedError& e) {
    throw MalformedError(replace_all(e.what(), file.path(), "the file"));
  }
}

}  // namespace bristle::archive
