#pragma once

#include "results/reader.hpp"

namespace bristle {

// A value with its error estimate over an abscissa.
struct CurvePoint {
  double x, value, error;
  double x_error = 0;
};
using Curve = std::vector<CurvePoint>;

// What a check measures on: curves along one dimension of a result.
struct Curves {
  std::vector<Curve> curves;
  std::size_t missing = 0;   // points without a value, left out
  bool independent = false;  // the errors are independent and add in quadrature, otherwise linearly
};

// The variable of a check (divided by powers of others: "divide_by") along its dimension "along", over that
// axis or over another variable ("x"), at the points that its "where" selects:
//   "where": {"friction": "nss", "k_r": 5, "z_0": [0.9, 0.98]}   a word, a value of an axis, a range
// With "at": {"R_n": 0.5} a traced curve is first reduced to the node, by linear interpolation, that carries
// the load on the loading path (for any other variable: where it first passes the value); the error then
// includes the distance to the nearer node. more adds selections to "where". Throws InputError naming what is
// not there.
Curves curves_of(const ResultReader& result, const Json& check, const Json& more = {});

// The same along another dimension.
Curves curves_along(const ResultReader& result, Json check, const std::string& along);

// All selected points in row-major order, those without a value included.
Curve points_of(const ResultReader& result, const Json& check, const Json& more = {});

}  // namespace bristle
