#pragma once

namespace bristle::results {

// Version of the layout. In version 1 the dimension scale of a choice has codes instead of words; the program
// reads both.
constexpr const char* kResultSchema = "bristle-result/2";
constexpr const char* kOldResultSchema = "bristle-result/1";
// A part has the layout of the whole result, with values at its own points only. Its different schema
// prevents readers from treating it as a whole result. Root attribute `shard`: "2/5"; dataset /part/points:
// the indices of its points.
constexpr const char* kPartSchema = "bristle-part/2";
constexpr const char* kOldPartSchema = "bristle-part/1";
// The group whose text attributes are the errors of failed points.
constexpr const char* kFailures = "failures";
// Version of physics and numerics. Increase it when results may change.
constexpr long kNumericsVersion = 7;

}  // namespace bristle::results
