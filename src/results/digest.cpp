#include "results/digest.hpp"

#include "util/sha.hpp"

#include <nlohmann/json.hpp>

namespace bristle::results {

nlohmann::json without_trials(const Json& document) {
  nlohmann::json out = document;
  if (!document.contains("design") || !document.contains("sweep")) return out;
  out["sweep"].erase("sample");
  if (out["sweep"].empty()) out.erase("sweep");
  return out;
}

std::string inputs_sha256(const Json& document) {
  nlohmann::json inputs = without_trials(document);
  for (const char* name : {"name", "title", "figure", "institution", "notes", "checks", "checks_for_each"})
    inputs.erase(name);
  // The order of the axes matters, because it is the order of the dimensions.
  nlohmann::json axes = nlohmann::json::array();
  if (document.contains("sweep"))
    for (const auto& [name, axis] : document["sweep"].items()) axes.push_back(name);
  inputs["axes"] = axes;
  if (document.contains("design")) std::erase(inputs["axes"].get_ref<nlohmann::json::array_t&>(), "sample");
  if (inputs.contains("sweep") && inputs["sweep"].empty()) inputs.erase("sweep");
  return sha256_of(inputs.dump());
}

}  // namespace bristle::results
