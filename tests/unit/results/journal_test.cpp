#include "experiment/experiment.hpp"
#include "experiment/si_units.hpp"
#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"
#include "shards.hpp"
#include "small_result.hpp"

#include <bit>
#include "catch.hpp"
#include <filesystem>
#include <rapidcheck.h>
#include <set>

namespace bristle::journal_test {
using namespace testing;

namespace {

PointRecord small_record(const Experiment& e, std::size_t i) {
  return record_of(layout_of(e.sweep), small_point(i), {});
}

// Adds the first points of the small experiment to the journal, unless it has them.
void write_journal(const std::string& result, const Experiment& e, std::size_t points) {
  Journal journal(result + ".journal", "0123abc", false);
  for (std::size_t i = 0; i < points; ++i)
    if (!journal.has(point_key(e.sweep, i))) journal.append(point_key(e.sweep, i), small_record(e, i));
}

bool holds(const Journal& journal, const Experiment& e, std::size_t i) {
  const std::string key = point_key(e.sweep, i);
  return journal.has(key) &&
         differences(journal.read(key, layout_of(e.sweep)).record, small_record(e, i)).empty();
}

std::map<std::string, std::string> keys_of(const Experiment& e, const std::vector<std::size_t>& points) {
  std::map<std::string, std::string> keys;
  for (const std::size_t i : points) keys[point_key(e.sweep, i)] = e.sweep.place(i);
  return keys;
}

std::size_t points_in(const Journal& journal, const Experiment& e) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < e.sweep.size(); ++i) n += journal.has(point_key(e.sweep, i));
  return n;
}

}  // namespace

TEST_CASE("a journal line reads back bit for bit with arbitrary numbers") {
  const Scratch s;
  PointRecord record = small_record(small_experiment(s), 0);
  const std::size_t status = record.layout->number("status");
  const std::vector<double> edges = {0.0, -0.0, INFINITY, -INFINITY, kNone, 5e-324, 0.1, 1e308};
  std::copy(edges.begin(), edges.end(), record.values.begin());
  rc::check([&](const std::vector<std::uint64_t>& bits) {
    for (std::size_t i = 0; i < bits.size() && edges.size() + i < status; ++i) {
      const double x = std::bit_cast<double>(bits[i]);
      record.values[edges.size() + i] = std::isnan(x) ? kNone : x;
    }
    const std::string text = encode(std::string(64, 'a'), "c", "node1", record);
    const auto line = decode(std::string_view(text).substr(0, text.size() - 1), record.layout);
    RC_ASSERT(line.has_value());
    RC_ASSERT(differences(line->record, record).empty());
    RC_ASSERT(line->key == std::string(64, 'a') && line->commit == "c" && line->host == "node1");
  });
}

TEST_CASE("journals keep tables and curves, as far as their layout is the same") {
  const Scratch s;
  for (const std::string& more : {kTables, kLattice}) {
    CAPTURE(more);
    const Experiment e = sharded(s, more);
    PointRecord record = invented_record(e, 1);
    record.failure = "a \"b\"\n";
    const std::string text = encode("k", "c", "h", record);
    const std::string_view line = std::string_view(text).substr(0, text.size() - 1);
    REQUIRE(decode(line, record.layout));
    CHECK(differences(decode(line, record.layout)->record, record).empty());
    CHECK(decode(line, record.layout)->record.failure == record.failure);
    CHECK_FALSE(decode(line, layout_of(small_experiment(s).sweep)));
  }
}

TEST_CASE("a line with a correct checksum that the program cannot have written is no point") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const Layout layout = layout_of(e.sweep);
  const auto line_of = [](const std::string& json) { return sha256_of(json) + " " + json; };
  const std::string text = encode("k", "c", "h", small_record(e, 0));
  const std::string whole = text.substr(kDigestLength + 1, text.size() - kDigestLength - 2);
  REQUIRE(decode(line_of(whole), layout));
  for (std::size_t size = 0; size < whole.size(); ++size)
    if (decode(line_of(whole.substr(0, size)), layout)) FAIL(size);
  const std::string values = R"("values":[)", tables = R"("tables":[)";
  for (const auto& [before, after] :
       {std::pair(values, values + "1e999,"), std::pair(values, values + "null,"),
        std::pair(values, values + "inf,"), std::pair(values, values + R"("one",)"),
        std::pair(values, values + "1,"), std::pair(tables, tables + "1"), std::pair(tables, tables + "[]"),
        std::pair(tables, R"("failure":1,)" + tables),
        std::pair(std::string("]}"), std::string(R"(],"failure":1})"))}) {
    CAPTURE(after);
    std::string changed = whole;
    changed.replace(changed.rfind(before), before.size(), after);
    CHECK_FALSE(decode(line_of(changed), layout));
  }
}

TEST_CASE("a journal truncated at any byte of its last record keeps the others and accepts new ones") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const std::string result = s.path("r.h5"), path = result + ".journal";
  write_journal(result, e, 2);
  const auto two = std::filesystem::file_size(path);
  write_journal(result, e, 3);
  const std::string whole = bytes_of(path);
  REQUIRE(whole.size() > two + 500);
  for (std::size_t size = two; size < whole.size(); ++size) {
    s.write("r.h5.journal", whole.substr(0, size));
    Journal journal(result + ".journal", "0123abc", false);
    if (points_in(journal, e) != 2 || !holds(journal, e, 0) || !holds(journal, e, 1)) FAIL(size);
    journal.append(point_key(e.sweep, 2), small_record(e, 2));
    if (bytes_of(path) != whole) FAIL("not repaired: " << size);
  }
}

TEST_CASE("a journal with only a truncated record or zeros after a power cut starts empty") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  write_journal(s.path("r.h5"), e, 1);
  const std::string whole = bytes_of(s.path("r.h5.journal"));
  for (const std::string& left :
       {std::string(), whole.substr(0, 10), whole.substr(0, 300), std::string(4096, '\0')}) {
    s.write("r.h5.journal", left);
    CHECK(points_in(Journal(s.path("r.h5.journal"), "0123abc", false), e) == 0);
    CHECK(bytes_of(s.path("r.h5.journal")).empty());
  }
}

TEST_CASE("a damaged record is ignored, and the others are used") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  write_journal(s.path("r.h5"), e, 3);
  std::string text = bytes_of(s.path("r.h5.journal"));
  const auto second = text.find('\n') + 1, digit = text.find("\"values\":[", second) + 10;
  text[digit] = text[digit] == '1' ? '2' : '1';
  s.write("r.h5.journal", text);
  const Journal journal(s.path("r.h5.journal"), "0123abc", false);
  CHECK(holds(journal, e, 0));
  CHECK(!journal.has(point_key(e.sweep, 1)));
  CHECK(holds(journal, e, 2));
}

TEST_CASE("keys of points contain choices as words, whose codes may change") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const std::string text = e.sweep.key(0);
  for (const char* word : {R"("friction":"nss")", R"("bending":"polar")", R"("engine":"fast")",
                           R"("initial_state":"static_equilibrium")", R"("pole_rule":"reflect")"}) {
    CAPTURE(word, text);
    CHECK(text.find(word) != std::string::npos);
  }
}

TEST_CASE("points computed by a program with uncommitted changes are used by such programs only") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  {
    Journal(s.path("r.h5.journal"), "0123abc-dirty", false).append(point_key(e.sweep, 0), small_record(e, 0));
  }
  { Journal(s.path("r.h5.journal"), "4567def", false).append(point_key(e.sweep, 1), small_record(e, 1)); }
  const auto has = [&](const char* commit, std::size_t i) {
    return Journal(s.path("r.h5.journal"), commit, false).has(point_key(e.sweep, i));
  };
  CHECK(has("0123abc-dirty", 0));
  CHECK(has("unknown", 0));
  CHECK(!has("4567def", 0));
  for (const char* commit : {"4567def", "0123abc-dirty", "unknown"}) CHECK(has(commit, 1));
  Journal other(s.path("other.h5.journal"), "4567def", false);
  other.adopt(s.path("r.h5.journal"), layout_of(e.sweep), keys_of(e, {0, 1}));
  CHECK(points_in(other, e) == 1);
}

TEST_CASE("a journal that another run has locked is refused, and the lock ends with that run") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  {
    const Journal first(s.path("r.h5.journal"), "0123abc", false);
    CHECK_THROWS_WITH(Journal(s.path("r.h5.journal"), "0123abc", false),
                      Catch::Contains("another run is writing it"));
  }
  CHECK_NOTHROW(Journal(s.path("r.h5.journal"), "0123abc", false));
}

TEST_CASE("a file that is not a journal is not changed, and a path that cannot be written is an error") {
  const Scratch s;
  s.write("r.h5.journal", "Dear diary,\n");
  CHECK_THROWS_WITH(Journal(s.path("r.h5.journal"), "0123abc", false), Catch::Contains("not a journal"));
  CHECK(bytes_of(s.path("r.h5.journal")) == "Dear diary,\n");
  CHECK_THROWS_AS(Journal("/proc/nowhere/r.h5.journal", "0123abc", false), InputError);
}

TEST_CASE("a journal of another version is refused with its schema and not changed") {
  const Scratch s;
  const std::string json = R"({"schema":"bristle-journal/9","key":"k","commit":"c"})";
  const std::string text = sha256_of(json) + " " + json + "\n";
  s.write("r.h5.journal", text);
  CHECK_THROWS_WITH(Journal(s.path("r.h5.journal"), "0123abc", false),
                    Catch::Contains("schema bristle-journal/9"));
  CHECK(bytes_of(s.path("r.h5.journal")) == text);
}

TEST_CASE("points of this experiment in another journal are copied") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  write_journal(s.path("other.h5"), e, 4);
  Journal journal(s.path("r.h5.journal"), "0123abc", false);
  journal.adopt(s.path("other.h5.journal"), layout_of(e.sweep), keys_of(e, {0, 2, 5}));
  CHECK(holds(journal, e, 0));
  CHECK(!journal.has(point_key(e.sweep, 1)));
  CHECK(holds(journal, e, 2));
  CHECK(!journal.has(point_key(e.sweep, 5)));
  write_journal(s.path("other.h5"), e, 6);  // it has grown since
  journal.adopt(s.path("other.h5.journal"), layout_of(e.sweep), keys_of(e, {5}));
  CHECK(holds(journal, e, 5));
  const Experiment recorded = small_experiment(s, R"(, "record": ["observables", "bristles"])");
  journal.adopt(s.path("other.h5.journal"), layout_of(recorded.sweep), keys_of(recorded, {0, 1, 2, 3}));
  CHECK(points_in(journal, recorded) == 0);
}

TEST_CASE("of another journal, a damaged line is left out, and a point that differs is an error") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const std::string path = s.path("other.h5.journal");
  write_journal(s.path("other.h5"), e, 2);
  std::string bytes = read_file(path);
  bytes[bytes.size() - 20] ^= 1;
  s.write("other.h5.journal", bytes);
  Journal journal(s.path("r.h5.journal"), "0123abc", false);
  journal.adopt(path, layout_of(e.sweep), keys_of(e, {0, 1}));
  CHECK(holds(journal, e, 0));
  CHECK(!journal.has(point_key(e.sweep, 1)));
  Journal(s.path("third.h5.journal"), "0123abc", false).append(point_key(e.sweep, 0), small_record(e, 1));
  CHECK_THROWS_WITH(journal.adopt(s.path("third.h5.journal"), layout_of(e.sweep), keys_of(e, {0})),
                    Catch::Contains("differ at the point"));
}

TEST_CASE("equal points have equal keys regardless of grid and names") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  Experiment finer = e;
  finer.name = finer.title = "finer";
  finer.sweep.axes[1].values = {0.1, 0.3, 1, 3};
  CHECK(point_key(e.sweep, 0) == point_key(finer.sweep, 1));
  CHECK(point_key(e.sweep, 5) == point_key(finer.sweep, 7));
  std::set<std::string> keys;
  for (std::size_t i = 0; i < finer.sweep.size(); ++i) keys.insert(point_key(finer.sweep, i));
  CHECK(keys.size() == 8);
}

TEST_CASE("every sweepable quantity and every setting changes the key of a point") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const auto one = [&](const std::string& name, double value) {
    Experiment changed = e;
    changed.sweep.axes = {{name, {value}}};
    changed.sweep.C_peaks_at_V_s = false;
    return point_key(changed.sweep, 0);
  };
  const auto in_si = [](const std::string& name) {
    const auto& all = si_quantities();
    return std::any_of(all.begin(), all.end(), [&](const SiQuantity& q) { return q.name == name; });
  };
  for (const Sweepable& sweepable : sweepables()) {
    CAPTURE(sweepable.name);
    if (sweepable.name == "z_0" || in_si(sweepable.name))
      continue;  // changed below, together with their prerequisites
    CHECK(one(sweepable.name, 1) != one(sweepable.name, 0));
  }
  const auto one_in_si = [&](const std::string& name, double value) {
    Experiment changed = e;
    changed.sweep.axes = {{name, {value}}};
    changed.sweep.base.si = {{"m_kg", 1}, {"r0_m", 1}, {"V0_m_per_s", 1},
                             {"E_Pa", 1}, {"nu", 0.1}, {"R_m", 1}};
    changed.sweep.base.si["k_r_over_k_phi"] = 1;
    return point_key(changed.sweep, 0);
  };
  for (const SiQuantity& q : si_quantities()) {
    CAPTURE(q.name);
    CHECK(one_in_si(q.name, 0.3) != one_in_si(q.name, 0.2));
  }
  for (const char* change : {R"("load": {"R_n": null, "z_0": 0.5})", R"("load": {"R_n": 1.5})",
                             R"("orientation": {"rtol": 0.5})", R"("orientation": {"full_circle": true})",
                             R"("integrator": {"rtol": 1e-3})", R"("integrator": {"engine": "reference"})",
                             R"("integrator": {"max_evaluations": 1000})", R"("record": ["bristles"])"}) {
    CAPTURE(change);
    CHECK(point_key(small_experiment(s, std::string(", ") + change).sweep, 0) != point_key(e.sweep, 0));
  }
}

}  // namespace bristle::journal_test
