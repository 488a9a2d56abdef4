#pragma once

namespace bristle {

// Embedded explicit Runge-Kutta pairs. k_i, the slope at stage i, is taken at y + h sum_j a[i][j] k_j; the step
// is y + h sum b_i k_i; its error h sum error_i k_i, where the last entry goes with the slope after the step, which
// is the next step's first. exponent is -1/(order of the error).

// J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980), 5(4).
struct DormandPrince5 {
  static constexpr int stages = 6;
  static constexpr double exponent = -1.0 / 5;
  static constexpr double a[6][5] = {{},
                                     {1. / 5},
                                     {3. / 40, 9. / 40},
                                     {44. / 45, -56. / 15, 32. / 9},
                                     {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                     {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656}};
  static constexpr double b[6] = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84};
  static constexpr double error[7] = {71. / 57600,      0,          -71. / 16695, 71. / 1920,
                                      -17253. / 339200, 22. / 525, -1. / 40};
};

// RODAS 4(3): E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, section IV.10, for
// autonomous systems. Stage i solves (1/(gamma h) - J) k_i = f(y + sum_j a[i][j] k_j) + sum_j c[i][j] k_j / h;
// the step is the last stage's argument plus k of the last stage, which is the error.
struct Rodas4 {
  static constexpr int stages = 6;
  static constexpr double exponent = -1.0 / 4;
  static constexpr double gamma = 0.25;
  static constexpr double a[6][5] = {{},
                                     {1.544},
                                     {0.9466785280815826, 0.2557011698983284},
                                     {3.314825187068521, 2.896124015972201, 0.9986419139977817},
                                     {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
                                     {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950,
                                      1}};
  static constexpr double c[6][5] = {
      {},
      {-5.6688},
      {-2.430093356833875, -0.2063599157091915},
      {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
      {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
      {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
};

}  // namespace bristle
