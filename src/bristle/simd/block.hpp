#pragma once

#include "bristle/dynamics/ode.hpp"
#include "bristle/model/path.hpp"
#include "bristle/model/friction/table.hpp"

#include <cstdint>

namespace bristle {

// Two vectors of eight numbers, which is what the widest instruction set holds.
constexpr int kLanes = 16;
struct alignas(64) Row {
  double lane[kLanes];
};

// Active passages, one per lane, each with its own time and step size. Plain data: the kernels, compiled once
// per instruction set, advance it; the engine, compiled once, fills lanes and handles events.
struct Block {
  FrictionLaw friction;
  Bending bending;
  Contact contact;
  const ModulationTable* modulation;
  std::uint32_t occupied = 0;    // lanes that hold a passage, one bit each
  std::uint64_t lane_steps = 0;  // attempted steps, counted for occupied and empty lanes

  Row constants[kConstants];  // of Bristle, in the order of constants_of()
  Row rtol, atol, L_x, x_0;   // slip is xi - (x - x_0)
  Row s_handover;             // distance from the pole at which the other kernel takes over
  Row s_min;                  // distance from the pole, or from a rod's base, at which the pole rule acts
  Row t, y[COMPONENTS];       // after the last accepted step
  Row path[PATH_QUANTITIES];  // of the accepted steps
  Row h;                      // size of the next step
  Row last_error;             // of the last accepted step, as a multiple of the tolerance
  Row attempts, max_attempts;
  Row next_sample;  // next time at which the integrals are sampled; infinity if they are not

  // The last attempted step of lanes with an event. It is not yet accepted.
  Row t_new, h_next, error, y_new[COMPONENTS], path_new[PATH_QUANTITIES];
};

// A passage ends when its slip is this close to L_x.
constexpr double kSlipTolerance = 1e-10;
constexpr double kSmallestStep = 1e-15;

// Why a kernel stopped. One bit per lane in each. "good": the error of the step is within the tolerance.
struct Events {
  std::uint32_t exit = 0;       // the step is good, and the slip reaches L_x within it
  std::uint32_t pole = 0;       // the step is good, and reaches s_handover (far) or s_min (near, rod)
  std::uint32_t sample = 0;     // the step is good, and reaches next_sample
  std::uint32_t pole_left = 0;  // near: the step was good, and its end is farther than s_handover
  std::uint32_t exhausted = 0;  // max_attempts is reached
  std::uint32_t failed = 0;     // the step size is below kSmallestStep, or the state is not finite
  std::uint32_t any() const { return exit | pole | sample | pole_left | exhausted | failed; }
};

}  // namespace bristle
