#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bristle::results {

// How a file stores the values of an array.
enum class Number {
  real,
  integer,
  code,  // index of a word of a choice
  text   // the words themselves
};

// What an array contains: a variable over the sweep, or a column of a table.
struct Column {
  std::string name, long_name{}, symbol{}, equation{};
  Number number = Number::real;
  std::vector<std::string> words{};  // words of the values 0, 1, ...; empty for numbers
  std::string units = "1";           // "": none, and the file states none
  std::vector<std::pair<std::string, double>> constants{};  // constants of the definition, as attributes
  std::string ancillary{};                                  // names of variables about this one
  std::vector<std::pair<std::string, std::string>> attributes{};  // further ones, such as "formula"
};

// Numbers, or codes of words, over named dimensions.
struct Array {
  Column about;
  std::vector<std::string> dimensions{};
  std::vector<std::size_t> shape{};  // size of each dimension
  std::vector<double> values{};      // in row-major order
  bool coordinate = false;           // the array holds the coordinates of the dimension of its name

  // Returns the word of a code, or a number with enough digits to identify it.
  std::string text(double value) const;
  // Returns the text of the value at index i; empty for NaN.
  std::string cell(std::size_t i) const;
};

// Returns the coordinates of a dimension, an array over this dimension alone. With words, the values are
// their codes.
Array coordinates(const Column& about, std::vector<double> values);
Array coordinates(const std::string& name, const std::string& meaning, const std::vector<std::string>& words);
// Returns the coordinates 0, 1, ..., count - 1.
Array row_numbers(const std::string& name, const std::string& meaning, std::size_t count);

// Arrays over common dimensions: a table, a group of a result file, or the numbers of a reference.
class Dataset {
 public:
  explicit Dataset(std::string name = "") : name_(std::move(name)) {}

  // Adds a dimension. Call it before adding arrays; the last dimension varies fastest.
  void add_dimension(Array coordinates);
  // Adds a dimension of the sweep, whose coordinates are in the root of a result file.
  void add_axis(const std::string& name, std::size_t size);
  // Adds an array over all dimensions; of(i) returns its value at index i, a number or a text.
  template <class Of>
  void add(Column about, const Of& of) {
    Array& array = add_array(std::move(about));
    for (std::size_t i = 0; i < size(); ++i)
      if constexpr (std::is_convertible_v<decltype(of(i)), std::string>) add_word(array, of(i));
      else array.values.push_back(double(of(i)));
  }

  // Adds an array over all dimensions. Requires as many values as the other arrays have.
  void add(Array array);

  // Adds a text about the whole, which may have several lines; a file has it as an attribute of the group.
  void add_text(const std::string& name, const std::string& text) { texts_[name] = text; }

  const std::string& name() const { return name_; }
  const std::map<std::string, std::string>& texts() const { return texts_; }
  const std::vector<Array>& arrays() const { return arrays_; }
  // Throws std::out_of_range if there is no array of this name.
  const Array& array(const std::string& name) const;
  // Returns the coordinates of each dimension; the coordinates of an axis have no values.
  const std::vector<Array>& dimensions() const { return dimensions_; }
  const Array& dimension(const std::string& name) const;
  std::vector<std::size_t> shape() const;
  std::size_t size() const;  // number of values of each array

 private:
  Array& add_array(Column about);
  static void add_word(Array& array, const std::string& text);

  std::string name_;
  std::vector<Array> dimensions_, arrays_;
  std::map<std::string, std::string> texts_;
};

// Returns true if two numbers are the same. NaN equals NaN; zeros of opposite signs differ.
bool same_bits(double a, double b);

}  // namespace bristle::results
