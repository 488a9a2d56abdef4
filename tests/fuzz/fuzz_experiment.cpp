#include "fuzz.hpp"

#include "claims/checks.hpp"
#include "experiment/experiment.hpp"
#include "util/error.hpp"

// Reads the bytes as an experiment file: only an experiment or an InputError may result.
using namespace bristle;
using namespace bristle::testing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch s;
  static const std::string parent =
      s.write("experiments/paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  const std::string path = s.write("experiments/fuzz.json", text_of(data, size));
  try {
    const Experiment experiment = load_experiment(path, {});
    validate_checks(experiment);
    // The document as stored in a result must read as the same experiment.
    require(stored_experiment(*experiment.document, experiment.tier, path).sweep.size() ==
            experiment.sweep.size());
  } catch (const InputError&) {
  }
  return 0;
}
