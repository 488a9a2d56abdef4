#include "archive/build.hpp"
#include "assumptions/assumptions.hpp"
#include "compare/reference.hpp"
#include "results/journal.hpp"
#include "results/version.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "json/json.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <sys/stat.h>

// Nothing is replaced but files of the kind that is written, and nothing is read that may never end.
namespace bristle::outputs_test {
using namespace testing;
using Catch::Contains;

namespace {

// Two bristles at one given gap, computed in milliseconds.
Experiment quick_experiment(const Scratch& s) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("quick.json", R"({"extends": "paper.json", "name": "quick",
      "load": {"z_0": 0.5, "R_n": null}, "orientation": {"sampling": "list", "theta_0_deg": [10, 100]}})"),
                         {});
}

void run_into(const Experiment& e, const std::string& path, bool force = false) {
  run_experiment(e, {.output = path, .threads = 1, .force = force, .quiet = true});
}

// The message with which a run into path is refused. The file there must remain as it is.
std::string refusal(const Scratch& s, const std::string& path) {
  const std::string before = std::filesystem::is_regular_file(path) ? bytes_of(path) : "";
  try {
    run_into(quick_experiment(s), path);
  } catch (const InputError& e) {
    if (!before.empty()) CHECK(bytes_of(path) == before);
    return e.what();
  }
  return "(written)";
}

}  // namespace

TEST_CASE("a run replaces neither its experiment, nor what that extends, nor any file of another kind") {
  const Scratch s;
  quick_experiment(s);
  const std::string text = s.write("notes.h5", "schema_version bristle-result/1\n");
  std::string foreign = s.path("foreign.h5");
  h5::create_file(foreign).close("closing");
  Journal(s.path("other.h5.journal"), "0123abc", false)
      .append("key", record_of(layout_of(small_experiment(s).sweep), small_point(0), {}));
  for (const std::string& path :
       {s.path("quick.json"), s.path("paper.json"), text, foreign, s.path("other.h5.journal")}) {
    CAPTURE(path);
    CHECK_THAT(refusal(s, path), Contains(path + ": is not a result of bristle"));
    CHECK_FALSE(std::filesystem::exists(path + ".journal"));
  }
}

TEST_CASE("results of any version, damaged results and empty files are replaced") {
  const Scratch s;
  const Experiment e = quick_experiment(s);
  const std::string path = s.write("r.h5", "");
  run_into(e, path);
  CHECK(up_to_date(path, e));
  put(path, "R_x", {}, 7);
  run_into(e, path);
  CHECK(up_to_date(path, e));
  h5::write_attribute(h5::open_file(path, true), "schema_version", "bristle-result/9");
  run_into(e, path);
  CHECK(up_to_date(path, e));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  run_into(e, path);
  CHECK(up_to_date(path, e));
}

TEST_CASE("symbolic links, pipes and folders are refused as outputs, links to folders are followed") {
  const Scratch s;
  const Experiment e = quick_experiment(s);
  namespace fs = std::filesystem;
  run_into(e, s.path("there/r.h5"));
  fs::create_symlink(s.path("there/r.h5"), s.path("link.h5"));
  fs::create_symlink(s.path("nowhere"), s.path("dangling.h5"));
  REQUIRE(mkfifo(s.path("pipe.h5").c_str(), 0600) == 0);
  CHECK_THAT(refusal(s, s.path("link.h5")), Contains("link.h5: is a symbolic link"));
  CHECK_THAT(refusal(s, s.path("dangling.h5")), Contains("dangling.h5: is a symbolic link"));
  CHECK_FALSE(fs::exists(s.path("nowhere")));
  CHECK_THAT(refusal(s, s.path("pipe.h5")), Contains("pipe.h5: is a device, pipe or socket"));
  CHECK_THAT(refusal(s, s.path("there")), Contains("there: is a folder; give a file name"));
  CHECK_THAT(refusal(s, s.path("new/")), Contains("new/: is a folder; give a file name"));
  CHECK(fs::is_symlink(s.path("link.h5")));
  fs::create_directory_symlink(s.path("there"), s.path("folder"));
  CHECK_NOTHROW(run_into(e, s.path("folder/r.h5"), true));
}

TEST_CASE("temporary files and journals are not written through links or over other files") {
  const Scratch s;
  quick_experiment(s);
  const std::string precious = s.write("precious", "as it was");
  namespace fs = std::filesystem;
  for (const char* ending : {".partial", ".journal"}) {
    CAPTURE(ending);
    const std::string beside = s.path(std::string("r.h5") + ending);
    fs::create_symlink(precious, beside);
    CHECK_THAT(refusal(s, s.path("r.h5")), Contains(std::string("r.h5") + ending + ": is a symbolic link"));
    fs::remove(beside);
    REQUIRE(mkfifo(beside.c_str(), 0600) == 0);
    CHECK_THAT(refusal(s, s.path("r.h5")), Contains(std::string("r.h5") + ending + ": is a device, pipe"));
    fs::remove(beside);
    s.write(std::string("r.h5") + ending, "Dear diary,\n");
    CHECK_THAT(refusal(s, s.path("r.h5")), Contains(std::string("r.h5") + ending + ": "));
    CHECK(bytes_of(beside) == "Dear diary,\n");
    fs::remove(beside);
  }
  fs::create_hard_link(s.write("r.h5", "\x89HDF"), s.path("r.h5.partial"));
  fs::remove(s.path("r.h5"));
  fs::create_hard_link(s.path("r.h5.partial"), s.path("second name"));
  CHECK_THAT(refusal(s, s.path("r.h5")), Contains("r.h5.partial: is not the remainder"));
  CHECK(bytes_of(precious) == "as it was");
  CHECK_FALSE(fs::exists(s.path("r.h5")));
}

TEST_CASE("a list of checksums is not taken for a truncated journal") {
  const Scratch s;
  const std::string text = std::string(64, 'a') + "  fig4.h5\n";
  s.write("r.h5.journal", text);
  CHECK_THROWS_WITH(Journal(s.path("r.h5.journal"), "0123abc", false), Contains("not a journal"));
  CHECK(bytes_of(s.path("r.h5.journal")) == text);
  s.write("r.h5.journal", std::string(64, 'a') + " {\"schema\":\"bris");
  CHECK_NOTHROW(Journal(s.path("r.h5.journal"), "0123abc", false));
}

TEST_CASE("the matrix of assumptions replaces only a matrix, which is checked before computing") {
  const Scratch s;
  s.write("e/paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  s.write("e/small.json", R"({"extends": "paper.json", "name": "small", "figure": "0",
      "load": {"z_0": 0.5, "R_n": null}, "orientation": {"sampling": "list", "theta_0_deg": [10, 100]},
      "sweep": {"k_r": {"values": [5, 20]}},
      "checks": [{"claim": "x", "statement": "falls", "predicate": "end_ratio", "variable": "R_x_norm",
                  "along": "k_r", "is": "at_most", "threshold": 0.99}]})");
  AssumptionsOptions options;
  options.experiments = s.path("e");
  options.quiet = true;
  options.threads = 1;
  std::filesystem::create_directory(s.path("folder"));
  options.output = s.path("folder");
  CHECK_THROWS_WITH(run_assumptions(options), Contains("folder: is a folder"));
  options.output = s.path("e/small.json");
  CHECK_THROWS_WITH(run_assumptions(options), Contains("small.json: is not a matrix of assumptions"));
  options.output = s.path("m.json");
  s.write("m/baseline/small.h5", "hello");
  CHECK_THROWS_WITH(run_assumptions(options), Contains("small.h5: is not a result of bristle"));
  CHECK_FALSE(std::filesystem::exists(s.path("m/baseline/small.h5.journal")));
  write_whole(options.output, matrix_json({}).dump(1), replaceable_by_matrix());
  CHECK_NOTHROW(require_replaceable(options.output, replaceable_by_matrix()));
}

TEST_CASE("an archive replaces only an archive") {
  const Scratch s;
  ArchiveOptions options;
  options.output = s.write("results.tar", "bristle-1.0, my results");
  CHECK_THROWS_WITH(build_archive(options), Contains("results.tar: is not an archive of bristle"));
}

TEST_CASE("experiments are read only from regular files of limited size") {
  const Scratch s;
  REQUIRE(mkfifo(s.path("pipe.json").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(load_experiment(s.path("pipe.json"), {}),
                    Contains("pipe.json: cannot be read: a device, pipe"));
  CHECK_THROWS_WITH(load_experiment("/dev/zero", {}), Contains("/dev/zero: cannot be read: a device, pipe"));
  CHECK_THROWS_WITH(read_reference(s.path("pipe.json")), Contains("cannot be read: a device, pipe"));
  std::filesystem::resize_file(s.write("large.json", "{}"), kMaxJsonBytes + 1);
  CHECK_THROWS_WITH(load_experiment(s.path("large.json"), {}),
                    Contains("large.json: cannot be read: more than"));
}

}  // namespace bristle::outputs_test
