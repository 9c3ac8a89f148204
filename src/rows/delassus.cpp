#include "rows/delassus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "rows/compliance.hpp"

namespace carom {

namespace {

/// Number of components of a row that take part.
std::size_t components(const ConstraintRows& rows, std::size_t row) {
  return components(rows.law[row]);
}

/// One appearance of a node in a row.
struct NodeUse {
  std::size_t i;  ///< row of W
  std::size_t k;  ///< entry of ConstraintRows::block
};

/// All appearances by node, in the order of the rows.
struct NodeUses {
  NodeUses(const ConstraintRows& rows, const std::vector<std::size_t>& chosen, std::size_t nodes) : begin(nodes + 1) {
    const auto each = [&](const auto& visit) {
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const auto end = static_cast<std::size_t>(rows.begin[chosen[i] + 1]);
        for (auto k = static_cast<std::size_t>(rows.begin[chosen[i]]); k < end; ++k)
          visit(static_cast<std::size_t>(rows.node[k]), NodeUse{i, k});
      }
    };
    each([&](std::size_t node, const NodeUse&) { ++begin[node + 1]; });
    for (std::size_t n = 0; n < nodes; ++n) begin[n + 1] += begin[n];
    use.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    each([&](std::size_t node, const NodeUse& of_row) { use[next[node]++] = of_row; });
  }
  std::span<const NodeUse> of(Index node) const {
    const auto n = static_cast<std::size_t>(node);
    return std::span(use).subspan(begin[n], begin[n + 1] - begin[n]);
  }

  std::vector<std::size_t> begin;
  std::vector<NodeUse> use;
};

/// B_i diag(inverse) B_j^T for the first m_i and m_j components
FrameBlock product(const RowBlock& B_i, const double* inverse, const RowBlock& B_j, std::size_t m_i, std::size_t m_j) {
  FrameBlock block{};
  for (std::size_t a = 0; a < m_i; ++a) {
    const Vec3 scaled_row{B_i[a][0] * inverse[0], B_i[a][1] * inverse[1], B_i[a][2] * inverse[2]};
    for (std::size_t b = 0; b < m_j; ++b) block[3 * a + b] = dot(scaled_row, B_j[b]);
  }
  return block;
}

bool have_tangents(const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
  return std::ranges::any_of(chosen, [&](std::size_t r) { return components(rows, r) > 1; });
}

void resize_entries(Delassus& W, std::size_t count, bool has_tangents) {
  if (has_tangents)
    W.block.assign(count, FrameBlock{});
  else
    W.normal.assign(count, 0.0);
}

}  // namespace

std::size_t Delassus::most_rows(bool has_tangents) {
  const std::size_t entries = most_bytes / (has_tangents ? sizeof(FrameBlock) : sizeof(double));
  return static_cast<std::size_t>(std::sqrt(static_cast<double>(entries)));
}

void Delassus::admit_dense(std::size_t count, bool has_tangents) {
  if (count <= most_rows(has_tangents)) return;
  throw TooManyRows(fmt::format(
      "{} rows in contact at once, each of which acts on every other through the bodies: that is more than the {} that "
      "exact contact may have there, {:.2g} GB ({} without friction, {} with it). Choose enforcement = \"penalty\", or "
      "an explicit scheme with a lumped mass (kind = \"cd_lagrange\"), where rows act only on those that share nodes "
      "with them",
      count, most_rows(has_tangents), static_cast<double>(most_bytes) / 1e9, most_rows(false), most_rows(true)));
}

Delassus Delassus::dense(std::vector<std::size_t> rows, bool has_tangents) {
  admit_dense(rows.size(), has_tangents);
  Delassus W;
  resize_entries(W, rows.size() * rows.size(), has_tangents);
  W.rows = std::move(rows);
  return W;
}

Delassus Delassus::dense(std::span<const std::size_t> rows, std::span<const std::size_t> components) {
  return dense({rows.begin(), rows.end()},
               std::ranges::any_of(components, [](std::size_t count) { return count > 1; }));
}

std::size_t Delassus::own_entry(std::size_t i) const {
  if (begin.empty()) return i * size() + i;
  const auto row = column.begin() + static_cast<std::ptrdiff_t>(begin[i]);
  const auto end = column.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
  return static_cast<std::size_t>(std::lower_bound(row, end, i) - column.begin());
}

void Delassus::add(std::size_t entry, const FrameBlock& more) {
  if (block.empty())
    normal[entry] += more[0];
  else
    for (std::size_t e = 0; e < more.size(); ++e) block[entry][e] += more[e];
}

void Delassus::apply(std::span<const Vec3> r, std::span<Vec3> w) const {
  assert(r.size() == size() && w.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    Vec3 sum{};
    if (block.empty()) {
      each(i, [&](std::size_t j, std::size_t k) { sum[0] += normal[k] * r[j][0]; });
    } else {
      each(i, [&](std::size_t j, std::size_t k) {
        const FrameBlock& B = block[k];
        const Vec3& s = r[j];
        for (std::size_t a = 0; a < 3; ++a) sum[a] += B[3 * a] * s[0] + B[3 * a + 1] * s[1] + B[3 * a + 2] * s[2];
      });
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
  const bool has_tangents = have_tangents(rows, chosen);
  Delassus W = Delassus::dense(std::move(chosen), has_tangents);
  const std::size_t n = W.size();
  SparseColumns G;
  std::vector<std::size_t> first;
  for (const std::size_t row : W.rows) {
    first.push_back(G.size());
    add_components(rows, row, 0, components(rows, row), G);
  }
  Compliance C;
  C.add(G, dof_count, inverse);
  for (std::size_t k = 0; k < n * n; ++k) {
    const std::size_t i = k / n, j = k % n;
    if (!has_tangents) {
      W.normal[k] = C(first[i], first[j]);
      continue;
    }
    for (std::size_t a = 0; a < components(rows, W.rows[i]); ++a)
      for (std::size_t b = 0; b < components(rows, W.rows[j]); ++b)
        W.block[k][3 * a + b] = C(first[i] + a, first[j] + b);
  }
  return W;
}

namespace {

/// visit(entry of the row in ConstraintRows::block, appearance of the same node) for all nodes of a row.
template <class Visit>
void each_partner(const ConstraintRows& rows, std::size_t row, const NodeUses& uses, const Visit& visit) {
  const auto end = static_cast<std::size_t>(rows.begin[row + 1]);
  for (auto k = static_cast<std::size_t>(rows.begin[row]); k < end; ++k)
    for (const NodeUse& use : uses.of(rows.node[k])) visit(k, use);
}

/// For each row of W the rows that share a node with it, itself included, ascending.
std::vector<std::vector<std::size_t>> partners(const ConstraintRows& rows, const std::vector<std::size_t>& chosen,
                                               const NodeUses& uses) {
  std::vector<std::vector<std::size_t>> out(chosen.size());
  parallel_for(chosen.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<std::size_t>& of_row = out[i];
      of_row.push_back(i);
      each_partner(rows, chosen[i], uses, [&](std::size_t, const NodeUse& use) { of_row.push_back(use.i); });
      std::ranges::sort(of_row);
      of_row.erase(std::unique(of_row.begin(), of_row.end()), of_row.end());
    }
  });
  return out;
}

}  // namespace

Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen,
                       std::span<const double> inverse_diagonal) {
  Delassus W;
  W.rows = std::move(chosen);
  const NodeUses uses(rows, W.rows, inverse_diagonal.size() / 3);
  const std::vector<std::vector<std::size_t>> columns = partners(rows, W.rows, uses);
  W.begin.push_back(0);
  for (const std::vector<std::size_t>& of_row : columns) W.begin.push_back(W.begin.back() + of_row.size());
  W.column.resize(W.begin.back());
  resize_entries(W, W.begin.back(), have_tangents(rows, W.rows));
  parallel_for(W.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = W.column.begin() + static_cast<std::ptrdiff_t>(W.begin[i]);
      const auto last = std::ranges::copy(columns[i], first).out;
      const std::size_t of_row = components(rows, W.rows[i]);
      each_partner(rows, W.rows[i], uses, [&](std::size_t k, const NodeUse& use) {
        const auto entry = static_cast<std::size_t>(std::lower_bound(first, last, use.i) - W.column.begin());
        const double* inverse = inverse_diagonal.data() + 3 * static_cast<std::size_t>(rows.node[k]);
        W.add(entry, product(rows.block[k], inverse, rows.block[use.k], of_row, components(rows, W.rows[use.i])));
      });
    }
  });
  return W;
}

Delassus sum_of(const Delassus& W, const std::vector<std::size_t>& some, const Delassus& more) {
  Delassus out;
  out.rows = W.rows;
  out.names = W.names;
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(W.size(), none);  // of each row among some
  for (std::size_t p = 0; p < some.size(); ++p) place[some[p]] = p;
  std::vector<std::size_t> columns;
  out.begin.push_back(0);
  for (std::size_t i = 0; i < W.size(); ++i) {
    columns.clear();
    W.each(i, [&](std::size_t j, std::size_t) { columns.push_back(j); });
    if (place[i] == none)
      out.column.insert(out.column.end(), columns.begin(), columns.end());
    else
      std::ranges::set_union(columns, some, std::back_inserter(out.column));
    out.begin.push_back(out.column.size());
  }
  resize_entries(out, out.column.size(), W.normal.empty() || more.normal.empty());
  for (std::size_t i = 0; i < W.size(); ++i) {
    std::size_t k = W.first_entry(i);
    out.each(i, [&](std::size_t j, std::size_t entry) {
      if (k < W.end_entry(i) && W.column[k] == j) out.add(entry, W.block_at(k++));
      if (place[i] != none && place[j] != none) out.add(entry, more.block_at(place[i] * some.size() + place[j]));
    });
  }
  return out;
}

}  // namespace carom
