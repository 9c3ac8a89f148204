#include "schemes/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/largest_eigenvalue.hpp"
#include "parallel/threads.hpp"
#include "schemes/mass_solver.hpp"

namespace carom {

namespace {

/// y = (K + closed contact) x on the free dofs.
class Stiffness {
 public:
  Stiffness(const System& system, bool with_contact)
      : system_(system), with_contact_(with_contact), zero_(system.solid.dof_count(), 0.0) {}

  void operator()(std::span<const double> x, std::span<double> y) const {
    system_.solid.tangent_action(zero_, x, y);
    if (with_contact_) system_.contact.add_closed_stiffness(x, y);
    const std::vector<bool>& fixed = system_.supports.fixed();
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (fixed[i]) y[i] = 0.0;
    }
  }

 private:
  const System& system_;
  bool with_contact_;
  std::vector<double> zero_;
};

/// Largest eigenvalue of M^-1/2 K M^-1/2, M lumped.
double lumped_frequency(const System& system, const Stiffness& K) {
  const std::vector<bool>& fixed = system.supports.fixed();
  const std::vector<double>& m = system.mass.node_diagonal();
  std::vector<double> scale(fixed.size()), work(fixed.size());
  for (std::size_t i = 0; i < scale.size(); ++i) scale[i] = fixed[i] ? 0.0 : 1.0 / std::sqrt(m[i / 3]);
  const LinearOperator A = [&](std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) work[i] = scale[i] * x[i];
    K(work, y);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] *= scale[i];
  };
  return largest_eigenvalue(A, scale.size()).upper;
}

/// The same for a consistent M by power iteration in its inner product; 5 % is added for what is still missing.
double consistent_frequency(const System& system, const Stiffness& K) {
  const std::vector<bool>& fixed = system.supports.fixed();
  std::vector<double> x(fixed.size()), Kx(fixed.size()), Mx(fixed.size()), y(fixed.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = fixed[i] ? 0.0
                    : 0.5 + std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) * (i % 2 == 0 ? 1.0 : -1.0);
  MassSolver mass(system);
  double value = 0.0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    K(x, Kx);
    system.mass.apply(x, Mx);
    const double before = value, xMx = dot(x, Mx);
    if (xMx == 0.0) return 0.0;
    value = dot(x, Kx) / xMx;
    if (iteration > 10 && value - before < 1e-4 * value) break;
    std::fill(y.begin(), y.end(), 0.0);
    mass.solve(Kx, y);
    const double length = std::sqrt(dot(y, y));
    if (length == 0.0) break;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = y[i] / length;
  }
  return 1.05 * value;
}

/// Largest sum of damping / mass over the nodes. For the consistent mass of parallelepipeds, M >= 1/8 of its diagonal
/// (Wathen, IMA Journal of Numerical Analysis 7, 1987).
double largest_damping_ratio(const System& system) {
  const ConstraintRows& rows = system.contact.rows();
  const double smallest_share = system.mass.kind() == MassKind::lumped ? 1.0 : 1.0 / 8.0;
  std::vector<double> damping(system.mass.node_diagonal().size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Index k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
      damping[static_cast<std::size_t>(rows.node[k])] +=
          system.contact.parameters()[r].damping * rows.weight[k] * rows.weight[k];
    }
  }
  double d = 0.0;
  for (std::size_t n = 0; n < damping.size(); ++n) {
    const double m = system.mass.node_diagonal()[n] * smallest_share;
    if (m > 0.0) d = std::max(d, damping[n] / m);
  }
  return d;
}

}  // namespace

StableStep stable_step(const System& system) {
  const auto frequency = [&](bool with_contact) {
    const Stiffness K(system, with_contact);
    return system.mass.kind() == MassKind::lumped ? lumped_frequency(system, K) : consistent_frequency(system, K);
  };
  StableStep out;
  out.omega_max_squared_free = frequency(false);
  out.omega_max_squared = system.contact.rows().size() == 0 ? out.omega_max_squared_free : frequency(true);
  const double d = largest_damping_ratio(system);
  out.dt_free = 2.0 / std::sqrt(out.omega_max_squared_free);
  out.dt = (std::sqrt(d * d + 4.0 * out.omega_max_squared) - d) / out.omega_max_squared;
  return out;
}

}  // namespace carom
