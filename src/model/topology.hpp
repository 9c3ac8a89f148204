// Which cells of the bodies are there, and the surfaces that follow from it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// The bodies after some cells have gone: a function of the model and of `alive` alone (Topologies).
struct Topology {
  /// By solid cell, part after part (as Solid::cells): 0 where it has gone.
  std::vector<std::uint8_t> alive;
  /// The model, its parts, contacts' surfaces and outer facets those of what is there. Facets of cells that have gone
  /// are left out. A hole that begins at a facet of a surface is of that surface: the faces that it lays bare have
  /// joined it, and nodes that all cells have left are points that touch its other side.
  Model model;

  friend bool operator==(const Topology& a, const Topology& b) { return a.alive == b.alive; }
};

/// Makes the topologies of a model, from what never changes of it: which cells share faces.
class Topologies {
 public:
  /// cells: all solid cells, part after part. The model outlives the object.
  Topologies(const Model& model, std::span<const CellRef> cells);

  /// Time is linear in the cells and in the facets of the surfaces. Precondition: those may erode
  /// (Model::erosion).
  std::shared_ptr<const Topology> of(std::vector<std::uint8_t> alive) const;

 private:
  struct Beyond {
    Index cell;  ///< position of the cell beyond a face, -1: of no part
    CellRef other;
    int face;  ///< of that cell
  };
  using FacetKey = std::array<Index, 4>;

  Index position_of(const CellRef& cell) const;
  Index owner_of(const Facet& facet) const;
  /// Cells that have gone, and what they have laid bare.
  struct Holes {
    std::set<Index> cells;
    std::vector<OuterFacet> bare;
  };
  Holes holes(std::vector<Index> gone, const std::vector<std::uint8_t>& alive) const;
  Surface loose_nodes(const Surface& surface, const Holes& holes, const std::vector<bool>& is_held) const;
  std::span<const Index> connectivity(Index cell) const;
  Surface replace(Surface& surface, const std::vector<std::uint8_t>& alive, const std::vector<bool>& is_held) const;
  void replace_nodes(std::vector<Index>& nodes, const std::vector<std::uint8_t>& alive) const;

  const Model& model_;
  std::shared_ptr<const std::vector<OuterFacet>> outer_;  ///< of all cells
  std::vector<CellRef> cells_;
  std::vector<std::vector<Index>> position_;     ///< by block and cell of the mesh, -1: of no part
  std::map<Index, std::vector<Beyond>> beyond_;  ///< by position of a cell that may go
  std::map<FacetKey, Index> owner_;              ///< of the outer facets of such cells
};

}  // namespace carom
