#include "linalg/half_solution.hpp"

#include "linalg/lapack.hpp"

namespace carom {

void add_product(const HalfPanel& A, const HalfPanel& B, std::size_t stride, std::span<double> C) {
  const int m = static_cast<int>(B.column.size()), n = static_cast<int>(A.column.size());
  const int rows_a = static_cast<int>(A.rows()), rows_b = static_cast<int>(B.rows()), ld = static_cast<int>(stride);
  const double one = 1.0;
  std::size_t a = 0, b = 0;
  while (a < A.supernode.size() && b < B.supernode.size()) {
    if (A.supernode[a] < B.supernode[b]) {
      ++a;
    } else if (B.supernode[b] < A.supernode[a]) {
      ++b;
    } else {
      // Supernodes in common follow each other in both up to the root: one product for as many as do.
      const std::size_t first_a = a, first_b = b;
      while (a < A.supernode.size() && b < B.supernode.size() && A.supernode[a] == B.supernode[b]) ++a, ++b;
      const int k = static_cast<int>(A.begin[a] - A.begin[first_a]);
      dgemm_("T", "N", &m, &n, &k, &one, B.value.data() + B.begin[first_b], &rows_b, A.value.data() + A.begin[first_a],
             &rows_a, &one, C.data(), &ld);
    }
  }
}

}  // namespace carom
