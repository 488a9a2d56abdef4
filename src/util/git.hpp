#pragma once

#include <ctime>
#include <string>
#include <vector>

namespace bristle {

// The git work tree that is archived. Functions throw InputError if git refuses.
class Repository {
 public:
  explicit Repository(const std::string& folder);

  const std::string& folder() const { return folder_; }
  const std::string& commit() const { return commit_; }  // the one checked out
  std::time_t time() const;                              // of that commit
  std::string changes() const;                           // as `git status --porcelain`; empty: none
  bool follows(const std::string& commit) const;         // this commit descends from that, or is it
  // Names of files under version control, relative to the folder.
  std::vector<std::string> files(const std::string& under) const;
  // Their content as a tar archive; the commit's identifier is in its header.
  std::string source(const std::string& prefix) const;

 private:
  std::string git(const std::string& arguments) const;

  std::string folder_, commit_;
};

}  // namespace bristle
