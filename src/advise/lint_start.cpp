#include "advise/lint_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "base/units.hpp"
#include "build/groups.hpp"
#include "build/parts.hpp"
#include "casefile/document.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr double rounding = 1e-6;  // of speeds and lengths: meshes often come in single precision

/// Extents of points along and across a direction.
class Extent {
 public:
  explicit Extent(const Vec3& along) {
    const std::size_t least = std::abs(along[0]) < 0.6 ? 0 : 1;
    Vec3 axis{};
    axis[least] = 1.0;
    const Vec3 across = normalized(cross(along, axis));
    axes_ = {along, across, cross(along, across)};
  }
  void include(const Vec3& x) {
    for (std::size_t a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], dot(x, axes_[a]));
      high_[a] = std::max(high_[a], dot(x, axes_[a]));
    }
  }
  /// The end that comes last.
  double rear() const { return low_[0]; }
  bool is_empty() const { return low_[0] > high_[0]; }
  double size() const { return norm(subtract(high_, low_)); }
  Vec3 middle() const {
    Vec3 x{};
    for (std::size_t a = 0; a < 3; ++a) x = add(x, scaled(axes_[a], 0.5 * (low_[a] + high_[a])));
    return x;
  }
  /// Would this, on its way along the direction, come to the other? Not where they touch with their sides.
  bool meets(const Extent& other) const {
    const double least = rounding * size();
    if (other.is_empty() || other.high_[0] <= low_[0] + least) return false;
    for (std::size_t a = 1; a < 3; ++a) {
      const double common = std::min(high_[a], other.high_[a]) - std::max(low_[a], other.low_[a]);
      const bool is_flat = high_[a] - low_[a] <= least || other.high_[a] - other.low_[a] <= least;
      if (common < (is_flat ? -least : least)) return false;
    }
    return true;
  }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();
  std::array<Vec3, 3> axes_{};
  Vec3 low_{far, far, far}, high_{-far, -far, -far};
};

/// Looks at the [[initial]] sections of a case: at velocities that something else overwrites, and at falls.
class StartLint {
 public:
  explicit StartLint(const Simulation& s)
      : s_(s), case_(s.given()), groups_(s.mesh()), parts_(case_, s.mesh(), groups_) {
    const std::size_t nodes = s.mesh().node_count();
    given_by_.assign(nodes, none);
    part_of_.assign(nodes, none);
    for (std::size_t p = 0; p < case_.parts.size(); ++p) {
      part_nodes_.push_back(parts_.nodes_of(*case_.parts[p].name));
      for (const Index n : part_nodes_.back()) part_of_[at(n)] = p;
    }
    for (std::size_t i = 0; i < case_.initial.size(); ++i) {
      nodes_.push_back(nodes_of(case_.initial[i]));
      if (case_.initial[i].has_velocity())
        for (const Index n : nodes_.back()) given_by_[at(n)] = i;
    }
  }

  std::vector<std::string> run() {
    check_held();
    for (std::size_t i = 0; i < case_.initial.size(); ++i) {
      if (!case_.initial[i].has_velocity()) continue;
      check_overwritten(i);
      if (case_.initial[i].drop_height) check_fall(i);
    }
    return std::move(out_);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void say(const Location& where, const std::string& text) { out_.push_back(to_string(where) + ": initial: " + text); }

  std::string with_unit(double value, Dimension dimension) const {
    return fmt::format("{:.4g} {}", value, unit_name(dimension, case_.units));
  }

  std::vector<Index> nodes_of(const CaseInitial& initial) const {
    return initial.nodes ? groups_.nodes(*initial.nodes, "initial.nodes") : parts_.nodes_of(**initial.part);
  }
  static std::string key_of(const CaseInitial& initial) {
    return initial.nodes ? fmt::format("nodes = {}", toml_string(**initial.nodes))
                         : fmt::format("part = {}", toml_string(**initial.part));
  }

  double velocities_begin() const {
    for (const auto& stage : s_.stages())
      if (has_inertia(stage->settings().kind)) return stage->begin();
    return s_.end();
  }

  /// The velocity that a motion imposes at the beginning; nothing where it goes on with the one that is given, or where
  /// displacements change.
  static std::optional<double> imposed(const PrescribedMotion& motion, double t) {
    if (motion.kind == MotionKind::velocity) return motion.function(t);
    const bool stays = motion.kind == MotionKind::displacement && is_zero(motion.function.value);
    return stays ? std::optional(0.0) : std::nullopt;
  }

  /// Nodes of one section, part and motion.
  struct Held {
    const PrescribedMotion* motion = nullptr;
    std::size_t count = 0;
  };

  void check_held() {
    const std::vector<double> v = s_.initial_state().v;
    double fastest = 0.0;
    for (const double value : v) fastest = std::max(fastest, std::abs(value));
    const double begin = velocities_begin();
    HeldParts held;
    for (const PrescribedMotion& motion : s_.model().motions) {
      const std::optional<double> speed = imposed(motion, begin);
      if (!speed) continue;
      HeldParts own;
      for (const Index n : motion.nodes) {
        const std::size_t section = given_by_[at(n)], part = part_of_[at(n)];
        const double given = v[3 * at(n) + at(motion.component)];
        if (section == none || part == none || std::abs(given - *speed) <= rounding * fastest) continue;
        Held& entry = own[{section, part}];
        entry.motion = &motion;
        ++entry.count;
      }
      for (const auto& [key, entry] : own)
        if (entry.count > held[key].count) held[key] = entry;
    }
    for (const auto& [key, entry] : held) say_held(key[0], key[1], entry, held);
  }

  using HeldParts = std::map<std::array<std::size_t, 2>, Held>;  ///< by section and part

  /// A body of one section that is stopped at some nodes is a shock, and meant.
  void say_held(std::size_t section, std::size_t part, const Held& held, const HeldParts& all) {
    std::vector<std::string> flying;
    std::size_t given = 0;
    for (std::size_t p = 0; p < case_.parts.size(); ++p) {
      if (std::ranges::none_of(nodes_[section], [&](Index n) { return part_of_[at(n)] == p; })) continue;
      ++given;
      if (!all.contains({section, p})) flying.push_back(toml_string(*case_.parts[p].name));
    }
    if (given == 1 && held.count < part_nodes_[part].size()) return;
    const CaseInitial& initial = case_.initial[section];
    const std::string name = toml_string(*case_.parts[part].name);
    say(initial.where,
        fmt::format("{} gives part {} a velocity along {} that {} does not let {} of its {} nodes have, where it is "
                    "overwritten; {}",
                    key_of(initial), name, "xyz"[at(held.motion->component)], held.motion->name, held.count,
                    part_nodes_[part].size(),
                    flying.empty()
                        ? fmt::format("give it to what flies, or take the support from {}", name)
                        : fmt::format("name what flies instead: part = {}", fmt::join(flying, ", part = "))));
  }

  void check_overwritten(std::size_t i) {
    if (std::ranges::any_of(nodes_[i], [&](Index n) { return given_by_[at(n)] == i; })) return;
    std::set<int> later;
    for (const Index n : nodes_[i])
      if (given_by_[at(n)] != none) later.insert(case_.initial[given_by_[at(n)]].where.line);
    if (later.empty()) return;
    say(case_.initial[i].where,
        fmt::format("the {} of {} is without effect, since later sections (line {}) give all of these nodes theirs: "
                    "remove it, or say in one section what is to be added",
                    case_.initial[i].drop_height ? "drop_height" : "velocity", key_of(case_.initial[i]),
                    fmt::join(later, ", ")));
  }

  void check_fall(std::size_t i) {
    const CaseInitial& initial = case_.initial[i];
    const double speed = norm(initial.fall), height = **initial.drop_height;
    const Vec3 down = scaled(initial.fall, 1.0 / speed);
    if (const double own = initial.velocity ? dot(*initial.velocity, down) : 0.0; std::abs(own) > rounding * speed)
      say(initial.drop_height->where,
          fmt::format("velocity has {} along gravity beside a drop_height of {}, which gives {}, and the two are added "
                      "to {}; expected one of them along gravity: leave out drop_height, or that component",
                      with_unit(own, Dimension::velocity), with_unit(height, Dimension::length),
                      with_unit(speed, Dimension::velocity), with_unit(speed + own, Dimension::velocity)));
    Extent body(down);
    for (const Index n : nodes_[i]) body.include(s_.mesh().coordinates[at(n)]);
    check_height(initial, body.size());
    if (!is_held_along(i, down) && !meets_something(body, down))
      say(initial.drop_height->where,
          fmt::format("a fall along ({:.3g}, {:.3g}, {:.3g}), as the gravity of the loads points, and {}; expected a "
                      "floor there: turn the gravity towards it, or add a [[contact]] kind = \"plane\" below",
                      down[0], down[1], down[2], what_is_missed()));
  }

  /// Air alone slows what falls so far, and drop towers are lower.
  void check_height(const CaseInitial& initial, double size) {
    constexpr double tall = 50.0, many = 100.0;
    const double height = **initial.drop_height, metres = height * si_factor(Dimension::length, case_.units);
    if (metres <= tall || height <= many * size) return;
    say(initial.drop_height->where,
        fmt::format(
            "a drop_height of {}, {:.2g} times the size of what falls, gives {}{}; is it written in another unit? "
            "Lengths of this case are in {}, so that 1000 mm are {:g}",
            with_unit(height, Dimension::length), height / size, with_unit(norm(initial.fall), Dimension::velocity),
            case_.units == UnitSystem::si
                ? ""
                : fmt::format(" ({:.4g} m/s)", norm(initial.fall) * si_factor(Dimension::velocity, case_.units)),
            unit_name(Dimension::length, case_.units), 1.0 / si_factor(Dimension::length, case_.units)));
  }

  /// Does a support or a spring of what falls stop it?
  bool is_held_along(std::size_t section, const Vec3& down) const {
    const auto falls = [&](Index n) { return std::ranges::binary_search(nodes_[section], n); };
    for (const PrescribedMotion& motion : s_.model().motions)
      if (std::abs(down[at(motion.component)]) > 0.5 && std::ranges::any_of(motion.nodes, falls)) return true;
    return std::ranges::any_of(s_.model().springs,
                               [&](const Spring& spring) { return std::ranges::any_of(spring.nodes, falls); });
  }

  bool meets_something(const Extent& body, const Vec3& down) const {
    if (std::ranges::any_of(s_.model().contacts, [&](const ContactDefinition& c) { return meets(body, down, c); }))
      return true;
    for (const std::vector<Index>& nodes : part_nodes_) {
      Extent other(down);
      for (const Index n : nodes)
        if (given_by_[at(n)] == none || !case_.initial[given_by_[at(n)]].drop_height)
          other.include(s_.mesh().coordinates[at(n)]);
      if (body.meets(other)) return true;
    }
    return false;
  }

  bool meets(const Extent& body, const Vec3& down, const ContactDefinition& contact) const {
    const ContactParts pair = parts_of(contact);
    if (pair.nature == ContactNature::springs) return pair.direction && dot(*pair.direction, down) < 0.0;
    if (pair.shape == nullptr) return false;
    if (pair.moves()) return true;  // where it comes to is another matter
    const auto is_ahead = [&](const Vec3& x) { return dot(x, down) > body.rear(); };
    if (const auto* plane = std::get_if<Plane>(pair.shape)) return dot(plane->normal, down) < -rounding;
    if (const auto* sphere = std::get_if<Sphere>(pair.shape)) return sphere->inside || is_ahead(sphere->centre);
    if (const auto* box = std::get_if<Box>(pair.shape)) return is_ahead(scaled(add(box->lower, box->upper), 0.5));
    if (const auto* cylinder = std::get_if<Cylinder>(pair.shape)) {
      const Vec3 axis = normalized(cylinder->axis), way = subtract(body.middle(), cylinder->point);
      return cylinder->inside || is_ahead(add(cylinder->point, scaled(axis, dot(way, axis))));
    }
    Extent faces(down);
    for (const Facet& facet : std::get<RigidSurface>(*pair.shape).surface.facets)
      for (const Index n : facet) faces.include(s_.mesh().coordinates[at(n)]);
    return body.meets(faces);
  }

  /// In words, what obstacles there are and why none is met.
  std::string what_is_missed() const {
    std::vector<std::string> names;
    for (std::size_t c = 0; c < case_.contacts.size(); ++c)
      if (parts_of(s_.model().contacts[c]).shape != nullptr) names.push_back(toml_string(*case_.contacts[c].name));
    if (names.empty()) return "no obstacle and no other part ahead of what falls";
    return fmt::format("none of the obstacles ({}) ahead of what falls, and no other part", fmt::join(names, ", "));
  }

  const Simulation& s_;
  const Case& case_;
  const Groups groups_;
  const Parts parts_;
  std::vector<std::vector<Index>> nodes_, part_nodes_;  ///< of each section, of each part
  std::vector<std::size_t> given_by_, part_of_;         ///< by node: the section that its velocity is of, and its part
  std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> start_warnings(const Simulation& simulation) {
  const std::vector<CaseInitial>& initial = simulation.given().initial;
  const bool is_any = std::ranges::any_of(initial, [](const CaseInitial& i) { return i.has_velocity(); });
  return is_any ? StartLint(simulation).run() : std::vector<std::string>{};
}

}  // namespace carom
