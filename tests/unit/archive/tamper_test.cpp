#include "util/error.hpp"
#include "small_archive.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <cstring>
#include <fcntl.h>
#include <random>

// Archives that were changed: every change is found, its place is named, and it causes no harm.
namespace bristle::tamper_test {
using namespace testing;
using Catch::Contains;

namespace {

std::string problems_text(const Problems& problems) {
  std::string text;
  for (const std::string& problem : problems) text += problem + "\n";
  return text;
}

std::string problems_of(const std::string& archive) {
  const Scratch s;
  return problems_text(verify_bytes(s, archive).problems);
}

std::size_t padded(std::size_t size) { return (size + 511) / 512 * 512; }

// One entry of a tar archive with arbitrary header fields.
std::string entry(const std::string& name, char type, const std::string& content,
                  const std::string& link = "", const std::string& size = "") {
  std::string header(512, '\0');
  const auto put_at = [&](std::size_t at, const std::string& text) { header.replace(at, text.size(), text); };
  put_at(0, name);
  put_at(100, "0000644");
  put_at(108, "0000000");
  put_at(116, "0000000");
  put_at(124, size.empty() ? fmt::format("{:011o}", content.size()) : size);
  put_at(136, "00000000001");
  put_at(148, "        ");
  header[156] = type;
  put_at(157, link);
  put_at(257, std::string("ustar\00000", 8));
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  put_at(148, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
  std::string body = content;
  body.resize(padded(content.size()), '\0');
  return header + body;
}

std::string ended(const std::string& entries) { return entries + std::string(10240, '\0'); }

// The archive with a changed result and matching manifests.
std::string with_result(const std::function<void(hid_t file)>& change) {
  return repacked(sound(), [&](Files& payload) {
    const Scratch s;
    const std::string path = s.write("r.h5", payload["results/small.h5"]);
    {
      const h5::Handle file = h5::open_file(path, true);
      change(file);
    }
    payload["results/small.h5"] = bytes_of(path);
  });
}

}  // namespace

TEST_CASE("a flipped bit is found anywhere in the archive, and its place is named") {
  const Scratch s;
  const std::string path = s.write("a.tar", sound());
  const int file = open(path.c_str(), O_RDWR);
  const Files files = read_tar(bytes_of(path));
  std::size_t tried = 0;
  const auto flip = [&](std::size_t at, char mask, const std::vector<std::string>& names) {
    const char changed = char(sound()[at] ^ mask);
    REQUIRE(pwrite(file, &changed, 1, off_t(at)) == 1);
    const std::string found = problems_text(verify_archive(path).problems);
    REQUIRE(pwrite(file, &sound()[at], 1, off_t(at)) == 1);
    const bool named = std::any_of(names.begin(), names.end(),
                                   [&](const std::string& n) { return found.find(n) != std::string::npos; });
    if (!named) {
      CAPTURE(at, names, found);
      CHECK(named);
    }
    ++tried;
  };
  std::size_t at = 0, number = 0;
  std::string before = "(byte 0)";
  for (const auto& [name, content] : files) {
    const std::size_t stride = ++number % 5 == 1 ? 1 : 23;
    const std::string short_name = name.substr(name.find('/') + 1);
    // A file name that was flipped in the tag manifest is itself the first word of the message.
    const std::string first = short_name == "tagmanifest-sha512.txt" ? short_name : short_name + ":";
    for (std::size_t i = 0; i < 512; i += stride) flip(at + i, char(1 << (i % 8)), {short_name, before});
    const std::size_t step = std::max<std::size_t>(1, content.size() / 60);
    for (std::size_t i = 0; i < content.size(); i += step) flip(at + 512 + i, char(1 << (i % 8)), {first});
    if (!content.empty()) flip(at + 512 + content.size() - 1, 1, {first});
    for (std::size_t i = content.size(); i < padded(content.size()); i += 41)
      flip(at + 512 + i, 1, {short_name + ": the padding after it"});
    at += 512 + padded(content.size());
    before = "after " + name;
  }
  for (std::size_t i = at; i < sound().size(); i += i < at + 1024 ? 5 : 97)
    flip(i, char(1 << (i % 8)), {"the end of the archive", before});
  flip(sound().size() - 1, 1, {"the end of the archive"});
  close(file);
  CHECK(tried > 2500);
  CHECK(problems_text(verify_archive(path).problems) == "");
}

TEST_CASE("a hash in capital letters is reported as a change") {
  const Scratch s;
  Files files = read_tar(sound());
  for (auto& [name, content] : files)
    if (name.find("/manifest-sha512.txt") != std::string::npos) {
      for (char& c : content)
        if (c >= 'a' && c <= 'f') {
          c = char(std::toupper(c));
          break;
        }
    }
  CHECK_THAT(problems_text(verify_bytes(s, write_tar(files, 1)).problems),
             Contains("manifest-sha512.txt: its SHA-512") && Contains("data/CITATION.cff: its SHA-512"));
}

TEST_CASE("missing, added, renamed and exchanged files are named") {
  const Scratch s;
  const Files files = read_tar(sound());
  const std::string folder = files.begin()->first.substr(0, files.begin()->first.find('/') + 1);
  const auto after = [&](const std::function<void(Files&)>& change) {
    Files changed = files;
    change(changed);
    return problems_text(verify_bytes(s, write_tar(changed, 1)).problems);
  };
  for (const auto& [name, content] : files) {
    CAPTURE(name);
    CHECK_THAT(after([&](Files& f) { f.erase(name); }),
               Contains(name.substr(folder.size()) + ": is missing"));
  }
  CHECK_THAT(after([&](Files& f) { f[folder + "data/new.txt"] = "x"; }),
             Contains("data/new.txt: does not belong here; manifest-sha512.txt does not list it"));
  CHECK_THAT(after([&](Files& f) { f[folder + "fetch.txt"] = "x"; }),
             Contains("fetch.txt: does not belong here"));
  CHECK_THAT(after([&](Files& f) { f["other/file"] = "x"; }), Contains("other/file: lies outside"));
  const std::string renamed = after([&](Files& f) {
    f[folder + "data/LICENCE"] = f[folder + "data/LICENSE"];
    f.erase(folder + "data/LICENSE");
  });
  CHECK_THAT(renamed, Contains("data/LICENSE: is missing") && Contains("data/LICENCE: does not belong here"));
  const std::string exchanged = after([&](Files& f) {
    std::swap(f[folder + "data/figures/small.pdf"], f[folder + "data/figures/small.png"]);
  });
  CHECK_THAT(exchanged, Contains("data/figures/small.pdf: its SHA-512") &&
                            Contains("data/figures/small.png: its SHA-512"));
}

TEST_CASE("a file that was added to the manifest and a folder of another version are found") {
  CHECK_THAT(problems_of(repacked(sound(), [](Files& payload) { payload["new.txt"] = "x"; })),
             Contains("ro-crate-metadata.json: line") && Contains("new.txt"));
  const Scratch s;
  Files files = read_tar(sound()), renamed;
  strip_folder(files);
  for (const auto& [name, content] : files) renamed["bristle-9.9.9/" + name] = content;
  CHECK_THAT(
      problems_text(
          verify_bytes(s, write_tar(renamed, std::stol(bag_info(files, "Source-Date-Epoch")))).problems),
      Contains("bristle-9.9.9: is the folder of another version"));
}

TEST_CASE("control characters of an archive do not reach the terminal") {
  const Scratch s;
  Files files = read_tar(sound());
  for (auto& [name, content] : files)
    if (name.find("/manifest-sha512.txt") != std::string::npos)
      content = std::string(128, 'f') + "  data/\x1b]0;evil\x07\n" + content;
  CHECK_THAT(problems_text(verify_bytes(s, write_tar(files, 1)).problems),
             Contains("data/\\x1b]0;evil\\x07: is missing") && !Contains("\x1b"));
}

TEST_CASE("harmful tar entries are refused by name, and nothing is unpacked") {
  const auto refused = [](const std::string& entries) { return problems_of(ended(entries)); };
  CHECK_THAT(refused(entry("../evil", '0', "x")), Contains("\"../evil\": leads out of the archive"));
  CHECK_THAT(refused(entry("b/../../evil", '0', "x")), Contains("leads out of the archive"));
  CHECK_THAT(refused(entry("/etc/evil", '0', "x")), Contains("\"/etc/evil\": leads out of the archive"));
  CHECK_THAT(refused(entry("b/link", '2', "", "/etc/passwd")), Contains("\"b/link\": is a link"));
  CHECK_THAT(refused(entry("b/link", '1', "", "b/a")), Contains("\"b/link\": is a link"));
  CHECK_THAT(refused(entry("b/folder/", '5', "")),
             Contains("\"b/folder/\": is a link, a folder or a device"));
  for (const char type : {'3', '4', '6'})
    CHECK_THAT(refused(entry("b/device", type, "")),
               Contains("\"b/device\": is a link, a folder or a device"));
  CHECK_THAT(refused(entry("b/a", '0', "x") + entry("b/a", '0', "y")), Contains("b/a: its tar header"));
  CHECK_THAT(refused(entry("b/b", '0', "x") + entry("b/a", '0', "y")), Contains("b/a: its tar header"));
  CHECK_THAT(refused(entry("b/\x1b[2Jx", '0', "x")),
             Contains("\\u001b[2Jx") && Contains("names may contain"));
  CHECK_THAT(refused(entry("b/\xff", '0', "x")), Contains("b/\\ufffd"));
  CHECK_THAT(refused(entry("b//a", '0', "x")),
             Contains("\"b//a\": leads out of the archive, or is not the shortest form"));
  CHECK_THAT(refused(entry("././@LongLink", 'L', "b/a") + entry("b/a", '0', "x")),
             Contains("b/a: its tar header"));
  CHECK_THAT(refused(entry("p", 'x', "16 path=../evil\n") + entry("b/a", '0', "x")),
             Contains("\"../evil\": leads out of the archive"));
  CHECK_THAT(refused(entry("p", 'x', "22 GNU.sparse.major=1\n") + entry("b/a", '0', "x")),
             Contains("its tar header"));
}

TEST_CASE("entries that are exchanged, repeated, or have another time, owner or mode are named") {
  const Files files = read_tar(sound());
  const auto& [first, content] = *files.begin();
  const auto& [second, more] = *std::next(files.begin());
  const std::size_t a = 512 + padded(content.size()), b = 512 + padded(more.size());
  const std::string one = sound().substr(0, a), two = sound().substr(a, b), rest = sound().substr(a + b);
  CHECK(problems_of(one + two + rest) == "");
  CHECK_THAT(problems_of(two + one + rest), Contains(first + ": its tar header"));
  CHECK_THAT(problems_of(one + one + two + rest), Contains(second + ": its tar header"));
  for (const std::size_t at : {146, 113, 105}) {
    std::string header = one;
    const int change = header[at] == '7' ? -1 : 1;  // of an octal digit
    header[at] = char(header[at] + change);
    header.replace(
        148, 6, fmt::format("{:06o}", std::stoul(header.substr(148, 6), nullptr, 8) + std::size_t(change)));
    CHECK_THAT(problems_of(header + two + rest), Contains(first + ": its tar header"));
  }
}

TEST_CASE("bag-info.txt must follow from the other files, also if the manifest is made for it") {
  Files files = read_tar(sound());
  const std::string folder = strip_folder(files);
  const std::time_t time = std::stol(bag_info(files, "Source-Date-Epoch"));
  Files payload;
  for (const auto& [name, bytes] : files)
    if (name.starts_with("data/")) payload[name.substr(5)] = bytes;
  const auto with = [&](const BagInfo& info) {
    return problems_of(write_tar(in_folder(folder, make_bag(payload, info)), time));
  };
  CHECK_THAT(with({{"Source-Organization", "Mallory"}, {"Source-Date-Epoch", fmt::format("{}", time)}}),
             Contains("bag-info.txt: line 1 is \"Source-Organization: Mallory\""));
  CHECK_THAT(with({{"Source-Date-Epoch", "x"}}), Contains("Source-Date-Epoch is not a number of seconds"));
}

TEST_CASE("declared sizes beyond the end of the file are refused") {
  for (const char* size : {"77777777777", "00077777777", "-0000000001"}) {
    CAPTURE(size);
    CHECK_THAT(problems_of(ended(entry("b/a", '0', "x", "", size))), Contains("b/a"));
  }
  CHECK_THAT(problems_of(ended(
                 entry("b/a", '0', "x", "", std::string("\x80\0\0\0\x7f\xff\xff\xff\xff\xff\xff\xff", 12)))),
             Contains("b/a"));
}

TEST_CASE("truncated, extended, compressed and empty archives and other files are refused") {
  for (const std::size_t size : {std::size_t(1), std::size_t(511), std::size_t(700), sound().size() / 2,
                                 sound().size() - 10240, sound().size() - 1}) {
    CAPTURE(size);
    CHECK(problems_of(sound().substr(0, size)) != "");
  }
  CHECK_THAT(problems_of(sound() + "x"), Contains("the end of the archive: there are bytes after it"));
  CHECK_THAT(problems_of(sound() + sound()), Contains("the end of the archive"));
  CHECK_THAT(problems_of("\x1f\x8b\x08 and so on"),
             Contains("compressed (gzip)") && Contains("unpack it first"));
  CHECK_THAT(problems_of("PK\x03\x04"), Contains("compressed (zip)"));
  CHECK_THAT(problems_of(""), Contains("the file is empty"));
  CHECK_THAT(problems_of("hello"), Contains("no tar archive"));
  CHECK_THAT(problems_of(std::string(20480, '\0')), Contains("no files") || Contains("no tar archive"));
  CHECK_THROWS_AS(verify_archive("/nowhere.tar"), InputError);
  CHECK_THROWS_AS(verify_archive("/dev/zero"), InputError);
  CHECK_THROWS_AS(verify_archive("/tmp"), InputError);
}

TEST_CASE("HDF5 files with links, cycles, compression or excessive sizes are refused") {
  CHECK_THAT(problems_of(with_result([](hid_t file) {
               h5::check(H5Lcreate_external("/etc/passwd", "/x", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT),
                         "");
             })),
             Contains("data/results/small.h5: /elsewhere: a soft or external link"));
  CHECK_THAT(problems_of(with_result([](hid_t file) {
               h5::check(H5Lcreate_soft("/R_x", file, "soft", H5P_DEFAULT, H5P_DEFAULT), "");
             })),
             Contains("/soft: a soft or external link"));
  CHECK_THAT(problems_of(with_result([](hid_t file) {
               const h5::Handle group = h5::create_group(file, "circle");
               h5::check(H5Lcreate_hard(file, "circle", group, "again", H5P_DEFAULT, H5P_DEFAULT), "");
             })),
             Contains("nested too deeply") || Contains("too many"));
  const auto with_dataset = [](hsize_t size, bool deflated) {
    return problems_of(with_result([=](hid_t file) {
      const hsize_t chunk = 1024;
      const h5::Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "");
      const h5::Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "");
      H5Pset_chunk(how, 1, &chunk);
      if (deflated) H5Pset_deflate(how, 9);
      const h5::Handle data(H5Dcreate2(file, "big", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT),
                            H5Dclose, "");
    }));
  };
  CHECK_THAT(with_dataset(hsize_t(1) << 50, false),
             Contains("/big: a dataset whose declared size exceeds its stored data"));
  CHECK_THAT(problems_of(with_result([](hid_t file) { h5::create_dataset(file, "text", H5T_C_S1, {1}); })),
             Contains("/text: a dataset of other than numbers"));
  CHECK_THAT(with_dataset(1 << 20, true), Contains("/big: a compressed or filtered dataset"));
}

TEST_CASE("randomly damaged HDF5 with matching manifests causes an error, not a crash") {
  std::mt19937 random(7);
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const std::string archive = repacked(sound(), [&](Files& payload) {
      std::string& bytes = payload["results/small.h5"];
      for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] ^= char(1 << random() % 8);
    });
    const std::string problems = problems_of(archive);
    found += !problems.empty();
    CHECK_THAT(problems, Contains("small.h5") || Contains("ro-crate-metadata.json"));
  }
  CHECK(found == 60);  // always, because the metadata contains the hash of the file
}

}  // namespace bristle::tamper_test
