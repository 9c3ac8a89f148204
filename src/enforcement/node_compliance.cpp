#include "enforcement/node_compliance.hpp"

#include <algorithm>

namespace carom {

namespace {

/// Row r of the frame block B times the 3 x 3 matrix M, and M times its transpose.
FrameBlock times_transpose(const FrameBlock& M, const RowBlock& B) {
  FrameBlock out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      out[3 * i + c] = M[3 * i] * B[c][0] + M[3 * i + 1] * B[c][1] + M[3 * i + 2] * B[c][2];
    }
  }
  return out;
}

/// W += B T
void add_product(const RowBlock& B, const FrameBlock& T, FrameBlock& W) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t c = 0; c < 3; ++c) W[3 * a + c] += B[a][0] * T[c] + B[a][1] * T[3 + c] + B[a][2] * T[6 + c];
  }
}

std::size_t first_entry(const ConstraintRows& rows, std::size_t r) {
  return static_cast<std::size_t>(rows.begin[r]);
}

}  // namespace

void NodeCompliance::forget() {
  growth_ = {};
  place_.clear();
  lower_.clear();
}

bool NodeCompliance::extend(const ConstraintRows& rows, std::span<const std::size_t> chosen, std::size_t dof_count,
                            const InverseOperator& inverse) {
  place_.resize(dof_count / 3, -1);
  std::vector<Index> missing;
  for (const std::size_t r : chosen) {
    for (std::size_t k = first_entry(rows, r); k < first_entry(rows, r + 1); ++k) {
      if (place_[static_cast<std::size_t>(rows.node[k])] < 0) missing.push_back(rows.node[k]);
    }
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  if (growth_.entries.size() + missing.size() > most_nodes_) return false;
  add(missing, dof_count, inverse);
  return true;
}

bool NodeCompliance::grow_as(const Growth& growth, std::size_t dof_count, const InverseOperator& inverse) {
  const std::size_t calls = calls_in_common(growth_, growth);
  if (calls == growth_.calls.size() && calls == growth.calls.size()) return false;
  for (std::size_t k = calls; k < growth_.calls.size(); ++k)
    for (const Index n : entries_of_call(growth_, k)) place_[static_cast<std::size_t>(n)] = -1;
  cut_growth(growth_, calls);
  lower_.resize(3 * growth_.entries.size());
  place_.resize(dof_count / 3, -1);
  for (std::size_t k = calls; k < growth.calls.size(); ++k) add(entries_of_call(growth, k), dof_count, inverse);
  return true;
}

void NodeCompliance::add(std::span<const Index> missing, std::size_t dof_count, const InverseOperator& inverse) {
  if (missing.empty()) return;
  std::size_t known = growth_.entries.size();
  add_call(growth_, missing);
  constexpr std::size_t most = 10;  // nodes per call: 30 columns, enough for matrix-matrix kernels
  for (std::size_t first = 0; first < missing.size(); first += most) {
    const std::size_t count = std::min(most, missing.size() - first);
    std::vector<double> columns(3 * count * dof_count, 0.0);
    for (std::size_t k = 0; k < 3 * count; ++k) {
      columns[k * dof_count + 3 * static_cast<std::size_t>(missing[first + k / 3]) + k % 3] = 1.0;
    }
    inverse(columns, static_cast<int>(3 * count));
    for (std::size_t k = 0; k < 3 * count; ++k) {
      if (k % 3 == 0) {
        place_[static_cast<std::size_t>(missing[first + k / 3])] = static_cast<Index>(known++);
      }
      std::vector<double>& line = lower_.emplace_back();
      line.reserve(3 * known);
      for (const Index n : std::span(growth_.entries).first(known)) {
        const double* at_node = &columns[k * dof_count + 3 * static_cast<std::size_t>(n)];
        line.insert(line.end(), at_node, at_node + 3);
      }
    }
  }
}

/// C(a, b) for places a and b.
FrameBlock NodeCompliance::block(std::size_t a, std::size_t b) const {
  FrameBlock out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      out[3 * i + j] = a >= b ? lower_[3 * a + i][3 * b + j] : lower_[3 * b + j][3 * a + i];
  }
  return out;
}

std::vector<FrameBlock> NodeCompliance::compliance(const ConstraintRows& rows, std::span<const std::size_t> chosen,
                                                   std::span<const std::size_t> components) const {
  const std::size_t n = chosen.size();
  std::vector<FrameBlock> W(n * n, FrameBlock{}), answer(growth_.entries.size());
  for (std::size_t j = 0; j < n; ++j) {
    // answer = C G_j^T at the nodes of the rows from j on
    std::fill(answer.begin(), answer.end(), FrameBlock{});
    std::vector<bool> is_made(growth_.entries.size(), false);
    for (std::size_t i = j; i < n; ++i) {
      FrameBlock& entry = W[i * n + j];
      for (std::size_t k = first_entry(rows, chosen[i]); k < first_entry(rows, chosen[i] + 1); ++k) {
        const auto a = static_cast<std::size_t>(place_[static_cast<std::size_t>(rows.node[k])]);
        if (!is_made[a]) {
          is_made[a] = true;
          for (std::size_t m = first_entry(rows, chosen[j]); m < first_entry(rows, chosen[j] + 1); ++m) {
            const auto b = static_cast<std::size_t>(place_[static_cast<std::size_t>(rows.node[m])]);
            const FrameBlock part = times_transpose(block(a, b), rows.block[m]);
            for (std::size_t e = 0; e < 9; ++e) answer[a][e] += part[e];
          }
        }
        add_product(rows.block[k], answer[a], entry);
      }
      for (std::size_t e = 0; e < 9; ++e) {
        if (e / 3 >= components[i] || e % 3 >= components[j]) entry[e] = 0.0;
      }
      for (std::size_t e = 0; e < 9; ++e) W[j * n + i][3 * (e % 3) + e / 3] = entry[e];
    }
  }
  return W;
}

}  // namespace carom
