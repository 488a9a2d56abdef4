#include "fuzz.hpp"

#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"
#include "unit/small_result.hpp"

// Reads the bytes as a journal, and as the JSON of a line with a matching checksum.
using namespace bristle;
using namespace bristle::testing;

namespace {

const PointRecord& record() {
  static const Scratch s;
  static const PointRecord record = record_of(layout_of(small_experiment(s).sweep), small_point(0), {});
  return record;
}

void open_journal(const Scratch& s, const std::string& bytes) {
  s.write("fuzz.h5.journal", bytes);
  try {
    Journal journal(s.path("fuzz.h5.journal"), "0123abc", false);
    journal.append("key", record());
    require(differences(journal.read("key", record().layout).record, record()).empty());
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
  if (const auto read = decode(line, record().layout)) {
    const std::string text = encode(read->key, read->commit, read->host, read->record);
    const auto again = decode(std::string_view(text).substr(0, text.size() - 1), record().layout);
    require(again && differences(again->record, read->record).empty());
  }
  return 0;
}
