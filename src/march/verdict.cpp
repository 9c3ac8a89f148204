#include "march/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr double balance_limit = 1e-10;
constexpr double rounding_of_a_step = 8.0 * std::numeric_limits<double>::epsilon();  // of sums of energies

double ratio(double error, double scale) {
  return scale > 0.0 ? error / scale : 0.0;
}

}  // namespace

void RunMonitor::update(double load_impulse, double rounding) {
  rounding_ += rounding;
  ++steps_;
  const EnergyTerms total = ledger_.now();
  if (stage_.is_static) {
    static_.quadrature += total.quadrature - before_.quadrature;
    static_.algorithmic += total.algorithmic - before_.algorithmic;
    static_.impact += total.impact - before_.impact;
    contact_work_ = std::max(contact_work_, std::abs(static_.impact));
  }
  (stage_.is_explicit ? explicit_loss_ : implicit_loss_) += total.algorithmic - before_.algorithmic;
  before_ = total;
  const EnergyTerms now = dynamic();
  imbalance_ = std::max(imbalance_, std::abs(ledger_.imbalance()));
  quadrature_ = std::max(quadrature_, std::abs(now.quadrature));
  algorithmic_ = std::max(algorithmic_, std::abs(now.algorithmic));
  const double taken_back = std::max(0.0, implicit_loss_ - static_.algorithmic);
  gained_ = std::max(gained_, std::max(0.0, -now.quadrature) + std::max(0.0, -now.impact - taken_back));
  lent_before_ = std::exchange(lent_, -now.algorithmic);
  const Momentum error = ledger_.momentum_error(), impulse = ledger_.impulse();
  const Momentum &momentum = ledger_.momentum(), &begin = ledger_.initial_momentum();
  const bool is_axial = bodies_.momenta == Momenta::axial;
  linear_error_ = std::max(linear_error_, is_axial ? std::abs(error.linear[1]) : norm(error.linear));
  if (!is_axial) angular_error_ = std::max(angular_error_, norm(error.angular));
  // The last entries stand for bodies at rest under their loads, and for those whose momenta cancel: the momentum of
  // all mass with the run's energy.
  load_impulse_ += load_impulse;
  linear_scale_ = std::max({linear_scale_, norm(begin.linear), norm(momentum.linear), norm(impulse.linear),
                            load_impulse_, std::sqrt(2.0 * bodies_.mass * scale())});
  // Moments are compared with what the forces would do at the far end of the bodies, not with a sum that may vanish by
  // symmetry.
  angular_scale_ = std::max({angular_scale_, norm(begin.angular), norm(momentum.angular), norm(impulse.angular),
                             linear_scale_ * ledger_.reach()});
}

void RunMonitor::begin_stage(const StageKind& stage, double springs) {
  if (stage_.is_static) {
    static_.algorithmic += springs;
    implicit_loss_ += springs;
    before_.algorithmic += springs;
  }
  stage_ = stage;
}

double RunMonitor::scale() const {
  return std::max({ledger_.scale(), bodies_.rest_energy, contact_work_, rounding_ / balance_limit});
}

/// The totals without what static stages have booked for the path of their loads and contacts.
EnergyTerms RunMonitor::dynamic() const {
  EnergyTerms terms = ledger_.now();
  terms.quadrature -= static_.quadrature;
  terms.algorithmic -= static_.algorithmic;
  terms.impact -= static_.impact;
  return terms;
}

double RunMonitor::growth() const {
  const double most = stage_.reversible * (scale() + stage_.of_accelerations);
  // Where a load or a motion jumps, the work that supplies the energy comes with the step after it.
  const bool is_lent = stage_.reversible > 0.0 && std::min(lent_, lent_before_) <= most;
  const double path = static_.quadrature + static_.algorithmic + static_.impact;
  return ledger_.growth() + path - (is_lent ? std::max(0.0, lent_) : 0.0);
}

std::string RunMonitor::alarm(double growth_limit) const {
  constexpr double limit = 0.05;
  const double scale = std::max(this->scale(), lent_);
  if (!std::isfinite(ledger_.now().mechanical())) return "the energy is not finite";
  if (growth() > growth_limit * scale) {
    return fmt::format(
        "the mechanical energy has grown by {:.3g} of the initial and supplied energy; the limit is {:g} "
        "(energy_growth in [guards])",
        ratio(growth(), scale), growth_limit);
  }
  if (std::abs(ledger_.imbalance()) > limit * scale) {
    return fmt::format("the balance of powers is off by {:.3g} of the initial and supplied energy; the limit is {:g}",
                       ratio(std::abs(ledger_.imbalance()), scale), limit);
  }
  return {};
}

double RunMonitor::relative_imbalance() const {
  return ratio(std::abs(ledger_.imbalance()), scale());
}
double RunMonitor::linear_momentum_error() const {
  return ratio(linear_error_, linear_scale_);
}
double RunMonitor::angular_momentum_error() const {
  return ratio(angular_error_, angular_scale_);
}

/// Energy that the schemes have given by the end, if it is more than they may keep, `lent` being what they may take
/// back.
double RunMonitor::kept(double lent) const {
  // A step that changes its length changes what an explicit scheme keeps: 0.5 % where bodies are crushed.
  constexpr double least_of_explicit = 0.02, least_of_implicit = 0.005;
  const EnergyTerms now = dynamic();
  const double by_explicit = -explicit_loss_ - lent,
               by_implicit = -(implicit_loss_ - static_.algorithmic) - std::max(0.0, now.impact) - lent;
  return std::max(by_explicit > least_of_explicit * scale() ? by_explicit : 0.0,
                  by_implicit > least_of_implicit * scale() ? by_implicit : 0.0);
}

std::vector<VerdictItem> RunMonitor::items(const Limits& limits) const {
  const double scale = this->scale(), gained = std::max(gained_, kept(limits.lent));
  const auto item = [](const char* name, double value, double limit, const char* explanation) {
    return VerdictItem{name, value, limit, value <= limit, explanation};
  };
  return {
      item("energy balance", ratio(imbalance_, scale), std::max(balance_limit, rounding_of_a_step * steps_),
           "largest imbalance of powers over the run, relative to the larger of initial and supplied energy: forces, "
           "solves and formulas agree to the rounding of every step"),
      item("quadrature", ratio(quadrature_, scale), 0.05,
           "work of internal and contact forces that the trapezoidal rule misplaces. A shorter step or a softer "
           "contact helps (time.step or time.safety, contact.stiffness_factor)"),
      item("energy gained", ratio(gained, scale), limits.energy_gained,
           "energy that contact, the internal forces or the scheme have added; what a scheme lends and takes back does "
           "not count. A shorter step helps, or a scheme that keeps or dissipates energy"),
      item(
          "algorithmic dissipation", ratio(algorithmic_, scale), 0.1,
          "energy that the time scheme takes out (or adds). A shorter step, less numerical damping (alpha, rho_inf, gamma) or "
          "another scheme keeps more of it; contact that stops or throws back what touches counts here, too"),
      item("linear momentum", linear_momentum_error(), 1e-9, "change of momentum against the impulses"),
      item("angular momentum", angular_momentum_error(), limits.angular_momentum,
           "change of angular momentum against the impulses"),
  };
}

}  // namespace carom
