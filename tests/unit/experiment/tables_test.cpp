// What follows from the tables of parameters, choices, SI quantities and words.
#include "claims/measure.hpp"
#include "experiment/experiment.hpp"
#include "experiment/schema.hpp"
#include "experiment/si_units.hpp"
#include "bristle/model/friction/laws.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <nlohmann/json.hpp>

namespace bristle::tables_test {
using namespace testing;

namespace {

const std::string kPaper = std::string(BRISTLE_EXPERIMENTS) + "/paper.json";

}  // namespace

TEST_CASE("the schema has every parameter, choice and SI quantity, with limits and description") {
  const Json& definitions = experiment::experiment_schema().root()["definitions"];
  const Json& model = definitions["model"]["properties"];
  CHECK(model.size() == kParameters.size() + choices().size());
  for (const Parameter& one : kParameters) {
    CAPTURE(one.name);
    const Json& number = one.word ? model[one.name]["anyOf"][0] : model[one.name];
    CHECK((number.contains("minimum") || number.contains("exclusiveMinimum")));
    CHECK_THAT(model[one.name]["description"].get<std::string>(), Catch::StartsWith(one.description));
  }
  CHECK(model["phi_0_deg"]["exclusiveMaximum"] == 90);
  CHECK(model["A"]["minimum"] == 1);
  CHECK(definitions["si"]["properties"]["nu"]["maximum"] == 0.5);
  for (const SiQuantity& q : sweep::si_quantities()) {
    CAPTURE(q.name);
    CHECK(definitions["si"]["properties"].contains(q.name));
    CHECK((!q.scale || q.replaces.size() == 1));
    for (const char* name : q.replaces) CHECK(find_sweepable(name) != nullptr);
  }
}

TEST_CASE("the values that paper.json states are the defaults of the program") {
  const Experiment paper = experiment::load_experiment(kPaper, {});
  const Parameters stated = paper.sweep.point(0).setup.parameters, defaults;
  for (const Parameter& one : kParameters) {
    CAPTURE(one.name);
    CHECK(stated.*one.member == Approx(defaults.*one.member).epsilon(1e-4));  // C is rounded in Parameters
  }
  for (const Choice& choice : choices()) {
    CAPTURE(choice.name);
    CHECK(choice.get(stated) == choice.get(defaults));
  }
}

TEST_CASE("the defaults in the schema for editors are those of the program") {
  const Json blocks = experiment::author_schema(claims::predicate_names())["definitions"];
  int found = 0;
  const auto check = [&](const JsonPointer& block, const Json& properties,
                         const std::vector<std::string>& set) {
    for (const auto& [key, property] : properties.items()) {
      if (!property.contains("default") || key == "friction") continue;  // which must be stated
      const Json standard = property["default"];
      const auto with = [&set, &standard, at = (block / key).to_string()](const Json& value) {
        // The key exists in any case, so that null removes it.
        json::DocumentOptions options{set, "full"};
        for (const Json& one : {standard, value}) options.set.push_back(at + "=" + one.dump());
        return experiment::load_experiment(kPaper, options).sweep.key(0);
      };
      CAPTURE((block / key).to_string());
      CHECK(with(nullptr) == with(standard));
      ++found;
    }
  };
  for (const char* block : {"model", "load", "orientation", "integrator"})
    check(JsonPointer() / block, blocks[block]["properties"], {});
  CHECK(found >= 29);
}

TEST_CASE("a point's canonical text, of which journals store the digest, holds words instead of positions") {
  const Experiment paper = experiment::load_experiment(kPaper, {});
  const auto text_after = [&](const auto& change) {
    Experiment changed = paper;
    change(changed);
    return changed.sweep.key(0);
  };
  const auto has = [](const char* key, const std::string& word) {
    return Catch::Contains("\"" + std::string(key) + "\":\"" + word + "\"");
  };
  for (const Choice& choice : choices())
    for (std::size_t i = 0; i < choice.words.size(); ++i)
      CHECK_THAT(text_after([&](Experiment& e) { choice.set(e.sweep.base.setup.parameters, int(i)); }),
                 has(choice.name, choice.words[i]));
  for (const std::string word : words<Distribution>())
    CHECK_THAT(text_after([&](Experiment& e) {
                 e.sweep.base.setup.orientation.distribution = from_word<Distribution>(word);
               }),
               has("distribution", word));
  for (const std::string word : words<Sampling>())
    CHECK_THAT(text_after([&](Experiment& e) {
                 e.sweep.base.setup.orientation.sampling = from_word<Sampling>(word);
               }),
               has("sampling", word));
  for (const std::string word : words<LoadPath>())
    CHECK_THAT(text_after([&](Experiment& e) { e.sweep.base.loading.path = from_word<LoadPath>(word); }),
               has("path", word));
  for (const std::string word : words<Engine>())
    CHECK_THAT(text_after([&](Experiment& e) { e.sweep.engine = from_word<Engine>(word); }),
               has("engine", word));
  for (const std::string word : words<Method>())
    CHECK_THAT(
        text_after([&](Experiment& e) { e.sweep.base.setup.integrator.method = from_word<Method>(word); }),
        has("method", word));
  // Whatever the order of the enumerations, these words belong to these values.
  CHECK_THAT(text_after([](Experiment& e) { e.sweep.base.setup.parameters.friction = FrictionLaw::coulomb; }),
             has("friction", "coulomb"));
  CHECK_THAT(text_after([](Experiment& e) { e.sweep.base.setup.parameters.pole_rule = PoleRule::cross; }),
             has("pole_rule", "cross"));
}

}  // namespace bristle::tables_test
