#include "fuzz.hpp"

#include "archive/result_facts.hpp"
#include "archive/tar.hpp"
#include "compare/comparison.hpp"
#include "compare/reference.hpp"
#include "results/inspect.hpp"
#include "util/error.hpp"
#include "unit/small_result.hpp"

#include <fuzzer/FuzzedDataProvider.h>

// Uses the bytes to replace attributes, texts, shapes, types and numbers of a valid small result.
using namespace bristle;
using namespace bristle::testing;

namespace {

struct Original {
  Scratch s;
  Experiment experiment = small_experiment(s);
  std::string bytes = bytes_of(small_result(s, "original.h5", experiment));
};

using Bytes = FuzzedDataProvider;

// Name of an object in the root, or a name that does not exist.
std::string some_object(hid_t file, Bytes& in) {
  std::vector<std::string> names = h5::children(file);
  names.push_back("other");
  return names[in.ConsumeIntegralInRange<std::size_t>(0, names.size() - 1)];
}

void change_attribute(hid_t object, Bytes& in) {
  std::vector<std::string> names = h5::attribute_names(object);
  names.push_back("other");
  const std::string name = names[in.ConsumeIntegralInRange<std::size_t>(0, names.size() - 1)];
  if (name == "DIMENSION_LIST" || name == "REFERENCE_LIST")
    return;  // internal to HDF5, which crashes on malformed ones
  switch (in.ConsumeIntegralInRange(0, 3)) {
    case 0: h5::write_attribute(object, name, in.ConsumeRandomLengthString()); break;
    case 1: h5::write_attribute(object, name, in.ConsumeIntegral<long>()); break;
    case 2:
      h5::write_attribute(object, name, std::vector<signed char>(in.ConsumeIntegral<std::uint8_t>() % 9));
      break;
    default:
      if (h5::has_attribute(object, name)) H5Adelete(object, name.c_str());
  }
}

void change_dataset(hid_t file, const std::string& name, Bytes& in) {
  if (h5::exists(file, name)) H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  if (in.ConsumeBool()) return;
  h5::Shape shape(in.ConsumeIntegralInRange<std::size_t>(0, 3));
  std::size_t size = 1;
  for (hsize_t& n : shape) size *= n = in.ConsumeIntegralInRange<hsize_t>(0, 4);
  const bool flags = in.ConsumeBool();
  const h5::Handle dataset =
      h5::create_dataset(file, name, flags ? H5T_NATIVE_SCHAR : H5T_NATIVE_DOUBLE, shape);
  std::vector<double> numbers(size);
  for (double& x : numbers) x = in.ConsumeFloatingPoint<double>();
  if (size) h5::write_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, numbers.data());
}

void change_number(hid_t file, const std::string& name, Bytes& in) {
  if (!h5::exists(file, name) || h5::is_group(file, name)) return;
  const h5::Handle dataset = h5::open_dataset(file, name);
  h5::Shape at = h5::shape_of(dataset);
  for (hsize_t& n : at) n = n ? in.ConsumeIntegralInRange<hsize_t>(0, n - 1) : 0;
  const double value = in.ConsumeFloatingPoint<double>();
  try {
    h5::write_part(dataset, H5T_NATIVE_DOUBLE, at, h5::Shape(at.size(), 1), &value);
  } catch (const RunError&) {  // a dataset of texts, or an empty one
  }
}

void change(hid_t file, Bytes& in) {
  for (int n = 0; n < 8 && in.remaining_bytes() > 0; ++n) {
    const std::string name = some_object(file, in);
    switch (in.ConsumeIntegralInRange(0, 3)) {
      case 0: change_attribute(file, in); break;
      case 1: change_dataset(file, name, in); break;
      case 2: change_number(file, name, in); break;
      default:
        if (h5::exists(file, name))
          change_attribute(h5::Handle(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose, name), in);
    }
  }
}

// The readers of results. Each run uses one of them, because HDF5 takes most of the time.
enum class Reader {
  facts,
  difference,
  points,
  reference,
  kMaxValue = reference
};

void read(const Original& original, const std::string& path, Reader reader) {
  // ResultReader does this in a child process, where a crash is no finding.
  require_plain_hdf5(h5::open_file(path, false), std::filesystem::file_size(path));
  const ResultReader result(path);
  switch (reader) {
    case Reader::facts:
      for (const std::string& name : result.datasets()) result.variable(name);
      payload_sha256(h5::open_file(path, false));
      result_facts(result).dump();
      break;
    case Reader::difference:
      comparison_text(diff_results(result, ResultReader(original.s.path("original.h5")), {}));
      break;
    case Reader::points: {
      const Experiment experiment = stored_experiment(result.experiment(), result.text("tier"), path);
      for (std::size_t i = 0; i < std::min<std::size_t>(experiment.sweep.size(), 6); ++i)
        read_record(result, experiment.sweep, i);
      break;
    }
    case Reader::reference: {
      checks_table(evaluate_checks(result), true, 80);
      reference_of(path);
      break;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  h5::silence();
  static const Original original;
  const std::string path = original.s.write("fuzz.h5", original.bytes);
  Bytes in(data, size);
  const auto reader = in.ConsumeEnum<Reader>();
  try {
    {
      const h5::Handle file = h5::open_file(path, true);
      change(file, in);
    }
    read(original, path, reader);
  } catch (const InputError&) {
  } catch (const RunError&) {
  } catch (const MalformedError&) {
  }
  return 0;
}
