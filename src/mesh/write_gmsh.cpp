#include "mesh/write_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "base/errors.hpp"
#include "mesh/gmsh_cells.hpp"

namespace carom {

namespace {

std::int64_t gmsh_number(CellType type) {
  std::int64_t number = 1;
  while (gmsh_cell_type(number) == nullptr || gmsh_cell_type(number)->type != type) ++number;
  return number;
}

/// Numbers for the sets of groups that something of one dimension is in.
class PhysicalNames {
 public:
  /// 0: in no group.
  std::size_t tag(int dimension, const std::string& names) {
    if (names.empty()) return 0;
    return tags_.emplace(std::pair(dimension, names), tags_.size() + 1).first->second;
  }
  std::string section() const {
    std::string text = fmt::format("$PhysicalNames\n{}\n", tags_.size());
    for (const auto& [key, tag] : tags_) text += fmt::format("{} {} \"{}\"\n", key.first, tag, key.second);
    return text + "$EndPhysicalNames\n";
  }

 private:
  std::map<std::pair<int, std::string>, std::size_t> tags_;
};

/// The groups of each of `count` things, joined by +; `members` gives the positions of one group's.
class Memberships {
 public:
  Memberships(std::size_t count, std::string source) : names_(count), source_(std::move(source)) {}
  template <class Entries, class Position>
  void add(const std::string& group, const Entries& entries, const Position& position) {
    if (group.empty() || group.find_first_of("+\"\n\r") != std::string::npos) {
      throw CaseError({source_, 0, 0}, "groups", "the name \"" + group + "\"",
                      "a name that is not empty and has no +, quotes or ends of lines");
    }
    for (const auto& entry : entries) {
      std::string& names = names_[position(entry)];
      if (names == group || names.ends_with("+" + group)) continue;  // named twice
      names += (names.empty() ? "" : "+") + group;
    }
  }
  const std::string& of(std::size_t i) const { return names_[i]; }

 private:
  std::vector<std::string> names_;
  std::string source_;
};

class GmshWriter {
 public:
  explicit GmshWriter(const Mesh& mesh) : mesh_(mesh) {
    for (const CellBlock& block : mesh.blocks) {
      first_.push_back(cells_);
      cells_ += block.size();
      for (const std::int64_t number : block.file_numbers) last_ = std::max(last_, number);
    }
  }

  std::string text() {
    write_points();
    write_cells();
    std::string nodes;
    for (std::size_t n = 0; n < mesh_.node_count(); ++n) {
      const Vec3& x = mesh_.coordinates[n];
      fmt::format_to(std::back_inserter(nodes), "{} {} {} {}\n", mesh_.node_numbers[n], x[0], x[1], x[2]);
    }
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names_.section() +
           fmt::format("$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n", mesh_.node_count(), nodes, lines_,
                       elements_);
  }

 private:
  void write_points() {
    Memberships groups(mesh_.node_count(), mesh_.report.source);
    for (const auto& [group, nodes] : mesh_.node_groups)
      groups.add(group, nodes, [](Index n) { return static_cast<std::size_t>(n); });
    for (std::size_t n = 0; n < mesh_.node_count(); ++n) {
      if (groups.of(n).empty()) continue;
      const std::size_t tag = names_.tag(0, groups.of(n));
      fmt::format_to(std::back_inserter(elements_), "{} 15 2 {} 0 {}\n", ++last_, tag, mesh_.node_numbers[n]);
      ++lines_;
    }
  }

  void write_cells() {
    Memberships groups(cells_, mesh_.report.source);
    for (const auto& [group, cells] : mesh_.cell_groups) {
      groups.add(group, cells, [&](const CellRef& ref) {
        return first_[static_cast<std::size_t>(ref.block)] + static_cast<std::size_t>(ref.cell);
      });
    }
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const CellBlock& block = mesh_.blocks[b];
      const std::int64_t type = gmsh_number(block.type);
      const std::span<const LocalNode> order = gmsh_cell_type(type)->order;
      std::vector<std::int64_t> file(static_cast<std::size_t>(node_count(block.type)));
      for (std::size_t k = 0; k < block.size(); ++k) {
        const std::span<const Index> nodes = block.nodes(static_cast<Index>(k));
        for (std::size_t i = 0; i < nodes.size(); ++i)
          file[order[i]] = mesh_.node_numbers[static_cast<std::size_t>(nodes[i])];
        const std::size_t tag = names_.tag(dimension(block.type), groups.of(first_[b] + k));
        fmt::format_to(std::back_inserter(elements_), "{} {} 2 {} 0 {}\n", block.file_numbers[k], type, tag,
                       fmt::join(file, " "));
        ++lines_;
      }
    }
  }

  const Mesh& mesh_;
  std::vector<std::size_t> first_;  ///< position of each block's first cell among all
  std::size_t cells_ = 0, lines_ = 0;
  std::int64_t last_ = 0;  ///< number of a cell
  PhysicalNames names_;
  std::string elements_;
};

}  // namespace

std::string gmsh_text(const Mesh& mesh) {
  return GmshWriter(mesh).text();
}

}  // namespace carom
