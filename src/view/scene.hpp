// What one run's frames show from outside: surface, fields on it, times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "output/frame_format.hpp"
#include "view/seen_surface.hpp"

namespace carom {

/// A recorded field on the nodes or cells of a surface.
struct SceneField {
  std::string name;
  int components = 1;
  bool at_cells = false;
  std::vector<std::vector<float>> frames;  ///< by time: entry after entry; NaN where there is no value
};

/// Bodies, or obstacles. `displacement` is a field of the nodes.
struct Scene {
  SeenSurface surface;
  std::vector<Vec3> reference;                           ///< per node of the surface
  std::vector<std::int64_t> node_numbers, cell_numbers;  ///< in the mesh file; empty where the frames have none
  std::vector<Index> part;                               ///< per cell of the surface
  std::vector<SceneField> fields;
  std::size_t all_nodes = 0;      ///< of the frames, with those inside
  std::size_t surface_nodes = 0;  ///< of the whole surface

  std::size_t value_count() const;  ///< of a frame, over all fields
};

/// Reads frames (paths) of one mesh: `part` names the cell field that tells the parts. Fields of the first frame that
/// others do not have are left out. More nodes than `most` are coarsened away. Throws std::runtime_error for a frame
/// that cannot be read or has another mesh.
Scene read_scene(std::span<const std::string> frames, const std::string& part, std::size_t most);

/// The same over fewer nodes.
Scene coarsened(const Scene& scene, std::size_t most);

/// Some of so many things, evenly, the first and the last among them.
std::vector<std::size_t> evenly(std::size_t all, std::size_t some);

}  // namespace carom
