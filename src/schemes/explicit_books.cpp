#include "schemes/explicit_books.hpp"

#include <array>
#include <utility>
#include <vector>

#include "parallel/threads.hpp"
#include "schemes/books.hpp"

namespace carom {

namespace {

/// What a node adds to the books of a step of central differences: the work of internal forces; works of contact and
/// external forces, impulses of both and their moments. The forces of each end act where the nodes stand then: with a
/// lumped mass that is the exact change of momentum.
class StepSums {
 public:
  static constexpr std::size_t count = 8;

  StepSums(const System& system, const State& begin, const State& end, double h)
      : f0_(begin.forces),
        f1_(end.forces),
        q0_(begin.q.data()),
        q1_(end.q.data()),
        half_(0.5 * h),
        arms_0_(system, begin.q),
        arms_1_(system, end.q) {}

  double internal_work(std::size_t node) const {
    double work = 0.0;
    for (std::size_t i = 3 * node; i < 3 * node + 3; ++i)
      work += 0.5 * (f0_.internal[i] + f1_.internal[i]) * (q1_[i] - q0_[i]);
    return work;
  }
  /// What pushes the body.
  void add_pushes(std::size_t node, double* sums) const {
    const Vec3 contact_0 = f0_.contact.at(node), contact_1 = f1_.contact.at(node);
    Vec3 impulse_0, impulse_1;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * node + c;
      const double half_way = 0.5 * (q1_[i] - q0_[i]);
      sums[0] += (contact_0[c] + contact_1[c]) * half_way;
      sums[1] += (f0_.external[i] + f1_.external[i]) * half_way;
      impulse_0[c] = half_ * (f0_.external[i] + contact_0[c]);
      impulse_1[c] = half_ * (f1_.external[i] + contact_1[c]);
    }
    add_with_moment(arms_0_.at(node), impulse_0, sums + 2);
    add_with_moment(arms_1_.at(node), impulse_1, sums + 2);
  }
  /// The half impulses of the supports of a node.
  void add_support(std::size_t node, const Vec3& reaction_0, const Vec3& reaction_1, double* sums) const {
    add_with_moment(arms_0_.at(node), scaled(reaction_0, half_), sums + 2);
    add_with_moment(arms_1_.at(node), scaled(reaction_1, half_), sums + 2);
  }

 private:
  const Forces &f0_, &f1_;
  const double *q0_, *q1_;
  double half_;
  MomentArms arms_0_, arms_1_;
};

/// From the sums over the nodes; takes those of the supports in.
LedgerIncrement books_of_sums(const System& system, const State& begin, const Balance& b0,
                              std::span<const double> a_begin, const State& end, double h, const StepSums& terms,
                              ContactWork contact, double internal_work, std::array<double, StepSums::count> sums) {
  const Forces& f1 = end.forces;
  double support = 0.0, inertia_power = f1.inertia_power - b0.inertia_power;  // da . (M a0 + M a1), as M is symmetric
  const std::vector<PrescribedDof>& prescribed = system.supports.prescribed();
  for (std::size_t k = 0; k < prescribed.size();) {
    const auto node = static_cast<std::size_t>(prescribed[k].dof) / 3;
    Vec3 before{}, after{};  // the reactions on its dofs, which stand together
    for (; k < prescribed.size() && static_cast<std::size_t>(prescribed[k].dof) / 3 == node; ++k) {
      const auto i = static_cast<std::size_t>(prescribed[k].dof);
      support += support_work(system, k, begin, b0, end, 0.5);
      inertia_power -= (end.a[i] - a_begin[i]) * (b0.supports[k].inertia + f1.supports[k].inertia);
      before[i % 3] = b0.supports[k].reaction;
      after[i % 3] = f1.supports[k].reaction;
    }
    terms.add_support(node, before, after, sums.data());
  }
  contact.total = sums[0];
  LedgerIncrement step = books_of_works(begin, end, {internal_work, sums[1], support, contact});
  step.energy.algorithmic = -0.125 * h * h * inertia_power;
  step.impulse = momentum_from(sums.data() + 2);
  return step;
}

}  // namespace

LedgerIncrement central_difference_books(const System& system, const State& begin, const Balance& b0,
                                         std::span<const double> a_begin, const ContactWork& contact, const State& end,
                                         double h) {
  const StepSums terms(system, begin, end, h);
  const std::size_t nodes = end.q.size() / 3;
  const double internal_work = parallel_sum(nodes, [&](std::size_t node) { return terms.internal_work(node); });
  const auto sums = parallel_sums<StepSums::count>(
      nodes, [&](std::size_t node, std::array<double, StepSums::count>& s) { terms.add_pushes(node, s.data()); });
  return books_of_sums(system, begin, b0, a_begin, end, h, terms, contact, internal_work, sums);
}

PushedNodes::PushedNodes(const System& system)
    : loaded_(system.solid.loads().nodes().size()),
      nodes_(system.solid.loads().nodes()),
      is_pushed_(system.solid.node_count(), 0) {
  for (const Index n : nodes_) is_pushed_[static_cast<std::size_t>(n)] = 1;
}

void PushedNodes::look(const ConstraintRows& before, const ConstraintRows& after) {
  for (std::size_t k = loaded_; k < nodes_.size(); ++k) is_pushed_[static_cast<std::size_t>(nodes_[k])] = 0;
  nodes_.resize(loaded_);
  for (const ConstraintRows* rows : {&before, &after})
    for (const Index n : rows->node)
      if (std::exchange(is_pushed_[static_cast<std::size_t>(n)], std::uint8_t{1}) == 0) nodes_.push_back(n);
}

LedgerIncrement end_lumped_step(const System& system, const State& begin, const Balance& b0,
                                std::span<const double> a_begin, const ContactWork& contact_work,
                                const PushedNodes& pushed, const Holding& nodes, State& end, double h) {
  const double half = 0.5 * h;
  const std::vector<double>& mass = system.mass.node_diagonal();
  Forces& f1 = end.forces;
  const StateSums of_state(system, end);
  const StepSums of_step(system, begin, end, h);
  constexpr std::size_t count = StateSums::count + 1;
  const auto move = [&](std::size_t node, Vec3 & a, Vec3 & v) __attribute__((always_inline)) {
    const double inverse = 1.0 / mass[node];
    const bool is_pushed = pushed[node];
    const Vec3 contact = is_pushed ? f1.contact.at(node) : Vec3{};
    const unsigned fixed = system.supports.fixed_components(node);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * node + c;
      a[c] = end.a[i];
      v[c] = end.v[i];
      if ((fixed >> c & 1U) != 0) continue;
      const double push = is_pushed ? f1.external[i] + contact[c] : 0.0;
      a[c] = inverse * (push - f1.internal[i]);
      v[c] += half * a[c];
      end.a[i] = a[c];
      end.v[i] = v[c];
    }
  };
  nodes.each_range_beside([&](std::size_t first, std::size_t last) {
    Vec3 a, v;
    for (std::size_t node = first; node < last; ++node) move(node, a, v);
  });
  const auto sums = nodes.sums<count>([&](std::size_t node, std::array<double, count>& s) {
    Vec3 a, v;
    move(node, a, v);
    of_state.add(node, v, scaled(v, mass[node]), a, scaled(a, mass[node]), s.data());
    s[count - 1] += of_step.internal_work(node);
  });
  StateSums::give(system, sums.data(), f1);
  complete_supports(system, end);
  constexpr std::size_t pushes_count = StepSums::count;
  const auto add_push = [&](std::size_t node, std::array<double, pushes_count>& s) {
    of_step.add_pushes(node, s.data());
  };
  const auto pushes = pushed.are_all()
                          ? nodes.sums<pushes_count>(add_push)
                          : parallel_sums<pushes_count>(pushed.nodes().size(), [&](std::size_t k, auto& s) {
                              add_push(static_cast<std::size_t>(pushed.nodes()[k]), s);
                            });
  return books_of_sums(system, begin, b0, a_begin, end, h, of_step, contact_work, sums.back(), pushes);
}

LedgerIncrement explicit_books(const System& system, const State& begin, const Balance& b0, const ContactWork& contact,
                               const State& end, std::span<const double> A, std::span<const double> B, double h) {
  LedgerIncrement step = central_difference_books(system, begin, b0, begin.a, contact, end, h);
  const std::span<const double> inertia = end.forces.inertia;
  std::vector<double> MA(A.size());
  system.mass.apply(A, MA);
  const auto sums = parallel_sums<4>(A.size(), [&](std::size_t i, std::array<double, 4>& s) {
    if (system.supports.is_prescribed(static_cast<Index>(i))) return;
    const double du = end.q[i] - begin.q[i], missed = 0.5 * (b0.inertia[i] + inertia[i]) - MA[i];
    s[i % 3] += h * missed;
    s[3] += du * missed - h * h * (0.5 * A[i] - B[i]) * MA[i];
  });
  step.energy.algorithmic = sums[3];
  step.lag = {sums[0], sums[1], sums[2]};
  step.impulse = {};
  return step;
}

}  // namespace carom
