#include "advise/loose_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "model/outer_facets.hpp"
#include "surface/box_tree.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facet_projection.hpp"

namespace carom {

namespace {

constexpr double close_by = 0.05;          ///< of the size of a facet
constexpr double facing = -0.9;            ///< product of the normals
constexpr double single_precision = 1e-6;  ///< of lengths and speeds: meshes often come in single precision

/// A facet of a body's skin where it is at the start.
struct SkinSide {
  const Facet* facet = nullptr;
  Index part = -1, body = -1;
  PlacedFacet placed;
  Vec3 centre{}, normal{}, velocity{};
  double size = 0.0;

  Bounds bounds() const {
    Bounds box;
    for (std::size_t a = 0; a < static_cast<std::size_t>(placed.size); ++a) box.include(placed.x[a]);
    return box;
  }
};

std::vector<SkinSide> sides_of(const Simulation& s, const State& state) {
  const Model& model = s.model();
  const std::vector<Index> body = bodies_of_nodes(model);
  std::vector<SkinSide> sides;
  const auto skin = outer_facets(model);
  const std::vector<std::vector<Index>> part_of = model.part_of_cells();
  for (const OuterFacet& outer : *skin) {
    const Index part = part_of[at(outer.cell.block)][at(outer.cell.cell)];
    if (part < 0 || outer.facet.size < 2) continue;
    SkinSide side{&outer.facet, part, body[at(outer.facet[0])], place(outer.facet, s.mesh().coordinates)};
    for (std::size_t a = 0; a < static_cast<std::size_t>(outer.facet.size); ++a) {
      side.placed.x[a] = add(side.placed.x[a], vector_at(state.q, at(outer.facet[a])));
      side.velocity = add(side.velocity, scaled(vector_at(state.v, at(outer.facet[a])), 1.0 / outer.facet.size));
    }
    const ParentPoint middle = facet_centre(outer.facet.size);
    const FacetFrame frame = facet_frame(side.placed, middle.xi, middle.eta);
    side.centre = frame.position;
    side.normal = frame.normal;
    for (std::size_t a = 0; a < static_cast<std::size_t>(outer.facet.size); ++a)
      side.size = std::max(side.size, norm(subtract(side.placed.x[a], side.centre)));
    sides.push_back(side);
  }
  return sides;
}

/// The smallest gap between points inside of `a` and their feet on `b`.
std::optional<std::pair<double, Vec3>> gap_over(const SkinSide& a, const SkinSide& b) {
  std::optional<std::pair<double, Vec3>> least;
  const auto look = [&](const Vec3& x) {
    const Projection foot = project(b.placed, x);
    const double aside = std::sqrt(std::max(0.0, foot.distance * foot.distance - foot.gap * foot.gap));
    if (aside > single_precision * b.size || foot.distance > close_by * std::min(a.size, b.size)) return;
    if (!least || foot.gap < least->first) least = {foot.gap, x};
  };
  look(a.centre);
  for (std::size_t k = 0; k < static_cast<std::size_t>(a.placed.size); ++k)
    look(scaled(add(a.placed.x[k], a.centre), 0.5));
  return least;
}

/// What holds nodes to nodes: contacts, springs and equations, as lists of nodes; by node the lists that it is in.
class Joined {
 public:
  explicit Joined(const Model& model) : lists_of_(model.mesh->coordinates.size()) {
    for (const ContactDefinition& contact : model.contacts) {
      const ContactParts parts = parts_of(contact);
      if (parts.shape == nullptr) add(nodes_of(parts, *model.mesh));  // an obstacle joins no bodies
    }
    for (const Spring& spring : model.springs) add(spring.nodes);
    for (const LinearEquation& equation : model.equations) {
      std::vector<Index> nodes;
      for (const LinearEquation::Term& term : equation.terms) nodes.push_back(term.node);
      add(nodes);
    }
  }
  bool are(const Facet& a, const Facet& b) const {
    return std::any_of(a.begin(), a.end(), [&](Index m) {
      return std::any_of(b.begin(), b.end(), [&](Index n) { return share_a_list(m, n); });
    });
  }

 private:
  void add(std::span<const Index> nodes) {
    for (const Index n : nodes)
      if (lists_of_[at(n)].empty() || lists_of_[at(n)].back() != count_) lists_of_[at(n)].push_back(count_);
    ++count_;
  }
  bool share_a_list(Index m, Index n) const {
    const std::vector<std::size_t>&a = lists_of_[at(m)], &b = lists_of_[at(n)];
    return std::any_of(a.begin(), a.end(), [&](std::size_t i) { return std::binary_search(b.begin(), b.end(), i); });
  }
  std::vector<std::vector<std::size_t>> lists_of_;
  std::size_t count_ = 0;
};

/// By degree of freedom: is its motion imposed?
std::vector<char> led(const Simulation& s) {
  std::vector<char> is_led(3 * s.mesh().node_count(), 0);
  for (const PrescribedMotion& motion : s.model().motions)
    for (const Index n : motion.nodes) is_led[3 * at(n) + static_cast<std::size_t>(motion.component)] = 1;
  return is_led;
}

bool are_led_along(const SkinSide& a, const SkinSide& b, const std::vector<char>& is_led) {
  std::size_t along = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(a.normal[c]) > std::abs(a.normal[along])) along = c;
  const auto all = [&](const Facet& facet) {
    return std::all_of(facet.begin(), facet.end(), [&](Index n) { return is_led[3 * at(n) + along] != 0; });
  };
  return all(*a.facet) && all(*b.facet);
}

}  // namespace

std::vector<LooseFaces> loose_faces(const Simulation& s, const State& state) {
  const std::vector<SkinSide> sides = sides_of(s, state);
  const auto is_of_first = [&](const SkinSide& side) { return side.body == sides.front().body; };
  if (std::all_of(sides.begin(), sides.end(), is_of_first)) return {};
  const Joined joined(s.model());
  const std::vector<char> is_led = led(s);
  std::vector<Bounds> boxes;
  for (const SkinSide& side : sides) boxes.push_back(side.bounds());
  BoxTree tree;
  tree.build(boxes);
  std::map<std::array<Index, 2>, LooseFaces> found;
  std::vector<Index> candidates;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const SkinSide& a = sides[i];
    Bounds box = boxes[i];
    box.grow(close_by * a.size);
    candidates.clear();
    tree.find(box, candidates);
    bool counts = false;
    for (const Index j : candidates) {
      const SkinSide& b = sides[at(j)];
      if (a.body == b.body || dot(a.normal, b.normal) > facing) continue;
      auto gap = gap_over(a, b);
      if (!gap) continue;
      if (std::abs(gap->first) < single_precision * std::min(a.size, b.size)) gap->first = 0.0;
      const double parting = dot(subtract(b.velocity, a.velocity), a.normal);
      if (parting > single_precision * (norm(a.velocity) + norm(b.velocity))) continue;
      if (joined.are(*a.facet, *b.facet) || are_led_along(a, b, is_led)) continue;
      const std::array<Index, 2> key{std::min(a.part, b.part), std::max(a.part, b.part)};
      LooseFaces& loose = found.try_emplace(key, LooseFaces{key, 0, {}, INFINITY}).first->second;
      if (!counts) ++loose.count;
      counts = true;
      if (gap->first < loose.gap) {
        loose.gap = gap->first;
        loose.position = gap->second;
        loose.size = std::min(a.size, b.size);
      }
    }
  }
  std::vector<LooseFaces> out;
  for (const auto& [parts, loose] : found) out.push_back(loose);
  return out;
}

std::vector<std::string> loose_face_warnings(const Simulation& s) {
  constexpr std::size_t most = 5;
  std::vector<std::string> out;
  const std::vector<LooseFaces> all = loose_faces(s, s.initial_state());
  for (std::size_t k = 0; k < std::min(all.size(), most); ++k) {
    const LooseFaces& loose = all[k];
    const std::string &first = s.model().parts[at(loose.part[0])].name,
                      &second = s.model().parts[at(loose.part[1])].name;
    const Vec3& x = loose.position;
    out.push_back(fmt::format(
        "{}: {} lie face to face at ({:.6g}, {:.6g}, {:.6g}), gap {:.3g} ({:.2g} of a facet), {} facets in all, and "
        "nothing is said of what happens there: they will pass through each other and come apart freely. If they "
        "touch, add a [[contact]] of kind \"pair\" (or \"all\"); if they are glued, one of kind \"tie\"; if they are "
        "one body, let the mesh have common nodes there",
        s.given().file,
        first == second ? fmt::format("two bodies of part \"{}\"", first)
                        : fmt::format("parts \"{}\" and \"{}\"", first, second),
        x[0], x[1], x[2], loose.gap, std::abs(loose.gap) / loose.size, loose.count));
  }
  if (all.size() > most)
    out.push_back(fmt::format("{}: so do {} more pairs of parts", s.given().file, all.size() - most));
  return out;
}

}  // namespace carom
