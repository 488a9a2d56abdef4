#include "bristle/ensemble/normal_quantile.hpp"

#include "bristle/model/elementary.hpp"

#include <cmath>

namespace bristle {
namespace {

double ratio(double r, const double (&a)[8], const double (&b)[8]) {
  double numerator = 0, denominator = 0;
  for (int i = 7; i >= 0; --i) {
    numerator = numerator * r + a[i];
    denominator = denominator * r + b[i];
  }
  return numerator / denominator;
}

}  // namespace

// Evaluates algorithm AS 241 of M. J. Wichura, Appl. Statist. 37, 1988. Boost.Math calls functions of the C
// library, whose last bits differ between machines.
double normal_quantile(double share) {
  static const double a[] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                             1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                             3.3430575583588128105e4, 2.5090809287301226727e3},
                      b[] = {1.0,
                             4.2313330701600911252e1,
                             6.8718700749205790830e2,
                             5.3941960214247511077e3,
                             2.1213794301586595867e4,
                             3.9307895800092710610e4,
                             2.8729085735721942674e4,
                             5.2264952788528545610e3},
                      c[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                             3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4},
                      d[] = {1.0,
                             2.05319162663775882187e0,
                             1.67638483018380384940e0,
                             6.89767334985100004550e-1,
                             1.48103976427480074590e-1,
                             1.51986665636164571966e-2,
                             5.47593808499534494600e-4,
                             1.05075007164441684324e-9};
  const double from_middle = share - 0.5;
  if (std::abs(from_middle) <= 0.425) return from_middle * ratio(0.180625 - from_middle * from_middle, a, b);
  const double size = ratio(sqrt(-log(from_middle < 0 ? share : 1 - share)) - 1.6, c, d);
  return from_middle < 0 ? -size : size;
}

}  // namespace bristle
