#include "archive/verify.hpp"

#include "archive/contents.hpp"
#include "archive/crate.hpp"
#include "archive/result_facts.hpp"
#include "results/reader.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace bristle::archive {
namespace {

// Returns the first line of a text that differs from the expected text, with both versions.
std::string first_difference(const std::string& text, const std::string& expected) {
  const auto at =
      std::mismatch(text.begin(), text.end(), expected.begin(), expected.end()).first - text.begin();
  const auto line = std::count(text.begin(), text.begin() + at, '\n');
  const auto line_of = [line](const std::string& whole) {
    std::istringstream in(whole);
    std::string found;
    for (long i = 0; i <= line; ++i)
      if (!std::getline(in, found)) return std::string("the end of the file");
    return fmt::format("\"{}\"", found.substr(0, 80));
  };
  return fmt::format("line {} is {}, but according to the other files of the archive it should be {}",
                     line + 1, line_of(text), line_of(expected));
}

bool is_result(const std::string& name, const char* extension) {
  return name.starts_with("data/results/") && name.ends_with(extension);
}

class Verifier {
 public:
  explicit Verifier(const std::string& path) : path_(path) {}

  Verification run() {
    try {
      bytes_ = read_archive(path_);
      if (bytes_.starts_with(results::result_file().start))
        throw MalformedError(fmt::format("a result, not an archive; `bristle info {}` checks its digest",
                                         shell_quoted(path_)));
      files_ = read_tar(bytes_);
      out_.folder = strip_folder(files_);
    } catch (const MalformedError& e) {
      out_.problems.push_back(e.what());
      return out_;
    }
    out_.files = files_.size();
    add(check_manifests(files_));
    read_time();
    // A file with a wrong hash is reported once; its content is then not checked.
    if (out_.problems.empty()) check_content();
    check_bytes();
    return out_;
  }

 private:
  void add(const Problems& more) { out_.problems.insert(out_.problems.end(), more.begin(), more.end()); }

  void check_content() {
    for (const auto& [name, bytes] : files_)
      if (is_result(name, ".h5")) check_result(name, bytes);
    for (const auto& [name, bytes] : files_)
      if (is_result(name, ".json")) check_matrix(name, bytes);
    if (facts_.empty()) out_.problems.push_back("data/results: there are no results");
    find_commit();
    if (!out_.problems.empty()) return;
    try {
      check_description();
    } catch (const MalformedError& e) {
      out_.problems.push_back(e.what() + other_program());
    } catch (
        const Json::exception& e) {  // an attribute of a result, or a key of the citation, of another type
      out_.problems.push_back(
          fmt::format("the metadata cannot be generated: {}{}", json_error(e.what()), other_program()));
    }
  }

  // Finds the commit in the name of the only file in data/source/.
  void find_commit() {
    const std::string before = "data/source/bristle-", after = ".tar";
    for (const auto& [name, bytes] : files_) {
      if (!name.starts_with("data/source/")) continue;
      const bool named = name.starts_with(before) && name.ends_with(after) && out_.commit.empty();
      if (!named) {
        out_.problems.push_back(fmt::format("{}: is not the source of the commit of the archive", name));
        continue;
      }
      out_.commit = name.substr(before.size(), name.size() - before.size() - after.size());
      if (bytes.substr(0, 1024).find("comment=" + out_.commit + "\n") == std::string::npos)
        out_.problems.push_back(fmt::format("{}: was not created by `git archive` from this commit", name));
    }
    if (out_.commit.empty()) out_.problems.push_back("data/source: the source of the commit is missing");
  }

  // Makes README, citation, crate and the files of the bag again, and compares bytes.
  void check_description() {
    out_.identifier = bag_info(files_, "External-Identifier");
    out_.draft = bag_info(files_, "Draft");
    Files payload;
    for (const auto& [name, bytes] : files_)
      if (name.starts_with("data/")) payload[name.substr(5)] = bytes;
    payload.erase(kCrateFile);  // which lists the others
    const Contents contents = describe(std::move(payload), facts_, out_.commit, time_, out_.draft);
    out_.version = contents.citation["version"];
    if (out_.folder != folder_of(contents))
      out_.problems.push_back(fmt::format("{}: is the folder of another version; the source has version {}",
                                          out_.folder, out_.version));
    const Files expected = bag_of(contents);
    for (const char* start : {"data/", ""})  // the files of the bag follow from the files in data/
      if (out_.problems.empty()) compare(expected, start);
  }

  void compare(const Files& expected, const std::string& start) {
    for (const auto& [name, bytes] : expected)
      if (const auto file = files_.find(name); !name.starts_with(start)) continue;
      else if (file == files_.end())
        out_.problems.push_back(fmt::format("{}: is missing; every archive contains it", name));
      else if (file->second != bytes)
        out_.problems.push_back(
            fmt::format("{}: {}{}", name, first_difference(file->second, bytes), other_program()));
    for (const auto& [name, bytes] : files_)
      if (name.starts_with(start) && !expected.contains(name))
        out_.problems.push_back(
            fmt::format("{}: does not belong here; an archive has no such file outside data/", name));
  }

  // Returns what to do about a difference that may come from another program, which words the files
  // differently.
  std::string other_program() const {
    const std::string agent = bag_info(files_, "Bag-Software-Agent");
    if (!agent.empty() && agent != fmt::format("bristle {}", run::kVersion))
      return fmt::format(" (archived by {}, this is {}: verify with the program in data/source)", agent,
                         run::kVersion);
    if (out_.commit == run::kCommit) return "";
    return fmt::format(" (the archive is of commit {}, this program of {}: use the program in data/source)",
                       out_.commit, run::kCommit);
  }

  // Checks that a matrix of assumptions matches its digest and has the numerics_version of the results.
  void check_matrix(const std::string& name, const std::string& bytes) {
    try {
      const Json matrix = checked_matrix_facts(bytes)["numerics_version"];
      for (const auto& [file, of_result] : facts_)
        if (of_result["numerics_version"] != matrix)
          return out_.problems.push_back(fmt::format("{}: has numerics_version {}, but {} has {}", name,
                                                     shown(matrix), file,
                                                     shown(of_result["numerics_version"])));
    } catch (const MalformedError& e) {
      out_.problems.push_back(fmt::format("{}: {}", name, e.what()));
    }
  }

  void check_result(const std::string& name, const std::string& bytes) {
    try {
      const Json found = checked_result_facts(bytes);
      if ("data/results/" + found["name"].get<std::string>() + ".h5" != name)
        out_.problems.push_back(fmt::format("{}: contains the result of {}", name, shown(found["name"])));
      if (found["tier"] != "full" && bag_info(files_, "Draft").empty())
        out_.problems.push_back(fmt::format("{}: has the tier {}, not \"full\"", name, shown(found["tier"])));
      facts_[name.substr(5)] = found;
      out_.results[name] = {bytes, found};
    } catch (const MalformedError& e) {
      out_.problems.push_back(fmt::format("{}: {}", name, e.what()));
    }
  }

  void read_time() {
    const std::string text = bag_info(files_, "Source-Date-Epoch");
    if (text.empty() || text.size() > 11 || !std::all_of(text.begin(), text.end(), ::isdigit))
      out_.problems.push_back("bag-info.txt: Source-Date-Epoch is not a number of seconds");
    else time_ = std::stol(text);
  }

  // Compares headers, padding and order, the bytes that no hash covers.
  void check_bytes() {
    const Files named = in_folder(out_.folder, std::move(files_));
    try {
      if (const std::string difference = tar_difference(bytes_, named, time_); !difference.empty())
        out_.problems.push_back(difference);
    } catch (const RunError& e) {  // a name that no archive of this program has
      out_.problems.emplace_back(e.what());
    }
  }

  std::string path_, bytes_;
  long time_ = 0;  // of the source commit
  Files files_;
  std::map<std::string, Json> facts_;  // of the results, by name in data/
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

}  // namespace bristle::archive
