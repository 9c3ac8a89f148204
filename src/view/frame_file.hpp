// The fields of one instant, read back from a results folder.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"
#include "output/frame_format.hpp"
#include "view/mapped_file.hpp"

namespace carom {

/// One array of a frame: `components` values per entry, entry after entry.
class StoredArray {
 public:
  using Type = NumberType;

  std::string name;
  int components = 1;
  Type type{};

  StoredArray() = default;
  /// Bytes that are there, as long as the array is used.
  StoredArray(std::string its_name, int width, Type its_type, std::span<const std::byte> bytes);
  /// Bytes that are read when a value is looked at for the first time; a copy reads them anew.
  StoredArray(std::string its_name, int width, Type its_type, std::size_t entries,
              std::function<std::vector<std::byte>()> read);

  std::size_t entries() const { return entries_; }
  double at(std::size_t entry, std::size_t component = 0) const;
  /// All values as they are stored, entry after entry.
  std::span<const std::byte> bytes() const;

 private:
  std::size_t entries_ = 0;
  std::function<std::vector<std::byte>()> read_;
  std::span<const std::byte> bytes_;
  /// What has been read.
  struct Kept {
    std::vector<std::byte> bytes;
    bool is_there = false;
    Kept() = default;
    Kept(const Kept& /*other*/) {}
    Kept& operator=(const Kept& /*other*/) { return *this; }
    Kept(Kept&&) = default;
    Kept& operator=(Kept&&) = default;
    ~Kept() = default;
  };
  mutable Kept kept_;
};

/// A frame as the formats of output/frame_format.hpp write it; others are refused. The arrays stay in the file until
/// they are looked at. Throws std::runtime_error, which names the file and what is wrong with it.
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
  void read_vtu();
  void read_hdf5();

  std::optional<MappedFile> file_;
  std::string path_;
  std::size_t points_ = 0, cells_ = 0;
  std::vector<StoredArray> point_fields_, cell_fields_;
  /// Coordinates, connectivity, ends of the cells in it (after a 0, where there is one more than cells), types.
  std::vector<StoredArray> structure_;
};

/// The frames that the indices of a results folder name; empty when there are none. Throws std::runtime_error for a
/// line that is not understood.
std::vector<FrameEntry> read_frames(const std::string& folder);

}  // namespace carom
