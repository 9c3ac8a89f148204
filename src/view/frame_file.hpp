// The fields of one instant, read back from a results folder.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"
#include "output/pvd.hpp"
#include "view/mapped_file.hpp"

namespace carom {

/// One array of a frame: `components` values per entry, entry after entry.
struct StoredArray {
  enum class Type : std::uint8_t { float32, float64, int32, int64, uint8 };

  std::string name;
  int components = 1;
  Type type{};
  std::span<const std::byte> bytes;

  std::size_t entries() const;
  double at(std::size_t entry, std::size_t component = 0) const;
};

/// A .vtu as write_vtu writes it (raw appended data, header_type UInt64); others are refused. The arrays stay in the
/// file until they are looked at. Throws std::runtime_error, which names the file and what is wrong with it.
class FrameFile {
 public:
  explicit FrameFile(const std::string& path);

  std::size_t points() const { return points_; }
  std::size_t cells() const { return cells_; }
  std::span<const StoredArray> point_fields() const { return point_fields_; }
  std::span<const StoredArray> cell_fields() const { return cell_fields_; }
  /// The array of that name, nullptr where there is none.
  const StoredArray* point_field(std::string_view name) const;
  const StoredArray* cell_field(std::string_view name) const;
  const StoredArray& coordinates() const { return structure_[0]; }
  /// Points and cells; CellBlock::file_numbers are the positions of the cells in the file, from 0.
  Mesh mesh() const;

 private:
  MappedFile file_;
  std::string path_;
  std::size_t points_ = 0, cells_ = 0;
  std::vector<StoredArray> point_fields_, cell_fields_;
  std::vector<StoredArray> structure_;  ///< coordinates, connectivity, offsets, types
};

/// The frames of a collection that PvdCollection has written; empty when there is no such file. Throws
/// std::runtime_error for a line that is not understood.
std::vector<PvdFrame> read_frames(const std::string& path);

}  // namespace carom
