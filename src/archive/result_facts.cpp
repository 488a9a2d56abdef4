#include "archive/result_facts.hpp"

#include "util/isolated.hpp"
#include "archive/plain_hdf5.hpp"
#include "archive/safe_json.hpp"
#include "archive/tar.hpp"
#include "checks/checks.hpp"
#include "util/sha.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace bristle {
namespace {

Json provenance_of(hid_t file) {
  Json out = Json::object();
  if (!h5::exists(file, "provenance")) return out;
  const h5::Handle group(H5Gopen2(file, "provenance", H5P_DEFAULT), H5Gclose, "opening /provenance");
  for (const std::string& name : h5::attribute_names(group)) out[name] = h5::read_text_attribute(group, name);
  return out;
}

void require(bool sound, const std::string& what) {
  if (!sound) throw BadArchive(what);
}

void check_digests(const ResultReader& result) {
  const std::string document = result.text("experiment");
  const Json experiment = safe_json(document);
  require(sha256_of(document) == result.text("experiment_sha256"),
          "its experiment is not that of the attribute experiment_sha256");
  require(experiment.is_object() && inputs_sha256(experiment) == result.text("inputs_sha256"),
          "its experiment is not that of the attribute inputs_sha256");
  const std::string is = payload_sha256(result.file()), told = result.text("payload_sha256");
  require(is == told, fmt::format("its numbers have the digest {}..., not the {}... of payload_sha256",
                                  is.substr(0, 16), told.substr(0, 16)));
}

// Of the axes: a traced curve counts once, whatever its nodes.
std::size_t sweep_points(const ResultReader& result) {
  const Variable status = result.variable("status");
  std::size_t points = 1;
  for (std::size_t d = 0; d < status.shape.size(); ++d)
    if (status.dimensions[d] != "node") points *= status.shape[d];
  return points;
}

}  // namespace

Json result_facts(const ResultReader& result) {
  const Variable status = result.variable("status");
  Json facts;
  for (const char* name : {"name", "title", "figure", "tier", "payload_sha256"})
    facts[name] = result.text(name);
  facts["numerics_version"] = h5::read_number_attribute(result.file(), "numerics_version");
  facts["points"] = long(status.values.size()) -
                    std::count(status.values.begin(), status.values.end(), double(PointStatus::absent));
  facts["sweep_points"] = sweep_points(result);
  facts["provenance"] = provenance_of(result.file());
  facts["checks"] = Json::array();
  for (const CheckResult& check : evaluate_checks(result))
    facts["checks"].push_back(
        {{"claim", check.claim}, {"statement", check.statement}, {"verdict", to_string(check.verdict)}});
  return facts;
}

Json checked_result_facts(const std::string& bytes) {
  const TemporaryFile file(bytes);
  try {
    return safe_json(isolated([&] {
      require_plain_hdf5(file.path(), bytes.size());
      const ResultReader result(file.path());
      check_digests(result);
      return result_facts(result).dump();
    }));
  } catch (const BadArchive& e) {
    throw BadArchive(without_path(e.what(), file.path()));
  }
}

std::string without_path(std::string text, const std::string& path) {
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path))
    text.replace(at, path.size(), "the file");
  return text;
}

}  // namespace bristle
