#pragma once

#include "dynamics/components.hpp"
#include "model/bristle.hpp"

#include <cstdint>

namespace bristle {

// Room for the widest instruction set: two vectors of eight numbers.
constexpr int kLanes = 16;
struct alignas(64) Row {
  double lane[kLanes];
};

// Passages under way, one per lane, each with its own time and step size. Plain data: the kernels, compiled
// once per instruction set, step it; the engine, compiled once, fills lanes and answers events.
struct Block {
  FrictionLaw friction;
  AzimuthRate azimuth_rate;
  std::uint32_t occupied = 0;  // lanes that hold a passage, one bit each
  std::uint32_t fresh = 0;     // lanes whose slope is not that of their state
  std::uint64_t tried = 0;     // steps, of occupied lanes or not

  Row constants[kConstants];                // of Bristle, in the order of constants_of()
  Row rtol, atol, L_x, x_0;                 // slip is xi - (x - x_0)
  Row near_pole, pole;                      // distances s: where the other method takes over; s_min
  Row t, y[COMPONENTS], slope[COMPONENTS];  // at the last accepted step
  Row h;                                    // next step to try
  Row attempts, max_attempts;
  Row next_sample;  // time at which the integrals are to be sampled; infinity without

  // The step that was just tried, for lanes with an event: it is not yet accepted.
  Row t_new, h_next, y_new[COMPONENTS], slope_new[COMPONENTS];
};

// The exit is met when the slip is this close to L_x.
constexpr double kSlipTolerance = 1e-10;
constexpr double kSmallestStep = 1e-15;

// Why a kernel stopped. One bit per lane in each; lanes without a bit go on.
struct Events {
  std::uint32_t exit = 0;       // the step is good, and the slip reaches L_x in it
  std::uint32_t axis = 0;       // the step is good, and comes near the axis (explicit) or the pole (implicit)
  std::uint32_t sample = 0;     // the step is good, and reaches next_sample
  std::uint32_t away = 0;       // implicit: the step was good, and left the axis behind
  std::uint32_t exhausted = 0;  // max_attempts
  std::uint32_t stuck = 0;      // no step is small enough, or a state is not finite
  std::uint32_t any() const { return exit | axis | sample | away | exhausted | stuck; }
};

}  // namespace bristle
