#pragma once

#include "results/reader.hpp"
#include "util/json.hpp"

#include <string>

namespace bristle::compare {

// The command that computes only this point of a result again, with the same bits. index: of the point's
// value in the variable status, in row-major order.
std::string replay_command(const results::ResultReader& result, std::size_t index);

// The commands of all sweep points in row-major order, as a JSON array.
Json replay_json(const results::ResultReader& result);

}  // namespace bristle::compare
