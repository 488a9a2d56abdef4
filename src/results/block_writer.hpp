#pragma once

#include "results/hdf5.hpp"

#include <string>
#include <vector>

namespace bristle::results {

// Writes the values of a dataset in ascending order, in large blocks.
class BlockWriter {
 public:
  // missing: the value of places that are left out.
  BlockWriter(h5::Handle dataset, const h5::Shape& shape, double missing);

  // Adds values from a place of the row-major dataset on, which lies beyond those of earlier calls. The
  // values are in the file after flush(). HDF5 converts them to the dataset's type.
  void add(std::size_t place, const std::vector<double>& values);
  void flush();
  // Call flush() before.
  void close(const std::string& what) { dataset_.close(what); }

 private:
  h5::Handle dataset_;
  std::vector<std::size_t> shape_;
  double missing_;
  std::size_t first_ = 0;  // place of the first of the values that are not yet in the file
  std::vector<double> values_;
};

}  // namespace bristle::results
