#pragma once

namespace bristle {

// Bounds of the load search (docs/numerics.md, section "The gap for a load"). A share is a share of the
// target load, and lengths are in steps of the scan (LoadSearch::step), unless stated otherwise.

// Certainty

// A load lies on one side of the target beyond doubt if its distance from the target exceeds this multiple of
// its error; two loads differ beyond doubt if their difference exceeds this multiple of the sum of their
// errors.
constexpr double kUndecidedErrors = 2;
// Share within which the side of the target is undecided, however small the error of the load is: the load of
// a lattice fluctuates by more over time.
constexpr double kUndecidedShare = 0.005;
// Largest undecided distance, as a share, at which a rough load need not be made precise to decide whether
// the load falls beyond the crossing. A large rtol exceeds it.
constexpr double kRoughErrorShare = 0.02;

// Scan

// The scan skips a gap if the loads at the gaps before and after it are below the target by more than this
// share: the load between such gaps does not rise to the target.
constexpr double kSkipShare = 0.35;
// Between two gaps below the target the scan halves its distance, down to kLeastHalvingSteps, while a load is
// within this share, times the distance in steps, of the target: humps of R_n(z_0) are a few per cent high
// and down to 0.01 wide.
constexpr double kHalvingShare = 0.08, kLeastHalvingSteps = 1. / 8;
// The scan computes the middle of two gaps if a load is within this share of the target and the gaps are
// more than kLeastMiddleSteps apart, which is true of whole steps only: R_n(z_0) may oscillate between them.
constexpr double kMiddleShare = 0.25, kLeastMiddleSteps = 0.9;
// Where the load in the middle deviates from the straight line between two gaps, the scan halves its
// distance, down to kLeastDeviationSteps, while a load is within this multiple of the deviation from the
// target. Half of the deviation of a step counts at least within its parts.
constexpr double kDeviationFactor = 2, kLeastDeviationSteps = 1. / 64;
// The search for the top of a hump goes on while its parabola comes within this share of the target, at gaps
// that are at least kLeastHumpSteps apart.
constexpr double kHumpShare = 0.01, kLeastHumpSteps = 1. / 16;

// Root-finder

// Number of slow steps of the root-finder, less the others, from which on it bisects.
constexpr int kMaxSlowSteps = 3;
// A bracket narrower than this should have led to the target already: it contains a jump, or the noise of the
// means has misled the search.
constexpr double kSuspectBracketSteps = 1. / 64;
// Where the load is even, a gap is accepted if its load is within this multiple of rtol, because the values
// at the target follow from secants. With a multiple of four, secants miss humps of a few thousandths.
constexpr double kEvenToleranceFactor = 3;
// Largest ratio of the slopes on both sides of a gap at which the load counts as even.
constexpr double kSlopeRatio = 2;

// Earlier crossings

// Distance before a crossing of the first gap at which the search for an earlier crossing looks. It looks
// twice as far each time.
constexpr double kFirstLookSteps = 0.125;
// Share of the mean slope in the scan's bracket by which R_n is expected to fall at least before a crossing.
constexpr double kExpectedSlopeShare = 0.75;
// Number of times that the search moves to an earlier crossing.
constexpr int kMaxEarlierCrossings = 4;

}  // namespace bristle
