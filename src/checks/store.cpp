#include "checks/store.hpp"

#include "results/hdf5.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::checks {
namespace {

// Writes strings of fixed length, as elsewhere in result files.
void write_texts(hid_t group, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string bytes;
  for (std::string text : texts) {
    text.resize(length, '\0');
    bytes += text;
  }
  const h5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "creating a string type");
  h5::check(H5Tset_size(type, length), "sizing a string type");
  h5::check(H5Tset_cset(type, H5T_CSET_UTF8), "choosing UTF-8");
  h5::check(H5Tset_strpad(type, H5T_STR_NULLPAD), "choosing string padding");
  const h5::Handle dataset = h5::create_dataset(group, name, type, {texts.size()});
  h5::write_part(dataset, type, {0}, {texts.size()}, bytes.data());
}

}  // namespace

void write_checks(const std::string& path, const std::vector<CheckResult>& checks) {
  h5::Handle file = h5::open_file(path, true);
  if (h5::exists(file, "checks")) h5::check(H5Ldelete(file, "checks", H5P_DEFAULT), "replacing /checks");
  if (!checks.empty()) {
    h5::Handle group = h5::create_group(file, "checks");
    const auto texts = [&](const std::string& name, auto text) {
      std::vector<std::string> all;
      for (const CheckResult& c : checks) all.push_back(text(c));
      write_texts(group, name, all);
    };
    const auto numbers = [&](const std::string& name, auto number) {
      std::vector<double> all;
      for (const CheckResult& c : checks) all.push_back(number(c));
      const h5::Handle dataset = h5::create_dataset(group, name, H5T_NATIVE_DOUBLE, {all.size()});
      h5::write_part(dataset, H5T_NATIVE_DOUBLE, {0}, {all.size()}, all.data());
    };
    texts("claim", [](const CheckResult& c) { return c.check.claim; });
    texts("statement", [](const CheckResult& c) { return c.check.statement; });
    texts("is", [](const CheckResult& c) { return std::string(to_string(c.check.criterion)); });
    texts("verdict", [](const CheckResult& c) { return std::string(to_string(c.verdict)); });
    numbers("measured", [](const CheckResult& c) { return c.measured.value; });
    numbers("uncertainty", [](const CheckResult& c) { return c.measured.uncertainty; });
    numbers("threshold", [](const CheckResult& c) { return c.check.threshold; });
    numbers("band", [](const CheckResult& c) { return c.check.band.value_or(NAN); });
    numbers("margin", [](const CheckResult& c) { return c.margin; });
    numbers("significance", [](const CheckResult& c) { return c.measured.significance; });
    group.close("closing /checks");
  }
  file.close("closing " + path);
}

}  // namespace bristle::checks
