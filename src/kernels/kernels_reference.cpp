#include "kernels/kernel_table.hpp"

namespace carom {

const KernelTable& kernels_reference() {
  static constexpr KernelTable table = make_kernels<double>();
  return table;
}

}  // namespace carom
