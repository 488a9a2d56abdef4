#pragma once

#include "results/journal.hpp"
#include "results/writer.hpp"
#include "run/points.hpp"
#include "run/provenance.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <random>

// Journals of shards with invented numbers.
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

inline bool is_flag(const std::string& name) { return name == "status" || name == "phase"; }

// Invented numbers of a point, reproducible: arbitrary doubles where possible, and any number of rows.
inline PointRecord invented_record(const Experiment& e, std::size_t index) {
  std::mt19937_64 random(index + 1);
  const auto fill = [&](std::vector<double>& numbers, const std::string& name, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double any = std::normal_distribution<double>(0, 1e3)(random);
      const bool whole = is_flag(name) || name == "passages" || name == "steps" || name == "reflections";
      numbers.push_back(whole ? double(random() % 4) : random() % 5 == 0 ? kNone : any);
    }
  };
  PointRecord record{layout_of(e.sweep)};
  for (const Column& variable : record.layout->variables) fill(record.values, variable.name, 1);
  for (const std::string& table : record.layout->tables) {
    const std::size_t rows = random() % 6;
    record.tables.emplace_back();
    for (const Column& column : table_columns(table))
      fill(record.tables.back().emplace_back(), column.name, rows);
  }
  return record;
}

// Writes a result with invented numbers at once. Returns its payload digest.
inline std::string whole_digest(const Scratch& s, const Experiment& e) {
  ResultWriter writer(e, s.path("whole.h5"));
  for (std::size_t i = 0; i < e.sweep.size(); ++i) writer.write(i, invented_record(e, i));
  writer.close({});
  writer.publish();
  return ResultReader(s.path("whole.h5")).text("payload_sha256");
}

// The journal of a shard of the result small/r.h5, with invented numbers. Returns its path.
inline std::string write_shard(const Scratch& s, const Experiment& e, const Shard& shard,
                               const std::string& commit = kCommit) {
  const std::string path = journal_path(s.path("small/r.h5"), shard);
  Journal journal(path, commit, false);
  for (const std::size_t i : shard_points(shard, e.sweep.size()))
    journal.append(point_key(e.sweep, i), invented_record(e, i));
  return path;
}

inline void write_shards(const Scratch& s, const Experiment& e, std::size_t count) {
  for (std::size_t i = 1; i <= count; ++i) write_shard(s, e, {i, count});
}

// Completes small/r.h5 from the journals beside it. Returns its payload digest.
inline std::string completed(const Scratch& s, const Experiment& e) {
  run_experiment(e, {.output = s.path("small/r.h5"), .complete = true, .threads = 1, .quiet = true});
  const ResultReader result(s.path("small/r.h5"));
  CHECK(result.damage().empty());
  return result.text("payload_sha256");
}

}  // namespace bristle::testing
