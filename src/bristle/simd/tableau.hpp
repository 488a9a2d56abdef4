#pragma once

namespace bristle {

// Additive embedded Runge-Kutta pairs, for slopes k_i = e_i + f_i of an explicit and an implicit part. Stage
// i is at y + h sum_j<i (a[i][j] e_j + a_implicit[i][j] f_j) + h gamma f_i, where f_0 is explicit. The step
// is y + h sum b_i k_i and its error h sum error_i k_i. exponent is -1/(order of the error).

// ARK4(3)6L[2]SA: C. A. Kennedy, M. H. Carpenter, Appl. Numer. Math. 44 (2003) 139.
struct KennedyCarpenter4 {
  static constexpr int stages = 6;
  static constexpr double exponent = -1.0 / 4;
  static constexpr double gamma = 0.25;
  static constexpr double a[6][5] = {
      {},
      {0.5},
      {0.221776, 0.110224},
      {-0.04884659515311858, -0.177720652326401, 0.84656724747951961},
      {-0.15541685842491548, -0.3567050098221991, 1.0587258798684427, 0.30339598837867193},
      {0.20142435067267633, 0.0087420578429041849, 0.15993995707168115, 0.40382906052207751,
       0.22606457389066084}};
  static constexpr double a_implicit[6][5] = {
      {},
      {0.25},
      {0.13777600000000001, -0.055775999999999999},
      {0.14463686602698217, -0.22393190761334475, 0.44929504158636258},
      {0.098258783283564771, -0.59154424281967044, 0.81012105382829958, 0.28316440570780599},
      {0.15791629516167136, 0, 0.18675894052400077, 0.68056529530933463, -0.27524053099500667}};
  static constexpr double b[6] = {0.15791629516167136,  0,   0.18675894052400077, 0.68056529530933463,
                                  -0.27524053099500667, 0.25};
  static constexpr double error[6] = {0.0032044943984591845,  0,
                                      -0.0024462511366794559, -0.021480075919587227,
                                      0.043946868068572453,   -0.023225035410764872};
};

}  // namespace bristle
