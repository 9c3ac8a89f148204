// Writes the seed files of tests/fuzz/corpus: make_seeds FOLDER. A block of two HEXA8 with groups, as Gmsh 2.2 and 4.1
// (text, both byte orders), as a MED file and as the stream of the process that reads MED files.
#include <fmt/format.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/hdf5_visitor.hpp"
#include "mesh/isolated_process.hpp"
#include "mesh/structured_block.hpp"
#include "mesh_fixture.hpp"

namespace {

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_attribute(hid_t group, const char* name, std::int64_t value) {
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t id = H5Acreate2(group, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(id, H5T_NATIVE_INT64, &value);
  H5Aclose(id);
  H5Sclose(space);
}

hid_t make_group(hid_t parent, const char* name) {
  return H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

void write_data(hid_t group, const char* name, hid_t file_type, hid_t memory_type, hsize_t count, const void* data) {
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t id = H5Dcreate2(group, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  H5Dclose(id);
  H5Sclose(space);
}

void write_integers(hid_t group, const char* name, const std::vector<std::int64_t>& values) {
  write_data(group, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
}

void write_family(hid_t parent, const char* family, std::int64_t number, std::string group_name) {
  const hid_t group = make_group(parent, family);
  write_attribute(group, "NUM", number);
  const hid_t names = make_group(group, "GRO");
  write_attribute(names, "NBR", 1);
  const hsize_t length = 80;
  const hid_t type = H5Tarray_create2(H5T_STD_I8LE, 1, &length);
  group_name.resize(length, ' ');
  write_data(names, "NOM", type, type, 1, group_name.data());
  H5Tclose(type);
  H5Gclose(names);
  H5Gclose(group);
}

/// Two HEXA8 in MED's order: nodes 1 to 12 in three layers of four.
void write_med(const std::string& path) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const hid_t general = make_group(file, "INFOS_GENERALES");
  write_attribute(general, "MAJ", 4);
  write_attribute(general, "MIN", 1);
  const hid_t meshes = make_group(file, "ENS_MAA"), mesh = make_group(meshes, "m");
  write_attribute(mesh, "ESP", 3);
  write_attribute(mesh, "TYP", 0);
  const hid_t step = make_group(mesh, "-1-1"), nodes = make_group(step, "NOE"), cells = make_group(step, "MAI"),
              hexas = make_group(cells, "HE8");
  const std::vector<double> coordinates{0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0,
                                        1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2};
  write_data(nodes, "COO", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, coordinates.size(), coordinates.data());
  write_integers(nodes, "FAM", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  write_integers(hexas, "NOD", {1, 5, 4, 8, 3, 7, 2, 6, 5, 9, 8, 12, 7, 11, 6, 10});
  write_integers(hexas, "FAM", {-1, 0});
  write_integers(hexas, "NUM", {11, 12});
  const hid_t families = make_group(file, "FAS"), here = make_group(families, "m");
  const hid_t of_nodes = make_group(here, "NOEUD"), of_cells = make_group(here, "ELEME");
  write_family(of_nodes, "FAM_1", 1, "CORNER");
  write_family(of_cells, "FAM_-1", -1, "LOWER");
  for (const hid_t id : {general, meshes, mesh, step, nodes, cells, hexas, families, here, of_nodes, of_cells})
    H5Gclose(id);
  H5Fclose(file);
  H5Pclose(access);
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    fmt::print(stderr, "usage: make_seeds FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  carom::StructuredBlock block;
  block.size = {1, 1, 2};
  block.divisions = {1, 1, 2};
  block.face_groups = {"SIDE", "", "", "", "FOOT", ""};
  block.points = {{"CORNER", {0, 0, 0}, {}}};
  const carom::Mesh mesh = carom::make_structured_blocks({block});
  using carom::test::GmshEncoding;
  using carom::test::GmshVersion;
  const std::pair<GmshEncoding, const char*> encodings[] = {
      {GmshEncoding::text, "text"}, {GmshEncoding::little_endian, "little"}, {GmshEncoding::big_endian, "big"}};
  for (const auto& [encoding, name] : encodings) {
    write_file(folder / "gmsh" / fmt::format("2.2_{}.msh", name), gmsh_file(mesh, GmshVersion::v2_2, encoding));
    write_file(folder / "gmsh" / fmt::format("4.1_{}.msh", name), gmsh_file(mesh, GmshVersion::v4_1, encoding));
  }
  write_file(folder / "med" / "block.med", "");
  write_med(folder / "med" / "block.med");
  const std::string bytes = carom::test::bytes_of(folder / "med" / "block.med");
  const auto all = [](const std::string&) { return true; };
  const carom::IsolationLimits limits{.memory_bytes = 1 << 28, .output_bytes = 1 << 20, .cpu_seconds = 2};
  write_file(folder / "med" / "block.stream",
             carom::run_isolated(limits, [&](int fd) { carom::visit_hdf5(bytes, all, fd); }).output);
  return 0;
}
