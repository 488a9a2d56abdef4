#include "json/mismatches.hpp"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace bristle::json {

Mismatches mismatches(const Json& schema, const Json& value) {
  using Plain = nlohmann::json;  // the type that valijson's adapter requires
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const Plain plain_schema = schema, plain_value = value;
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(Adapter(plain_schema), parsed);
  valijson::ValidationResults results;
  valijson::Validator().validate(parsed, Adapter(plain_value), &results);
  Mismatches found;
  for (valijson::ValidationResults::Error error; results.popError(error);) found.push_back(error.context);
  return found;
}

}  // namespace bristle::json
