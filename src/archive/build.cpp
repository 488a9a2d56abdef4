#include "archive/build.hpp"

#include "archive/verify.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <filesystem>
#include <fstream>

namespace bristle {
namespace fs = std::filesystem;
namespace {

BagInfo info_of(const Gathered& gathered) {
  const Json& citation = gathered.contents.citation;
  const Json& author = citation["authors"][0];
  BagInfo info = {{"Source-Organization", author.value("name", author.value("family-names", ""))},
                  {"External-Description", citation["title"]},
                  {"Bagging-Date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(gathered.time))},
                  {"Bag-Software-Agent", "bristle " + gathered.version},
                  {"Source-Date-Epoch", fmt::format("{}", long(gathered.time))}};
  if (!gathered.contents.draft.empty()) info.push_back({"Draft", gathered.contents.draft});
  return info;
}

std::ofstream open_output(const std::string& path, const std::string& partial) {
  std::error_code ignored;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, ignored);
  if (fs::is_directory(path)) throw InputError(fmt::format("-o {}: is a folder; give a file name", path));
  std::ofstream out(partial, std::ios::binary);
  if (!out) throw InputError(fmt::format("-o {}: cannot be written; give another place with -o", path));
  return out;
}

// Removes the temporary file unless it got its name.
struct Partial {
  std::string path;
  ~Partial() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

}  // namespace

BuiltArchive build_archive(const ArchiveOptions& options) {
  const Gathered gathered = gather(options);
  const std::string folder = "bristle-" + gathered.version;
  BuiltArchive built;
  built.path = options.output.empty() ? "dist/" + folder + ".tar" : options.output;
  built.draft = gathered.contents.draft;
  const Partial partial{built.path + ".partial"};
  std::ofstream out = open_output(built.path, partial.path);
  Digest digest(Sha::bits_512);
  write_tar(make_bag(folder, gathered.contents.payload, info_of(gathered)), gathered.time,
            [&](const char* bytes, std::size_t size) {
              out.write(bytes, std::streamsize(size));
              digest.add(bytes, size);
              built.bytes += size;
            });
  out.close();
  if (!out) throw RunError(fmt::format("{}: cannot be written to the end: is there room?", partial.path));
  const Verification verified = verify_archive(partial.path);
  if (!verified.problems.empty())
    throw RunError(
        fmt::format("the archive does not verify, nothing was written: {}", verified.problems.front()));
  fs::rename(partial.path, built.path);
  built.files = verified.files;
  built.sha512 = digest.hex();
  return built;
}

}  // namespace bristle
