#include "results/block_writer.hpp"

#include <algorithm>

namespace bristle::results {
namespace {

constexpr std::size_t kBlock = 16384;  // values

}  // namespace

BlockWriter::BlockWriter(h5::Handle dataset, const h5::Shape& shape, double missing)
    : dataset_(std::move(dataset)), shape_(shape.begin(), shape.end()), missing_(missing) {}

void BlockWriter::add(std::size_t place, const std::vector<double>& values) {
  if (place + values.size() > first_ + kBlock) flush();
  if (values_.empty()) first_ = place;
  values_.resize(place - first_, missing_);
  values_.insert(values_.end(), values.begin(), values.end());
}

void BlockWriter::flush() {
  for (std::size_t done = 0; done < values_.size();) {
    const std::size_t left = values_.size() - done;
    const h5::Shape start = h5::position(shape_, first_ + done);
    // The largest part of the dataset that begins here and whose values follow one another.
    h5::Shape count(start.size(), 1);
    std::size_t size = 1;
    for (std::size_t d = shape_.size(); d-- > 0;) {
      count[d] = std::min(shape_[d] - std::size_t(start[d]), left / size);
      size *= std::size_t(count[d]);
      if (count[d] < shape_[d]) break;
    }
    h5::write_part(dataset_, H5T_NATIVE_DOUBLE, start, count, values_.data() + done);
    done += size;
  }
  values_.clear();
}

}  // namespace bristle::results
