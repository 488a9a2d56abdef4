#include "shards.hpp"

#include "catch.hpp"
#include "generators.hpp"

namespace bristle::shards_test {
using namespace testing;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// What stands at the output before: enough to be taken for a result, which a run may replace.
const std::string kOldResult = "\x89HDF\r\n\x1a\n bristle-result/1";

// The message with which the completion of small/r.h5 is refused. It must not write anything.
std::string refusal(const Scratch& s, const Experiment& e, const std::vector<std::string>& arguments = {}) {
  s.write("small/r.h5", kOldResult);
  std::string message = "(nothing)";
  try {
    run_experiment(e, {.output = s.path("small/r.h5"),
                       .complete = true,
                       .threads = 1,
                       .quiet = true,
                       .arguments = arguments});
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK(bytes_of(s.path("small/r.h5")) == kOldResult);
  CHECK_FALSE(fs::exists(s.path("small/r.h5.partial")));
  return message;
}

void check_holds(const std::string& text, const std::vector<std::string>& all) {
  for (const std::string& one : all) CHECK_THAT(text, Contains(one));
}

}  // namespace

TEST_CASE("shards distribute all points, each once") {
  for (std::size_t points = 0; points < 12; ++points)
    for (std::size_t count = 1; count < 15; ++count) {
      std::vector<int> times(points, 0);
      for (std::size_t i = 1; i <= count; ++i)
        for (const std::size_t p : shard_points(Shard{i, count}, points)) ++times.at(p);
      CHECK(times == std::vector<int>(points, 1));
    }
  CHECK(shard_points({}, 3) == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("an invalid shard is refused with what is allowed") {
  CHECK(shard_text(parse_shard("3/3")) == "3/3");
  for (const char* text : {"", "/", "3", "a/b", "1/", "/2", "1/0", "-1/2", "1.0/2", " 1/2", "1/2/3", "1/2 "})
    CHECK_THROWS_WITH(parse_shard(text), Contains("such as 2/8"));
  for (const char* text : {"1/1000000000", "5/18446744073709551614"})
    CHECK_THROWS_WITH(parse_shard(text), Contains("more than 999999999 shards"));
  for (const char* text : {"0/3", "4/3"})
    CHECK_THROWS_WITH(parse_shard(text), Contains("shards are numbered 1/3 to 3/3"));
}

TEST_CASE("each shard of a result has a journal of its own, which is found by its name") {
  const Scratch s;
  const std::string result = s.path("r.h5");
  CHECK(journal_path(result, {}) == result + ".journal");
  for (const char* name :
       {"r.h5.journal", "r.h5.2-of-13.journal", "r.h5.12-of-13.journal", "r.h5.a-of-3.journal",
        "other.h5.1-of-3.journal", "r.h5.1-of-3.log", "r.h5.0-of-3.journal"})
    s.write(name, "");
  std::vector<std::string> found;
  for (const auto& [shard, path] : shard_journals(result)) {
    CHECK(path == journal_path(result, shard));
    found.push_back(shard_text(shard));
  }
  CHECK(found == std::vector<std::string>{"12/13", "2/13"});
}

TEST_CASE("the command of another shard, or of the completion, is that of the run with another option") {
  CHECK(command_with({"bristle", "run", "x.json", "--shard", "2/5", "-o", "r.h5"}, "--complete") ==
        "bristle run x.json -o r.h5 --complete");
  CHECK(command_with({"bristle", "run", "x.json", "--shard=2/5"}, "--shard 1/5") ==
        "bristle run x.json --shard 1/5");
  CHECK(command_with({"bristle", "run", "--complete", "x.json"}, "") == "bristle run x.json");
  CHECK(command_with({"bristle", "run", "a --force b.json", "--force"}, "") ==
        "bristle run 'a --force b.json'");
  CHECK(command_with({"bristle", "run", "-", "--shard", "1/2"}, "--complete") ==
        "bristle run - --complete < EXPERIMENT.json");
}

TEST_CASE("the journals of any number of shards give the digest of the whole result") {
  const Scratch s;
  for (const std::string& more : {std::string(), kTables, kLattice}) {
    const Experiment e = sharded(s, more);
    const std::string whole = whole_digest(s, e);
    for (const std::size_t count : {1, 2, 3, 7, 6}) {
      CAPTURE(more, count);
      fs::remove_all(s.path("small"));
      write_shards(s, e, count);
      CHECK(completed(s, e) == whole);
    }
  }
}

TEST_CASE("property: any shards that have all points, some twice, give the digest of the whole result") {
  const Scratch s;
  const Experiment e = sharded(s, kTables);
  const std::string whole = whole_digest(s, e);
  rc::prop("digest of the completed result", [&] {
    fs::remove_all(s.path("small"));
    write_shards(s, e, *rc::gen::inRange<std::size_t>(1, 10));
    const auto count = *rc::gen::inRange<std::size_t>(1, 10);
    write_shard(s, e, {*rc::gen::inRange<std::size_t>(1, count + 1), count});
    RC_ASSERT(completed(s, e) == whole);
  });
}

TEST_CASE("more journals than may be open at the same time can be completed") {
  const Scratch s;
  const Experiment e = sharded(s, "", R"("k_r": {"linspace": [2, 50, 203]})");
  const std::string whole = whole_digest(s, e);
  write_shards(s, e, 203);
  CHECK(completed(s, e) == whole);
}

TEST_CASE("a completed result is like that of one run, with the hosts of its points") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  for (const char* host : {"node1", "node2"}) {
    std::string lines;
    for (std::size_t i = host[4] - '1'; i < e.sweep.size(); i += 2)
      lines += encode(point_key(e.sweep, i), kCommit, host, invented_record(e, i));
    s.write("small/r.h5." + std::string(1, host[4]) + "-of-2.journal", lines);
  }
  completed(s, e);
  const ResultReader result(s.path("small/r.h5"));
  CHECK(result.text("tier") == "smoke");
  CHECK(result.experiment() == *e.document);
  CHECK(result.has("checks"));
  CHECK(up_to_date(result.path(), e));
  CHECK(result.provenance().at("points_commits") == kCommit);
  CHECK(result.provenance().at("points_hosts") == "node1, node2");
  CHECK(result.provenance().at("points_computed") == "0 of 6");
}

TEST_CASE("once the result is written, its journal has all points, and no shard's is left but one in use") {
  const Scratch s;
  const Experiment e = sharded(s), other = sharded(s, R"(, "model": {"k_phi": 2})");
  write_shards(s, e, 4);
  const std::string foreign = write_shard(s, other, {1, 3}), used = write_shard(s, e, {2, 3});
  s.write("small/other.h5.1-of-2.journal", bytes_of(used));
  const Journal lock(used, kCommit, false);
  completed(s, e);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(s.path("small"))) left.insert(entry.path().filename());
  CHECK(left == std::set<std::string>{"r.h5", "r.h5.journal", "other.h5.1-of-2.journal",
                                      "r.h5.1-of-3.journal", "r.h5.2-of-3.journal"});
  const Journal journal(s.path("small/r.h5.journal"), kCommit, false);
  for (std::size_t i = 0; i < e.sweep.size(); ++i) CHECK(journal.has(point_key(e.sweep, i)));
}

TEST_CASE("a shard that runs again takes its points from the journals of its folder") {
  const Scratch s;
  const Experiment e = sharded(s, R"(, "load": {"R_n": null, "z_0": 0.5},
      "orientation": {"sampling": "list", "theta_0_deg": [10]})");
  const std::string first = write_shard(s, e, {1, 2});
  const std::string before = bytes_of(first);
  run_experiment(e, {.output = s.path("small/r.h5"), .shard = Shard{1, 2}, .threads = 1, .quiet = true});
  CHECK(bytes_of(first) == before);
  run_experiment(e, {.output = s.path("small/r.h5"), .shard = Shard{1, 4}, .threads = 1, .quiet = true});
  const Journal journal(journal_path(s.path("small/r.h5"), Shard{1, 4}), kCommit, false);
  for (const std::size_t i : {0, 4})
    CHECK(differences(journal.read(point_key(e.sweep, i), layout_of(e.sweep)).record, invented_record(e, i))
              .empty());
  CHECK_FALSE(fs::exists(s.path("small/r.h5")));
}

TEST_CASE("missing points are named, with their shards and the command that computes them") {
  const Scratch s;
  const Experiment e = sharded(s);
  CHECK_THAT(refusal(s, e, {"bristle", "run", "small.json", "--complete"}),
             Contains("6 of 6 points") && Contains("To compute them:\n  bristle run small.json"));
  write_shard(s, e, {3, 3});
  check_holds(
      refusal(s, e, {"bristle", "run", "small.json", "--complete", "-o", "small/r.h5"}),
      {"r.h5: 4 of 6 points are missing",
       "0 (k_r = 5, k_theta = 0.3), 1 (k_r = 5, k_theta = 1), 3 (k_r = 20, k_theta = 0.3)",
       "They belong to the shards 1/3, 2/3.", "\n  bristle run small.json -o small/r.h5 --shard 1/3"});
  CHECK_FALSE(fs::exists(s.path("small/r.h5.journal")));
  write_shard(s, e, {2, 3});
  check_holds(refusal(s, e), {"They belong to shard 1/3. To compute it:\n  "});
  fs::remove_all(s.path("small"));
  const Experiment many = sharded(s, "", R"("k_r": {"linspace": [2, 50, 60]})");
  write_shard(s, many, {2, 4});
  check_holds(refusal(s, many), {"45 of 60 points", " and 35 more", "1/4, 3/4, 4/4"});
}

TEST_CASE("a damaged line is a missing point") {
  const Scratch s;
  const Experiment e = sharded(s);
  write_shard(s, e, {1, 2});
  const std::string path = write_shard(s, e, {2, 2});
  std::string text = bytes_of(path);
  const auto digit = text.find("\"values\":[", text.find('\n')) + 10;
  text[digit] = text[digit] == '1' ? '2' : '1';
  s.write("small/" + fs::path(path).filename().string(), text);
  check_holds(refusal(s, e), {"1 of 6 points are missing in the journals of its folder: 3 (", "shard 2/2"});
}

TEST_CASE("a line with other variables is a missing point, which another journal may have") {
  const Scratch s;
  const Experiment e = sharded(s);
  {
    Journal journal(s.path("small/r.h5.journal"), kCommit, false);
    for (std::size_t i = 0; i < e.sweep.size(); ++i) {
      PointRecord record = invented_record(e, i);
      if (i == 2) record.values.pop_back();
      journal.append(point_key(e.sweep, i), record);
    }
  }
  check_holds(refusal(s, e), {"1 of 6 points are missing in the journals of its folder: 2 ("});
  write_shard(s, e, {1, 1});
  CHECK(completed(s, e) == whole_digest(s, e));
}

TEST_CASE("journals of other experiments, numerics or uncommitted programs are named if points are missing") {
  const Scratch s;
  const Experiment e = sharded(s);
  write_shard(s, e, {1, 2});
  const std::string foreign = write_shard(s, sharded(s, R"(, "model": {"k_phi": 2})"), {2, 2});
  const std::string message = refusal(s, e);
  check_holds(message,
              {"3 of 6 points", foreign + " has 3 points, but none can be used: ", "numerics version"});
  CHECK_THAT(message, !Contains("1-of-2.journal has"));
  if (is_dirty(kCommit)) return;
  fs::remove(foreign);
  write_shard(s, e, {2, 2}, "0123abc-dirty");
  check_holds(refusal(s, e), {foreign + " has 3 points, but none can be used: ", "uncommitted changes"});
}

TEST_CASE("axes in another order are the same points in another order") {
  const Scratch s;
  write_shards(s, sharded(s), 2);
  const Experiment turned =
      sharded(s, "", R"("k_theta": {"values": [0.3, 1, 3]}, "k_r": {"values": [5, 20]})");
  completed(s, turned);
  const ResultReader result(s.path("small/r.h5"));
  CHECK(result.sweep_shape() == std::vector<std::size_t>{3, 2});
  CHECK(result.variable("passages").values[1] == invented_record(sharded(s), 3).at("passages"));
}

TEST_CASE("contradictory journals are refused with files, point and dataset") {
  const Scratch s;
  const Experiment e = sharded(s);
  write_shards(s, e, 2);
  PointRecord record = invented_record(e, 3);
  record.values[record.layout->number("R_x")] = 7;
  const std::string other = journal_path(s.path("small/r.h5"), Shard{4, 4});
  Journal(other, kCommit, false).append(point_key(e.sweep, 3), record);
  check_holds(refusal(s, e),
              {"small/r.h5.journal and " + other, "differ at the point k_r = 20, k_theta = 0.3: R_x;"});
  CHECK(fs::exists(other));
}

TEST_CASE("two runs of the same shard at the same time are refused, two shards are not") {
  const Scratch s;
  const Experiment e = sharded(s);
  const Journal first(write_shard(s, e, {1, 2}), kCommit, false);
  CHECK_THROWS_WITH(
      run_experiment(e, {.output = s.path("small/r.h5"), .shard = Shard{1, 2}, .threads = 1, .quiet = true}),
      Contains("r.h5.1-of-2.journal: another run is writing it"));
  write_shard(s, e, {2, 2});
  CHECK_NOTHROW(completed(s, e));
}

}  // namespace bristle::shards_test
