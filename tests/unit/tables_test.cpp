// The tables of parameters, choices, SI quantities, words and predicates agree with the experiment schema and
// with experiments/paper.json.
#include "claims/measure.hpp"
#include "experiment/author_schema.hpp"
#include "experiment/canonical.hpp"
#include "experiment/parameters_table.hpp"
#include "experiment/schema.hpp"
#include "experiment/si_units.hpp"
#include "experiment/words.hpp"
#include "model/friction/laws.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::tables_test {
using namespace testing;

namespace {

const std::string kPaper = std::string(BRISTLE_EXPERIMENTS) + "/paper.json";

using Names = std::set<std::string>;

Json schema_at(const std::string& pointer) {
  static const Json schema = Json::parse(experiment::experiment_schema());
  return schema.at(JsonPointer(pointer));
}

Names words_in(const Json& list) { return list.get<Names>(); }

Names keys_in(const Json& object) {
  Names keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

template <class Table>
Names names_in(const Table& table) {
  Names names;
  for (const auto& entry : table) names.insert(entry.name);
  return names;
}

// The schema's description may add a unit or a remark to that of the table.
void check_description(const Json& schema, const std::string& description) {
  CHECK_FALSE(description.empty());
  CHECK_THAT(schema["description"].get<std::string>(), Catch::StartsWith(description));
}

void check_number(const Json& schema) {
  const Json& number = schema.contains("anyOf") ? schema["anyOf"][0] : schema;
  CHECK(number["type"] == "number");
  CHECK((number.contains("minimum") || number.contains("exclusiveMinimum") || number.contains("maximum")));
}

template <class Enum>
void check_words(const std::string& pointer) {
  CAPTURE(pointer);
  const auto& list = experiment::words<Enum>();
  CHECK(words_in(schema_at(pointer)["enum"]) == Names(list.begin(), list.end()));
}

}  // namespace

TEST_CASE("every key of the schema's model block is a parameter or a choice, and the reverse") {
  const Json model = schema_at("/definitions/model/properties");
  Names names = names_in(experiment::parameters_table());
  names.merge(names_in(experiment::choices_table()));
  CHECK(keys_in(model) == names);
  for (const ParameterEntry& entry : parameters_table()) {
    CAPTURE(entry.name);
    check_number(model[entry.name]);
    check_description(model[entry.name], entry.description);
  }
  for (const Choice& choice : choices_table()) {
    CAPTURE(choice.name);
    CHECK(words_in(model[choice.name]["enum"]) == Names(choice.options.begin(), choice.options.end()));
    check_description(model[choice.name], choice.description);
  }
}

TEST_CASE("every key of the schema's si block is an SI quantity, and the reverse") {
  const Json si = schema_at("/definitions/si/properties");
  CHECK(keys_in(si) == names_in(experiment::si_quantities()));
  for (const SiQuantity& q : si_quantities()) {
    CAPTURE(q.name);
    check_number(si[q.name]);
    check_description(si[q.name], q.description);
    CHECK((!q.scale || q.replaces.size() == 1));
    for (const char* name : q.replaces) CHECK(find_sweepable(name) != nullptr);
  }
}

TEST_CASE("the words of choices are those of the schema") {
  check_words<Distribution>("/properties/orientation/properties/distribution");
  check_words<Sampling>("/properties/orientation/properties/sampling");
  check_words<LoadPath>("/properties/load/properties/path");
  check_words<Engine>("/properties/integrator/properties/engine");
}

TEST_CASE("the predicates are those of the schema") {
  CHECK(words_in(schema_at("/definitions/check/properties/predicate/enum")) ==
        names_in(claims::predicates()));
}

TEST_CASE("paper.json states every parameter and choice, with the default values of the program") {
  // pole_rule came later: stating it would change inputs_sha256 of every experiment that extends paper.json.
  const Names left_at_default = {"pole_rule"};
  const Experiment paper = experiment::load_experiment(kPaper, {});
  Names names = keys_in((*paper.document)["model"]);
  names.insert(left_at_default.begin(), left_at_default.end());
  CHECK(names == keys_in(schema_at("/definitions/model/properties")));
  const Parameters stated = paper.point(0).setup.parameters, defaults;
  for (const ParameterEntry& entry : parameters_table()) {
    CAPTURE(entry.name);
    CHECK(stated.*entry.member ==
          Approx(defaults.*entry.member).epsilon(1e-4));  // C is rounded in Parameters
  }
  for (const Choice& choice : choices_table()) {
    CAPTURE(choice.name);
    CHECK(choice.get(stated) == choice.get(defaults));
  }
}

TEST_CASE("the defaults in the schema for editors are those of the program") {
  const Json blocks = experiment::author_schema()["definitions"];
  int found = 0;
  const auto check = [&](const JsonPointer& block, const Json& properties,
                         const std::vector<std::string>& set) {
    for (const auto& [key, property] : properties.items()) {
      if (!property.contains("default") || key == "friction") continue;  // which must be stated
      const Json standard = property["default"];
      const auto with = [&set, &standard, at = (block / key).to_string()](const Json& value) {
        // The key exists in any case, so that null removes it.
        experiment::DocumentOptions options{set, "full"};
        for (const Json& one : {standard, value}) options.set.push_back(at + "=" + one.dump());
        return canonical_point(experiment::load_experiment(kPaper, options), 0);
      };
      CAPTURE((block / key).to_string());
      CHECK(with(nullptr) == with(standard));
      ++found;
    }
  };
  for (const char* block : {"model", "load", "orientation", "integrator"})
    check(JsonPointer() / block, blocks[block]["properties"], {});
  check(JsonPointer("/load/trace"), blocks["load"]["properties"]["trace"]["properties"],
        {R"(/load={"R_n":null,"path":null,"trace":{"to":0.1}})"});
  CHECK(found >= 31);
}

TEST_CASE("a point's canonical text, of which journals store the digest, holds words instead of positions") {
  const Experiment paper = experiment::load_experiment(kPaper, {});
  const auto text_after = [&](const auto& change) {
    Experiment changed = paper;
    change(changed);
    return canonical_point(changed, 0);
  };
  const auto has = [](const char* key, const std::string& word) {
    return Catch::Contains("\"" + std::string(key) + "\":\"" + word + "\"");
  };
  for (const Choice& choice : choices_table())
    for (std::size_t i = 0; i < choice.options.size(); ++i)
      CHECK_THAT(text_after([&](Experiment& e) { choice.set(e.base.setup.parameters, int(i)); }),
                 has(choice.name, choice.options[i]));
  for (const std::string& word : experiment::words<Distribution>())
    CHECK_THAT(text_after([&](Experiment& e) {
                 e.base.setup.orientation.distribution = experiment::from_word<Distribution>(word);
               }),
               has("distribution", word));
  for (const std::string& word : experiment::words<Sampling>())
    CHECK_THAT(text_after([&](Experiment& e) {
                 e.base.setup.orientation.sampling = experiment::from_word<Sampling>(word);
               }),
               has("sampling", word));
  for (const std::string& word : experiment::words<LoadPath>())
    CHECK_THAT(
        text_after([&](Experiment& e) { e.base.loading.path = experiment::from_word<LoadPath>(word); }),
        has("path", word));
  for (const std::string& word : experiment::words<Engine>())
    CHECK_THAT(text_after([&](Experiment& e) { e.engine = experiment::from_word<Engine>(word); }),
               has("engine", word));
  for (const std::string& word : experiment::words<Method>())
    CHECK_THAT(text_after([&](Experiment& e) {
                 e.base.setup.integrator.method = experiment::from_word<Method>(word);
               }),
               has("method", word));
  // Whatever the order of the enumerations, these words belong to these values.
  CHECK_THAT(text_after([](Experiment& e) { e.base.setup.parameters.friction = FrictionLaw::coulomb; }),
             has("friction", "coulomb"));
  CHECK_THAT(text_after([](Experiment& e) { e.base.setup.parameters.pole_rule = PoleRule::cross; }),
             has("pole_rule", "cross"));
}

}  // namespace bristle::tables_test
