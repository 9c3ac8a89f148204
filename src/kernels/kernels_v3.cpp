#include "kernels/kernel_table.hpp"

namespace carom {

const KernelTable& kernels_v3() {
  static constexpr KernelTable table = make_kernels<Pack4>();
  return table;
}

}  // namespace carom
