#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"
#include "results/reader.hpp"
#include "results/record.hpp"

#include <map>

namespace bristle::run {

// Contents of the file of one shard, except the numbers.
struct Part {
  std::string path;
  results::Shard shard;
  std::vector<std::size_t> points;  // ascending
  std::string payload_sha256;
  std::map<std::string, std::string> provenance;
};

// The parts of one experiment. They have been verified to be intact and to belong together.
class PartSet {
 public:
  // Throws InputError, naming the files, if a file is not a part or is damaged, if its experiment or version
  // differs from that of the first file, or if its version differs from that of this program.
  explicit PartSet(const std::vector<std::string>& paths);

  const Experiment& experiment() const { return experiment_; }
  const std::vector<Part>& parts() const { return parts_; }  // ascending by shard
  // Throws InputError, naming the missing points and the command that computes them.
  void require_complete() const;
  // The record of a point. Throws InputError if two parts contain different numbers for it.
  results::PointRecord record(std::size_t index);

 private:
  struct Location {
    std::size_t point, part;
    auto operator<=>(const Location&) const = default;
  };
  std::vector<Part> read(const std::vector<std::string>& paths);
  const results::ResultReader& open(std::size_t part);
  std::string point_label(std::size_t index) const;  // for messages: "3 (k_r = 2, k_theta = 0.5)"

  Experiment experiment_;
  std::vector<Part> parts_;
  std::vector<Location> locations_;                      // of every point in every part, ascending by point
  std::map<std::size_t, results::ResultReader> opened_;  // at most kMaxOpenParts
};

}  // namespace bristle::run
