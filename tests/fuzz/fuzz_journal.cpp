#include "fuzz.hpp"

#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

// Reads the bytes as a journal, and as the JSON of a line with a matching checksum.
using namespace bristle;
using namespace bristle::testing;

namespace {

void open_journal(const Scratch& s, const std::string& bytes) {
  s.write("fuzz.h5.journal", bytes);
  try {
    Journal journal(s.path("fuzz.h5.journal"), "0123abc", false);
    journal.append("key", {{{"R_n", {2}}}, {}, {}});
    require(journal.read("key").record.values.at("R_n").at(0) == 2);
  } catch (const InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch s;
  const std::string bytes = text_of(data, size), line = sha256_of(bytes) + " " + bytes;
  open_journal(s, bytes);
  open_journal(s, line + "\n");
  // A line that can be read must not change when it is written and read again.
  if (const auto read = decode(line)) {
    const std::string text = encode(*read);
    const auto again = decode(std::string_view(text).substr(0, text.size() - 1));
    require(again && encode(*again) == text);
  }
  return 0;
}
