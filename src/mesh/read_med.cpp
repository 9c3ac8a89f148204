#include "mesh/read_med.hpp"

#include "mesh/finish_mesh.hpp"
#include "mesh/hdf5_tree.hpp"
#include "mesh/med_mesh.hpp"

namespace carom {

namespace {

/// Meshes and families, without the names of single nodes and cells and without result fields.
bool is_wanted(const std::string& path) {
  if (path.starts_with("/FAS") || path.ends_with("/GRO/NOM")) return true;
  if (path.ends_with("/NOM")) return false;
  return path.starts_with("/ENS_MAA") || path == "/INFOS_GENERALES";
}

}  // namespace

Mesh read_med(std::string_view bytes, const std::string& source) {
  return finished(med_mesh(read_hdf5_tree(bytes, source, is_wanted), source));
}

}  // namespace carom
