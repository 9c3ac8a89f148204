#include "system/row_compliance.hpp"

#include <algorithm>
#include <utility>

#include "parallel/threads.hpp"

namespace carom {

void RowCompliance::use(const std::shared_ptr<const ConstraintRows>& rows) {
  if (rows == rows_) return;
  rows_ = rows;
  growth_ = {};
  components_.clear();
  S_.forget();
  columns_.clear();
  known_.assign(3 * rows->size(), -1);
}

void RowCompliance::extend(std::span<const RowComponent> wanted, const InverseOperator& inverse) {
  std::vector<Index> missing;
  for (const RowComponent& rc : wanted)
    if (!knows(rc)) missing.push_back(static_cast<Index>(3 * rc.row + rc.component));
  add(missing, inverse);
}

bool RowCompliance::grow_as(const Growth& growth, const InverseOperator& inverse) {
  const std::size_t calls = calls_in_common(growth_, growth);
  if (calls == growth_.calls.size() && calls == growth.calls.size()) return false;
  cut(calls);
  for (std::size_t k = calls; k < growth.calls.size(); ++k) add(entries_of_call(growth, k), inverse);
  return true;
}

/// Keeps the first calls.
void RowCompliance::cut(std::size_t calls) {
  cut_growth(growth_, calls);
  const std::size_t count = growth_.entries.size();
  for (std::size_t k = count; k < components_.size(); ++k)
    known_[3 * components_[k].row + components_[k].component] = -1;
  components_.resize(count);
  S_.cut(count);
  if (columns_.size() > count * dof_count_) columns_.resize(count * dof_count_);
}

void RowCompliance::add(std::span<const Index> missing, const InverseOperator& inverse) {
  if (missing.empty()) return;
  add_call(growth_, missing);
  const ConstraintRows& rows = *rows_;
  SparseColumns B;
  for (const Index i : missing) {
    const auto row = static_cast<std::size_t>(i) / 3, c = static_cast<std::size_t>(i) % 3;
    known_[static_cast<std::size_t>(i)] = static_cast<int>(components_.size());
    components_.push_back({row, c});
    add_components(rows, row, c, c + 1, B);
  }
  S_.add(B, dof_count_, inverse, [this](std::size_t first, std::span<const double> block) {
    const bool keep = columns_.size() == first * dof_count_ && columns_.size() + block.size() <= column_entries_;
    if (keep) columns_.insert(columns_.end(), block.begin(), block.end());
  });
}

double RowCompliance::operator()(const RowComponent& a, const RowComponent& b) const {
  const auto i = static_cast<std::size_t>(known_[3 * a.row + a.component]);
  const auto j = static_cast<std::size_t>(known_[3 * b.row + b.component]);
  return S_(i, j);
}

Delassus RowCompliance::compliance(std::span<const std::size_t> rows, std::span<const std::size_t> counts,
                                   const InverseOperator& inverse) {
  Delassus W = Delassus::dense(rows, counts);
  std::vector<RowComponent> wanted;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < counts[i]; ++c) wanted.push_back({rows[i], c});
  extend(wanted, inverse);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows.size(); ++j) {
      FrameBlock block{};
      for (std::size_t a = 0; a < counts[i]; ++a)
        for (std::size_t b = 0; b < counts[j]; ++b) block[3 * a + b] = (*this)({rows[i], a}, {rows[j], b});
      W.add(i * rows.size() + j, block);
    }
  }
  return W;
}

void RowCompliance::add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force,
                                std::span<double> x) const {
  std::vector<std::pair<const double*, double>> terms;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (force[i][c] == 0.0) continue;
      const auto column = static_cast<std::size_t>(known_[3 * rows[i] + c]);
      terms.emplace_back(columns_.data() + column * dof_count_, force[i][c]);
    }
  }
  parallel_for(x.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (const auto& [column, f] : terms) {
      for (std::size_t i = begin; i < end; ++i) x[i] += f * column[i];
    }
  });
}

}  // namespace carom
