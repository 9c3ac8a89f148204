#include "run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "contact/detect.hpp"
#include "run/build_mesh.hpp"
#include "run/build_model.hpp"
#include "schemes/central_differences.hpp"
#include "schemes/newmark.hpp"

namespace carom {

namespace {

bool is_newmark(const Case& given) {
  return given.scheme.kind == CaseScheme::Kind::newmark;
}

MassKind mass_kind(const Case& given) {
  return given.scheme.mass == CaseScheme::Mass::consistent ? MassKind::consistent : MassKind::lumped;
}

/// Turns what the numerics refuse (std::invalid_argument) into an error at the section that asked for it.
template <class Make>
auto at_section(const Location& where, const std::string& key, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const std::invalid_argument& e) {
    throw CaseError(where, key, e.what(), "");
  }
}

Penalty make_contact(const Case& given, const Model& model, std::vector<std::string>& notes) {
  const Location where = given.contacts.empty() ? Location{given.file} : given.contacts.front().where;
  DetectedContact detected = at_section(where, "contact", [&] { return detect_contact(model); });
  notes = std::move(detected.notes);
  std::vector<PenaltyParameters> parameters = penalty_parameters(model, detected.rows);
  return {std::move(detected.rows), std::move(parameters)};
}

Supports make_supports(const Case& given, const Model& model, const Mass& mass) {
  std::vector<bool> has_mass;
  for (const double m : mass.node_diagonal()) has_mass.push_back(m > 0.0);
  const Location where = given.supports.empty() ? Location{given.file} : given.supports.front().where;
  return at_section(where, "support", [&] { return Supports(model, has_mass); });
}

}  // namespace

Simulation::Simulation(const Case& given)
    : case_(given),
      mesh_(std::make_shared<const Mesh>(build_mesh(given))),
      model_(build_model(given, mesh_)),
      solid_(model_),
      mass_(solid_.mass(mass_kind(given))),
      contact_(make_contact(given, model_, notes_)),
      supports_(make_supports(given, model_, mass_)),
      system_{*mesh_, solid_, mass_, contact_, supports_} {
  refuse_ringing_motions();
  refuse_massless_contact();
  refuse_initial_penetration();
  choose_step();
}

/// Newmark's accelerations that follow an imposed displacement obey beta z^2 + (1/2 + gamma - 2 beta) z + 1/2 - gamma +
/// beta = 0: with gamma = 1/2 the roots have modulus 1, and every kink of the function rings on for ever.
void Simulation::refuse_ringing_motions() const {
  if (!is_newmark(case_) || case_.scheme.gamma > 0.5) return;
  for (const CaseSupport& support : case_.supports) {
    for (const CaseSupport::Motion& motion : support.motions) {
      if (motion.kind != CaseSupport::Kind::displacement || !motion.function) continue;
      throw CaseError(motion.amplitude.where, "support.displacement",
                      fmt::format("a displacement that changes in time, with gamma = {:g}", case_.scheme.gamma),
                      "gamma > 0.5 in [scheme], since otherwise the velocities of these nodes ring without end",
                      "Take beta = 0.28 and gamma = 0.55, or impose the velocity.");
    }
  }
}

/// A contact node that belongs to no part and is held by no support has no equation.
void Simulation::refuse_massless_contact() const {
  const ConstraintRows& rows = contact_.rows();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Index k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
      const Index n = rows.node[k];
      if (mass_.node_diagonal()[static_cast<std::size_t>(n)] > 0.0) continue;
      if (supports_.is_prescribed(3 * n) && supports_.is_prescribed(3 * n + 1) && supports_.is_prescribed(3 * n + 2))
        continue;
      const CaseContact& contact = case_.contacts[static_cast<std::size_t>(rows.source[r])];
      throw CaseError(contact.group.where, "contact.group",
                      fmt::format("node {} of \"{}\", which belongs to no part and is not held in x, y and z",
                                  mesh_->node_numbers[static_cast<std::size_t>(n)], *contact.group),
                      "nodes with mass, or supports on all three components",
                      "Put the cells in a [[part]], or block the node by a [[support]].");
    }
  }
}

/// Bodies that overlap at the start would be thrown apart by energy that nobody put in.
void Simulation::refuse_initial_penetration() const {
  const ConstraintRows& rows = contact_.rows();
  const State state = initial_state();
  for (std::size_t c = 0; c < case_.contacts.size(); ++c) {
    double worst = 0.0;
    std::size_t count = 0, total = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (static_cast<std::size_t>(rows.source[r]) != c) continue;
      ++total;
      const double gap = rows.gap[r] + rows.relative(r, state.q)[0];
      worst = std::min(worst, gap);
      if (gap < 0.0) ++count;
    }
    const std::vector<double>& lengths = solid_.cell_lengths();
    const double cell = *std::min_element(lengths.begin(), lengths.end());
    if (-worst <= 1e-6 * cell) continue;  // relative to the cell: coordinates of meshes often come in single precision
    const CaseContact& contact = case_.contacts[c];
    throw CaseError(
        contact.where, "contact",
        fmt::format("{} of {} rows of \"{}\" that penetrate at the start, the worst by {:.4g} ({:.3g} of a cell)",
                    count, total, *contact.name, -worst, -worst / cell),
        "a gap that is open or just closed", "Is the normal turned the wrong way, or the gap of the wrong sign?");
  }
}

void Simulation::choose_step() {
  const double end = *case_.time.end;
  double wanted = is_newmark(case_) ? **case_.time.step : 0.0, stable_dt = std::numeric_limits<double>::infinity();
  if (!is_newmark(case_)) {
    const StableStep stable = stable_step(system_);
    stable_dt = stable.dt;
    wanted = case_.time.step ? **case_.time.step : case_.time.safety * stable.dt;
    if (wanted > stable.dt) {
      throw CaseError(
          case_.time.step->where, "time.step", fmt::format("{:.6g}", wanted),
          fmt::format("at most the stable step {:.6g} (contact included; {:.6g} without)", stable.dt, stable.dt_free),
          "Lower the step, or leave it out to have it chosen.");
    }
  }
  const double count = end / wanted;
  if (!(count < 1e13)) {
    throw CaseError(case_.time.where, "time", fmt::format("{:.3g} steps to the end", count), "fewer than 1e13");
  }
  steps_ = std::max(1LL, static_cast<long long>(std::ceil(count * (1.0 - 1e-9))));
  if (case_.time.fixed && std::abs(count - static_cast<double>(steps_)) > 1e-6) {
    throw CaseError(
        case_.time.end.where, "time.end", fmt::format("{:.9g} steps of {:.6g} to {:.6g}", count, wanted, end),
        "a whole number of steps, since the step is fixed", "Change end or step, or leave out fixed = true.");
  }
  // Keep the user's own number when it divides the end; its multiples are then the times of the steps.
  dt_ = std::abs(count - static_cast<double>(steps_)) <= 1e-6 ? wanted : end / static_cast<double>(steps_);
  if (is_newmark(case_)) {
    reversible_energy_ = 2.0 * case_.scheme.beta >= case_.scheme.gamma * (1.0 - 1e-12) ? 1.0 : 0.0;
  } else {
    reversible_energy_ = 1.0 / std::max(1e-3, 1.0 - std::pow(dt_ / stable_dt, 2));  // finite also at the limit
  }
}

State Simulation::initial_state() const {
  State state;
  state.q.assign(solid_.dof_count(), 0.0);
  state.v = state.a = state.q;
  state.contact.resize(contact_.rows().size());
  for (const InitialState& initial : model_.initial) {
    for (const Index n : initial.nodes) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 3 * static_cast<std::size_t>(n) + c;
        if (initial.displacement) state.q[i] = (*initial.displacement)[c];
        if (initial.velocity) state.v[i] = (*initial.velocity)[c];
      }
    }
  }
  return state;
}

std::unique_ptr<Scheme> Simulation::make_scheme() const {
  if (!is_newmark(case_)) return std::make_unique<CentralDifferences>(system_);
  static constexpr SolverKind kinds[] = {SolverKind::automatic, SolverKind::conjugate_gradients, SolverKind::cholesky};
  NewmarkParameters parameters;
  parameters.beta = case_.scheme.beta;
  parameters.gamma = case_.scheme.gamma;
  parameters.max_iterations = case_.solver.max_contact_iterations;
  parameters.solver = kinds[static_cast<int>(case_.solver.kind)];
  const std::vector<double> bounds = solid_.cell_frequency_bounds();
  return std::make_unique<Newmark>(system_, parameters, dt_, *std::max_element(bounds.begin(), bounds.end()));
}

std::string Simulation::scheme_name() const {
  const char* mass = mass_.kind() == MassKind::lumped ? "lumped" : "consistent";
  if (!is_newmark(case_)) return fmt::format("central differences, {} mass", mass);
  return fmt::format("Newmark beta {:g} gamma {:g}, {} mass", case_.scheme.beta, case_.scheme.gamma, mass);
}

}  // namespace carom
