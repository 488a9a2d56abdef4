#include "archive/build.hpp"

#include "archive/bag.hpp"
#include "archive/gather.hpp"
#include "archive/verify.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/sha.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

BagInfo bag_info_of(const Gathered& gathered) {
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

}  // namespace

BuiltArchive build_archive(const ArchiveOptions& options) {
  const FileKind kind = {"an archive of bristle", "bristle-", {"/bag-info.txt"}};
  if (!options.output.empty()) require_replaceable(options.output, kind);
  const Gathered gathered = gather(options);
  const std::string folder = "bristle-" + gathered.version;
  BuiltArchive built;
  built.path = options.output.empty() ? "dist/" + folder + ".tar" : options.output;
  built.draft = gathered.contents.draft;
  WholeFile out(built.path, kind);
  Digest digest(Sha::bits_512);
  write_tar(make_bag(folder, gathered.contents.payload, bag_info_of(gathered)), gathered.time,
            [&](const char* bytes, std::size_t size) {
              out.write(bytes, size);
              digest.add(bytes, size);
              built.bytes += size;
            });
  out.close();
  const Verification verified = verify_archive(out.partial());
  if (!verified.problems.empty())
    throw RunError(fmt::format("verification of the new archive failed, nothing was written: {}",
                               verified.problems.front()));
  out.publish();
  built.files = verified.files;
  built.sha512 = digest.hex();
  return built;
}

}  // namespace bristle::archive
