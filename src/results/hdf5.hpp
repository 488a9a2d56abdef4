#pragma once

#include <hdf5.h>
#include <string>
#include <vector>

// Thin ownership over HDF5's C interface: every handle is closed, every return code looked at.
namespace bristle::h5 {

// Throws RunError naming what failed and HDF5's innermost reason, if code is negative; else returns it.
template <class Code>
Code check(Code code, const std::string& what);
[[noreturn]] void fail(const std::string& what);

// Call first. Stops HDF5 from printing its error stack (errors become exceptions) and from cleaning up at
// exit.
void silence();

class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close, const std::string& what) : id_(check(id, what)), close_(close) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();

  operator hid_t() const { return id_; }
  // Closes and looks at the result, which a destructor cannot report.
  void close(const std::string& what);

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

using Shape = std::vector<hsize_t>;
// Position of a point in a row-major grid of this shape.
Shape position(const std::vector<std::size_t>& shape, std::size_t index);

Handle create_file(const std::string& path);
Handle open_file(const std::string& path, bool writable);
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
Handle open_dataset(hid_t parent, const std::string& name);
bool exists(hid_t parent, const std::string& name);

// A dataset without time stamps. An empty shape is a scalar; a first extent of H5S_UNLIMITED appends.
// Doubles are filled with NaN.
Handle create_dataset(hid_t parent, const std::string& name, hid_t type, const Shape& shape);
Shape shape_of(hid_t dataset);
hsize_t length_of(hid_t dataset);  // of one dimension; else throws RunError
// Part of a dataset: count elements along each dimension from start. Throws RunError if it has other
// dimensions.
void write_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, const void* data);
void read_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, void* data);

void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, const char* text);
void write_attribute(hid_t object, const std::string& name, long value);
void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, const std::vector<signed char>& values);
// Single values; of a list they throw RunError.
std::string read_text_attribute(hid_t object, const std::string& name);
double read_number_attribute(hid_t object, const std::string& name);
long read_integer_attribute(hid_t object, const std::string& name);
bool has_attribute(hid_t object, const std::string& name);
std::vector<std::string> attribute_names(hid_t object);
// Names of the links of a group, ascending.
std::vector<std::string> children(hid_t group);
bool is_group(hid_t parent, const std::string& name);

// Makes dataset a dimension scale (a coordinate), or labels a dataset's dimension with one.
void make_scale(hid_t dataset, const std::string& name);
void attach_scale(hid_t dataset, hid_t scale, unsigned dimension);
bool is_scale(hid_t dataset);
// Name of the scale on a dimension; empty if there is none.
std::string scale_name(hid_t dataset, unsigned dimension);

template <class Code>
Code check(Code code, const std::string& what) {
  if (code < 0) fail(what);
  return code;
}

}  // namespace bristle::h5
