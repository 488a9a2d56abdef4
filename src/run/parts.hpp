#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"
#include "results/reader.hpp"
#include "results/record.hpp"

#include <map>

namespace bristle {

// A part as its file says.
struct Part {
  std::string path;
  Shard shard;
  std::vector<std::size_t> points;  // ascending
  std::string payload_sha256;
  std::map<std::string, std::string> provenance;
};

// Parts of one experiment, verified to belong together and to be intact.
class PartSet {
 public:
  // Throws InputError that names the files and what is wrong: not a part, damaged, of another experiment or
  // version than the first or than this program.
  explicit PartSet(const std::vector<std::string>& paths);

  const Experiment& experiment() const { return experiment_; }
  const std::vector<Part>& parts() const { return parts_; }  // ascending by shard
  // Throws InputError with the points that no part has and what computes them.
  void require_complete() const;
  // Throws InputError if two parts have other numbers for it.
  PointRecord record(std::size_t index);

 private:
  struct Place {
    std::size_t point, part;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Part> read(const std::vector<std::string>& paths);
  const ResultReader& open(std::size_t part);
  std::string numbered_place(std::size_t index) const;  // for messages: "3 (k_r = 2, k_theta = 0.5)"

  Experiment experiment_;
  std::vector<Part> parts_;
  std::vector<Place> places_;                   // of every point in every part, ascending
  std::map<std::size_t, ResultReader> opened_;  // a few of them: descriptors are limited
};

}  // namespace bristle
