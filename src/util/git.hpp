#pragma once

#include <ctime>
#include <string>
#include <vector>

namespace bristle {

// A git work tree. All functions throw InputError if git fails.
class Repository {
 public:
  // folder: any folder of the work tree. option is the command-line option that named it, purpose the reason
  // why it must be in a repository; both for messages.
  Repository(const std::string& folder, const std::string& option, const std::string& purpose);

  std::string commit() const;                             // the commit checked out
  bool is_top() const { return prefix_.empty(); }         // folder is the top folder of the work tree
  std::time_t time() const;                               // of that commit
  // Output of `git status --porcelain`, leaving out one path relative to folder; empty if nothing differs.
  std::string changes(const std::string& except = "") const;
  // Whether the commit checked out is this one or descends from it.
  bool follows(const std::string& commit) const;
  // Names of the files under version control below a path, relative to folder.
  std::vector<std::string> files(const std::string& under) const;
  // The files of the commit as a tar archive, whose header holds the commit's identifier.
  std::string source(const std::string& prefix) const;

 private:
  std::string git(const std::string& arguments) const;

  std::string folder_, option_, prefix_;
};

}  // namespace bristle
