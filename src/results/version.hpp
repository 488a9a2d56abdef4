#pragma once

namespace bristle::results {

// Version of the layout of result files.
constexpr const char* kResultSchema = "bristle-result/2";
// The group whose text attributes are the errors of failed points.
constexpr const char* kFailures = "failures";
// Version of physics and numerics. Increase it when results may change.
constexpr long kNumericsVersion = 19;

}  // namespace bristle::results
