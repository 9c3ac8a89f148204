#include "record/exact_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

#include "exact/bar_impact.hpp"
#include "exact/bouncing_bar.hpp"
#include "exact/friction.hpp"
#include "exact/hertz.hpp"
#include "exact/two_bars.hpp"

namespace carom {

namespace {

using Columns = std::vector<ExactCurves::Column>;
using Value = ExactCurves::Value;

/// What an exact solution says of a point: displacement, velocity and axial stress; an empty one says nothing.
struct PointValues {
  Value displacement, velocity, stress;
};

/// Makes the columns of one case; the solutions live as long as the functions that hold them.
class CurveBuilder {
 public:
  CurveBuilder(const Simulation& simulation, const ProbeCurves& probes)
      : simulation_(simulation),
        given_(simulation.given()),
        exact_(*given_.exact),
        probes_(probes),
        axis_(static_cast<std::size_t>(exact_.axis)),
        letter_("xyz"[axis_]) {}

  Columns build() {
    const std::string& solution = *exact_.solution;
    try {
      if (solution == "bouncing_bar")
        bouncing_bar();
      else if (solution == "two_bars")
        two_bars();
      else if (solution == "sphere_on_rigid_wall")
        sphere();
      else if (solution == "sliding_block")
        sliding_block();
      else if (solution == "friction_oscillator")
        oscillator();
      else
        bar_on_wall();
    } catch (const std::invalid_argument& error) {
      throw CaseError(exact_.where, "exact", error.what(), fmt::format("the data of {}", solution));
    }
    return std::move(columns_);
  }

 private:
  void bar_on_wall() {
    BarImpactData data{exact_.length, exact_.modulus, exact_.density, exact_.area, exact_.speed, exact_.gap};
    if (*exact_.solution == "bar_on_penalty_wall") data.stiffness = exact_.stiffness;
    if (*exact_.solution == "bar_on_free_mass") data.wall_mass = exact_.mass;
    const auto bar = std::make_shared<const BarImpact>(data);
    const double z0 = lowest(), shift = exact_.initial_displacement;
    add_probes([&](std::size_t, double x) {
      const double z = std::clamp(x - z0, 0.0, exact_.length);
      return PointValues{[bar, z, shift](double t) { return shift + bar->displacement(z, t); },
                         [bar, z](double t) { return bar->velocity(z, t); },
                         [bar, z](double t) { return bar->stress(z, t); }};
    });
    add_force([bar](double t) { return bar->contact_force(t); });
    if (data.wall_mass > 0.0 && given_.contacts.size() == 1)
      columns_.push_back({fmt::format("{}.velocity_{}", *given_.contacts[0].name, letter_),
                          [bar](double t) { return bar->wall_velocity(t); }});
    const double mass = data.wall_mass;
    columns_.push_back({"kinetic", [bar, mass](double t) {
                          const double v = bar->wall_velocity(t);
                          return bar->kinetic_energy(t) + 0.5 * mass * v * v;
                        }});
    columns_.push_back({"strain", [bar](double t) { return bar->strain_energy(t); }});
    columns_.push_back({"contact_stored", [bar](double t) { return bar->contact_energy(t); }});
  }

  void bouncing_bar() {
    const ElasticBar data{exact_.length, exact_.modulus, exact_.density, exact_.area, -exact_.speed};
    const auto bar =
        std::make_shared<const BouncingBar>(BouncingBarData{data, exact_.gravity, exact_.gap}, past_the_end());
    const double z0 = lowest();
    add_probes([&](std::size_t, double x) {
      const double z = std::clamp(x - z0, 0.0, exact_.length);
      return PointValues{[bar, z](double t) { return bar->displacement(z, t); },
                         [bar, z](double t) { return bar->velocity(z, t); },
                         [bar, z](double t) { return bar->stress(z, t); }};
    });
    add_force([bar](double t) { return bar->contact_force(t); });
    columns_.push_back({"kinetic", [bar](double t) { return bar->kinetic_energy(t); }});
    columns_.push_back({"strain", [bar](double t) { return bar->strain_energy(t); }});
  }

  /// The first part is the bar on the negative side of the axis, the second that on the positive side.
  void two_bars() {
    if (simulation_.given().parts.size() != 2)
      throw std::invalid_argument(fmt::format("{} parts", simulation_.given().parts.size()));
    const CaseExactBar& second = *exact_.second;
    const TwoBarsData data{{exact_.length, exact_.modulus, exact_.density, exact_.area, exact_.speed},
                           {second.length, second.modulus, second.density, second.area, second.speed},
                           exact_.gap};
    const auto bars = std::make_shared<const TwoBars>(data, past_the_end());
    const double face = lowest() + exact_.length;
    add_probes([&](std::size_t probe, double x) {
      const int bar = part_of_probe(probe);
      const double length = bar == 0 ? exact_.length : second.length;
      const double z = std::clamp(bar == 0 ? face - x : x - face - exact_.gap, 0.0, length);
      return PointValues{[bars, bar, z](double t) { return bars->displacement(bar, z, t); },
                         [bars, bar, z](double t) { return bars->velocity(bar, z, t); },
                         [bars, bar, z](double t) { return bars->stress(bar, z, t); }};
    });
    const double sign = slave_part() == 0 ? -1.0 : 1.0;
    add_force([bars, sign](double t) { return sign * bars->force(t); });
    columns_.push_back(
        {"kinetic", [bars](double t) { return bars->kinetic_energy(0, t) + bars->kinetic_energy(1, t); }});
    columns_.push_back({"strain", [bars](double t) { return bars->strain_energy(0, t) + bars->strain_energy(1, t); }});
  }

  void sphere() {
    const double modulus = exact_.modulus / (1.0 - exact_.poisson * exact_.poisson);
    const double touch = exact_.gap / exact_.speed;
    const auto impact = std::make_shared<const HertzImpact>(exact_.mass, exact_.radius, modulus, exact_.speed);
    add_force([impact, touch](double t) { return t < touch ? 0.0 : impact->force(t - touch); });
  }

  void sliding_block() {
    const auto block = std::make_shared<const SlidingBlock>(
        SlidingBlockData{exact_.mass, exact_.friction, exact_.gravity, exact_.angle, exact_.speed});
    add_probes([&](std::size_t, double) {
      return PointValues{
          [block](double t) { return block->position(t); }, [block](double t) { return block->velocity(t); }, {}};
    });
    columns_.push_back({"friction", [block](double t) { return block->dissipated(t); }});
  }

  void oscillator() {
    const auto block = std::make_shared<const FrictionOscillator>(FrictionOscillatorData{
        exact_.mass, exact_.stiffness, exact_.friction * exact_.mass * exact_.gravity, exact_.initial_displacement});
    add_probes([&](std::size_t, double) {
      return PointValues{
          [block](double t) { return block->position(t); }, [block](double t) { return block->velocity(t); }, {}};
    });
    columns_.push_back({"friction", [block](double t) { return block->dissipated(t); }});
  }

  /// A little past the end, so that the last step's rounding stays inside.
  double past_the_end() const { return simulation_.end() * (1.0 + 1e-6); }

  /// values(probe, coordinate along the axis)
  template <class Values>
  void add_probes(const Values& values) {
    for (std::size_t p = 0; p < given_.probes.size(); ++p) {
      const std::string& probe = *given_.probes[p].name;
      const PointValues point = values(p, probes_.positions()[p][axis_]);
      add_probe_column(fmt::format("{}.displacement_{}", probe, letter_), point.displacement);
      add_probe_column(fmt::format("{}.velocity_{}", probe, letter_), point.velocity);
      add_probe_column(fmt::format("{}.stress_{}{}", probe, letter_, letter_), point.stress);
    }
  }

  void add_probe_column(const std::string& name, const Value& value) {
    if (value && probes_.table().find(name)) columns_.push_back({name, value});
  }

  /// Of the only resultant, where there is one.
  void add_force(const Value& value) {
    const ContactResultants resultants(simulation_.model(), std::vector<std::optional<Vec3>>(given_.contacts.size()));
    if (resultants.places().size() == 1)
      columns_.push_back({fmt::format("{}.force_{}", resultants.places()[0].name, letter_), value});
  }

  /// Lowest coordinate of the parts along the axis.
  double lowest() const {
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < simulation_.solid().cells().size(); ++k)
      for (const Index n : simulation_.solid().cells().nodes_of(k))
        low = std::min(low, simulation_.mesh().coordinates[static_cast<std::size_t>(n)][axis_]);
    return low;
  }

  /// Position in the case of the part that holds the node.
  int part_of_node(Index node) const {
    std::size_t cell = 0;
    const std::vector<Part>& parts = simulation_.model().parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (std::size_t k = 0; k < parts[p].cells.size(); ++k, ++cell) {
        const auto nodes = simulation_.solid().cells().nodes_of(cell);
        if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) return simulation_.model().part_numbers()[p];
      }
    }
    return 0;
  }

  int part_of_probe(std::size_t probe) const { return part_of_node(probes_.nodes(probe).front()); }

  /// The part that the contact's force acts on: the first of two in self-contact (ResultantPlace).
  int slave_part() const {
    if (simulation_.model().contacts.empty()) return 1;
    const ContactParts contact = parts_of(simulation_.model().contacts[0]);
    if (contact.is_self) return 0;
    const bool is_pair = contact.other != nullptr && contact.nature == ContactNature::touches;
    return !is_pair || contact.own->facets.empty() ? 1 : part_of_node(contact.own->facets[0][0]);
  }

  const Simulation& simulation_;
  const Case& given_;
  const CaseExact& exact_;
  const ProbeCurves& probes_;
  std::size_t axis_;
  char letter_;
  Columns columns_;
};

}  // namespace

ExactCurves::ExactCurves(const Simulation& simulation, const ProbeCurves& probes)
    : columns_(CurveBuilder(simulation, probes).build()) {
  table_.columns = {"time"};
  for (const Column& c : columns_) table_.columns.push_back(c.name);
}

std::optional<double> ExactCurves::value(const std::string& column, double t) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
  if (found == columns_.end()) return std::nullopt;
  return found->value(t);
}

void ExactCurves::sample(double t) {
  table_.row = {t};
  for (const Column& c : columns_) table_.row.push_back(c.value(t));
}

}  // namespace carom
