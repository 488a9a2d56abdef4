#include "archive/verify.hpp"

#include "archive/citation.hpp"
#include "archive/crate.hpp"
#include "archive/result_facts.hpp"
#include "archive/safe_json.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace bristle {
namespace {

constexpr const char* kCitation = "data/CITATION.cff";
const std::string kCratePath = std::string("data/") + kCrateFile;

bool is_result(const std::string& name) {
  return name.compare(0, 13, "data/results/") == 0 && name.size() > 3 &&
         name.substr(name.size() - 3) == ".h5";
}

class Verifier {
 public:
  explicit Verifier(const std::string& path) : path_(path) {}

  Verification run() {
    try {
      files_ = read_tar(path_);
      out_.folder = strip_folder(files_);
    } catch (const BadArchive& e) {
      out_.problems.push_back(e.what());
      return out_;
    }
    out_.files = files_.size();
    add(check_bag(files_));
    // What the hashes find needs no second complaint by those who read it.
    if (out_.problems.empty()) check_content();
    check_bytes();
    return out_;
  }

 private:
  void add(const Problems& more) { out_.problems.insert(out_.problems.end(), more.begin(), more.end()); }

  void check_content() {
    for (const char* name : {"data/README.md", "data/LICENSE", kCitation, kCratePath.c_str()})
      if (!files_.contains(name))
        out_.problems.push_back(fmt::format("{}: is missing; every archive has it", name));
    if (!out_.problems.empty()) return;
    std::map<std::string, Json> facts;
    for (const auto& [name, bytes] : files_)
      if (is_result(name)) check_result(name, bytes, facts);
    if (facts.empty()) out_.problems.push_back("data/results: there are no results");
    const Json citation = parse(kCitation, parse_citation), crate = parse(kCratePath, safe_json);
    if (!crate.is_null() && !crate.is_object()) out_.problems.push_back(kCratePath + ": not a JSON object");
    if (!citation.is_object() || !crate.is_object()) return;
    add(check_citation(citation));
    if (!out_.problems.empty()) return;
    add(check_crate(crate, files_, citation, facts));
    check_identity(citation);
  }

  Json parse(const std::string& name, Json (*parser)(const std::string&)) {
    try {
      return parser(files_.at(name));
    } catch (const BadArchive& e) {
      out_.problems.push_back(fmt::format("{}: {}", name, e.what()));
      return {};
    }
  }

  void check_result(const std::string& name, const std::string& bytes, std::map<std::string, Json>& facts) {
    try {
      const Json found = checked_result_facts(bytes);
      if ("data/results/" + found["name"].get<std::string>() + ".h5" != name)
        out_.problems.push_back(fmt::format("{}: holds the result of {}", name, shown(found["name"])));
      if (found["tier"] != "full")
        out_.problems.push_back(
            fmt::format("{}: is of the tier {}, not the full one", name, shown(found["tier"])));
      facts[name] = found;
      out_.results[name] = {bytes, found};
    } catch (const BadArchive& e) {
      out_.problems.push_back(fmt::format("{}: {}", name, e.what()));
    }
  }

  // Version, source and folder are one release's.
  void check_identity(const Json& citation) {
    out_.version = citation["version"];
    out_.commit = citation.value("commit", "");
    out_.identifier = bag_info(files_, "External-Identifier");
    out_.draft = bag_info(files_, "Draft");
    if (out_.folder != "bristle-" + out_.version)
      out_.problems.push_back(fmt::format("{}: is the folder of another version than that of {}, {}",
                                          out_.folder, kCitation, out_.version));
    const std::string source = fmt::format("data/source/bristle-{}.tar", out_.commit);
    const auto file = files_.find(source);
    if (file == files_.end())
      out_.problems.push_back(fmt::format("{}: is missing; {} names that commit", source, kCitation));
    else if (file->second.substr(0, 1024).find("comment=" + out_.commit + "\n") == std::string::npos)
      out_.problems.push_back(fmt::format("{}: is not git's archive of that commit", source));
  }

  // Headers, padding, order: all that is not content.
  void check_bytes() {
    if (!files_.contains("bag-info.txt")) return;
    const std::string time = bag_info(files_, "Source-Date-Epoch");
    if (time.empty() || time.size() > 11 || !std::all_of(time.begin(), time.end(), ::isdigit))
      return out_.problems.push_back("bag-info.txt: Source-Date-Epoch is not a number of seconds");
    Files named;
    for (auto& [name, bytes] : files_) named[out_.folder + "/" + name] = std::move(bytes);
    if (const std::string place = tar_difference(path_, named, std::stol(time)); !place.empty())
      out_.problems.push_back(place);
  }

  std::string path_;
  Files files_;
  Verification out_;
};

}  // namespace

Verification verify_archive(const std::string& path) {
  Verification found = Verifier(path).run();
  for (std::string& problem : found.problems) problem = printable(problem);
  for (std::string* text : {&found.version, &found.commit, &found.identifier, &found.draft})
    *text = printable(*text);
  return found;
}

}  // namespace bristle
