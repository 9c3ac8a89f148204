#include "linalg/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "linalg/lapack.hpp"
#include "linalg/metis_turn.hpp"

namespace carom {

namespace {

/// The lower triangle by rows. CHOLMOD reads it as the upper triangle by columns (stype = 1). Without values: a
/// pattern.
struct LowerTriangle {
  std::vector<SuiteSparse_long> begin, column;
  std::vector<double> value;

  cholmod_sparse view();
};

LowerTriangle lower_triangle(const CsrMatrix& A) {
  LowerTriangle lower{std::vector<SuiteSparse_long>(static_cast<std::size_t>(A.size) + 1, 0), {}, {}};
  auto& [begin, column, value] = lower;
  const std::size_t about_half = (A.value.size() + static_cast<std::size_t>(A.size)) / 2;
  column.reserve(about_half);
  value.reserve(about_half);
  for (Index i = 0; i < A.size; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const auto last = static_cast<std::size_t>(A.row_begin[row + 1]);
    for (auto k = static_cast<std::size_t>(A.row_begin[row]); k < last && A.column[k] <= i; ++k) {
      if (!std::isfinite(A.value[k]))
        throw std::runtime_error(fmt::format("Cholesky factorisation: entry ({}, {}) is not finite", i, A.column[k]));
      column.push_back(A.column[k]);
      value.push_back(A.value[k]);
    }
    begin[row + 1] = static_cast<SuiteSparse_long>(value.size());
  }
  return lower;
}

cholmod_sparse LowerTriangle::view() {
  cholmod_sparse view{};
  view.nrow = view.ncol = begin.size() - 1;
  view.nzmax = column.size();
  view.p = begin.data();
  view.i = column.data();
  view.x = value.data();
  view.stype = 1;
  view.itype = CHOLMOD_LONG;
  view.xtype = value.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

/// Which nodes of three rows each share an entry.
LowerTriangle by_nodes(std::span<const SuiteSparse_long> begin, std::span<const SuiteSparse_long> column) {
  const std::size_t nodes = (begin.size() - 1) / 3;
  LowerTriangle out{std::vector<SuiteSparse_long>(nodes + 1, 0), {}, {}};
  std::vector<std::size_t> seen_by(nodes, nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    for (auto k = begin[3 * node]; k < begin[3 * node + 3]; ++k) {
      const SuiteSparse_long other = column[static_cast<std::size_t>(k)] / 3;
      if (std::exchange(seen_by[static_cast<std::size_t>(other)], node) != node) out.column.push_back(other);
    }
    std::sort(out.column.begin() + out.begin[node], out.column.end());
    out.begin[node + 1] = static_cast<SuiteSparse_long>(out.column.size());
  }
  return out;
}

std::string reason(const cholmod_common& common) {
  switch (common.status) {
    case CHOLMOD_OUT_OF_MEMORY:
      return "out of memory";
    case CHOLMOD_TOO_LARGE:
      return "the matrix is too large";
    case CHOLMOD_NOT_INSTALLED:
      return "this CHOLMOD was built without METIS";
    default:
      return fmt::format("CHOLMOD status {}", common.status);
  }
}

}  // namespace

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_factor* L = nullptr;
  // Kept between solves.
  cholmod_dense* X = nullptr;
  cholmod_dense* Y = nullptr;
  cholmod_dense* E = nullptr;
  // Of the factor: supernode of each pivot, pivot of each row of A.
  std::vector<Index> supernode_of, pivot_of;

  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::vector<SuiteSparse_long> begin, column;  ///< of the lower triangle that L has been analysed for

  void analyse(cholmod_sparse A);
  void factorize(LowerTriangle lower);
  void number_pivots();
  void substitute(HalfPanel& panel, std::vector<std::size_t>& place) const;
};

Cholesky::Impl::Impl() {
  cholmod_l_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.postorder = 1;
  common.quick_return_if_not_posdef = 1;
}

Cholesky::Impl::~Impl() {
  cholmod_l_free_dense(&E, &common);
  cholmod_l_free_dense(&Y, &common);
  cholmod_l_free_dense(&X, &common);
  cholmod_l_free_factor(&L, &common);
  cholmod_l_finish(&common);
}

/// Orders and analyses A: where its rows come in threes, those of a node, nodes are ordered, by a graph of a ninth of
/// the entries.
void Cholesky::Impl::analyse(cholmod_sparse A) {
  std::vector<SuiteSparse_long> order;
  if (A.nrow % 3 == 0) {
    LowerTriangle nodes = by_nodes(begin, column);
    cholmod_sparse graph = nodes.view();
    std::vector<SuiteSparse_long> order_of_nodes(graph.ncol);
    const std::scoped_lock turn(metis_turn);
    if (cholmod_l_metis(&graph, nullptr, 0, 1, order_of_nodes.data(), &common) == 0)
      throw std::runtime_error("Cholesky factorisation: ordering failed: " + reason(common));
    for (const SuiteSparse_long node : order_of_nodes)
      for (SuiteSparse_long d = 0; d < 3; ++d) order.push_back(3 * node + d);
  }
  common.method[0].ordering = order.empty() ? CHOLMOD_METIS : CHOLMOD_GIVEN;
  L = cholmod_l_analyze_p(&A, order.empty() ? nullptr : order.data(), nullptr, 0, &common);
  if (L == nullptr) throw std::runtime_error("Cholesky factorisation: analysis failed: " + reason(common));
}

void Cholesky::Impl::factorize(LowerTriangle lower) {
  cholmod_sparse A = lower.view();
  if (L == nullptr || lower.begin != begin || lower.column != column) {
    cholmod_l_free_factor(&L, &common);
    pivot_of.clear();
    begin = lower.begin;
    column = lower.column;
    analyse(A);
  }
  const bool done = cholmod_l_factorize(&A, L, &common) != 0;
  if (common.status == CHOLMOD_NOT_POSDEF || (done && L->minor < L->n)) {
    const SuiteSparse_long row = static_cast<const SuiteSparse_long*>(L->Perm)[L->minor];
    cholmod_l_free_factor(&L, &common);
    throw NotPositiveDefinite(
        fmt::format("Cholesky factorisation: the matrix is not positive definite (pivot of row {})", row));
  }
  if (!done) throw std::runtime_error("Cholesky factorisation failed: " + reason(common));
}

void Cholesky::Impl::number_pivots() {
  if (!pivot_of.empty()) return;
  const auto* first = static_cast<const SuiteSparse_long*>(L->super);
  const auto* row = static_cast<const SuiteSparse_long*>(L->Perm);
  supernode_of.resize(L->n);
  pivot_of.resize(L->n);
  for (std::size_t s = 0; s < L->nsuper; ++s)
    std::fill(supernode_of.begin() + first[s], supernode_of.begin() + first[s + 1], static_cast<Index>(s));
  for (std::size_t k = 0; k < L->n; ++k) pivot_of[static_cast<std::size_t>(row[k])] = static_cast<Index>(k);
}

/// panel = L^-1 panel by supernodes: dense triangles, and what lies below them. place: of each of its supernodes, its
/// first row.
void Cholesky::Impl::substitute(HalfPanel& panel, std::vector<std::size_t>& place) const {
  const auto* first = static_cast<const SuiteSparse_long*>(L->super);
  const auto* index = static_cast<const SuiteSparse_long*>(L->pi);
  const auto* entry = static_cast<const SuiteSparse_long*>(L->px);
  const auto* row = static_cast<const SuiteSparse_long*>(L->s);
  const auto* x = static_cast<const double*>(L->x);
  const int width = static_cast<int>(panel.column.size()), rows = static_cast<int>(panel.rows());
  const double one = 1.0, zero = 0.0;
  std::vector<double> below;
  for (std::size_t k = 0; k < panel.supernode.size(); ++k) {
    const Index s = panel.supernode[k];
    const int size = static_cast<int>(first[s + 1] - first[s]), all = static_cast<int>(index[s + 1] - index[s]);
    const int rest = all - size;
    double* own = panel.value.data() + panel.begin[k];
    dtrsm_("L", "L", "N", "N", &size, &width, &one, x + entry[s], &all, own, &rows);
    if (rest == 0) continue;
    below.resize(static_cast<std::size_t>(rest) * panel.column.size());
    dgemm_("N", "N", &rest, &width, &size, &one, x + entry[s] + size, &all, own, &rows, &zero, below.data(), &rest);
    for (int i = 0; i < rest; ++i) {
      const SuiteSparse_long pivot = row[index[s] + size + i];
      const auto t = static_cast<std::size_t>(supernode_of[static_cast<std::size_t>(pivot)]);
      double* to = panel.value.data() + place[t] + (pivot - first[t]);
      const double* from = below.data() + i;
      for (std::ptrdiff_t c = 0; c < width; ++c) to[c * rows] -= from[c * rest];
    }
  }
}

Cholesky::Cholesky(const CsrMatrix& A) : impl_(std::make_unique<Impl>()) {
  factorize(A);
}

void Cholesky::factorize(const CsrMatrix& A) {
  if (A.size == 0) return;
  openblas_set_num_threads(1);
  impl_->factorize(lower_triangle(A));
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::solve(std::span<double> b, int columns) const {
  if (impl_->L == nullptr || columns == 0) return;
  const std::size_t n = impl_->L->n;
  assert(columns > 0 && b.size() == n * static_cast<std::size_t>(columns));
  cholmod_dense B{};
  B.nrow = B.d = n;
  B.ncol = static_cast<std::size_t>(columns);
  B.nzmax = b.size();
  B.x = b.data();
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  if (cholmod_l_solve2(CHOLMOD_A, impl_->L, &B, nullptr, &impl_->X, nullptr, &impl_->Y, &impl_->E, &impl_->common) == 0)
    throw std::runtime_error("Cholesky solve failed: " + reason(impl_->common));
  const auto* x = static_cast<const double*>(impl_->X->x);
  std::copy(x, x + b.size(), b.begin());
}

std::vector<HalfPanel> Cholesky::half_solve(const SparseColumns& B) const {
  std::vector<HalfPanel> panels;
  if (impl_->L == nullptr || B.size() == 0) return panels;
  impl_->number_pivots();
  const auto* first = static_cast<const SuiteSparse_long*>(impl_->L->super);
  const auto* index = static_cast<const SuiteSparse_long*>(impl_->L->pi);
  const auto* row = static_cast<const SuiteSparse_long*>(impl_->L->s);
  const std::vector<Index>&pivot_of = impl_->pivot_of, &supernode_of = impl_->supernode_of;
  std::vector<std::pair<Index, std::size_t>> order;  // first pivot, column
  for (std::size_t c = 0; c < B.size(); ++c) {
    Index lowest = std::numeric_limits<Index>::max();
    for (std::size_t k = B.begin[c]; k < B.begin[c + 1]; ++k)
      lowest = std::min(lowest, pivot_of[static_cast<std::size_t>(B.row[k])]);
    if (B.begin[c] < B.begin[c + 1]) order.emplace_back(lowest, c);
  }
  std::sort(order.begin(), order.end());
  constexpr std::size_t most = 48;  // columns of a panel: enough for the matrix-matrix kernels
  constexpr auto absent = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(impl_->L->nsuper, absent);
  for (std::size_t from = 0; from < order.size(); from += most) {
    HalfPanel& Y = panels.emplace_back();
    const std::size_t width = std::min(most, order.size() - from);
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t c = order[from + k].second;
      Y.column.push_back(c);
      for (std::size_t e = B.begin[c]; e < B.begin[c + 1]; ++e) {
        auto s = static_cast<std::size_t>(
            supernode_of[static_cast<std::size_t>(pivot_of[static_cast<std::size_t>(B.row[e])])]);
        while (place[s] == absent) {
          place[s] = 0;
          Y.supernode.push_back(static_cast<Index>(s));
          const SuiteSparse_long parent = index[s] + first[s + 1] - first[s];  // the first row below the triangle
          if (parent == index[s + 1]) break;
          s = static_cast<std::size_t>(supernode_of[static_cast<std::size_t>(row[parent])]);
        }
      }
    }
    std::sort(Y.supernode.begin(), Y.supernode.end());
    Y.begin.push_back(0);
    for (const Index s : Y.supernode) {
      place[static_cast<std::size_t>(s)] = Y.begin.back();
      Y.begin.push_back(Y.begin.back() + static_cast<std::size_t>(first[s + 1] - first[s]));
    }
    Y.value.assign(Y.rows() * width, 0.0);
    for (std::size_t k = 0; k < width; ++k) {
      for (std::size_t e = B.begin[Y.column[k]]; e < B.begin[Y.column[k] + 1]; ++e) {
        const Index pivot = pivot_of[static_cast<std::size_t>(B.row[e])];
        const auto s = static_cast<std::size_t>(supernode_of[static_cast<std::size_t>(pivot)]);
        Y.value[k * Y.rows() + place[s] + static_cast<std::size_t>(pivot - first[s])] += B.value[e];
      }
    }
    impl_->substitute(Y, place);
    for (const Index s : Y.supernode) place[static_cast<std::size_t>(s)] = absent;
  }
  return panels;
}

double Cholesky::factor_entries() const {
  return impl_->L == nullptr ? 0.0 : static_cast<double>(impl_->L->xsize);
}

double Cholesky::factor_bytes() const {
  if (impl_->L == nullptr) return 0.0;
  return static_cast<double>(impl_->L->xsize * sizeof(double) + impl_->L->ssize * sizeof(SuiteSparse_long));
}

}  // namespace carom
