// How far surfaces have slid along each other.
#pragma once

#include <span>
#include <vector>

#include "record/field_values.hpp"

namespace carom {

/// For every node the integral over time of the slip rate of NodalContact, which is 0 where nothing touches: by the
/// trapezoidal rule over the steps, which is exact for sliding that grows or slows evenly. Only where a field or a
/// probe of the case asks for `contact_slip`.
class ContactSlip {
 public:
  explicit ContactSlip(const Simulation& simulation);

  bool is_wanted() const { return is_wanted_; }
  /// Of the initial state and of each finished step, once.
  void sample(FieldsNow& now);
  /// Length, by node; empty where it is not wanted.
  std::span<const double> path() const { return path_; }

 private:
  template <class A>
  friend void fields(A& archive, ContactSlip& x) {
    archive("path", x.path_);
    archive("rate", x.rate_);
  }

  bool is_wanted_;
  std::vector<double> path_, rate_;  ///< so far; at the end of the last step
};

}  // namespace carom
