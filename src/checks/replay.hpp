#pragma once

#include "results/reader.hpp"
#include "util/json.hpp"

#include <string>

namespace bristle {

// The command that computes one point of a result again, alone, to the same bits. index: of the point's value
// in the variable status, row-major.
std::string replay_command(const ResultReader& result, std::size_t index);

// The commands of all sweep points, the last axis fastest, as a JSON array.
Json replay_json(const ResultReader& result);

}  // namespace bristle
