#include "results/hdf5.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "util/grid.hpp"
#include "json/json.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <hdf5_hl.h>
#include <limits>

namespace bristle::h5 {
namespace {

constexpr const char* kFillValue = "_FillValue";  // name in the conventions of netCDF
constexpr std::size_t kBlock = 16384;             // number of values that a BlockWriter keeps

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* out) {
  if (error->desc) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

// Adds the name of a link or attribute to names; HDF5 calls it for each.
template <class Info>
herr_t add_name(hid_t, const char* name, const Info*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

Handle space_of(hid_t dataset) { return {H5Dget_space(dataset), H5Sclose, "reading a dataset's shape"}; }

Handle selection(hid_t dataset, const Shape& start, const Shape& count) {
  Handle space = space_of(dataset);
  // HDF5 reads one element of start and count per dimension of the dataset, however short the arrays are.
  if (check(H5Sget_simple_extent_ndims(space), "reading a dataset's rank") != int(start.size()))
    throw RunError(fmt::format("HDF5: a dataset does not have {} dimensions", start.size()));
  if (!start.empty())
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
          "selecting a part of a dataset");
  return space;
}

Handle memory_space(const Shape& count) {
  if (count.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "creating a scalar space"};
  return {H5Screate_simple(int(count.size()), count.data(), nullptr), H5Sclose, "creating a space"};
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "creating a string type");
  check(H5Tset_size(type, length), "sizing a string type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "choosing UTF-8");
  return type;
}

void put_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* data) {
  if (has_attribute(object, name)) check(H5Adelete(object, name.c_str()), "replacing attribute " + name);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "creating attribute " + name);
  check(H5Awrite(attribute, type, data), "writing attribute " + name);
}

// Opens an attribute that must be a single value: H5Aread writes all elements of the attribute, however small
// the buffer.
Handle open_attribute(hid_t object, const std::string& name) {
  Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "opening attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "reading the shape of attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw RunError(fmt::format("HDF5: attribute {} is not a single value", name));
  return attribute;
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "creating file properties");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choosing the file format");
  return access;
}

// Returns properties for creating an object: without time stamps, and with the creation order of its
// attributes, without which netCDF programs do not add any.
Handle creation_properties(hid_t kind) {
  Handle creation(H5Pcreate(kind), H5Pclose, "creating an object's properties");
  check(H5Pset_obj_track_times(creation, false), "switching time stamps off");
  check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED), "tracking creation order");
  return creation;
}

// Returns creation_properties() with the creation order of links: netCDF programs write only to groups that
// have this order.
Handle group_properties(hid_t kind) {
  Handle creation = creation_properties(kind);
  check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
        "tracking creation order");
  return creation;
}

void set_fill_and_chunks(hid_t properties, hid_t type, const Shape& shape) {
  if (H5Tequal(type, H5T_NATIVE_DOUBLE) > 0) {
    const double missing = std::numeric_limits<double>::quiet_NaN();
    check(H5Pset_fill_value(properties, type, &missing), "setting the fill value");
  }
  if (shape.empty() || shape[0] != H5S_UNLIMITED) return;
  Shape chunk = shape;
  chunk[0] = 4096;
  check(H5Pset_chunk(properties, int(chunk.size()), chunk.data()), "setting the chunk size");
}

}  // namespace

void fail(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  // HDF5's text surrounds the system's error: "..., errno = 28, error message = ...". Show the latter alone.
  int error = 0;
  if (const auto at = reason.find("errno = "); at != std::string::npos) {
    error = std::atoi(reason.c_str() + at + 8);
    reason = system_reason(error);
  }
  // A malformed file may ask for more memory than the process that reads it may have.
  if (is_of_the_system(error) && error != ENOMEM)
    throw SystemError(fmt::format("HDF5: {} failed: {}", what, reason));
  throw RunError(fmt::format("HDF5: {} failed{}", what, reason.empty() ? "" : ": " + reason));
}

void silence() {
  // NOTE: HDF5 1.10 crashes in its clean-up at exit if a write failed before (full disk).
  H5dont_atexit();
  // NOTE: HDF5 1.14 explores numbers when it starts, and crashes if sums are not rounded to the nearest
  // number.
  const int rounding = std::fegetround();
  std::fesetround(FE_TONEAREST);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::fesetround(rounding);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

void Handle::close(const std::string& what) {
  const hid_t id = id_;
  id_ = -1;
  if (id >= 0) check(close_(id), what);
}

Handle create_file(const std::string& path) {
  const Handle creation = group_properties(H5P_FILE_CREATE);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, file_access()), H5Fclose, "creating " + path};
}

Handle open_file(const std::string& path, bool writable) {
  return {H5Fopen(path.c_str(), writable ? H5F_ACC_RDWR : H5F_ACC_RDONLY, file_access()), H5Fclose,
          "opening " + path};
}

Handle open_image(const std::string& bytes) {
  const Handle access = file_access();
  check(H5Pset_fapl_core(access, std::size_t(1) << 16, false), "reading a file in memory");
  check(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()), "reading a file in memory");
  return {H5Fopen("in memory", H5F_ACC_RDONLY, access), H5Fclose, "opening a file in memory"};
}

Handle create_group(hid_t parent, const std::string& name) {
  const Handle creation = group_properties(H5P_GROUP_CREATE);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose,
          "creating group " + name};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "opening group " + name};
}

Handle open_dataset(hid_t parent, const std::string& name) {
  return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "opening dataset " + name};
}

bool exists(hid_t parent, const std::string& name) {
  return check(H5Lexists(parent, name.c_str(), H5P_DEFAULT), "looking for " + name) > 0;
}

Handle create_dataset(hid_t parent, const std::string& name, hid_t type, const Shape& shape) {
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  set_fill_and_chunks(creation, type, shape);
  Shape now = shape;
  if (!now.empty() && now[0] == H5S_UNLIMITED) now[0] = 0;
  const Handle space = shape.empty() ? memory_space({})
                                     : Handle(H5Screate_simple(int(shape.size()), now.data(), shape.data()),
                                              H5Sclose, "creating the space of " + name);
  Handle dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                 "creating dataset " + name);
  if (H5Tequal(type, H5T_NATIVE_DOUBLE) > 0)
    write_attribute(dataset, kFillValue, std::numeric_limits<double>::quiet_NaN());
  return dataset;
}

Shape position(const std::vector<std::size_t>& shape, std::size_t index) {
  const auto at = unravel(index, shape);
  return {at.begin(), at.end()};
}

Handle type_of(hid_t dataset) { return {H5Dget_type(dataset), H5Tclose, "reading a dataset's type"}; }

bool is_text(hid_t dataset) { return H5Tget_class(type_of(dataset)) == H5T_STRING; }

Shape shape_of(hid_t dataset) {
  const Handle space = space_of(dataset);
  Shape shape(std::size_t(check(H5Sget_simple_extent_ndims(space), "reading a dataset's rank")));
  if (!shape.empty())
    check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "reading a dataset's shape");
  return shape;
}

hsize_t length_of(hid_t dataset) {
  const Shape shape = shape_of(dataset);
  if (shape.size() != 1) throw RunError("HDF5: a dataset is not one-dimensional");
  return shape[0];
}

void write_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, const void* data) {
  Shape shape = shape_of(dataset);
  if (!shape.empty() && !start.empty() && start[0] + count[0] > shape[0]) {
    shape[0] = start[0] + count[0];
    check(H5Dset_extent(dataset, shape.data()), "extending a dataset");
  }
  const Handle file = selection(dataset, start, count), memory = memory_space(count);
  check(H5Dwrite(dataset, type, memory, file, H5P_DEFAULT, data), "writing a dataset");
}

void read_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, void* data) {
  const Handle file = selection(dataset, start, count), memory = memory_space(count);
  check(H5Dread(dataset, type, memory, file, H5P_DEFAULT, data), "reading a dataset");
}

BlockWriter::BlockWriter(Handle dataset, const Shape& shape)
    : dataset_(std::move(dataset)), shape_(shape.begin(), shape.end()) {}

void BlockWriter::append(const std::vector<double>& values) {
  if (values_.size() + values.size() > kBlock) flush();
  values_.insert(values_.end(), values.begin(), values.end());
}

void BlockWriter::flush() {
  for (std::size_t done = 0; done < values_.size();) {
    const std::size_t left = values_.size() - done;
    const Shape start = position(shape_, first_ + done);
    // Find the largest part of the dataset that begins here and whose values follow one another.
    Shape count(start.size(), 1);
    std::size_t size = 1;
    for (std::size_t d = shape_.size(); d-- > 0;) {
      count[d] = std::min(shape_[d] - std::size_t(start[d]), left / size);
      size *= std::size_t(count[d]);
      if (count[d] < shape_[d]) break;
    }
    write_part(dataset_, H5T_NATIVE_DOUBLE, start, count, values_.data() + done);
    done += size;
  }
  first_ += values_.size();
  values_.clear();
}

Handle create_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  const Handle type = text_type(H5T_VARIABLE);
  Handle dataset = create_dataset(parent, name, type, {texts.size()});
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  write_part(dataset, type, {0}, {texts.size()}, pointers.data());
  return dataset;
}

std::vector<std::string> read_texts(hid_t dataset) {
  const Handle type = text_type(H5T_VARIABLE), space = space_of(dataset);
  const Shape shape = shape_of(dataset);
  std::vector<char*> pointers(std::size_t(H5Sget_simple_extent_npoints(space)), nullptr);
  if (pointers.empty()) return {};
  read_part(dataset, type, Shape(shape.size(), 0), shape, pointers.data());
  std::vector<std::string> texts;
  for (const char* text : pointers) texts.emplace_back(text ? text : "");
  check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data()), "freeing texts");
  return texts;
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type = text_type(std::max<std::size_t>(1, text.size()));
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "choosing string padding");
  put_attribute(object, name, type, memory_space({}), text.empty() ? "\0" : text.data());
}

void write_attribute(hid_t object, const std::string& name, long value) {
  put_attribute(object, name, H5T_NATIVE_LONG, memory_space({}), &value);
}

void write_attribute(hid_t object, const std::string& name, double value) {
  put_attribute(object, name, H5T_NATIVE_DOUBLE, memory_space({}), &value);
}

void write_attribute(hid_t object, const std::string& name, const std::vector<signed char>& values) {
  put_attribute(object, name, H5T_NATIVE_SCHAR, memory_space({values.size()}), values.data());
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_attribute(object, name);
  const Handle type(H5Aget_type(attribute), H5Tclose, "reading the type of attribute " + name);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    fail("reading attribute " + name + " as text of fixed length");
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attribute, type, text.data()), "reading attribute " + name);
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  if (!is_utf8(text)) throw RunError(fmt::format("HDF5: attribute {} is not text in UTF-8", name));
  return text;
}

long read_integer_attribute(hid_t object, const std::string& name) {
  long value = 0;
  check(H5Aread(open_attribute(object, name), H5T_NATIVE_LONG, &value), "reading attribute " + name);
  return value;
}

bool has_attribute(hid_t object, const std::string& name) {
  return check(H5Aexists(object, name.c_str()), "looking for attribute " + name) > 0;
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name<H5A_info_t>, &names),
        "listing attributes");
  return names;
}

std::vector<std::string> children(hid_t group) {
  std::vector<std::string> names;
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name<H5L_info_t>, &names),
        "listing a group");
  return names;
}

bool is_group(hid_t parent, const std::string& name) {
  const Handle object(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose, "opening " + name);
  return H5Iget_type(object) == H5I_GROUP;
}

void make_scale(hid_t dataset, const std::string& name) {
  check(H5DSset_scale(dataset, name.c_str()), "making a dimension scale of " + name);
  // Coordinates have no missing values.
  if (has_attribute(dataset, kFillValue)) check(H5Adelete(dataset, kFillValue), "removing the fill value");
}

void attach_scale(hid_t dataset, hid_t scale, unsigned dimension) {
  check(H5DSattach_scale(dataset, scale, dimension), "attaching a dimension scale");
}

bool is_scale(hid_t dataset) { return check(H5DSis_scale(dataset), "looking for a dimension scale") > 0; }

std::string scale_name(hid_t dataset, unsigned dimension) {
  hid_t first = -1;
  const auto visit = [](hid_t, unsigned, hid_t scale, void* out) -> herr_t {
    H5Iinc_ref(scale);
    *static_cast<hid_t*>(out) = scale;
    return 1;
  };
  check(H5DSiterate_scales(dataset, dimension, nullptr, visit, &first), "reading dimension scales");
  if (first < 0) return "";
  const Handle scale(first, H5Dclose, "opening a dimension scale");
  // NOTE: H5DSget_scale_name() writes beyond its buffer if a damaged NAME is not a single text.
  return has_attribute(scale, "NAME") ? read_text_attribute(scale, "NAME") : "";
}

}  // namespace bristle::h5
