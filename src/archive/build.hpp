#pragma once

#include <string>

namespace bristle::archive {

struct ArchiveOptions {
  std::string source = ".";  // source repository
  std::string results = "results", figures = "figures";
  std::string report = "report/index.html";
  std::string tier = "full";    // of another one the archive is a draft, without the matrices
  std::string output;           // empty: dist/bristle-<version>.tar or, of another tier, dist/...-<tier>.tar
  bool allow_dirty = false;     // archive, as a draft, results that cannot be traced to a commit
  bool check_only = false;      // write nothing
  std::string version, commit;  // of this program
};

struct BuiltArchive {
  std::string path, sha512, draft;
  std::size_t files = 0, bytes = 0;
};

// Throws InputError for what build_archive() would refuse and no result, figure or page that is still missing
// can change: the work tree, the program, and the origin of the results that are there.
void check_before_archive(const ArchiveOptions& options);

// Gathers the files, writes the archive under a temporary name, verifies it, and renames it. Equal inputs
// give equal bytes. Throws InputError if a file is missing, out of date, damaged or cannot be traced to a
// commit, or if the output cannot be written.
BuiltArchive build_archive(const ArchiveOptions& options);

}  // namespace bristle::archive
