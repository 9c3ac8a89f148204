#include "enforcement/node_compliance.hpp"

#include <algorithm>

namespace carom {

namespace {

std::size_t first_entry(const ConstraintRows& rows, std::size_t r) {
  return static_cast<std::size_t>(rows.begin[r]);
}

}  // namespace

void NodeCompliance::forget() {
  growth_ = {};
  place_.clear();
  of_dofs_.forget();
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
  if (growth_.entries.size() + missing.size() > capacity_) return false;
  add(missing, dof_count, inverse);
  return true;
}

bool NodeCompliance::grow_as(const Growth& growth, std::size_t dof_count, const InverseOperator& inverse) {
  const std::size_t calls = calls_in_common(growth_, growth);
  if (calls == growth_.calls.size() && calls == growth.calls.size()) return false;
  for (std::size_t k = calls; k < growth_.calls.size(); ++k)
    for (const Index n : entries_of_call(growth_, k)) place_[static_cast<std::size_t>(n)] = -1;
  cut_growth(growth_, calls);
  of_dofs_.cut(3 * growth_.entries.size());
  place_.resize(dof_count / 3, -1);
  for (std::size_t k = calls; k < growth.calls.size(); ++k) add(entries_of_call(growth, k), dof_count, inverse);
  return true;
}

void NodeCompliance::add(std::span<const Index> missing, std::size_t dof_count, const InverseOperator& inverse) {
  if (missing.empty()) return;
  std::size_t known = growth_.entries.size();
  add_call(growth_, missing);
  SparseColumns unit;
  for (const Index n : missing) {
    place_[static_cast<std::size_t>(n)] = static_cast<Index>(known++);
    for (Index i = 0; i < 3; ++i) {
      unit.add_entry(3 * n + i, 1.0);
      unit.end_column();
    }
  }
  of_dofs_.add(unit, dof_count, inverse);
}

// With the lower triangle C' of C, its diagonal halved, W = V + V^T, V = G C' G^T: line by line of C'.
Delassus NodeCompliance::compliance(const ConstraintRows& rows, std::span<const std::size_t> chosen,
                                    std::span<const std::size_t> components) const {
  struct Entry {
    std::size_t dof;  ///< by place
    std::size_t at;   ///< component of a row
    double g;
  };
  Delassus W = Delassus::dense(chosen, components);
  const std::size_t n = chosen.size(), dofs = of_dofs_.size();
  std::vector<std::size_t> first(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) first[i + 1] = first[i] + components[i];
  const std::size_t size = first[n];
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = first_entry(rows, chosen[i]); k < first_entry(rows, chosen[i] + 1); ++k) {
      const auto a = static_cast<std::size_t>(place_[static_cast<std::size_t>(rows.node[k])]);
      for (std::size_t c = 0; c < components[i]; ++c) {
        for (std::size_t d = 0; d < 3; ++d) {
          if (rows.block[k][c][d] != 0.0) entries.push_back({3 * a + d, first[i] + c, rows.block[k][c][d]});
        }
      }
    }
  }
  std::ranges::stable_sort(entries, {}, &Entry::dof);
  std::vector<std::size_t> begin(dofs + 1, 0);
  for (const Entry& e : entries) ++begin[e.dof + 1];
  for (std::size_t i = 0; i < dofs; ++i) begin[i + 1] += begin[i];
  std::vector<double> V(size * size, 0.0), answer(size);
  for (std::size_t dof = 0; dof < dofs; ++dof) {
    if (begin[dof] == begin[dof + 1]) continue;
    const Compliance::Line& line = of_dofs_.line(dof);
    std::fill(answer.begin(), answer.end(), 0.0);
    for (std::size_t k = begin[line.first]; k < begin[dof]; ++k)
      answer[entries[k].at] += entries[k].g * line.value[entries[k].dof - line.first];
    for (std::size_t k = begin[dof]; k < begin[dof + 1]; ++k)
      answer[entries[k].at] += 0.5 * entries[k].g * line.value.back();
    for (std::size_t k = begin[dof]; k < begin[dof + 1]; ++k) {
      double* to = V.data() + entries[k].at * size;
      for (std::size_t j = 0; j < size; ++j) to[j] += entries[k].g * answer[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      FrameBlock sum{};
      for (std::size_t a = 0; a < components[i]; ++a) {
        for (std::size_t b = 0; b < components[j]; ++b) {
          const std::size_t p = first[i] + a, q = first[j] + b;
          sum[3 * a + b] = V[p * size + q] + V[q * size + p];
        }
      }
      W.add(i * n + j, sum);
    }
  }
  return W;
}

void NodeCompliance::add_motion(std::span<const double> f, std::span<double> y) const {
  std::vector<double> force, motion(of_dofs_.size(), 0.0);
  for (const Index n : growth_.entries)
    for (std::size_t d = 0; d < 3; ++d) force.push_back(f[3 * static_cast<std::size_t>(n) + d]);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Compliance::Line& line = of_dofs_.line(i);
    const std::size_t below = line.value.size() - 1;
    const double* c = line.value.data();
    const double *f_j = force.data() + line.first, f_i = force[i];
    double* y_j = motion.data() + line.first;
    double sum = c[below] * f_i;
    for (std::size_t j = 0; j < below; ++j) sum += c[j] * f_j[j];
    if (f_i != 0.0)
      for (std::size_t j = 0; j < below; ++j) y_j[j] += f_i * c[j];
    motion[i] += sum;
  }
  for (std::size_t i = 0; i < motion.size(); ++i)
    y[3 * static_cast<std::size_t>(growth_.entries[i / 3]) + i % 3] += motion[i];
}

}  // namespace carom
