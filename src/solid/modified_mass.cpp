#include "solid/modified_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "solid/least_squares_mass.hpp"

namespace carom {

namespace {

/// Neighbours through cells, as the pattern of the consistent mass has them.
std::span<const Index> neighbours(const CsrMatrix& graph, Index n) {
  const auto begin = static_cast<std::size_t>(graph.row_begin[at(n)]);
  const auto end = static_cast<std::size_t>(graph.row_begin[at(n) + 1]);
  return {graph.column.data() + begin, end - begin};
}

/// The node sets that are connected among the nodes with the flag, each in the order of a breadth-first search.
std::vector<std::vector<Index>> connected_sets(const CsrMatrix& graph, std::vector<bool> flag) {
  std::vector<std::vector<Index>> sets;
  for (Index start = 0; start < graph.size; ++start) {
    if (!flag[at(start)]) continue;
    std::vector<Index>& set = sets.emplace_back(1, start);
    flag[at(start)] = false;
    for (std::size_t k = 0; k < set.size(); ++k) {
      for (const Index n : neighbours(graph, set[k])) {
        if (!flag[at(n)]) continue;
        flag[at(n)] = false;
        set.push_back(n);
      }
    }
  }
  return sets;
}

/// Contact nodes that have mass and are not imposed in every component.
std::vector<bool> massless_flags(const Model& model, const std::vector<double>& mass) {
  std::map<Index, std::array<bool, 3>> imposed;
  for (const PrescribedMotion& motion : model.motions) {
    for (const Index n : motion.nodes) imposed[n][at(static_cast<Index>(motion.component))] = true;
  }
  std::vector<bool> flags(mass.size(), false);
  for (const Index n : contact_nodes(model)) {
    const auto found = imposed.find(n);
    const bool held = found != imposed.end() && found->second == std::array{true, true, true};
    flags[at(n)] = mass[at(n)] > 0.0 && !held;
  }
  return flags;
}

/// Nodes of `from` and of what is reached from there through nodes that may be taken, one front of neighbours after the
/// other, at most `most` of them; `from` is not among them. Takes the flag off those that are found.
std::vector<std::vector<Index>> fronts(const CsrMatrix& graph, const std::vector<Index>& from, std::vector<bool>& free,
                                       std::size_t most) {
  std::vector<std::vector<Index>> found;
  const std::vector<Index>* front = &from;
  while (found.size() < most) {
    std::vector<Index> next;
    for (const Index n : *front) {
      for (const Index m : neighbours(graph, n)) {
        if (!free[at(m)]) continue;
        free[at(m)] = false;
        next.push_back(m);
      }
    }
    if (next.empty()) break;
    found.push_back(std::move(next));
    front = &found.back();
  }
  return found;
}

/// The mass of one patch after the other on its way to the layers.
class PatchSpread {
 public:
  PatchSpread(const CsrMatrix& consistent, const std::vector<bool>& massless, int layers)
      : graph_(consistent),
        layers_(at(layers)),
        is_free_(massless),
        in_patch_(massless.size(), false),
        rank_(massless.size(), -1),
        depth_(massless.size(), 0),
        carried_(massless.size(), 0.0) {
    is_free_.flip();
  }

  /// Takes the mass `before` of the patch's nodes to `after` of the layers. False when there is no layer.
  bool operator()(const std::vector<Index>& patch, const std::vector<double>& before, std::vector<double>& after) {
    const std::vector<std::vector<Index>> layers = fronts(graph_, patch, is_free_, layers_);
    if (layers.empty()) return false;
    for (const Index n : patch) in_patch_[at(n)] = true;
    std::vector<std::vector<Index>> way = fronts(graph_, layers.front(), in_patch_, patch.size());
    std::reverse(way.begin(), way.end());
    way.insert(way.end(), layers.begin(), layers.end());
    for (std::size_t f = 0; f < way.size(); ++f) {
      for (const Index n : way[f]) {
        rank_[at(n)] = static_cast<int>(f);
        carried_[at(n)] = f + layers.size() < way.size() ? before[at(n)] : 0.0;
      }
    }
    count_depth(layers);
    for (const std::vector<Index>& front : way) {
      for (const Index n : front) pass_on(n, after);
    }
    for (const std::vector<Index>& front : way) {
      for (const Index n : front) rank_[at(n)] = -1;
    }
    for (const std::vector<Index>& layer : layers) {
      for (const Index n : layer) {
        depth_[at(n)] = 0;
        is_free_[at(n)] = true;
      }
    }
    return true;
  }

 private:
  /// Calls visit(m, M_nm) for the neighbours of n in the next front.
  template <class Visit>
  void each_next(Index n, const Visit& visit) const {
    for (std::int64_t k = graph_.row_begin[at(n)]; k < graph_.row_begin[at(n) + 1]; ++k) {
      const Index m = graph_.column[static_cast<std::size_t>(k)];
      if (rank_[at(m)] == rank_[at(n)] + 1) visit(m, graph_.value[static_cast<std::size_t>(k)]);
    }
  }

  /// How many layers a node's mass can reach, its own among them.
  void count_depth(const std::vector<std::vector<Index>>& layers) {
    for (std::size_t f = layers.size(); f-- > 0;) {
      for (const Index n : layers[f]) {
        int below = 0;
        each_next(n, [&](Index m, double) { below = std::max(below, depth_[at(m)]); });
        depth_[at(n)] = below + 1;
      }
    }
  }

  void pass_on(Index n, std::vector<double>& after) {
    const double kept = depth_[at(n)] > 0 ? carried_[at(n)] / depth_[at(n)] : 0.0, rest = carried_[at(n)] - kept;
    after[at(n)] += kept;
    double weight = 0.0;
    int count = 0;
    each_next(n, [&](Index, double M) {
      weight += std::abs(M);
      ++count;
    });
    each_next(
        n, [&](Index m, double M) { carried_[at(m)] += rest * (weight > 0.0 ? std::abs(M) / weight : 1.0 / count); });
  }

  const CsrMatrix& graph_;
  std::size_t layers_;
  std::vector<bool> is_free_;  ///< nodes of no contact
  std::vector<bool> in_patch_;
  std::vector<int> rank_;   ///< front of a node on the way of the present patch, -1 elsewhere
  std::vector<int> depth_;  ///< of the nodes of the layers
  std::vector<double> carried_;
};

void spread_over_layers(const CsrMatrix& consistent, const std::vector<bool>& massless, int layers,
                        const std::vector<double>& before, std::vector<double>& after) {
  PatchSpread spread(consistent, massless, layers);
  for (const std::vector<Index>& patch : connected_sets(consistent, massless)) {
    if (spread(patch, before, after)) continue;
    throw std::invalid_argument(
        "the modified mass finds no node without contact beside a contact surface that could take its mass; refine "
        "the mesh, or choose another scheme");
  }
}

void spread_by_least_squares(const Mesh& mesh, const CsrMatrix& graph, const std::vector<bool>& massless,
                             const std::vector<double>& before, std::vector<double>& after) {
  std::vector<bool> has_mass(before.size());
  std::transform(before.begin(), before.end(), has_mass.begin(), [](double m) { return m > 0.0; });
  for (const std::vector<Index>& body : connected_sets(graph, has_mass)) {
    std::vector<MassPoint> kept, removed;
    std::vector<Index> nodes;
    for (const Index n : body) {
      const MassPoint point{mesh.coordinates[at(n)], before[at(n)]};
      (massless[at(n)] ? removed : kept).push_back(point);
      if (!massless[at(n)]) nodes.push_back(n);
    }
    if (removed.empty()) continue;
    const std::vector<double> change = redistribute(kept, removed, 0.25);
    for (std::size_t k = 0; k < nodes.size(); ++k) after[at(nodes[k])] += change[k];
  }
}

/// Distance of the farthest of the nodes from the line through the first of them and the one farthest from it.
double off_line(const Mesh& mesh, const std::vector<Index>& nodes) {
  const Vec3 origin = mesh.coordinates[at(nodes.front())];
  Vec3 along{};
  for (const Index n : nodes) {
    const Vec3 r = subtract(mesh.coordinates[at(n)], origin);
    if (norm(r) > norm(along)) along = r;
  }
  double most = 0.0;
  const double length = norm(along);
  for (const Index n : nodes) {
    const Vec3 r = subtract(mesh.coordinates[at(n)], origin);
    most = std::max(most, length > 0.0 ? norm(cross(r, along)) / length : 0.0);
  }
  return most;
}

/// A body whose mass is left on one line turns around it without inertia, and nothing balances its contact nodes.
void refuse_bodies_on_a_line(const Model& model, const CsrMatrix& graph, const std::vector<bool>& massless,
                             const std::vector<double>& before) {
  std::vector<bool> has_mass(before.size());
  std::transform(before.begin(), before.end(), has_mass.begin(), [](double m) { return m > 0.0; });
  std::vector<bool> imposed(before.size(), false);
  for (const PrescribedMotion& motion : model.motions) {
    for (const Index n : motion.nodes) imposed[at(n)] = true;
  }
  for (const std::vector<Index>& body : connected_sets(graph, has_mass)) {
    std::vector<Index> kept;
    std::copy_if(body.begin(), body.end(), std::back_inserter(kept), [&](Index n) { return !massless[at(n)]; });
    const bool is_held = std::any_of(body.begin(), body.end(), [&](Index n) { return imposed[at(n)]; });
    if (is_held || kept.empty() || kept.size() == body.size()) continue;
    constexpr double flat = 1e-6;  // of the body's own width; far above the rounding of coordinates
    if (off_line(*model.mesh, kept) > flat * off_line(*model.mesh, body) || off_line(*model.mesh, body) == 0.0)
      continue;
    const Vec3& x = model.mesh->coordinates[at(kept.front())];
    throw std::invalid_argument(fmt::format(
        "without the mass of its contact nodes, the body around ({:.6g}, {:.6g}, {:.6g}) has mass on {} nodes of one "
        "line alone, around which it would turn without inertia; let the contact group hold only the faces that can "
        "touch, refine the mesh across the body, or choose another scheme",
        x[0], x[1], x[2], kept.size()));
  }
}

/// Sum of m (|r|^2 1 - r r^T) about `centre`, and the Frobenius norm of a difference of two.
std::array<double, 6> inertia(const Mesh& mesh, const std::vector<double>& mass, const Vec3& centre) {
  std::array<double, 6> J{};
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const Vec3 r = subtract(mesh.coordinates[n], centre);
    const double square = dot(r, r);
    for (std::size_t c = 0; c < 3; ++c) {
      J[c] += mass[n] * (square - r[c] * r[c]);
      J[3 + c] -= mass[n] * r[c] * r[(c + 1) % 3];
    }
  }
  return J;
}

double tensor_norm(const std::array<double, 6>& J) {
  return std::sqrt(J[0] * J[0] + J[1] * J[1] + J[2] * J[2] + 2.0 * (J[3] * J[3] + J[4] * J[4] + J[5] * J[5]));
}

Vec3 mass_centre(const Mesh& mesh, const std::vector<double>& mass, double total) {
  Vec3 centre{};
  for (std::size_t n = 0; n < mass.size(); ++n) centre = add(centre, scaled(mesh.coordinates[n], mass[n] / total));
  return centre;
}

MassShift compare(const Mesh& mesh, const std::vector<bool>& massless, const std::vector<double>& before,
                  const std::vector<double>& after) {
  MassShift shift;
  shift.total = sum_of(before);
  shift.total_error = sum_of(after) - shift.total;
  for (std::size_t n = 0; n < before.size(); ++n) {
    if (massless[n]) {
      shift.moved += before[n];
      ++shift.contact_nodes;
    } else if (before[n] > 0.0) {
      shift.largest_gain = std::max(shift.largest_gain, after[n] / before[n] - 1.0);
      shift.largest_loss = std::max(shift.largest_loss, 1.0 - after[n] / before[n]);
    }
  }
  const Vec3 centre = mass_centre(mesh, before, shift.total);
  shift.centre = subtract(mass_centre(mesh, after, shift.total), centre);
  const std::array<double, 6> J = inertia(mesh, before, centre);
  std::array<double, 6> change = inertia(mesh, after, centre);
  for (std::size_t k = 0; k < 6; ++k) change[k] -= J[k];
  const double size = tensor_norm(J);
  shift.inertia = size > 0.0 ? tensor_norm(change) / size : 0.0;
  return shift;
}

}  // namespace

std::vector<std::string> describe(const MassShift& s) {
  return {
      fmt::format("modified mass: {:.6g} of {:.6g} taken from {} contact nodes, total kept to {:.2g}", s.moved, s.total,
                  s.contact_nodes, std::abs(s.total_error)),
      fmt::format("modified mass: the centre shifts by ({:.3g}, {:.3g}, {:.3g})", s.centre[0], s.centre[1],
                  s.centre[2]),
      fmt::format("modified mass: the inertia about the centre changes by {:.3g} %", 100.0 * s.inertia),
      fmt::format("modified mass: nodes gain at most {:.3g} % and lose at most {:.3g} % of their mass",
                  100.0 * s.largest_gain, 100.0 * s.largest_loss),
  };
}

std::vector<Index> contact_nodes(const Model& model) {
  std::vector<Index> nodes;
  for (const ContactDefinition& contact : model.contacts) {
    const ContactParts parts = parts_of(contact);
    if (parts.nature == ContactNature::bonds) continue;  // they need no mass to be moved
    const std::vector<Index> own = nodes_of(parts, *model.mesh);
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ModifiedMass modify_mass(const Solid& solid, const Model& model, const MassModification& how) {
  assert(how.layers >= 1);
  const std::vector<double> before = solid.mass(MassKind::lumped).node_diagonal();
  const CsrMatrix graph = solid.mass(MassKind::consistent).node_matrix();
  const std::vector<bool> massless = massless_flags(model, before);
  std::vector<double> after = before;
  for (std::size_t n = 0; n < after.size(); ++n) {
    if (massless[n]) after[n] = 0.0;
  }
  switch (how.spread) {
    case MassSpread::layers:
      spread_over_layers(graph, massless, how.layers, before, after);
      break;
    case MassSpread::least_squares:
      spread_by_least_squares(*model.mesh, graph, massless, before, after);
      break;
  }
  refuse_bodies_on_a_line(model, graph, massless, before);
  return {Mass(after), compare(*model.mesh, massless, before, after)};
}

}  // namespace carom
