#include "linalg/block_matrix.hpp"

#include <algorithm>

#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr std::size_t points_per_task = 512;

/// Calls body(n) for the points of a range.
template <class Body>
void each_point(EntryRange range, const Body& body) {
  parallel_for(range.size(), points_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = range.begin + begin; n < range.begin + end; ++n) body(n);
  });
}

template <class Scalar>
void apply_blocks(const BlockMatrix& A, const Scalar* value, std::span<const double> x, std::span<double> y,
                  EntryRange range) {
  each_point(range, [&](std::size_t n) {
    double sum[3] = {};
    for (std::int64_t k = A.row_begin[n]; k < A.row_begin[n + 1]; ++k) {
      const Scalar* a = value + 9 * k;
      const double* of_point = x.data() + 3 * at(A.column[static_cast<std::size_t>(k)]);
      for (int i = 0; i < 3; ++i)
        sum[i] += a[3 * i] * of_point[0] + a[3 * i + 1] * of_point[1] + a[3 * i + 2] * of_point[2];
    }
    for (std::size_t i = 0; i < 3; ++i) y[3 * n + i] = sum[i];
  });
}

}  // namespace

BlockMatrix BlockMatrix::with_graph(const std::vector<std::vector<Index>>& neighbours) {
  BlockMatrix A;
  for (const std::vector<Index>& row : neighbours) {
    A.column.insert(A.column.end(), row.begin(), row.end());
    A.row_begin.push_back(static_cast<std::int64_t>(A.column.size()));
  }
  A.value.assign(9 * A.column.size(), 0.0);
  return A;
}

std::ptrdiff_t BlockMatrix::place(Index row, Index col) const {
  const auto first = column.begin() + row_begin[at(row)], last = column.begin() + row_begin[at(row) + 1];
  return std::lower_bound(first, last, col) - column.begin();
}

void BlockMatrix::apply(std::span<const double> x, std::span<double> y, EntryRange range) const {
  if (single.empty())
    apply_blocks(*this, value.data(), x, y, range);
  else
    apply_blocks(*this, single.data(), x, y, range);
}

void BlockMatrix::round_to_single() {
  single.assign(value.begin(), value.end());
  value = std::vector<double>();  // frees; = {} keeps the memory
}

std::vector<double> BlockMatrix::diagonal() const {
  std::vector<double> d(3 * points(), 0.0);
  for (std::size_t n = 0; n < points(); ++n)
    for (auto k = static_cast<std::size_t>(row_begin[n]); k < static_cast<std::size_t>(row_begin[n + 1]); ++k)
      for (std::size_t i = 0; i < 3 && at(column[k]) == n; ++i)
        d[3 * n + i] = single.empty() ? value[9 * k + 4 * i] : static_cast<double>(single[9 * k + 4 * i]);
  return d;
}

void PointGraph::couple(std::span<const Index> points) {
  couple(points, points);
}

void PointGraph::couple(std::span<const Index> rows, std::span<const Index> columns) {
  for (const Index I : rows)
    for (const Index J : columns) {
      std::vector<Index>& row = neighbours_[at(I)];
      const auto place = std::lower_bound(row.begin(), row.end(), J);
      if (place == row.end() || *place != J) row.insert(place, J);
    }
}

BlockMatrix sum(const BlockMatrix& A, const BlockMatrix& B) {
  PointGraph graph(A.points());
  for (const BlockMatrix* M : {&A, &B})
    for_each_block(*M, [&](Index n, Index m, const double*) { graph.couple({&n, 1}, {&m, 1}); });
  BlockMatrix out = graph.matrix();
  for (const BlockMatrix* M : {&A, &B})
    for_each_block(*M, [&](Index n, Index m, const double* a) {
      double* b = out.block(n, m);
      for (std::size_t c = 0; c < 9; ++c) b[c] += a[c];
    });
  return out;
}

CsrMatrix by_unknowns(const BlockMatrix& A) {
  CsrMatrix out;
  out.size = static_cast<Index>(3 * A.points());
  out.row_begin.push_back(0);
  for (std::size_t n = 0; n < A.points(); ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      for (auto k = static_cast<std::size_t>(A.row_begin[n]); k < static_cast<std::size_t>(A.row_begin[n + 1]); ++k)
        for (std::size_t j = 0; j < 3; ++j) {
          out.column.push_back(3 * A.column[k] + static_cast<Index>(j));
          out.value.push_back(A.value[9 * k + 3 * i + j]);
        }
      out.row_begin.push_back(static_cast<std::int64_t>(out.column.size()));
    }
  return out;
}

BlockMatrix by_points(const CsrMatrix& A) {
  BlockMatrix out;
  for (std::size_t n = 0; 3 * n < at(A.size); ++n) {
    const auto first = static_cast<std::size_t>(A.row_begin[3 * n]);
    const std::size_t length = static_cast<std::size_t>(A.row_begin[3 * n + 1]) - first;
    for (std::size_t k = 0; k < length; k += 3) {
      out.column.push_back(A.column[first + k] / 3);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out.value.push_back(A.value[first + i * length + k + j]);
    }
    out.row_begin.push_back(static_cast<std::int64_t>(out.column.size()));
  }
  return out;
}

void Interpolation::add_point(std::span<const Index> coarse, std::span<const double> weights) {
  coarse_.insert(coarse_.end(), coarse.begin(), coarse.end());
  weight_.insert(weight_.end(), weights.begin(), weights.end());
  begin_.push_back(static_cast<std::int64_t>(coarse_.size()));
}

void Interpolation::finish(std::size_t coarse_points) {
  to_begin_.assign(coarse_points + 1, 0);
  for (const Index c : coarse_) ++to_begin_[at(c) + 1];
  for (std::size_t c = 0; c < coarse_points; ++c) to_begin_[c + 1] += to_begin_[c];
  fine_.resize(coarse_.size());
  to_weight_.resize(coarse_.size());
  std::vector<std::int64_t> next(to_begin_.begin(), to_begin_.end() - 1);
  for (std::size_t n = 0; n < fine_points(); ++n)
    for (std::int64_t k = begin_[n]; k < begin_[n + 1]; ++k) {
      const auto place = static_cast<std::size_t>(next[at(coarse_[static_cast<std::size_t>(k)])]++);
      fine_[place] = static_cast<Index>(n);
      to_weight_[place] = weight_[static_cast<std::size_t>(k)];
    }
}

void Interpolation::apply(std::span<const double> X, std::span<double> x, EntryRange range) const {
  each_point(range, [&](std::size_t n) {
    double sum[3] = {};
    for (auto k = static_cast<std::size_t>(begin_[n]); k < static_cast<std::size_t>(begin_[n + 1]); ++k)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += weight_[k] * X[3 * at(coarse_[k]) + i];
    for (std::size_t i = 0; i < 3; ++i) x[3 * n + i] = sum[i];
  });
}

void Interpolation::restrict_to(std::span<const double> r, std::span<double> R, EntryRange range) const {
  each_point(range, [&](std::size_t c) {
    double sum[3] = {};
    for (auto k = static_cast<std::size_t>(to_begin_[c]); k < static_cast<std::size_t>(to_begin_[c + 1]); ++k)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += to_weight_[k] * r[3 * at(fine_[k]) + i];
    for (std::size_t i = 0; i < 3; ++i) R[3 * c + i] = sum[i];
  });
}

void galerkin(const BlockMatrix& A, const Interpolation& P, BlockMatrix& out) {
  if (out.column.empty()) {
    PointGraph graph(P.coarse_points());
    for_each_block(A, [&](Index n, Index m, const double*) { graph.couple(P.coarse_of(at(n)), P.coarse_of(at(m))); });
    out = graph.matrix();
  }
  out.value.assign(9 * out.column.size(), 0.0);
  out.single.clear();
  for_each_block(A, [&](Index n, Index m, const double* a) {
    const auto I = P.coarse_of(at(n)), J = P.coarse_of(at(m));
    const auto w = P.weights_of(at(n)), v = P.weights_of(at(m));
    for (std::size_t p = 0; p < I.size(); ++p)
      for (std::size_t q = 0; q < J.size(); ++q) {
        double* b = out.block(I[p], J[q]);
        for (std::size_t c = 0; c < 9; ++c) b[c] += w[p] * v[q] * a[c];
      }
  });
}

}  // namespace carom
