#include "compare/reference.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <boost/algorithm/string.hpp>
#include <cstdlib>
#include <filesystem>

namespace bristle::reference_update_test {
using namespace testing;
using Catch::Contains;

namespace {

// A result in a clean git repository of its own.
struct Repository {
  Scratch s;
  std::string file;
  ReferenceUpdate update;

  explicit Repository(const Change& change = {}, const std::string& commit = "0123abc",
                      const std::string& tier = "smoke") {
    git("init -q .");
    git("-c user.name=n -c user.email=e commit -q --allow-empty -m m");
    s.write(".git/info/exclude", "*.h5\n/paper.json\n/small.json\n");
    file = small_result(s, "r.h5", small_experiment(s, "", tier), change, commit);
    update = {file, "first", s.path("reference"), "2026-12-01"};
  }
  void git(const std::string& arguments) const {
    REQUIRE(std::system(("git -C " + s.path("") + " " + arguments).c_str()) == 0);
  }
  std::string json() const { return s.path("reference/small.json"); }
  std::string log() const { return bytes_of(s.path("reference/CHANGELOG.md")); }
};

std::string refusal(const ReferenceUpdate& update) {
  try {
    update_reference(update);
  } catch (const InputError& e) {
    CHECK_FALSE(std::filesystem::exists(update.folder));
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("update: writes reference and change log, but nothing if the numbers are the same") {
  Repository r;
  CHECK_THAT(update_reference(r.update), Contains("new reference") && Contains("program: 0123abc"));
  CHECK(Json::parse(bytes_of(r.json())) == reference_of(r.file));
  const std::string before = bytes_of(r.json()), log = r.log();
  r.update.reason = "again";
  CHECK(update_reference(r.update) == "");
  CHECK(bytes_of(r.json()) == before);
  CHECK(r.log() == log);

  // The same values with another digest, because the number of passages belongs to the payload.
  small_result(r.s, "r.h5", small_experiment(r.s), [](std::size_t, PointResult& p) { p.passages = 200; });
  CHECK_THAT(update_reference(r.update), Contains("the same values, but different"));
  CHECK_THAT(bytes_of(r.json()), Contains(ResultReader(r.file).text("payload_sha256")));

  small_result(r.s, "r.h5", small_experiment(r.s), [](std::size_t i, PointResult& p) {
    if (i == 3) p.value[bristle::R_X] += 0.5;
    if (i < 3) p.R_x_norm.value = 0.1;
  });
  // A variable that the old reference does not have.
  std::string old = bytes_of(r.json());
  REQUIRE(boost::contains(old, "\"gamma_1\""));
  boost::replace_all(old, "\"gamma_1\"", "\"gamma_0\"");
  r.s.write("reference/small.json", old);
  r.update.reason = "a better quadrature";
  update_reference(r.update);
  CHECK_THAT(r.log(), Contains("- gamma_1: only in r.h5\n"));
  CHECK(r.log().substr(0, log.size()) == log);
  CHECK_THAT(r.log(), Contains("## 2026-12-01 small\n\na better quadrature\n") &&
                          Contains("of the old tolerance") && Contains("at k_r = 20, k_theta = 0.3") &&
                          Contains("refuted, was supported"));
  CHECK_FALSE(std::filesystem::exists(r.json() + ".new"));
  CHECK_THAT(r.log(), !Contains(r.s.path("")));
}

TEST_CASE("update: refused without a reason, with uncommitted changes, and outside a work tree") {
  Repository r;
  for (const char* reason : {"", "  ", "two\nlines"}) {
    ReferenceUpdate u = r.update;
    u.reason = reason;
    CHECK_THAT(refusal(u), Contains("--reason"));
  }
  r.s.write("changed.txt", "x");
  CHECK_THAT(refusal(r.update), Contains("commit or stash first") && Contains("changed.txt"));
  std::filesystem::remove(r.s.path("changed.txt"));
  std::filesystem::create_directory(r.s.path("reference"));
  r.s.write("reference/other.json", "changes beside it may be committed with it");
  CHECK_NOTHROW(update_reference(r.update));
  const Scratch bare;
  r.update.folder = bare.path("reference");
  CHECK_THAT(refusal(r.update), Contains("not in a git work tree"));
  r.update.folder = bare.path("no/where");
  CHECK_THAT(refusal(r.update), Contains("there is no folder"));
}

TEST_CASE("update: the work tree that counts is that of the references") {
  Repository r;
  r.s.write("changed.txt", "x");
  const Scratch other;
  REQUIRE(std::system(("git init -q " + other.path("")).c_str()) == 0);
  setenv("GIT_DIR", other.path(".git").c_str(), 1);
  const std::string with_git_dir = refusal(r.update);
  unsetenv("GIT_DIR");
  CHECK_THAT(with_git_dir, Contains("commit or stash first") && Contains("changed.txt"));
  setenv("GIT_LITERAL_PATHSPECS", "1", 1);
  const std::string with_literal_paths = refusal(r.update);
  unsetenv("GIT_LITERAL_PATHSPECS");
  CHECK_THAT(with_literal_paths, Contains("commit or stash first"));
  std::filesystem::remove(r.s.path("changed.txt"));

  r.s.write(".git/info/exclude", "*.h5\n/*.json\n/inner/\n");
  std::filesystem::create_directory(r.s.path("inner"));
  r.update.folder = r.s.path("inner/reference");
  CHECK_THAT(refusal(r.update), Contains("not in a git work tree") && Contains("ignores it"));
}

TEST_CASE("update: refused for a program or a file that cannot be reproduced") {
  CHECK_THAT(refusal(Repository({}, "0123abc-dirty").update), Contains("0123abc-dirty"));
  CHECK_THAT(refusal(Repository({}, "unknown").update), Contains("unknown"));
  CHECK_THAT(refusal(Repository({}, "0123abc", "full").update), Contains("contains the full tier"));
  const Repository r;
  put(r.file, "R_x", {0, 0}, 7);
  CHECK_THAT(refusal(r.update), Contains("payload_sha256 DOES NOT MATCH"));
}

TEST_CASE("update: refused for a reference that could not be read") {
  Repository r;
  r.update.most_bytes = 1000;
  CHECK_THAT(refusal(r.update), Contains("r.h5: has too many points for a reference, which would have ") &&
                                    Contains("and no more than 1000 are read; /tiers/smoke"));
  r.update.most_bytes = kMaxJsonBytes;
  update_reference(r.update);
  CHECK(std::filesystem::file_size(r.json()) > 1000);
}

TEST_CASE("a smoke tier with too many points for a reference is not advised") {
  const Repository r({}, "0123abc", "full");
  const results::ResultReader result(r.file);
  const Reference made = make_reference(result, {});
  const std::uintmax_t bytes = file_text(made).size();
  CHECK_THAT(smoke_commands(result, made, bytes),
             Catch::StartsWith("`bristle run ") && Contains("--tier smoke"));
  CHECK_THAT(smoke_commands(result, made, bytes / 2),
             Contains("points of the tier smoke are too many for a reference") && Contains("small.json"));
}

TEST_CASE("update: a change log of something else and linked references are not replaced") {
  const Repository r;
  r.s.write("reference/CHANGELOG.md", "# Changelog of the program\n");
  CHECK_THROWS_WITH(update_reference(r.update),
                    Contains("CHANGELOG.md: is not the record of the references"));
  CHECK(r.log() == "# Changelog of the program\n");
  CHECK_FALSE(std::filesystem::exists(r.json()));
  std::filesystem::remove(r.s.path("reference/CHANGELOG.md"));
  std::filesystem::create_symlink(r.s.path("elsewhere.json"), r.json());
  CHECK_THROWS_WITH(update_reference(r.update), Contains("small.json: is a symbolic link"));
  CHECK_FALSE(std::filesystem::exists(r.s.path("elsewhere.json")));
}

TEST_CASE("update: refused for a run with failures") {
  const auto with = [](const Change& change) {
    const Repository r([&](std::size_t i, PointResult& p) {
      if (i == 4) change(i, p);
    });
    return refusal(r.update);
  };
  const auto at = Contains("k_r = 20, k_theta = 1");
  CHECK_THAT(with([](std::size_t, PointResult& p) { p.status = PointStatus::incomplete; }),
             Contains("status: incomplete") && at);
  CHECK_THAT(with([](std::size_t, PointResult& p) { p.status = PointStatus::not_converged; }),
             Contains("status: not_converged") && at);
  CHECK_THAT(with([](std::size_t, PointResult& p) { p.value[bristle::R_X] = kNone; }),
             Contains("R_x: nan") && at);
  CHECK_THAT(with([](std::size_t, PointResult& p) { p.value[bristle::R_X] = INFINITY; }),
             Contains("inf") && at);
  CHECK(with([](std::size_t, PointResult& p) {
          p.status = PointStatus::unreachable;
          p.value.fill(kNone);
          p.z_0 = p.R_x_norm.value = p.R_y_norm.value = kNone;
        }) == "");
}

}  // namespace bristle::reference_update_test
