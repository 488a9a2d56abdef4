#pragma once

#include "util/error.hpp"

#include <hdf5.h>
#include <string>
#include <vector>

// Thin wrapper of HDF5's C interface: closes every handle and checks every return code.
namespace bristle::h5 {

// Throws RunError with what, the operation that failed, and HDF5's innermost reason.
[[noreturn]] void fail(const std::string& what);

// Returns code; fails if it is negative.
template <class Code>
Code check(Code code, const std::string& what) {
  if (code < 0) fail(what);
  return code;
}

// Calls work(), which uses the file at path, and adds the path to the message of a RunError.
template <class Work>
void in_file(const std::string& path, const Work& work) {
  try {
    work();
  } catch (const RunError& e) {
    throw RunError(path + ": " + e.what());
  }
}

// Prevents HDF5 from printing its error stack, as errors become exceptions, and from cleaning up at exit.
// Call it before all other functions.
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
  // Closes the handle. Throws RunError if closing fails, which the destructor cannot do.
  void close(const std::string& what);

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

using Shape = std::vector<hsize_t>;
// Returns the position of a point in a row-major grid of this shape.
Shape position(const std::vector<std::size_t>& shape, std::size_t index);

Handle create_file(const std::string& path);
Handle open_file(const std::string& path, bool writable);
// Opens a file in memory for reading. bytes need not outlive the call.
Handle open_image(const std::string& bytes);
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
Handle open_dataset(hid_t parent, const std::string& name);
bool exists(hid_t parent, const std::string& name);

// Creates a dataset without time stamps. An empty shape creates a scalar, a first extent of H5S_UNLIMITED a
// dataset that can grow. Doubles are filled with NaN, which the attribute _FillValue states.
Handle create_dataset(hid_t parent, const std::string& name, hid_t type, const Shape& shape);
Handle type_of(hid_t dataset);
bool is_text(hid_t dataset);
Shape shape_of(hid_t dataset);
hsize_t length_of(hid_t dataset);  // throws RunError unless the dataset has one dimension
// Writes a part of a dataset: count elements along each dimension from start. Throws RunError if the number
// of dimensions differs.
void write_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, const void* data);
// Reads a part of a dataset, with the arguments and errors of write_part().
void read_part(hid_t dataset, hid_t type, const Shape& start, const Shape& count, void* data);

// Writes the values of a dataset in row-major order, in large blocks.
class BlockWriter {
 public:
  BlockWriter(Handle dataset, const Shape& shape);

  // Appends values, which are in the file after flush(). HDF5 converts them to the dataset's type.
  void append(const std::vector<double>& values);
  void flush();

 private:
  Handle dataset_;
  std::vector<std::size_t> shape_;
  std::size_t first_ = 0;  // place of the first value that is not yet in the file
  std::vector<double> values_;
};

// Creates a dataset of texts: the words of a swept choice, or a column of /checks. The texts have a variable
// length, because the netCDF library crashes on arrays of texts of fixed length.
Handle create_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts);
// Reads a dataset of texts. HDF5 trusts the lengths that the file states: call this function for a file of
// unknown origin only in a process of its own.
std::vector<std::string> read_texts(hid_t dataset);

void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, long value);
void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, const std::vector<signed char>& values);
// Reads an attribute as a text. Throws RunError if the attribute is not a single value.
std::string read_text_attribute(hid_t object, const std::string& name);
// Reads an attribute as an integer. Throws RunError if the attribute is not a single value.
long read_integer_attribute(hid_t object, const std::string& name);
bool has_attribute(hid_t object, const std::string& name);
std::vector<std::string> attribute_names(hid_t object);
// Returns the names of the links of a group in ascending order.
std::vector<std::string> children(hid_t group);
bool is_group(hid_t parent, const std::string& name);

// Turns a dataset into a dimension scale, which holds coordinates.
void make_scale(hid_t dataset, const std::string& name);
// Attaches a dimension scale to a dimension of a dataset.
void attach_scale(hid_t dataset, hid_t scale, unsigned dimension);
bool is_scale(hid_t dataset);
// Returns the name of the dimension scale of a dimension; empty if the dimension has none.
std::string scale_name(hid_t dataset, unsigned dimension);

}  // namespace bristle::h5
