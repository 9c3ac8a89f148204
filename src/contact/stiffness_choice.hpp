// The cells behind the facets of a contact, from which its stiffness is chosen.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace carom {

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
  /// The model must outlive the object.
  explicit PartCells(const Model& model);

  const Model& model() const { return model_; }
  /// The softest cell of a part that has all nodes of the facet.
  std::optional<Backing> behind(const Facet& facet) const;

 private:
  struct Cell {
    const Part* part = nullptr;
    Index number = -1;
  };
  std::span<const Index> nodes_of(const Cell& cell) const;
  Backing backing_of(const Cell& cell, const Facet& facet) const;

  const Model& model_;
  const Mesh& mesh_;
  std::vector<std::size_t> begin_;
  std::vector<Cell> cells_;
};

/// The mean over the cells behind some facets. Throws std::invalid_argument naming the contact where no cell is behind
/// a facet.
Side side_of(const PartCells& cells, std::span<const Facet> facets, const std::string& contact);
/// Throws std::invalid_argument: no cell of a part is behind the contact.
[[noreturn]] void refuse_choice(const std::string& contact);

/// The value of one contact and the sides that it comes from.
struct StiffnessChoice {
  std::vector<Side> sides;
  double node_measure = 1.0;     ///< what a row's own measure is counted in; per_node: mean measure of a node
  const char* per = "per node";  ///< of that, in words

  double stiffness() const {
    const Side &first = sides.front(), &last = sides.back();
    const double modulus = 2.0 / (1.0 / first.mean_modulus() + 1.0 / last.mean_modulus());
    return modulus / std::min(first.mean_height(), last.mean_height()) * node_measure;
  }
};

/// The value of bars that touch with their sides, of one side or two: as stiff as they are along, E A / L a length L.
StiffnessChoice bar_choice(const Model& model, const std::vector<std::span<const BarSide>>& sides);

}  // namespace carom
