#include "run/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "energy/ledger.hpp"
#include "math/vec3.hpp"
#include "run/probe_place.hpp"

namespace carom {

std::optional<std::size_t> CurveTable::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

EnergyCurves::EnergyCurves() {
  table_.columns = {"time", "step", "dt", "iterations"};
  for (const EnergyTerm& term : energy_terms) table_.columns.emplace_back(term.name);
  table_.columns.emplace_back("imbalance");
  table_.columns.insert(table_.columns.end(), aster_names.begin(), aster_names.end());
  table_.columns.insert(table_.columns.end(),
                        {"momentum_x", "momentum_y", "momentum_z", "angular_momentum_x", "angular_momentum_y",
                         "angular_momentum_z", "momentum_error", "angular_momentum_error"});
}

void EnergyCurves::sample(const StepView& view) {
  const EnergyTerms e = view.ledger.now();
  const std::array<double, 6> aster = aster_values(view.ledger.aster());
  const Momentum &p = view.ledger.momentum(), error = view.ledger.momentum_error();
  table_.row = {view.state.t, static_cast<double>(view.step), view.dt, static_cast<double>(view.iterations)};
  for (const EnergyTerm& term : energy_terms) table_.row.push_back(e.*term.value);
  table_.row.push_back(view.ledger.imbalance());
  table_.row.insert(table_.row.end(), aster.begin(), aster.end());
  table_.row.insert(table_.row.end(), {p.linear[0], p.linear[1], p.linear[2], p.angular[0], p.angular[1], p.angular[2],
                                       norm(error.linear), norm(error.angular)});
}

namespace {

/// Names of what contact.csv says of the motion of a contact's obstacle.
std::vector<std::string> motion_columns(const Model& model, std::size_t contact) {
  const ContactParts found = parts_of(model.contacts[contact]);
  if (!found.moves()) return {};
  std::vector<std::string> names{"displacement_x", "displacement_y", "displacement_z",
                                 "velocity_x",     "velocity_y",     "velocity_z"};
  if (found.body >= 0) names.insert(names.end(), {"angular_velocity_x", "angular_velocity_y", "angular_velocity_z"});
  return names;
}

}  // namespace

namespace {

constexpr std::array resultant_columns{"force_x",   "force_y",  "force_z",  "impulse_x", "impulse_y",
                                       "impulse_z", "moment_x", "moment_y", "moment_z"};

std::vector<std::optional<Vec3>> moment_points(const Case& given) {
  std::vector<std::optional<Vec3>> points;
  for (const CaseContact& contact : given.contacts) points.push_back(contact.moment_point);
  return points;
}

}  // namespace

ContactCurves::ContactCurves(const Simulation& simulation)
    : model_(simulation.model()),
      solid_(simulation.solid()),
      contacts_(simulation.given().contacts.size()),
      resultants_(model_, moment_points(simulation.given())) {
  table_.columns = {"time"};
  for (std::size_t c = 0; c < contacts_; ++c) {
    const auto add_columns = [&](const std::string& place, const auto& names) {
      for (const auto& name : names) table_.columns.push_back(fmt::format("{}.{}", place, name));
    };
    for (const ResultantPlace& place : resultants_.places())
      if (place.contact == c) add_columns(place.name, resultant_columns);
    const std::string& contact = *simulation.given().contacts[c].name;
    add_columns(contact, std::array{"penetration", "closed", "closings"});
    add_columns(contact, motion_columns(model_, c));
  }
  force_.resize(resultants_.places().size());
  impulse_.resize(resultants_.places().size());
  closed_.resize(contacts_);
  closings_.resize(contacts_);
}

void ContactCurves::add_impulses(const StepView& view, const std::vector<ContactResultant>& now) {
  if (view.step > 0) {
    std::vector<ContactResultant> within(now.size());
    if (view.within.weight > 0.0) within = resultants_.of(view.within.rows, view.within.u);
    const double ends = 1.0 - view.within.weight;
    for (std::size_t k = 0; k < now.size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i)
        impulse_[k][i] +=
            view.dt * (ends * (1.0 - view.end_weight) * force_[k][i] + ends * view.end_weight * now[k].force[i] +
                       view.within.weight * within[k].force[i]);
    }
  }
  for (std::size_t k = 0; k < now.size(); ++k) force_[k] = now[k].force;
}

void ContactCurves::add_motion(std::size_t contact, const State& state) {
  const ContactParts found = parts_of(model_.contacts[contact]);
  const auto append = [&](const Vec3& x) { table_.row.insert(table_.row.end(), x.begin(), x.end()); };
  if (found.carrier >= 0) {
    for (const std::vector<double>* x : {&state.q, &state.v}) {
      const auto first = x->begin() + 3 * static_cast<std::ptrdiff_t>(found.carrier);
      table_.row.insert(table_.row.end(), first, first + 3);
    }
  }
  if (found.body < 0) return;
  const TurningBody& body = model_.turning_bodies[static_cast<std::size_t>(found.body)];
  const BodyFrame displacement = body_frame(body, nodal_values(body, state.q));
  const BodyFrame velocity = body_frame(body, nodal_values(body, state.v));
  BodyFrame position = displacement;
  for (std::size_t i = 0; i < 3; ++i) position.directors[i] = add(position.directors[i], body.axes[i]);
  append(displacement.centre);
  append(velocity.centre);
  append(angular_velocity(position, velocity));
}

void ContactCurves::sample(const StepView& view) {
  const ConstraintRows& rows = *view.forces.rows.rows;
  std::vector<ContactResultant> resultants = resultants_.of(view.forces.rows, view.state.q);
  resultants_.add_cohesive(solid_.cohesive(), view.state.q, view.points().history, resultants);
  std::vector<double> penetration(contacts_, 0.0), closed(contacts_, 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (view.forces.rows.status[r] == RowStatus::open || rows.source[r] < 0) continue;
    const auto c = static_cast<std::size_t>(rows.source[r]);
    penetration[c] = std::max(penetration[c], -rows.gap_at(r, view.state.q));
    closed[c] += 1.0;
  }
  table_.row = {view.state.t};
  add_impulses(view, resultants);
  for (std::size_t c = 0; c < contacts_; ++c) {
    for (std::size_t k = 0; k < resultants.size(); ++k) {
      if (resultants_.places()[k].contact != c) continue;
      for (const Vec3* v : std::array<const Vec3*, 3>{&resultants[k].force, &impulse_[k], &resultants[k].moment})
        table_.row.insert(table_.row.end(), v->begin(), v->end());
    }
    if (closed_[c] == 0.0 && closed[c] > 0.0) closings_[c] += 1.0;
    closed_[c] = closed[c];
    table_.row.insert(table_.row.end(), {penetration[c], closed[c], closings_[c]});
    add_motion(c, view.state);
  }
}

namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};
constexpr const char* stress_names[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

}  // namespace

ProbeCurves::ProbeCurves(const Simulation& simulation) : simulation_(simulation) {
  table_.columns = {"time"};
  for (const CaseProbe& given : simulation.given().probes) {
    Probe probe;
    const ProbePlace place = place_probe(given, simulation);
    probe.nodes = place.nodes;
    Vec3 position{};
    for (const Index n : probe.nodes) {
      position = add(position, scaled(simulation.mesh().coordinates[static_cast<std::size_t>(n)],
                                      1.0 / static_cast<double>(probe.nodes.size())));
    }
    for (const auto& quantity : given.quantities) probe.quantities.push_back(*quantity);
    find_cells(given, position, probe);
    add_columns(*given.name, probe);
    positions_.push_back(position);
    if (given.point) note_node(given, place);
    probes_.push_back(std::move(probe));
  }
}

void ProbeCurves::note_node(const CaseProbe& given, const ProbePlace& place) {
  const auto n = static_cast<std::size_t>(place.nodes[0]);
  const Vec3& x = simulation_.mesh().coordinates[n];
  notes_.push_back(fmt::format("probe \"{}\": node {} at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the point", *given.name,
                               simulation_.mesh().node_numbers[n], x[0], x[1], x[2], place.distance));
}

void ProbeCurves::find_cells(const CaseProbe& given, const Vec3& position, Probe& probe) const {
  const auto asks = [&](const char* q) {
    return std::find(probe.quantities.begin(), probe.quantities.end(), q) != probe.quantities.end();
  };
  if (!asks("stress") && !asks("section_force")) return;
  const Mesh& mesh = simulation_.mesh();
  const Solid& solid = simulation_.solid();
  const Vec3 across = given.side ? across_section(given, probe.nodes, mesh) : Vec3{};
  std::vector<bool> is_member(mesh.node_count(), false);
  for (const Index n : probe.nodes) is_member[static_cast<std::size_t>(n)] = true;
  for (std::size_t k = 0; k < solid.cell_count(); ++k) {
    const auto nodes = solid.nodes_of_cell(k);
    bool touches = false;
    Vec3 centre{};
    for (const Index n : nodes) {
      touches = touches || is_member[static_cast<std::size_t>(n)];
      centre =
          add(centre, scaled(mesh.coordinates[static_cast<std::size_t>(n)], 1.0 / static_cast<double>(nodes.size())));
    }
    if (!touches) continue;
    probe.cells.push_back(static_cast<Index>(k));
    if (given.side && dot(subtract(centre, position), across) > 0.0)
      probe.section_cells.push_back(static_cast<Index>(k));
  }
  const bool nothing_to_sum = asks("section_force") && probe.section_cells.empty();
  if (probe.cells.empty() || nothing_to_sum) {
    throw CaseError(
        given.where, "probe",
        fmt::format("no solid cell that touches probe \"{}\"{}", *given.name, nothing_to_sum ? " on that side" : ""),
        "a probe on nodes of a part", nothing_to_sum ? "Turn `side` to where the cells are." : "");
  }
}

void ProbeCurves::add_columns(const std::string& name, const Probe& probe) {
  for (const std::string& quantity : probe.quantities) {
    const bool is_tensor = quantity == "stress";
    for (std::size_t c = 0; c < (is_tensor ? 6U : 3U); ++c) {
      table_.columns.push_back(fmt::format("{}.{}_{}", name, quantity, is_tensor ? stress_names[c] : axis_names[c]));
    }
  }
}

void ProbeCurves::sample(const StepView& view) {
  table_.row = {view.state.t};
  const auto append_mean = [&](const Probe& probe, const std::vector<double>& x) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (const Index n : probe.nodes) sum += x[3 * static_cast<std::size_t>(n) + c];
      table_.row.push_back(sum / static_cast<double>(probe.nodes.size()));
    }
  };
  std::vector<std::array<double, 6>> stress;
  for (const Probe& probe : probes_) {
    for (const std::string& quantity : probe.quantities) {
      if (quantity == "displacement") append_mean(probe, view.state.q);
      if (quantity == "velocity") append_mean(probe, view.state.v);
      if (quantity == "acceleration") append_mean(probe, view.state.a);
      if (quantity == "stress") {
        if (stress.empty()) stress = simulation_.solid().cell_stress(view.state.q, view.points());
        for (std::size_t c = 0; c < 6; ++c) {
          double sum = 0.0;
          for (const Index k : probe.cells) sum += stress[static_cast<std::size_t>(k)][c];
          table_.row.push_back(sum / static_cast<double>(probe.cells.size()));
        }
      }
      if (quantity == "section_force") {
        section_work_.assign(view.state.q.size(), 0.0);
        simulation_.solid().add_internal_force_of(probe.section_cells, view.state.q, section_work_, view.points());
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0.0;
          for (const Index n : probe.nodes) sum -= section_work_[3 * static_cast<std::size_t>(n) + c];
          table_.row.push_back(sum);
        }
      }
    }
  }
}

}  // namespace carom
