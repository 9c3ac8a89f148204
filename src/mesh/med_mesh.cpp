#include "mesh/med_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/errors.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/node_numbers.hpp"

namespace carom {

namespace {

struct MedType {
  std::string_view code;
  CellType type;
};

constexpr std::array<MedType, 17> kMedTypes{{{"PO1", CellType::point1},
                                             {"SE2", CellType::line2},
                                             {"SE3", CellType::line3},
                                             {"TR3", CellType::tria3},
                                             {"TR6", CellType::tria6},
                                             {"QU4", CellType::quad4},
                                             {"QU8", CellType::quad8},
                                             {"QU9", CellType::quad9},
                                             {"TE4", CellType::tetra4},
                                             {"T10", CellType::tetra10},
                                             {"PY5", CellType::pyra5},
                                             {"P13", CellType::pyra13},
                                             {"PE6", CellType::penta6},
                                             {"P15", CellType::penta15},
                                             {"HE8", CellType::hexa8},
                                             {"H20", CellType::hexa20},
                                             {"H27", CellType::hexa27}}};

/// Faces of HEXA27 by their corners in MED: 1234, 1265, 2376, 3487, 1584, 5678; here -x, +x, -y, +y, -z, +z of the same
/// corners.
constexpr std::array<std::size_t, 6> kHexa27Faces{24, 22, 21, 23, 20, 25};

using Families = std::map<std::int64_t, std::vector<std::string>>;

/// Names of the groups directly below `path`.
std::vector<std::string> children(const Hdf5Tree& tree, const std::string& path) {
  std::vector<std::string> names;
  const std::string prefix = path + "/";
  for (auto it = tree.groups.lower_bound(prefix); it != tree.groups.end() && it->starts_with(prefix); ++it)
    if (it->find('/', prefix.size()) == std::string::npos) names.push_back(it->substr(prefix.size()));
  return names;
}

class MedReader {
 public:
  MedReader(const Hdf5Tree& tree, const std::string& source) : tree_(tree), source_(source) {}

  Mesh run() {
    mesh_.report.source = source_;
    mesh_.report.format = "MED " + version();
    const std::string name = only_mesh(), mesh = "/ENS_MAA/" + name;
    const std::string step = is_med_2_ ? mesh : first_step(mesh);
    families_ = read_families(is_med_2_ ? mesh + "/FAS" : "/FAS/" + name);
    read_nodes(step + "/NOE", space_dimension(mesh));
    read_cells(step + "/MAI");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& path, std::string found, std::string expected,
                         std::string suggestion = {}) const {
    throw CaseError({source_, 0, 0}, path, std::move(found), std::move(expected), std::move(suggestion));
  }

  std::int64_t attribute(const std::string& path, const std::string& name) const {
    const auto found = tree_.attributes.find(path + "@" + name);
    if (found == tree_.attributes.end())
      fail(path, "no attribute " + name, "one, as in every MED file", "Write the mesh again as MED 3 or 4.");
    return found->second;
  }

  bool has_attribute(const std::string& path, const std::string& name) const {
    return tree_.attributes.count(path + "@" + name) != 0;
  }

  /// MED 2.2 and 2.3 keep families below the mesh and have no computing steps.
  std::string version() {
    if (tree_.groups.count("/INFOS_GENERALES") == 0)
      fail("/INFOS_GENERALES", "an HDF5 file without this group", "a MED file",
           "Export the mesh as MED (Salome, Code_Aster) or as Gmsh 2.2 or 4.1.");
    const std::int64_t major = attribute("/INFOS_GENERALES", "MAJ"), minor = attribute("/INFOS_GENERALES", "MIN");
    if (major < 2 || major > 4 || (major == 2 && minor < 2))
      fail(
          "/INFOS_GENERALES", fmt::format("MED {}.{}", major, minor), "MED 2.2 to 4",
          "Convert the file by the program medimport of the MED library (medimport OLD.med NEW.med), or write it again "
          "by a newer Salome.");
    is_med_2_ = major == 2;
    return fmt::format("{}.{}", major, minor);
  }

  std::string only_mesh() const {
    const std::vector<std::string> names = children(tree_, "/ENS_MAA");
    if (names.size() != 1)
      fail("/ENS_MAA", names.empty() ? "no mesh" : fmt::format("{} meshes ({})", names.size(), fmt::join(names, ", ")),
           "one mesh", "Write the mesh that is wanted alone into a file.");
    if (attribute("/ENS_MAA/" + names[0], "TYP") != 0)
      fail("/ENS_MAA/" + names[0], "a structured mesh", "an unstructured one", "Convert it to cells with nodes.");
    return names[0];
  }

  std::string first_step(const std::string& mesh) {
    const std::vector<std::string> steps = children(tree_, mesh);
    if (steps.empty()) fail(mesh, "no computing step", "one with NOE and MAI", "Write the mesh again as MED 3 or 4.");
    if (steps.size() > 1)
      mesh_.report.notes.push_back(fmt::format("the first of {} computing steps is read", steps.size()));
    return mesh + "/" + steps[0];
  }

  /// MED 2 has ESP only where space has more dimensions than the mesh.
  std::size_t space_dimension(const std::string& mesh) const {
    const std::int64_t dimension = attribute(mesh, is_med_2_ && !has_attribute(mesh, "ESP") ? "DIM" : "ESP");
    if (dimension < 1 || dimension > 3) fail(mesh, fmt::format("space dimension {}", dimension), "1, 2 or 3");
    return static_cast<std::size_t>(dimension);
  }

  template <class T>
  const std::vector<T>* find(const std::string& path) const {
    const auto found = tree_.data_sets.find(path);
    if (found == tree_.data_sets.end()) return nullptr;
    const auto* values = std::get_if<std::vector<T>>(&found->second.values);
    if (values == nullptr) fail(path, "values of another kind", "integers (numbers) or reals (coordinates)");
    return values;
  }

  template <class T>
  const std::vector<T>& require(const std::string& path) const {
    const auto* values = find<T>(path);
    if (values == nullptr) fail(path, "nothing", "this data set", "Write the mesh again as MED 3 or 4.");
    return *values;
  }

  /// One integer per entity, or nullptr when the file has none.
  const std::vector<std::int64_t>* per_entity(const std::string& path, std::size_t count) const {
    const auto* values = find<std::int64_t>(path);
    if (values != nullptr && values->size() != count)
      fail(path, fmt::format("{} values", values->size()), fmt::format("{}, one for each entity", count),
           "The file is damaged; write it again.");
    return values;
  }

  /// MED 2.3.1 and older have the families of nodes and of cells side by side.
  Families read_families(const std::string& path) const {
    Families families;
    for (const char* kind : {"", "/NOEUD", "/ELEME"})
      for (const std::string& name : children(tree_, path + kind)) {
        const std::string family = path + kind + "/" + name;
        if (*kind == '\0' && !has_attribute(family, "NUM")) continue;  // NOEUD and ELEME themselves
        families[attribute(family, "NUM")] = group_names(family + "/GRO/NOM");
      }
    return families;
  }

  /// Names of 80 characters each, filled up with blanks or zeros; in MED 2 with one zero after the last.
  std::vector<std::string> group_names(const std::string& path) const {
    if (tree_.data_sets.count(path) == 0) return {};
    const std::vector<std::int64_t>& letters = require<std::int64_t>(path);
    constexpr std::size_t length = 80;
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin < letters.size(); begin += length) {
      const std::size_t end = std::min(begin + length, letters.size());
      std::string name;
      for (std::size_t i = begin; i < end && letters[i] != 0; ++i) name += static_cast<char>(letters[i]);
      name.erase(name.find_last_not_of(' ') + 1);
      if (!name.empty()) names.push_back(std::move(name));
    }
    return names;
  }

  const std::vector<std::string>& groups_of(std::int64_t family, const std::string& path) const {
    static const std::vector<std::string> none;
    if (family == 0) return none;
    const auto found = families_.find(family);
    if (found == families_.end())
      fail(path, fmt::format("family {}", family), "a family below /FAS", "The file is damaged; write it again.");
    return found->second;
  }

  void read_nodes(const std::string& path, std::size_t dimension) {
    const std::vector<double>& values = require<double>(path + "/COO");
    const std::size_t count = values.size() / dimension;
    if (count * dimension != values.size() || count > std::numeric_limits<Index>::max())
      fail(path + "/COO", fmt::format("{} coordinates", values.size()),
           fmt::format("{} for each of at most 2147483647 nodes", dimension));
    mesh_.coordinates.assign(count, Vec3{});
    for (std::size_t i = 0; i < values.size(); ++i) mesh_.coordinates[i % count][i / count] = values[i];
    const auto* numbers = per_entity(path + "/NUM", count);
    const auto* family = per_entity(path + "/FAM", count);
    NodeNumbers seen(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3& x = mesh_.coordinates[i];
      mesh_.node_numbers.push_back(numbers != nullptr ? (*numbers)[i] : static_cast<std::int64_t>(i) + 1);
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        fail(path + "/COO", fmt::format("node {} at ({}, {}, {})", mesh_.node_numbers[i], x[0], x[1], x[2]),
             "finite coordinates", "Write the mesh again; a coordinate overflowed or was never set.");
      if (!seen.insert(mesh_.node_numbers[i], static_cast<Index>(i)))
        fail(path + "/NUM", fmt::format("node number {} a second time", mesh_.node_numbers[i]),
             "every node number once", "Renumber the nodes.");
      if (family == nullptr) continue;
      for (const std::string& group : groups_of((*family)[i], path + "/FAM"))
        mesh_.node_groups[group].push_back(static_cast<Index>(i));
    }
  }

  void read_cells(const std::string& path) {
    std::int64_t next_number = 1;
    for (const std::string& code : children(tree_, path)) {
      const auto type =
          std::find_if(kMedTypes.begin(), kMedTypes.end(), [&](const MedType& t) { return t.code == code; });
      if (type == kMedTypes.end())
        fail(path + "/" + code, "cell type " + code,
             "PO1, SE2, SE3, TR3, TR6, QU4, QU8, QU9, TE4, T10, PY5, P13, PE6, P15, HE8, H20 or H27",
             "Mesh with cells of these types.");
      read_block(path + "/" + code, type->type, next_number);
    }
  }

  /// NOD holds the first node of all cells, then the second of all, and so on.
  void read_block(const std::string& path, CellType type, std::int64_t& next_number) {
    const std::vector<std::int64_t>& nodes = require<std::int64_t>(path + "/NOD");
    const auto per_cell = static_cast<std::size_t>(node_count(type));
    const std::size_t count = nodes.size() / per_cell;
    if (count * per_cell != nodes.size() || count > std::numeric_limits<Index>::max())
      fail(path + "/NOD", fmt::format("{} node numbers", nodes.size()),
           fmt::format("{} for each of at most 2147483647 cells", per_cell));
    const auto* numbers = per_entity(path + "/NUM", count);
    const auto* family = per_entity(path + "/FAM", count);
    CellBlock block{type, {}, {}};
    block.connectivity.reserve(nodes.size());
    for (std::size_t cell = 0; cell < count; ++cell) {
      block.file_numbers.push_back(numbers != nullptr ? (*numbers)[cell] : next_number);
      ++next_number;
      for (std::size_t i = 0; i < per_cell; ++i) {
        const std::int64_t node = nodes[med_position(type, i) * count + cell];
        if (node < 1 || node > static_cast<std::int64_t>(mesh_.node_count()))
          fail(path + "/NOD", fmt::format("node {} in cell {}", node, block.file_numbers[cell]),
               fmt::format("1 to {}", mesh_.node_count()), "The file is damaged; write it again.");
        block.connectivity.push_back(static_cast<Index>(node - 1));
      }
      if (family == nullptr) continue;
      for (const std::string& group : groups_of((*family)[cell], path + "/FAM"))
        mesh_.cell_groups[group].push_back({static_cast<Index>(mesh_.blocks.size()), static_cast<Index>(cell)});
    }
    if (count > 0) mesh_.blocks.push_back(std::move(block));
  }

  const Hdf5Tree& tree_;
  const std::string& source_;
  bool is_med_2_ = false;
  Families families_;
  Mesh mesh_;
};

}  // namespace

std::size_t med_position(CellType type, std::size_t i) {
  if (dimension(type) < 3) return i;
  const std::size_t mirrored = static_cast<std::size_t>(mirrored_order(type)[i]);
  return type == CellType::hexa27 && mirrored >= 20 && mirrored < 26 ? kHexa27Faces[mirrored - 20] : mirrored;
}

std::string_view med_code(CellType type) {
  const auto* const found =
      std::find_if(kMedTypes.begin(), kMedTypes.end(), [type](const MedType& t) { return t.type == type; });
  return found == kMedTypes.end() ? std::string_view() : found->code;
}

Mesh med_mesh(const Hdf5Tree& tree, const std::string& source) {
  return MedReader(tree, source).run();
}

}  // namespace carom
