#include "output/med_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "base/errors.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/med_mesh.hpp"
#include "output/file_writer.hpp"
#include "output/hdf5_handle.hpp"

namespace carom {

namespace {

constexpr std::size_t kGroupName = 80;  ///< bytes of a name in MED

using hdf5::File, hdf5::Plist, hdf5::Group, hdf5::Type, hdf5::Object, hdf5::Space, hdf5::Attribute, hdf5::Set;

/// A MED file being written; groups by their paths.
class MedFile {
 public:
  explicit MedFile(const std::string& path)
      : path_(path), file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {
    check(file_, "the file");
  }

  void group(const std::string& name) {
    const Plist links(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(links, 1);
    const Group made(H5Gcreate2(file_, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT));
    check(made, name);
  }
  void attribute(const std::string& owner, const char* name, int value) {
    write_attribute(owner, name, H5T_STD_I32LE, H5T_NATIVE_INT, &value);
  }
  void attribute(const std::string& owner, const char* name, double value) {
    write_attribute(owner, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
  }
  /// A text in so many bytes.
  void attribute(const std::string& owner, const char* name, const std::string& text, std::size_t bytes) {
    std::string filled = text;
    filled.resize(bytes + 1, '\0');
    const Type type(H5Tcopy(H5T_C_S1));
    H5Tset_size(type, bytes + 1);
    write_attribute(owner, name, type, type, filled.c_str());
  }
  void data(const std::string& name, const std::vector<double>& values) {
    write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  void data(const std::string& name, const std::vector<std::int64_t>& values) {
    write(name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
  }
  /// Names of 80 bytes each.
  void names(const std::string& name, const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) {
      all += text;
      all.resize((all.size() + kGroupName - 1) / kGroupName * kGroupName, '\0');
    }
    const hsize_t length = kGroupName;
    const Type type(H5Tarray_create2(H5T_STD_I8LE, 1, &length));
    write(name, type, type, texts.size(), all.data());
  }
  /// Number of entries of a data set, and that it is in no profile.
  void count(const std::string& name, std::size_t entries) {
    attribute(name, "CGT", 1);
    attribute(name, "NBR", static_cast<int>(entries));
  }

 private:
  void check(hid_t id, const std::string& what) const {
    if (id < 0) throw OutputError(path_, fmt::format("HDF5 could not write {}: is the disk full?", what));
  }
  void write_attribute(const std::string& owner, const char* name, hid_t type, hid_t memory, const void* value) {
    const Object object(H5Oopen(file_, owner.c_str(), H5P_DEFAULT));
    const Space space(H5Screate(H5S_SCALAR));
    const Attribute made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
    check(made, owner);
    check(H5Awrite(made, memory, value), owner);
  }
  void write(const std::string& name, hid_t type, hid_t memory, std::size_t entries, const void* values) {
    const hsize_t extent = entries;
    const Space space(H5Screate_simple(1, &extent, nullptr));
    const Set set(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    check(set, name);
    check(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }

  std::string path_;
  File file_;
};

/// The sets of groups that occur, with the number of the family that stands for each: positive for nodes, negative for
/// cells, 0 for none.
class Families {
 public:
  explicit Families(int sign) : sign_(sign) {}
  std::int64_t number(const std::vector<std::string>& groups) {
    if (groups.empty()) return 0;
    return found_.try_emplace(groups, sign_ * static_cast<std::int64_t>(found_.size() + 1)).first->second;
  }
  void write(MedFile& file, const std::string& below) const {
    for (const auto& [groups, number] : found_) {
      const std::string family = fmt::format("{}/FAM_{}", below, number);
      file.group(family);
      file.attribute(family, "NUM", static_cast<int>(number));
      file.group(family + "/GRO");
      file.attribute(family + "/GRO", "NBR", static_cast<int>(groups.size()));
      file.names(family + "/GRO/NOM", groups);
    }
  }

 private:
  int sign_;
  std::map<std::vector<std::string>, std::int64_t> found_;
};

void refuse_long_names(const Mesh& mesh) {
  for (const std::string& name : mesh.group_names())
    if (name.size() > kGroupName)
      throw CaseError({mesh.report.source, 0, 0}, "", fmt::format("a group named {}", name),
                      fmt::format("at most {} bytes", kGroupName), "Give it a shorter name.");
}

/// Things of the mesh in the lists of their groups, by name in their order.
template <class Members, class Place>
std::vector<std::vector<std::string>> groups_by_entry(const std::map<std::string, Members>& groups, std::size_t entries,
                                                      const Place& place) {
  std::vector<std::vector<std::string>> of(entries);
  for (const auto& [name, members] : groups)
    for (const auto& member : members)
      if (const auto entry = place(member); entry < entries) of[entry].push_back(name);
  return of;
}

void write_nodes(MedFile& file, const std::string& step, const Mesh& mesh, Families& families) {
  const std::string nodes = step + "/NOE";
  const std::size_t count = mesh.node_count();
  std::vector<double> coordinates(3 * count);
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t c = 0; c < 3; ++c) coordinates[c * count + n] = mesh.coordinates[n][c];
  std::vector<std::int64_t> family;
  for (const auto& groups : groups_by_entry(mesh.node_groups, count, [](Index n) { return at(n); }))
    family.push_back(families.number(groups));
  file.group(nodes);
  file.attribute(nodes, "CGT", 1);
  file.attribute(nodes, "CGS", 1);
  file.attribute(nodes, "PFL", "MED_NO_PROFILE_INTERNAL", 64);
  file.data(nodes + "/COO", coordinates);
  file.data(nodes + "/FAM", family);
  file.data(nodes + "/NUM", mesh.node_numbers);
  for (const char* name : {"/COO", "/FAM", "/NUM"}) file.count(nodes + name, count);
}

void write_block(MedFile& file, const std::string& cells, const Mesh& mesh, std::size_t b, Families& families) {
  const CellBlock& block = mesh.blocks[b];
  const std::string_view code = med_code(block.type);
  if (code.empty())
    throw CaseError({mesh.report.source, 0, 0}, "", fmt::format("cells of type {}", name(block.type)),
                    "cells that MED has", "Write the mesh as .msh or .vtu.");
  const std::string own = fmt::format("{}/{}", cells, code);
  const std::size_t count = block.size();
  std::vector<std::int64_t> nodes(block.connectivity.size());
  for (std::size_t c = 0; c < count; ++c) {
    const std::span<const Index> given = block.nodes(static_cast<Index>(c));
    for (std::size_t i = 0; i < given.size(); ++i)
      nodes[med_position(block.type, i) * count + c] = std::int64_t{given[i]} + 1;
  }
  const auto place = [b](const CellRef& cell) { return at(cell.block) == b ? at(cell.cell) : ~std::size_t{0}; };
  std::vector<std::int64_t> family;
  for (const auto& groups : groups_by_entry(mesh.cell_groups, count, place)) family.push_back(families.number(groups));
  file.group(own);
  file.attribute(own, "CGT", 1);
  file.attribute(own, "CGS", 1);
  file.attribute(own, "PFL", "MED_NO_PROFILE_INTERNAL", 64);
  file.attribute(own, "GEO", 100 * dimension(block.type) + node_count(block.type));
  file.data(own + "/NOD", nodes);
  file.data(own + "/FAM", family);
  file.data(own + "/NUM", block.file_numbers);
  for (const char* name : {"/NOD", "/FAM", "/NUM"}) file.count(own + name, count);
}

void write_head(MedFile& file, const std::string& mesh) {
  file.group("/INFOS_GENERALES");
  file.attribute("/INFOS_GENERALES", "MAJ", 4);
  file.attribute("/INFOS_GENERALES", "MIN", 0);
  file.attribute("/INFOS_GENERALES", "REL", 0);
  file.group(mesh);
  for (const auto& [name, value] :
       {std::pair{"DIM", 3}, {"ESP", 3}, {"REP", 0}, {"TYP", 0}, {"SRT", 0}, {"NXT", -1}, {"NXI", -1}})
    file.attribute(mesh, name, value);
  file.attribute(mesh, "UNT", "", 16);
  file.attribute(mesh, "UNI", "", 48);
  file.attribute(mesh, "NOM", fmt::format("{:16}{:16}{:16}", "X", "Y", "Z"), 48);
  file.attribute(mesh, "DES", "written by carom", 200);
}

void write(const std::string& path, const Mesh& mesh) {
  MedFile file(path);
  const std::string name = "mesh", top = "/ENS_MAA/" + name;
  const std::string step = top + "/-0000000000000000001-0000000000000000001", families = "/FAS/" + name;
  write_head(file, top);
  file.group(step);
  for (const char* number : {"NDT", "NOR", "NXT", "NXI", "PVT", "PVI"}) file.attribute(step, number, -1);
  file.attribute(step, "CGT", 1);
  file.attribute(step, "CGS", 1);
  file.attribute(step, "PDT", -1.0);
  Families of_nodes(1), of_cells(-1);
  write_nodes(file, step, mesh, of_nodes);
  file.group(step + "/MAI");
  file.attribute(step + "/MAI", "CGT", 1);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) write_block(file, step + "/MAI", mesh, b, of_cells);
  file.group(families + "/FAMILLE_ZERO");
  file.attribute(families + "/FAMILLE_ZERO", "NUM", 0);
  file.group(families + "/NOEUD");
  file.group(families + "/ELEME");
  of_nodes.write(file, families + "/NOEUD");
  of_cells.write(file, families + "/ELEME");
}

}  // namespace

void write_med(const std::string& path, const Mesh& mesh) {
  refuse_long_names(mesh);
  const QuietHdf5 quiet;
  { const FileWriter probe(path); }  // says why, where a file cannot be made there
  const std::string temporary = path + ".tmp";
  try {
    write(temporary, mesh);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) throw OutputError(path, error.message());
}

}  // namespace carom
