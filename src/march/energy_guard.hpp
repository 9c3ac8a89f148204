// Steps that make energy: which are made again shorter, and when all become shorter.
#pragma once

#include <optional>

#include "rows/response.hpp"
#include "state/state.hpp"

namespace carom {

/// Springs of contact push for whole steps: one that closes within a step, or opens, misplaces up to
///   1/2 eps_N |g_begin| |g_end|
/// of the energy, g of either sign (ledger: quadrature), a loss where it closes, a gain where it opens. Bodies of
/// finite strain misplace energy where they stiffen faster than the stable step is followed. This class says which
/// steps to make again:
///   - a step that misplaces more than 2e-4 of the energy scale by a change of contact, so short that it misplaces half
///     of that, at least a sixteenth of it: large blocks of few cells thus touch and leave at the end of a step;
///   - a step that gains more than 2e-3 otherwise, or is lent more than 1e-2 by the scheme (ledger: algorithmic), which
///     the scheme does not take back when the step changes, or whose energy is not finite, by halves; the steps after
///     it are shorter by 2^(-1/2);
///   - when the gains of all steps exceed the losses by another 5e-4 of the scale, the steps after it are likewise.
/// After a hundred steps that hold, steps grow again by 2^(1/4); after twice as many, where they have grown too far
/// before, so that a run gains by this no more than 5e-4 times the binary logarithm of its steps.
class EnergyGuard {
 public:
  /// Entries of the ledger for a step, and what energies are compared with.
  struct Books {
    double quadrature = 0.0, algorithmic = 0.0, scale = 0.0;
  };
  /// The fraction of the step from `begin` to `end` to make again.
  std::optional<double> cut(const State& begin, const State& end, const ContactResponse& response, const Books& books);
  /// Of implicit steps, which may lose what they like: true for one that gains more than 5e-4 of the scale by itself,
  /// if no losses make up for that; it is to be halved, four times at most.
  bool gains_too_much(const Books& books);
  /// The step counts.
  void accept(const Books& books);
  /// True when the present step has been cut since it made energy, not where contact closes or opens.
  bool has_made_energy() const { return shortened_; }
  /// What the usual step is multiplied by.
  double share() const { return share_; }

 private:
  template <class A>
  friend void fields(A& archive, EnergyGuard& x) {
    archive("net", x.net_);
    archive("allowed", x.allowed_);
    archive("share", x.share_);
    archive("quiet", x.quiet_);
    archive("wait", x.wait_);
    archive("has_grown", x.has_grown_);
    archive("cuts", x.cuts_);
    archive("shortened", x.shortened_);
  }

  void shorten();
  void grow();

  double net_ = 0.0;      ///< gains less losses
  double allowed_ = 0.0;  ///< net_ that shortens the steps, less what the scale allows
  double share_ = 1.0;
  long long quiet_ = 0, wait_ = 100;  ///< steps since the share has changed, and until it grows
  bool has_grown_ = false;            ///< since it fell last
  int cuts_ = 0;                      ///< of the present step
  bool shortened_ = false;            ///< in the present step
};

}  // namespace carom
