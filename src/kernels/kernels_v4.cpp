#include "kernels/kernel_table.hpp"

namespace carom {

const KernelTable& kernels_v4() {
  static constexpr KernelTable table = make_kernels<Pack8>();
  return table;
}

}  // namespace carom
