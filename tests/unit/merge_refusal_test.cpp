#include "parts.hpp"

#include "catch.hpp"

// Deliberately damaged parts: the message names the part, no temporary file remains and an existing file is
// unchanged.
namespace bristle::merge_refusal_test {
using namespace testing;

namespace {

// What stands at the output before: enough to be taken for a result, which a merge may replace.
const std::string kOldResult = "\x89HDF\r\n\x1a\n bristle-result/1";

// The message with which merging is refused.
std::string refusal(const Scratch& s, const std::vector<std::string>& paths,
                    const std::string& output = "merged.h5") {
  if (output == "merged.h5") s.write(output, kOldResult);
  const std::string before = bytes_of(s.path(output));
  std::string message = "(nothing)";
  try {
    PartSet parts(paths);
    merge_parts(parts, s.path(output), "bristle merge", [] { return false; });
  } catch (const InputError& e) {
    message = e.what();
  }
  CHECK(bytes_of(s.path(output)) == before);
  CHECK(!std::filesystem::exists(s.path(output) + ".partial"));
  return message;
}

void check_holds(const std::string& text, const std::vector<std::string>& all) {
  for (const std::string& one : all) {
    CAPTURE(text, one);
    CHECK(text.find(one) != std::string::npos);
  }
}

template <class Value>
void set_attribute(const std::string& path, const std::string& name, Value value) {
  const h5::Handle file = h5::open_file(path, true);
  h5::write_attribute(file, name, value);
}

}  // namespace

TEST_CASE("parts of different experiments are refused with both names and the difference") {
  const Scratch s;
  const std::string one = write_part(s, sharded(s), {1, 2});
  const std::string two = write_part(s, sharded(s, R"(, "model": {"k_phi": 2})"), {2, 2});
  check_holds(refusal(s, {one, two}),
              {one + " and " + two + " are parts of different experiments: ", "/model/k_phi is 1.9 and 2"});
}

TEST_CASE("parts with axes in different order are of different experiments") {
  const Scratch s;
  const std::string one = write_part(s, sharded(s), {1, 2});
  const Experiment turned =
      sharded(s, "", R"("k_theta": {"values": [0.3, 1, 3]}, "k_r": {"values": [5, 20]})");
  const std::string two = write_part(s, turned, {2, 2});
  check_holds(refusal(s, {one, two}), {"different experiments: the keys are in a different order"});
}

TEST_CASE("parts with different titles are refused with the advice to run the shards again") {
  const Scratch s;
  const std::string one = write_part(s, sharded(s), {1, 2});
  const std::string two = write_part(s, sharded(s, R"(, "title": "another")"), {2, 2});
  check_holds(refusal(s, {one, two}),
              {one + " and " + two, "/title is ", "and \"another\"", "run the shards again"});
}

TEST_CASE("parts of different versions of program or numerics, or not of this program's, are refused") {
  const Scratch s;
  const Experiment e = sharded(s);
  const auto parts = write_parts(s, e, 2);
  set_attribute(parts[1], "numerics_version", kNumericsVersion + 1);
  const std::string next = "(numerics version " + std::to_string(kNumericsVersion + 1) + ")";
  check_holds(refusal(s, parts), {parts[0] + " was computed by ", parts[1] + " by ", next});
  set_attribute(parts[0], "numerics_version", kNumericsVersion + 1);
  check_holds(refusal(s, parts), {parts[0] + " was computed by ", next, "this program is bristle "});
  auto provenance = provenance_of({2, 2});
  provenance["version"] = "0.0.9";
  const std::string old = write_file(s, "old.h5", e, Shard{2, 2}, provenance);
  check_holds(refusal(s, {write_part(s, e, {1, 2}), old}), {old + " by bristle 0.0.9"});
}

TEST_CASE("missing points are named, with their shards and the command that computes them") {
  const Scratch s;
  const auto parts = write_parts(s, sharded(s), 3);
  check_holds(
      refusal(s, {parts[2]}),
      {"4 of 6 points are missing: 0 (k_r = 5, k_theta = 0.3), 1 (k_r = 5, k_theta = 1), 3 (k_r = "
       "20, k_theta = 0.3)",
       "They belong to the shards 1/3, 2/3.", "bristle run small.json --shard 1/3 -o small.1-of-3.h5"});
  const Experiment many = sharded(s, "", R"("k_r": {"linspace": [2, 50, 60]})");
  check_holds(refusal(s, {write_part(s, many, {2, 4})}),
              {"45 of 60 points", " and 35 more", "1/4, 3/4, 4/4"});
}

TEST_CASE("contradictory parts are refused with files, point and dataset") {
  const Scratch s;
  const Experiment e = sharded(s);
  auto parts = write_parts(s, e, 2);
  ResultWriter writer(e, s.path("other.h5"), Shard{2, 2});
  for (const std::size_t i : {1, 3, 5}) {
    PointRecord record = invented_record(e, i);
    if (i == 3) record.values["R_x"][0] = 7;
    writer.write(i, record);
  }
  writer.close(provenance_of({2, 2}));
  writer.publish();
  parts.push_back(s.path("other.h5"));
  check_holds(refusal(s, parts),
              {parts[1] + " and " + parts[2] + " differ at point 3 (k_r = 20, k_theta = 0.3): R_x;"});
}

TEST_CASE("damaged parts are named: changed numbers or experiment, missing groups, and a truncated file") {
  const Scratch s;
  const Experiment e = sharded(s, kTables);
  const auto damaged = [&](auto damage) {
    const auto parts = write_parts(s, e, 2);
    damage(parts[1]);
    check_holds(refusal(s, parts), {parts[1] + ": damaged"});
  };
  damaged([](const std::string& path) { put(path, "R_x", {0, 1}, 7); });
  damaged([](const std::string& path) { put(path, "part/points", {0}, 0); });
  damaged([](const std::string& path) { remove_dataset(path, "part"); });
  damaged([](const std::string& path) { remove_dataset(path, "provenance"); });
  damaged([&](const std::string& path) {
    set_attribute(path, "experiment", sharded(s, kTables + R"(, "title": "x")").document->dump(1));
  });
  damaged([](const std::string& path) {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  });
}

TEST_CASE("a missing file, a text and a whole result are not parts") {
  const Scratch s;
  const Experiment e = sharded(s);
  const std::string part = write_part(s, e, {1, 2});
  check_holds(refusal(s, {part, s.path("none.h5")}), {"none.h5: no such file", "--shard"});
  check_holds(refusal(s, {part, s.write("text.h5", "hello")}), {"text.h5: not an HDF5 file"});
  const std::string whole = write_file(s, "whole.h5", e, {}, {});
  check_holds(refusal(s, {part, whole}), {whole + ": the whole result of small, not a part"});
}

TEST_CASE("the output must not be one of the parts, not even through a link") {
  const Scratch s;
  const auto parts = write_parts(s, sharded(s), 2);
  check_holds(refusal(s, parts, "small.2-of-2.h5"), {"small.2-of-2.h5: is one of the parts"});
  std::filesystem::create_symlink(parts[0], s.path("link.h5"));
  check_holds(refusal(s, parts, "link.h5"), {"link.h5: is one of the parts (" + parts[0] + ")"});
}

TEST_CASE("an interrupted merge leaves existing files unchanged") {
  const Scratch s;
  PartSet parts(write_parts(s, sharded(s), 2));
  s.write("merged.h5", kOldResult);
  CHECK_THROWS_AS(merge_parts(parts, s.path("merged.h5"), "", [] { return true; }), RunError);
  CHECK(bytes_of(s.path("merged.h5")) == kOldResult);
  CHECK(!std::filesystem::exists(s.path("merged.h5.partial")));
}

TEST_CASE("a part is up to date for its own shard only, and readers of results refuse it") {
  const Scratch s;
  const Experiment e = sharded(s);
  const std::string part = write_part(s, e, {1, 2});
  CHECK(up_to_date(part, e, Shard{1, 2}));
  CHECK(!up_to_date(part, e, Shard{2, 2}));
  CHECK(!up_to_date(part, e, Shard{1, 3}));
  CHECK(!up_to_date(part, e));
  CHECK(!up_to_date(write_file(s, "whole.h5", e, {}, {}), e, Shard{1, 1}));
  CHECK_THROWS_WITH(ResultReader{part}, Catch::Contains("a part (1/2) of small") &&
                                            Catch::Contains("bristle merge -o ") &&
                                            Catch::Contains("small.*-of-2.h5"));
}

}  // namespace bristle::merge_refusal_test
