#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bristle {

// Returns the first points of a Sobol sequence in the open unit cube, scrambled by the seed (A. B. Owen,
// 1995, in the form of hashes by B. Burley, J. Comput. Graph. Tech. 9(4), 2020). Of 2^m points, each of the
// 2^m equal intervals of a coordinate contains one. A longer sequence begins with the same points. The bits
// are the same on all machines. Throws std::invalid_argument for more dimensions than the tables of
// Boost.Random have.
std::vector<std::vector<double>> sobol_points(std::size_t points, std::size_t dimensions, std::uint64_t seed);

}  // namespace bristle
