#include "archive/build.hpp"

#include "archive/verify.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>

namespace bristle::archive {
BuiltArchive build_archive(const ArchiveOptions& options) {
  const FileKind kind = {"an archive of bristle", "bristle-", {"/bag-info.txt"}};
  if (!options.output.empty()) require_replaceable(options.output, kind);
  const Gathered gathered = gather(options);
  const std::string folder = folder_of(gathered.contents);
  BuiltArchive built;
  built.path = options.output.empty() ? "dist/" + folder + ".tar" : options.output;
  built.draft = gathered.contents.draft;
  WholeFile out(built.path, kind);
  Digest digest(Sha::bits_512);
  write_tar(in_folder(folder, bag_of(gathered.contents, gathered.time)), gathered.time,
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
