// The parts of a case on its mesh: which cells and nodes belong to which.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "build/groups.hpp"
#include "casefile/case.hpp"
#include "mesh/skin.hpp"
#include "model/model.hpp"

namespace carom {

/// Built in time linear in the size of the mesh.
class Parts {
 public:
  /// Throws CaseError for groups that do not fit the section of their part, cells of two parts, plane cells that do not
  /// lie in a plane z = const or are not counter-clockwise, axisymmetric ones with x < 0, and bars without length.
  Parts(const Case& given, const Mesh& mesh, const Groups& groups);

  const std::vector<Part>& parts() const { return parts_; }
  /// What the log says: cells that have not the formulation of their part.
  const std::vector<std::string>& notes() const { return notes_; }
  /// The part that holds the cell, or nullptr.
  const Part* part_of(const CellRef& cell) const;
  /// True when some part holds the node.
  bool hold(Index node) const { return holds_node_[static_cast<std::size_t>(node)] != Hold::none; }
  /// Nodes of the parts of a name, in increasing order.
  std::vector<Index> nodes_of(const std::string& name) const;
  /// What the sections ask for: no motion along z of the nodes of plane parts that no solid part holds, none along x of
  /// the nodes of axisymmetric parts on the axis.
  std::vector<PrescribedMotion> held() const;
  /// Facets with the section and thickness of the parts they belong to. Throws CaseError at the place of the group
  /// where these differ, and for edges and ends of cells that belong to no part.
  Surface surface(const std::vector<OuterFacet>& facets, const Location& where, const std::string& key) const;

 private:
  enum class Hold : std::uint8_t { none, plane_or_bar, solid };
  void add(const Case& given, const CasePart& part, const Groups& groups);
  void add(const CasePart& wanted, Part part);
  void choose_formulations(const CasePart& wanted, std::span<Part> of_types, bool may_go);
  void check_plane(const Part& part, const Located<std::string>& group) const;
  void check_axis(const Part& part, const Located<std::string>& group) const;
  void check_bars(const Part& part, const Located<std::string>& group) const;
  [[noreturn]] void refuse_cell(const Part& part, Index cell, const Located<std::string>& group,
                                const std::string& found, const std::string& expected) const;
  std::span<const Index> nodes_of_cell(const Part& part, Index cell) const;
  double axis_tolerance(std::span<const Index> nodes) const;

  const Mesh& mesh_;
  std::vector<Part> parts_;
  std::vector<std::string> notes_;
  std::vector<std::vector<Index>> part_of_cell_;  ///< per block and cell: position in parts_, or -1
  std::vector<Hold> holds_node_;
};

/// "plane_strain", ...: as in the case file.
std::string_view name(Section section);

}  // namespace carom
