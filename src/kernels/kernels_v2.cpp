#include "kernels/kernel_table.hpp"

namespace carom {

const KernelTable& kernels_v2() {
  static constexpr KernelTable table = make_kernels<Pack2>();
  return table;
}

}  // namespace carom
