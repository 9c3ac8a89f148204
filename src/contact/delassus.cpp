#include "contact/delassus.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "contact/admissible.hpp"
#include "contact/compliance.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

/// Number of components of a row that take part.
std::size_t components(const ConstraintRows& rows, std::size_t row) {
  return components(rows.law[row]);
}

/// One appearance of a node in a row.
struct NodeUse {
  Index node;
  std::size_t i;  ///< row of W
  std::size_t k;  ///< entry of ConstraintRows::block
};

/// All appearances, sorted by node, then row.
std::vector<NodeUse> uses_by_node(const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
  std::vector<NodeUse> uses;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto end = static_cast<std::size_t>(rows.begin[chosen[i] + 1]);
    for (auto k = static_cast<std::size_t>(rows.begin[chosen[i]]); k < end; ++k) uses.push_back({rows.node[k], i, k});
  }
  std::ranges::stable_sort(uses, {}, &NodeUse::node);
  return uses;
}

/// block += B_i diag(inverse) B_j^T for the first m_i and m_j components
void add_product(const RowBlock& B_i, const double* inverse, const RowBlock& B_j, std::size_t m_i, std::size_t m_j,
                 FrameBlock& block) {
  for (std::size_t a = 0; a < m_i; ++a) {
    const Vec3 scaled_row{B_i[a][0] * inverse[0], B_i[a][1] * inverse[1], B_i[a][2] * inverse[2]};
    for (std::size_t b = 0; b < m_j; ++b) block[3 * a + b] += dot(scaled_row, B_j[b]);
  }
}

}  // namespace

void Delassus::apply(std::span<const Vec3> r, std::span<Vec3> w) const {
  assert(r.size() == size() && w.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    Vec3 sum{};
    for (std::size_t k = begin[i]; k < begin[i + 1]; ++k) {
      const FrameBlock& B = block[k];
      const Vec3& s = r[column[k]];
      for (std::size_t a = 0; a < 3; ++a) sum[a] += B[3 * a] * s[0] + B[3 * a + 1] * s[1] + B[3 * a + 2] * s[2];
    }
    w[i] = sum;
  }
}

void add_components(const ConstraintRows& rows, std::size_t row, std::size_t first, std::size_t last,
                    SparseColumns& G) {
  for (std::size_t c = first; c < last; ++c) {
    for (auto k = static_cast<std::size_t>(rows.begin[row]); k < static_cast<std::size_t>(rows.begin[row + 1]); ++k) {
      for (Index d = 0; d < 3; ++d) G.add_entry(3 * rows.node[k] + d, rows.block[k][c][static_cast<std::size_t>(d)]);
    }
    G.end_column();
  }
}

Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen, std::size_t dof_count,
                       const InverseOperator& inverse) {
  Delassus W;
  W.rows = std::move(chosen);
  const std::size_t n = W.size();
  SparseColumns G;
  std::vector<std::size_t> first;
  for (const std::size_t row : W.rows) {
    first.push_back(G.size());
    add_components(rows, row, 0, components(rows, row), G);
  }
  Compliance C;
  C.add(G, dof_count, inverse);
  W.block.assign(n * n, FrameBlock{});
  for (std::size_t i = 0; i <= n; ++i) W.begin.push_back(i * n);
  for (std::size_t k = 0; k < n * n; ++k) {
    const std::size_t i = k / n, j = k % n;
    W.column.push_back(j);
    for (std::size_t a = 0; a < components(rows, W.rows[i]); ++a)
      for (std::size_t b = 0; b < components(rows, W.rows[j]); ++b)
        W.block[k][3 * a + b] = C(first[i] + a, first[j] + b);
  }
  return W;
}

Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen,
                       std::span<const double> inverse_diagonal) {
  Delassus W;
  W.rows = std::move(chosen);
  const std::size_t n = W.size();
  const std::vector<NodeUse> uses = uses_by_node(rows, W.rows);
  W.begin.push_back(0);
  std::vector<std::size_t> entry(n), seen_by(n, n);  // entry of column j in row i, once seen_by[j] == i
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < n; ++i) {
    const auto begin = static_cast<std::size_t>(rows.begin[W.rows[i]]);
    const auto end = static_cast<std::size_t>(rows.begin[W.rows[i] + 1]);
    columns.assign(1, i);
    seen_by[i] = i;
    const auto each_partner = [&](auto&& visit) {
      for (std::size_t k = begin; k < end; ++k) {
        const Index node = rows.node[k];
        auto use = std::lower_bound(uses.begin(), uses.end(), node,
                                    [](const NodeUse& u, Index wanted) { return u.node < wanted; });
        for (; use != uses.end() && use->node == node; ++use) visit(k, *use);
      }
    };
    each_partner([&](std::size_t, const NodeUse& use) {
      if (seen_by[use.i] == i) return;
      seen_by[use.i] = i;
      columns.push_back(use.i);
    });
    std::ranges::sort(columns);
    for (const std::size_t j : columns) {
      entry[j] = W.column.size();
      W.column.push_back(j);
      W.block.emplace_back();
    }
    each_partner([&](std::size_t k, const NodeUse& use) {
      const double* inverse = inverse_diagonal.data() + 3 * static_cast<std::size_t>(use.node);
      add_product(rows.block[k], inverse, rows.block[use.k], components(rows, W.rows[i]),
                  components(rows, W.rows[use.i]), W.block[entry[use.i]]);
    });
    W.begin.push_back(W.column.size());
  }
  return W;
}

}  // namespace carom
