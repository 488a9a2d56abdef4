#include "fuzz.hpp"

#include "archive/citation.hpp"
#include "archive/contents.hpp"
#include "archive/result_facts.hpp"
#include "archive/verify.hpp"
#include "results/hdf5.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

// The first byte selects how the others are read: as a tar, a citation, an experiment, the manifest of a bag
// or HDF5.
using namespace bristle;
using namespace bristle::testing;

namespace {

void bag_of(const std::string& text) {
  Files bag = make_bag({{"a", "x"}}, {{"Draft", "no"}});
  bag["manifest-sha512.txt"] = bag["bag-info.txt"] = text;
  check_manifests(bag);
  printable(bag_info(bag, "Draft"));
}

void read_as(char kind, const std::string& bytes) {
  static const Scratch s;
  switch (kind) {
    case 'c': citation_text(dataset_citation(parse_citation(bytes), "c")); return;
    case 'j': experiment_chain({{"experiments/a.json", bytes}}, "experiments/a.json"); return;
    case 'b': bag_of(bytes); return;
    case 'h': checked_result_facts(bytes); return;  // in a child process, because HDF5 may crash
    default: verify_archive(s.write("fuzz.tar", bytes));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  h5::silence();
  if (size == 0) return 0;
  try {
    read_as(char(data[0]), text_of(data + 1, size - 1));
  } catch (const MalformedError&) {
  }
  return 0;
}
