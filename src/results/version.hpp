#pragma once

namespace bristle {

constexpr const char* kResultSchema = "bristle-result/1";
// A part has the layout of the whole result, without values where it has no point. Its own schema keeps it from
// being read as a whole result. Root attribute `shard`: "2/5"; dataset /part/points: the indices of its points.
constexpr const char* kPartSchema = "bristle-part/1";
// Version of the physics and numerics together: raised by hand when results may change.
constexpr long kNumericsVersion = 4;

}  // namespace bristle
