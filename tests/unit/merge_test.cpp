#include "parts.hpp"

#include "catch.hpp"
#include "generators.hpp"

namespace bristle::merge_test {
using namespace testing;

TEST_CASE("shards distribute all points, each once") {
  for (std::size_t points = 0; points < 12; ++points)
    for (std::size_t count = 1; count < 15; ++count) {
      std::vector<int> times(points, 0);
      for (std::size_t i = 1; i <= count; ++i)
        for (const std::size_t p : shard_points({i, count}, points)) ++times.at(p);
      CHECK(times == std::vector<int>(points, 1));
    }
  CHECK(part_path("results/fig4.h5", {2, 5}) == "results/fig4.2-of-5.h5");
  CHECK(how_to_merge("a/b.2-of-5.h5", {2, 5}) == "bristle merge -o a/b.h5 a/b.*-of-5.h5");
  CHECK(how_to_merge("mine.h5", {2, 5}) == "bristle merge -o FILE.h5 PARTS...");
}

TEST_CASE("an invalid shard is refused with what is allowed") {
  CHECK(shard_text(parse_shard("3/3")) == "3/3");
  for (const char* text : {"", "/", "3", "a/b", "1/", "/2", "1/0", "-1/2", "1.0/2", " 1/2", "1/2/3", "1/2 "})
    CHECK_THROWS_WITH(parse_shard(text), Catch::Contains("such as 2/8"));
  for (const char* text : {"0/3", "4/3"})
    CHECK_THROWS_WITH(parse_shard(text), Catch::Contains("shards are numbered 1/3 to 3/3"));
}

TEST_CASE("merging any number of parts gives the digest of the whole result") {
  const Scratch s;
  for (const std::string& more : {std::string(), kTables, kLattice, kCurve}) {
    const Experiment e = sharded(s, more);
    const std::string whole = digest(write_file(s, "whole.h5", e, {}, {}));
    for (const std::size_t count : {1, 2, 3, 7, 6}) {
      CAPTURE(more, count);
      auto paths = write_parts(s, e, count);
      std::reverse(paths.begin(), paths.end());
      CHECK(merged(s, paths) == whole);
    }
  }
}

TEST_CASE("property: parts in any order, some twice, give the digest of the whole result") {
  const Scratch s;
  const Experiment e = sharded(s, kTables);
  const std::string whole = digest(write_file(s, "whole.h5", e, {}, {}));
  std::vector<std::vector<std::string>> parts(1);
  for (std::size_t count = 1; count < 10; ++count) parts.push_back(write_parts(s, e, count));
  rc::prop("merged digest", [&] {
    auto paths = parts[*rc::gen::inRange<std::size_t>(1, parts.size())];
    const auto& others = parts[*rc::gen::inRange<std::size_t>(1, parts.size())];
    paths.push_back(others[*rc::gen::inRange<std::size_t>(0, others.size())]);
    std::shuffle(paths.begin(), paths.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
    RC_ASSERT(merged(s, paths) == whole);
  });
}

TEST_CASE("more parts than may be open at the same time can be merged") {
  const Scratch s;
  const Experiment e = sharded(s, "", R"("k_r": {"linspace": [2, 50, 203]})");
  const std::string whole = digest(write_file(s, "whole.h5", e, {}, {}));
  CHECK(merged(s, write_parts(s, e, 203)) == whole);
}

TEST_CASE("a merged result has checks, the attributes of a whole result and the provenance of its parts") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  const auto paths = write_parts(s, e, 2);
  merged(s, paths);
  const ResultReader result(s.path("merged.h5"));
  CHECK(!result.shard());
  CHECK(result.text("tier") == "smoke");
  CHECK(result.experiment() == *e.document);
  CHECK(h5::exists(result.file(), "checks"));
  CHECK(!h5::exists(result.file(), "part"));
  CHECK(up_to_date(result.path(), e));
  const auto record = merged_provenance(PartSet(paths).parts());
  CHECK(record.at("commit") == "0123abc");
  CHECK(record.at("host") == "node1, node2");
  CHECK(record.at("started") == "2026-01-01");
  CHECK(record.at("finished") == "2026-02-01");
  CHECK(record.at("part_2") == "2/2 small.2-of-2.h5: 3 points, payload sha256 " +
                                   ResultReader(paths[1], Expected::part).text("payload_sha256") +
                                   "; 2026-01-02 to 2026-02-01 on node2 by 0123abc: bristle run small.json "
                                   "--shard 2/2 -o small.2-of-2.h5");
}

}  // namespace bristle::merge_test
