#include "contact/stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "base/types.hpp"
#include "contact/facet_geometry.hpp"
#include "contact/facing_facets.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "model/node_lengths.hpp"
#include "model/outer_facets.hpp"
#include "model/wave_modulus.hpp"

namespace carom {

namespace {

/// The cell behind a facet, as contact sees it.
struct Backing {
  double modulus = 0.0, height = 0.0;
  double measure = 0.0;  ///< of the facet, as its section counts it

  double stiffness() const { return modulus / height; }
};

/// One side of a contact: sums over its facets.
struct Side {
  double measure = 0.0, stiffness = 0.0, modulus = 0.0;

  void add(const Backing& b) {
    measure += b.measure;
    stiffness += b.measure * b.stiffness();
    modulus += b.measure * b.modulus;
  }
  double mean_modulus() const { return modulus / measure; }
  double mean_height() const { return modulus / stiffness; }
};

/// Finds the cells of parts by their nodes on the skin.
class PartCells {
 public:
  explicit PartCells(const Model& model) : mesh_(*model.mesh), begin_(mesh_.node_count() + 1, 0) {
    std::vector<bool> is_outer(mesh_.node_count());
    const auto skin = outer_facets(model);
    for (const OuterFacet& outer : *skin)
      for (const Index n : outer.facet) is_outer[static_cast<std::size_t>(n)] = true;
    const auto each = [&](auto&& visit) {
      for (const Part& part : model.parts) {
        for (const Index cell : part.cells) {
          for (const Index n : nodes_of({&part, cell}))
            if (is_outer[static_cast<std::size_t>(n)]) visit(static_cast<std::size_t>(n), Cell{&part, cell});
        }
      }
    };
    each([&](std::size_t n, const Cell&) { ++begin_[n + 1]; });
    for (std::size_t n = 0; n < mesh_.node_count(); ++n) begin_[n + 1] += begin_[n];
    cells_.resize(begin_.back());
    std::vector<std::size_t> next = begin_;
    each([&](std::size_t n, const Cell& cell) { cells_[next[n]++] = cell; });
  }

  /// The softest cell of a part that has all nodes of the facet.
  std::optional<Backing> behind(const Facet& facet) const {
    std::optional<Backing> softest;
    const auto first = static_cast<std::size_t>(facet[0]);
    for (std::size_t k = begin_[first]; k < begin_[first + 1]; ++k) {
      const std::span<const Index> nodes = nodes_of(cells_[k]);
      const auto held = [&](Index n) { return std::ranges::find(nodes, n) != nodes.end(); };
      if (!std::all_of(facet.begin(), facet.end(), held)) continue;
      const Backing backing = backing_of(cells_[k], facet);
      if (!(backing.height > 0.0)) continue;
      if (!softest || backing.stiffness() < softest->stiffness()) softest = backing;
    }
    return softest;
  }

 private:
  struct Cell {
    const Part* part = nullptr;
    Index number = -1;
  };

  std::span<const Index> nodes_of(const Cell& cell) const {
    const auto size = static_cast<std::size_t>(node_count(cell.part->type));
    return std::span(mesh_.block(cell.part->type)->connectivity)
        .subspan(size * static_cast<std::size_t>(cell.number), size);
  }

  Backing backing_of(const Cell& cell, const Facet& facet) const {
    const Part& part = *cell.part;
    const std::span<const Index> nodes = nodes_of(cell);
    const std::span<const Index> corners = nodes.first(static_cast<std::size_t>(corner_count(part.type)));
    Vec3 centroid{};
    for (const Index n : corners)
      centroid = add(centroid, scaled(mesh_.coordinates[static_cast<std::size_t>(n)], 1.0 / corners.size()));
    const PlacedFacet placed = place(facet, mesh_.coordinates);
    const ParentPoint centre = facet_centre(facet.size);
    const FacetFrame frame = facet_frame(placed, centre.xi, centre.eta);
    const Vec3 inward = subtract(centroid, frame.position);
    const double mean = facet.size == 1 ? norm(inward) : std::abs(dot(inward, frame.normal));
    double size = measure(placed);
    if (part.section == Section::axisymmetric) size *= 2.0 * std::numbers::pi * frame.position[0];
    if (part.section != Section::axisymmetric && part.section != Section::solid) size *= part.thickness;
    return {wave_modulus(part), share_of_height(part.type, nodes, facet) * mean, size};
  }

  /// How many times the mean distance of all corners from the facet that of the corners is which are not on it: 2 of a
  /// hexahedron, 4 of a tetrahedron. Half of that in a quadratic cell, where there are nodes in the middle.
  static double share_of_height(CellType type, std::span<const Index> nodes, const Facet& facet) {
    const auto corners = static_cast<double>(corner_count(type));
    for (const CellFace& face : cell_faces(type)) {
      const std::span<const LocalNode> of_face = face.nodes();
      const auto holds = [&](Index n) {
        return std::any_of(of_face.begin(), of_face.end(), [&](LocalNode a) { return nodes[a] == n; });
      };
      if (!std::all_of(facet.begin(), facet.end(), holds)) continue;
      const double others = corners - static_cast<double>(face.corners().size());
      return static_cast<double>(nodes.size()) > corners ? 0.5 * corners / others : corners / others;
    }
    return 0.0;
  }

  const Mesh& mesh_;
  std::vector<std::size_t> begin_;
  std::vector<Cell> cells_;
};

[[noreturn]] void refuse(const std::string& contact) {
  throw std::invalid_argument(fmt::format(
      "contact \"{}\": its stiffness cannot be chosen, since no cell of a part is behind it; give a stiffness",
      contact));
}

Side side_of(const PartCells& cells, std::span<const Facet> facets, const std::string& contact) {
  Side side;
  for (const Facet& facet : facets) {
    if (const auto backing = cells.behind(facet)) side.add(*backing);
  }
  if (!(side.measure > 0.0)) refuse(contact);
  return side;
}

/// The value of one contact and the sides that it comes from.
struct Choice {
  std::vector<Side> sides;
  double node_measure = 1.0;  ///< per_node: mean measure of a node

  double stiffness() const {
    const Side &first = sides.front(), &last = sides.back();
    const double modulus = 2.0 / (1.0 / first.mean_modulus() + 1.0 / last.mean_modulus());
    return modulus / std::min(first.mean_height(), last.mean_height()) * node_measure;
  }
};

struct Chooser {
  const Model& model;
  const PartCells& cells;
  const Mesh& mesh = *model.mesh;

  /// The sides are told apart by softness, cell by cell: which face of an interface comes first means nothing.
  Choice operator()(const InterfaceContact& contact) const {
    const std::vector<Index>& nodes = mesh.block(CellType::hexa8)->connectivity;
    Side softer, stiffer;
    for (const Index cell : contact.cells) {
      std::vector<Backing> found;
      for (const CellFace& face : cell_faces(CellType::hexa8)) {
        Facet facet{{}, 4};
        for (std::size_t a = 0; a < 4; ++a) facet.node[a] = nodes[8 * static_cast<std::size_t>(cell) + face.node[a]];
        if (const auto backing = cells.behind(facet)) found.push_back(*backing);
      }
      std::ranges::sort(found, {}, &Backing::stiffness);
      if (!found.empty()) softer.add(found.front());
      if (found.size() > 1) stiffer.add(found.back());
    }
    if (!(softer.measure > 0.0)) refuse(contact.name);
    if (stiffer.measure > 0.0) return {{softer, stiffer}};
    return {{softer}};
  }

  Choice operator()(const ObstacleContact& contact) const {
    if (contact.measure == RowMeasure::per_area) return {{side_of(cells, contact.surface.facets, contact.name)}};
    return per_node(contact);
  }

  Choice operator()(const PairContact& contact) const {
    const FacingFacets facing = facing_facets(model, contact);
    return {{side_of(cells, facing.slave, contact.name), side_of(cells, facing.master, contact.name)}};
  }

  Choice operator()(const TieContact& contact) const {
    return {{side_of(cells, contact.slave.facets, contact.name), side_of(cells, contact.master.facets, contact.name)}};
  }

  Choice per_node(const ObstacleContact& contact) const {
    std::vector<bool> listed(mesh.node_count(), false);
    for (const Index n : contact.nodes) listed[static_cast<std::size_t>(n)] = true;
    const auto on_list = [&](Index n) { return listed[static_cast<std::size_t>(n)]; };
    std::vector<Facet> whole, touched;
    const auto skin = outer_facets(model);
    for (const OuterFacet& outer : *skin) {
      const Facet& facet = outer.facet;
      if (std::all_of(facet.begin(), facet.end(), on_list)) whole.push_back(facet);
      if (std::any_of(facet.begin(), facet.end(), on_list)) touched.push_back(facet);
    }
    const std::vector<Facet>& facets = whole.empty() ? touched : whole;
    Choice choice{{side_of(cells, facets, contact.name)}};
    double sum = 0.0;
    for (const Facet& facet : facets) {
      const auto backing = cells.behind(facet);
      if (!backing) continue;
      const auto shares = static_cast<double>(std::count_if(facet.begin(), facet.end(), on_list));
      sum += backing->measure * shares / facet.size;
    }
    choice.node_measure = sum / static_cast<double>(std::ranges::count(listed, true));
    return choice;
  }
};

/// The depth down to which springs that are chosen are linear; infinite where all bodies are of small strain.
class LinearDepth {
 public:
  explicit LinearDepth(const Model& model) : mesh_(*model.mesh) {
    const auto is_finite = [](const Part& part) { return part.material.law->measure != Measure::small_strain; };
    if (std::any_of(model.parts.begin(), model.parts.end(), is_finite)) length_ = node_lengths(model);
  }

  double operator()(const InterfaceContact& contact) const {
    const std::span<const Index> nodes = mesh_.block(CellType::hexa8)->connectivity;
    double least = infinity;
    for (const Index cell : contact.cells)
      least = std::min(least, shortest(nodes.subspan(8 * static_cast<std::size_t>(cell), 8)));
    return share * least;
  }
  double operator()(const ObstacleContact& contact) const {
    return share * std::min(shortest(contact.surface), shortest(contact.nodes));
  }
  double operator()(const PairContact& contact) const {
    return share * std::min(shortest(contact.slave), shortest(contact.master));
  }

 private:
  static constexpr double share = 0.02;

  double shortest(std::span<const Index> nodes) const { return length_ ? least_length(*length_, nodes) : infinity; }
  double shortest(const Surface& surface) const {
    double least = infinity;
    for (const Facet& facet : surface.facets) least = std::min(least, shortest({facet.begin(), facet.end()}));
    return least;
  }

  const Mesh& mesh_;
  std::shared_ptr<const std::vector<double>> length_;  ///< by node; null: not asked for
};

std::string sentence(const std::string& contact, double stiffness, const Choice& choice, double factor) {
  std::string text = fmt::format("contact \"{}\": stiffness {:.4g} chosen", contact, stiffness);
  const char* join = " from";
  for (const Side& side : choice.sides) {
    text += fmt::format("{} modulus {:.4g} over cell height {:.4g}", join, side.mean_modulus(), side.mean_height());
    join = " and";
  }
  if (choice.node_measure != 1.0) text += fmt::format(", times {:.4g} per node", choice.node_measure);
  if (factor != 1.0) text += fmt::format(", times the factor {:.4g}", factor);
  return text;
}

}  // namespace

std::vector<std::string> choose_tie_stiffness(Model& model) {
  constexpr double stiffer = 1000.0;
  std::vector<std::string> notes;
  std::optional<PartCells> cells;
  for (ContactDefinition& contact : model.contacts) {
    auto* tie = std::get_if<TieContact>(&contact);
    if (tie == nullptr || tie->law.eps_N) continue;
    if (!cells) cells.emplace(model);
    const Choice choice = Chooser{model, *cells}(*tie);
    const double factor = stiffer * tie->law.stiffness_factor;
    tie->law.eps_N = factor * choice.stiffness();
    notes.push_back(sentence(tie->name, *tie->law.eps_N, choice, factor));
  }
  return notes;
}

std::vector<std::string> choose_stiffness(Model& model) {
  std::vector<std::string> notes;
  std::optional<PartCells> cells;  // made when first needed
  const LinearDepth linear_depth(model);
  const auto choose = [&](auto& contact) {
    using Contact = std::decay_t<decltype(contact)>;
    if constexpr (!std::is_same_v<Contact, StopContact> && !std::is_same_v<Contact, TieContact>) {
      ContactLaw& law = contact.law;
      if (!law.eps_N) {
        if (!cells) cells.emplace(model);
        const Choice choice = Chooser{model, *cells}(contact);
        law.eps_N = law.stiffness_factor * choice.stiffness();
        law.linear_depth = linear_depth(contact);
        notes.push_back(sentence(contact.name, *law.eps_N, choice, law.stiffness_factor));
      }
      if (!law.eps_T && law.mu > 0.0) law.eps_T = law.eps_N;
    }
  };
  for (ContactDefinition& contact : model.contacts) std::visit(choose, contact);
  return notes;
}

}  // namespace carom
