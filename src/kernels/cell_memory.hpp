// What a cell remembers from step to step, as named slots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

/// The slots, in the order in which they stand in the memory of a cell:
///   - law: the history variables of its points, point after point (PointBatch::history)
///   - hourglass: its modes, where they yield or are viscous (kernels/hourglass_flow.hpp)
///   - viscosity: BulkHistory
/// A new one is a name here, and its size where the stages of a part are made (solid/blocks.cpp).
enum class MemorySlot : std::uint8_t { law, hourglass, viscosity };
inline constexpr std::size_t memory_slots = 3;

/// How many numbers a cell remembers in each slot. Number k of a slot of lane l of a batch stands at
/// [(begin(slot) + k) lanes + l] of the batch's history.
class CellMemory {
 public:
  int size(MemorySlot slot) const { return size_[static_cast<std::size_t>(slot)]; }
  int begin(MemorySlot slot) const {
    int sum = 0;
    for (std::size_t s = 0; s < static_cast<std::size_t>(slot); ++s) sum += size_[s];
    return sum;
  }
  /// Of all slots.
  int size() const { return begin(static_cast<MemorySlot>(memory_slots)); }
  void resize(MemorySlot slot, int numbers) { size_[static_cast<std::size_t>(slot)] = numbers; }

 private:
  std::array<int, memory_slots> size_{};
};

}  // namespace carom
