#pragma once

#include "results/writer.hpp"
#include "run/merge.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <random>

// Parts of sharded experiments with invented numbers.
namespace bristle::testing {

// 2 x 3 points without checks. The strings below change what the experiment records.
inline Experiment sharded(
    const Scratch& s, const std::string& more = "",
    const std::string& sweep = R"("k_r": {"values": [5, 20]}, "k_theta": {"values": [0.3, 1, 3]})") {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("small.json", R"({"extends": "paper.json", "name": "small", "sweep": {)" +
                                                   sweep + "}" + more + "}"),
                         {});
}
inline const std::string kTables =
    R"(, "load": {"R_n": null, "z_0": 0.5}, "record": ["bristles", "trajectories"],
    "orientation": {"sampling": "list", "theta_0_deg": [10, 100]})";
inline const std::string kLattice = R"(, "load": {"R_n": null, "z_0": 0.5}, "record": ["slab_force"],
    "orientation": {"sampling": "lattice", "rtol": null, "rows": 100, "seed": 1})";
inline const std::string kCurve =
    R"(, "load": {"R_n": null, "path": null, "trace": {"to": 0.1, "resolution": 0.1, "nodes": 96}})";

inline bool is_flag(const std::string& name) {
  return name == "status" || name == "branch" || name == "phase";
}

// Invented numbers of a point, reproducible: arbitrary doubles where possible, and any number of rows.
inline PointRecord invented_record(const Experiment& e, std::size_t index) {
  std::mt19937_64 random(index + 1);
  const auto fill = [&](std::vector<double>& numbers, const std::string& name, std::size_t count) {
    numbers.clear();
    while (numbers.size() < count) {
      const double any = std::normal_distribution<double>(0, 1e3)(random);
      const bool whole = is_flag(name) || name == "passages" || name == "steps" || name == "reflections";
      numbers.push_back(whole ? double(random() % 4) : random() % 5 == 0 ? kNone : any);
    }
  };
  PointRecord record;
  const auto& trace = e.base.loading.trace;
  const std::size_t nodes = trace ? random() % (std::size_t(trace->nodes) + 1) : 1;
  const RecordFormat format(e);
  for (const auto& dataset : format.datasets) fill(record.values[dataset.name], dataset.name, nodes);
  for (const std::string& table : format.tables) {
    const std::size_t rows = random() % 6;
    for (const std::string& column : table_columns(table))
      fill(record.tables[table].emplace_back(), column, rows);
  }
  return record;
}

using Provenance = std::map<std::string, std::string>;

inline Provenance provenance_of(const Shard& shard) {
  const std::string file = part_path("small.h5", shard);
  return {{"version", kVersion},
          {"commit", "0123abc"},
          {"host", "node" + std::to_string(shard.number)},
          {"command_line", "bristle run small.json --shard " + shard_text(shard) + " -o " + file},
          {"started", "2026-01-0" + std::to_string(shard.number % 10)},
          {"finished", "2026-02-01"}};
}

inline std::string write_file(const Scratch& s, const std::string& file, const Experiment& e,
                              std::optional<Shard> shard, const Provenance& provenance) {
  ResultWriter writer(e, s.path(file), shard);
  for (const std::size_t i : shard_points(shard.value_or(Shard{1, 1}), e.points()))
    writer.write(i, invented_record(e, i));
  writer.close(provenance);
  writer.publish();
  return s.path(file);
}

inline std::string write_part(const Scratch& s, const Experiment& e, const Shard& shard) {
  return write_file(s, part_path("small.h5", shard), e, shard, provenance_of(shard));
}

inline std::vector<std::string> write_parts(const Scratch& s, const Experiment& e, std::size_t count) {
  std::vector<std::string> paths;
  for (std::size_t i = 1; i <= count; ++i) paths.push_back(write_part(s, e, {i, count}));
  return paths;
}

inline std::string digest(const std::string& path) {
  const ResultReader result(path);
  CHECK(payload_sha256(result.file()) == result.text("payload_sha256"));
  return result.text("payload_sha256");
}

inline std::string merged(const Scratch& s, const std::vector<std::string>& paths) {
  PartSet parts(paths);
  merge_parts(parts, s.path("merged.h5"), "bristle merge", [] { return false; });
  return digest(s.path("merged.h5"));
}

}  // namespace bristle::testing
