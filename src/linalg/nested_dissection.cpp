#include "linalg/nested_dissection.hpp"

#include <cholmod.h>

#include <cstddef>
#include <stdexcept>

#include "linalg/metis_turn.hpp"

namespace carom {

namespace {

/// The lower triangle by rows, which CHOLMOD reads as the upper triangle by columns (stype = 1); no values.
struct LowerPattern {
  std::vector<SuiteSparse_long> begin{0}, column;

  explicit LowerPattern(const CsrMatrix& A) {
    for (Index i = 0; i < A.size; ++i) {
      const auto row = static_cast<std::size_t>(i);
      for (std::int64_t k = A.row_begin[row]; k < A.row_begin[row + 1]; ++k) {
        const Index j = A.column[static_cast<std::size_t>(k)];
        if (j <= i) column.push_back(j);
      }
      begin.push_back(static_cast<SuiteSparse_long>(column.size()));
    }
  }

  cholmod_sparse view() {
    cholmod_sparse view{};
    view.nrow = view.ncol = begin.size() - 1;
    view.nzmax = column.size();
    view.p = begin.data();
    view.i = column.data();
    view.stype = 1;
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_PATTERN;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
  }
};

}  // namespace

std::vector<Index> nested_dissection(const CsrMatrix& A) {
  LowerPattern pattern(A);
  cholmod_sparse view = pattern.view();
  std::vector<SuiteSparse_long> order(static_cast<std::size_t>(A.size));
  cholmod_common common{};
  cholmod_l_start(&common);
  common.print = 0;
  const int postorder = 1;
  const std::scoped_lock turn(metis_turn);
  const bool done = cholmod_l_metis(&view, nullptr, 0, postorder, order.data(), &common) != 0;
  const bool without_memory = common.status == CHOLMOD_OUT_OF_MEMORY;
  cholmod_l_finish(&common);
  if (!done) throw std::runtime_error(without_memory ? "ordering: out of memory" : "ordering: METIS failed");
  return {order.begin(), order.end()};
}

}  // namespace carom
