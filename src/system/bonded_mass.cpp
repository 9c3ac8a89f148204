#include "system/bonded_mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "linalg/cholesky.hpp"
#include "math/vec3.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

/// Of Baumgarte's terms: both roots at 0.05 of a step.
constexpr double of_velocity = 0.1, of_displacement = 0.0025;
/// What is added to the diagonal of the scaled matrix, so that bonds which say the same twice have an answer.
constexpr double regular = 1e-11;

constexpr const char* no_bonds = "the forces of the ties are not finite";

}  // namespace

struct BondedMass::Impl {
  Impl(const System& of, MassSolver& with, Bonds which)
      : system(of),
        mass(with),
        equations_alone(which == Bonds::equations),
        rows(equations_alone ? of.contact.equations() : of.contact.bonds()) {
    if (rows.size() == 0) return;
    moved.assign(system.solid.dof_count(), 0.0);
    touched.assign(system.solid.node_count(), false);
    for (const Index n : rows.node) touched[static_cast<std::size_t>(n)] = true;
    if (!is_lumped()) return;
    bonds_of.resize(touched.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
        bonds_of[static_cast<std::size_t>(rows.node[k])].push_back(r);
    inverse.resize(moved.size());
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const double m = system.mass.node_diagonal()[i / 3];
      inverse[i] = system.supports.fixed()[i] || m == 0.0 ? 0.0 : 1.0 / m;
    }
  }

  /// Of the mass alone, made when it is asked for first: it takes memory.
  const ContactOperator& plain() {
    if (!plain_) plain_ = mass_operator(system, mass);
    return *plain_;
  }
  bool is_lumped() const { return system.mass.kind() == MassKind::lumped; }
  void factorise();
  bool solve(const std::vector<Vec3>& parting, std::vector<Vec3>& force);
  bool free_acceleration(std::span<const double> a, const Forces& forces, std::span<const double> besides);
  template <class Held>
  std::string answer_forces(std::span<const double> a, Forces& forces, std::span<const double> besides,
                            const Held& held);
  void take_off(Forces& forces) const;
  void give(Forces& forces) const;
  bool invert(std::span<double> b);
  bool touches(const ConstraintRows& of, std::size_t r) const;
  std::vector<std::size_t> bonds_at(const ConstraintRows& of, std::size_t r) const;
  Delassus delassus(const ConstraintRows& of, const std::vector<std::size_t>& chosen);

  bool holds(const RowLaw& law) const { return equations_alone ? is_equation(law) : is_bond(law); }

  const System& system;
  MassSolver& mass;
  bool equations_alone;
  const ConstraintRows& rows;
  std::optional<ContactOperator> plain_;
  Delassus W;
  std::vector<double> unit;  ///< of each component's force, that makes the diagonal of W 1; 0 where it has none
  std::optional<Cholesky> factor;
  std::vector<double> inverse;                     ///< of a lumped mass
  std::vector<bool> touched;                       ///< nodes of bonds
  std::vector<std::vector<std::size_t>> bonds_of;  ///< of each node, where the mass is lumped
  std::vector<double> moved, rhs, scaled_b;
  std::vector<Vec3> parting, force, answer;
};

void BondedMass::Impl::factorise() {
  if (factor) return;
  mass.factorise();
  std::vector<std::size_t> all(rows.size());
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = r;
  W = plain().delassus(rows, all);
  const std::size_t n = 3 * W.size();
  unit.assign(n, 0.0);
  for (std::size_t i = 0; i < W.size(); ++i) {
    const FrameBlock d = W.block_at(W.own_entry(i));
    const double most = std::max({d[0], d[4], d[8]});
    for (std::size_t a = 0; a < 3; ++a)
      if (d[4 * a] > 1e-12 * most) unit[3 * i + a] = 1.0 / std::sqrt(d[4 * a]);
  }
  CsrMatrix A;
  A.size = static_cast<Index>(n);
  A.row_begin.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    W.each(i / 3, [&](std::size_t of_column, std::size_t entry) {
      for (std::size_t b = 0; b < 3; ++b) {
        const std::size_t j = 3 * of_column + b;
        const bool is_own = i == j;
        const double value = unit[i] * unit[j] * W.block_at(entry)[3 * (i % 3) + b];
        if (value == 0.0 && !is_own) continue;
        A.column.push_back(static_cast<Index>(j));
        A.value.push_back(is_own ? 1.0 + regular : value);
      }
    });
    A.row_begin.push_back(static_cast<std::int64_t>(A.column.size()));
  }
  factor.emplace(A);
}

/// force with W force = -parting, by steps of the regularised matrix.
bool BondedMass::Impl::solve(const std::vector<Vec3>& w, std::vector<Vec3>& to) {
  constexpr int most = 6;
  constexpr double round_off = 1e-15;
  to.assign(w.size(), Vec3{});
  std::vector<Vec3> left = w;
  scaled_b.resize(3 * w.size());
  double before = std::numeric_limits<double>::infinity();
  for (int n = 0; n < most; ++n) {
    double scale = 0.0, error = 0.0;
    for (std::size_t i = 0; i < scaled_b.size(); ++i) {
      scaled_b[i] = -unit[i] * left[i / 3][i % 3];
      error = std::max(error, std::abs(scaled_b[i]));
      scale = std::max(scale, std::abs(unit[i] * w[i / 3][i % 3]));
    }
    if (!std::isfinite(error)) return false;
    if (error <= round_off * scale || error > 0.5 * before) break;
    before = error;
    factor->solve(scaled_b);
    for (std::size_t i = 0; i < scaled_b.size(); ++i) to[i / 3][i % 3] += unit[i] * scaled_b[i];
    W.apply(to, left);
    for (std::size_t r = 0; r < left.size(); ++r) left[r] = add(left[r], w[r]);
  }
  return true;
}

/// moved = M^-1 f where bonds look, the prescribed accelerations being those in a.
bool BondedMass::Impl::free_acceleration(std::span<const double> a, const Forces& forces,
                                         std::span<const double> besides) {
  const std::vector<bool>& fixed = system.supports.fixed();
  if (!is_lumped()) {
    moved.assign(a.begin(), a.end());
    rhs.resize(moved.size());
    force_sum(forces, rhs);
    for (std::size_t i = 0; i < besides.size(); ++i) rhs[i] -= besides[i];
    return mass.solve(rhs, moved) >= 0;
  }
  for (const Index n : rows.node) {
    for (std::size_t i = 3 * static_cast<std::size_t>(n); i < 3 * static_cast<std::size_t>(n) + 3; ++i) {
      const double f =
          forces.external[i] - forces.internal[i] + forces.contact[i] - (besides.empty() ? 0.0 : besides[i]);
      moved[i] = fixed[i] ? a[i] : inverse[i] * f;
    }
  }
  return true;
}

/// Gives the bonds the forces that leave G a = -held.
template <class Held>
std::string BondedMass::Impl::answer_forces(std::span<const double> a, Forces& forces, std::span<const double> besides,
                                            const Held& held) {
  take_off(forces);
  factorise();
  if (!free_acceleration(a, forces, besides)) return MassSolver::failure;
  parting.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) parting[r] = add(rows.relative(r, moved), held(r));
  if (!solve(parting, force)) return no_bonds;
  give(forces);
  return {};
}

/// The bonds among the rows of a response stand in the order of those that are held.
void BondedMass::Impl::take_off(Forces& forces) const {
  ContactResponse& response = forces.rows;
  for (std::size_t r = 0; r < response.rows->size(); ++r) {
    if (!holds(response.rows->law[r]) || response.status[r] == RowStatus::open) continue;
    response.rows->for_each_share(r, scaled(response.force[r], -1.0),
                                  [&](Index node, const Vec3& share) { forces.contact.add(node, share); });
    response.force[r] = {};
    response.status[r] = RowStatus::open;
  }
}

void BondedMass::Impl::give(Forces& forces) const {
  ContactResponse& response = forces.rows;
  std::size_t k = 0;
  for (std::size_t r = 0; r < response.rows->size(); ++r) {
    const RowLaw& law = response.rows->law[r];
    if (!holds(law)) continue;
    response.force[r] = force[k++];
    response.status[r] = admissible(law).status(response.force[r]);
    response.history[static_cast<std::size_t>(response.rows->slot[r])].multiplier =
        response.rows->to_space(r, response.force[r]);
    response.rows->for_each_share(r, response.force[r],
                                  [&](Index node, const Vec3& share) { forces.contact.add(node, share); });
  }
}

/// b = A^-1 b
bool BondedMass::Impl::invert(std::span<double> b) {
  factorise();
  plain().inverse(b);
  parting.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) parting[r] = rows.relative(r, b);
  if (!solve(parting, answer)) return false;
  if (is_lumped()) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      rows.for_each_share(r, answer[r], [&](Index n, const Vec3& share) {
        for (std::size_t c = 0; c < 3; ++c)
          b[3 * static_cast<std::size_t>(n) + c] += inverse[3 * static_cast<std::size_t>(n) + c] * share[c];
      });
    }
    return true;
  }
  std::vector<double> push(b.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) rows.scatter(r, answer[r], push);
  plain().inverse(push);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += push[i];
  return true;
}

/// True when a row has a node of a bond.
bool BondedMass::Impl::touches(const ConstraintRows& of, std::size_t r) const {
  return std::any_of(of.node.begin() + of.begin[r], of.node.begin() + of.begin[r + 1],
                     [&](Index n) { return touched[static_cast<std::size_t>(n)]; });
}

/// The bonds that share a node with a row.
std::vector<std::size_t> BondedMass::Impl::bonds_at(const ConstraintRows& of, std::size_t r) const {
  std::vector<std::size_t> out;
  for (auto k = static_cast<std::size_t>(of.begin[r]); k < static_cast<std::size_t>(of.begin[r + 1]); ++k) {
    const std::vector<std::size_t>& more = bonds_of[static_cast<std::size_t>(of.node[k])];
    out.insert(out.end(), more.begin(), more.end());
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

// G A^-1 G^T of a lumped mass: G M^-1 G^T, as sparse as that is, and what the bonds add between rows that share nodes
// with them, for each of their components the answer of the bonds to what it does to them.
Delassus BondedMass::Impl::delassus(const ConstraintRows& of, const std::vector<std::size_t>& chosen) {
  Delassus own = plain().delassus(of, chosen);
  std::vector<std::size_t> meeting, rows_meeting;  // rows of W, and of `of`
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!touches(of, own.rows[i])) continue;
    meeting.push_back(i);
    rows_meeting.push_back(own.rows[i]);
  }
  if (meeting.empty()) return own;
  factorise();
  const std::size_t m = meeting.size();
  Delassus more = Delassus::dense(rows_meeting, own.normal.empty());
  std::vector<double> push(moved.size(), 0.0);
  const auto add_push = [&](const ConstraintRows& from, std::size_t r, const Vec3& s) {
    from.for_each_share(r, s, [&](Index n, const Vec3& share) {
      for (std::size_t i = 3 * static_cast<std::size_t>(n), c = 0; c < 3; ++c) push[i + c] += inverse[i + c] * share[c];
    });
  };
  const auto clear_push = [&](const ConstraintRows& from, std::size_t r) {
    from.for_each_share(
        r, {}, [&](Index n, const Vec3&) { std::fill_n(push.begin() + 3 * static_cast<std::ptrdiff_t>(n), 3, 0.0); });
  };
  for (std::size_t j = 0; j < m; ++j) {
    const std::size_t row = rows_meeting[j];
    const std::vector<std::size_t> near = bonds_at(of, row);
    for (std::size_t c = 0; c < components(of.law[row]); ++c) {
      Vec3 unit_force{};
      unit_force[c] = 1.0;
      add_push(of, row, unit_force);
      parting.assign(rows.size(), Vec3{});
      for (const std::size_t r : near) parting[r] = rows.relative(r, push);
      clear_push(of, row);
      solve(parting, answer);
      for (std::size_t r = 0; r < rows.size(); ++r) add_push(rows, r, answer[r]);
      for (std::size_t i = j; i < m; ++i) {
        const Vec3 w = of.relative(rows_meeting[i], push);
        FrameBlock lower{}, upper{};
        for (std::size_t a = i == j ? c : 0; a < components(of.law[rows_meeting[i]]); ++a)
          lower[3 * a + c] = upper[3 * c + a] = w[a];
        if (i == j) upper[4 * c] = 0.0;
        more.add(i * m + j, lower);
        more.add(j * m + i, upper);
      }
      for (std::size_t r = 0; r < rows.size(); ++r) clear_push(rows, r);
    }
  }
  return sum_of(own, meeting, more);
}

BondedMass::BondedMass(const System& system, MassSolver& mass, Bonds which)
    : impl_(std::make_unique<Impl>(system, mass, which)) {}
BondedMass::~BondedMass() = default;

bool BondedMass::any() const {
  return impl_->rows.size() > 0;
}

std::string BondedMass::hold(const BondMotion& motion, Forces& forces) {
  if (!any()) return {};
  const double k_v = of_velocity / motion.h, k_u = of_displacement / (motion.h * motion.h);
  return impl_->answer_forces(motion.a, forces, {}, [&](std::size_t r) {
    const ConstraintRows& rows = impl_->rows;
    return add(scaled(rows.relative(r, motion.v), k_v), scaled(rows.relative(r, motion.u), k_u));
  });
}

std::string BondedMass::balance(std::span<const double> a, Forces& forces, std::span<const double> besides) {
  if (!any()) return {};
  return impl_->answer_forces(a, forces, besides,
                              [&](std::size_t r) { return scaled(impl_->rows.relative(r, a), -1.0); });
}

ContactOperator BondedMass::contact_operator() {
  if (!any()) return impl_->plain();
  ContactOperator out;
  out.inverse = [&impl = *impl_](std::span<double> b) { impl.invert(b); };
  out.delassus = [&impl = *impl_](const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
    if (impl.is_lumped()) return impl.delassus(rows, chosen);
    const std::size_t n = impl.moved.size();
    const auto solve = [&impl, n](std::span<double> b, int columns) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) impl.invert(b.subspan(k * n, n));
    };
    return make_delassus(rows, chosen, n, InverseOperator{solve});
  };
  return out;
}

std::vector<double> force_of_contact(const ContactResponse& response, std::size_t dofs) {
  std::vector<double> f(dofs, 0.0);
  for (std::size_t r = 0; r < response.force.size(); ++r)
    if (response.status[r] != RowStatus::open && !is_bond(response.rows->law[r]))
      response.rows->scatter(r, response.force[r], f);
  return f;
}

}  // namespace carom
