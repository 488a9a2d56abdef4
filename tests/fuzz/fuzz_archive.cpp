#include "fuzz.hpp"

#include "archive/citation.hpp"
#include "archive/crate.hpp"
#include "archive/result_facts.hpp"
#include "archive/safe_json.hpp"
#include "archive/verify.hpp"
#include "results/hdf5.hpp"

// The first byte tells what the others are: a tar, a citation, metadata, a bag's manifest or HDF5.
using namespace bristle;
using namespace bristle::testing;

namespace {

void crate_of(const std::string& text) {
  const Files files{{"data/results/small.h5", "x"}, {"data/README.md", "y"}};
  const std::map<std::string, Json> facts{{"data/results/small.h5", {{"provenance", {{"commit", "c"}}}}}};
  check_crate(safe_json(text), files, {{"version", "1"}, {"license", "MIT"}}, facts);
}

void bag_of(const std::string& text) {
  Files bag = make_bag("f", {{"a", "x"}}, {{"Draft", "no"}});
  bag["f/manifest-sha512.txt"] = bag["f/bag-info.txt"] = text;
  strip_folder(bag);
  check_bag(bag);
  printable(bag_info(bag, "Draft"));
}

void read_as(char kind, const std::string& bytes) {
  static const Scratch s;
  switch (kind) {
    case 'c': check_citation(parse_citation(bytes)); return;
    case 'j': crate_of(bytes); return;
    case 'b': bag_of(bytes); return;
    case 'h': checked_result_facts(bytes); return;  // in a process of its own: HDF5 does not survive all
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
