#pragma once

#include <ctime>
#include <string>
#include <vector>

namespace bristle {

// A git work tree, found from a folder alone: variables such as GIT_DIR are ignored. All functions throw
// InputError if git fails.
class Repository {
 public:
  // Finds the work tree. folder: any folder of the work tree that the repository does not ignore. For
  // messages: option, the command-line option that names the folder, and purpose, the reason why the folder
  // must be in a repository.
  Repository(const std::string& folder, const std::string& option, const std::string& purpose);

  std::string commit() const;  // the commit that is checked out
  bool is_top() const;         // true if folder is the top folder of the work tree
  std::time_t commit_time() const;
  // Returns the output of `git status --porcelain` without the path `except`, which is relative to folder;
  // empty if the work tree equals the commit.
  std::string changes(const std::string& except = "") const;
  // Returns true if the commit that is checked out is the given one or descends from it.
  bool descends_from(const std::string& commit) const;
  // Returns the names, relative to folder, of the files under version control below a path.
  std::vector<std::string> files(const std::string& under) const;
  // Returns the files of the commit as a tar archive, whose header contains the commit's identifier.
  std::string source_archive(const std::string& prefix) const;

 private:
  std::string git(const std::string& arguments) const;

  std::string folder_, option_, top_;
};

}  // namespace bristle
