#include "rows/compliance.hpp"

#include "parallel/threads.hpp"

namespace carom {

void Compliance::cut(std::size_t count) {
  line_.resize(std::min(count, line_.size()));
  std::erase_if(panels_, [count](const HalfPanel& p) { return p.column.front() >= count; });
  if (columns_.size() <= count) return;
  columns_.row.resize(columns_.begin[count]);
  columns_.value.resize(columns_.begin[count]);
  columns_.begin.resize(count + 1);
}

void Compliance::add(const SparseColumns& B, std::size_t dof_count, const InverseOperator& inverse, const Seen& seen) {
  if (inverse.half)
    add_halves(B, inverse);
  else
    add_solutions(B, dof_count, inverse, seen);
}

std::size_t Compliance::entries() const {
  std::size_t sum = columns_.value.size();
  for (const Line& line : line_) sum += line.value.size();
  for (const HalfPanel& panel : panels_) sum += panel.value.size();
  return sum;
}

void Compliance::add_halves(const SparseColumns& B, const InverseOperator& inverse) {
  const std::size_t before = line_.size(), old_panels = panels_.size();
  for (HalfPanel& panel : inverse.half(B)) {
    for (std::size_t& c : panel.column) c += before;
    panels_.push_back(std::move(panel));
  }
  const std::size_t size = before + B.size(), fresh = panels_.size() - old_panels;
  // Rows of C at the columns of each new panel, full length.
  std::vector<std::vector<double>> rows(fresh);
  parallel_for(fresh, 1, [&](std::size_t k, std::size_t) {
    const HalfPanel& panel = panels_[old_panels + k];
    const std::size_t width = panel.column.size();
    rows[k].assign(width * size, 0.0);
    std::vector<double> block;
    for (std::size_t q = 0; q <= old_panels + k; ++q) {
      const HalfPanel& other = panels_[q];
      block.assign(width * other.column.size(), 0.0);
      add_product(panel, other, other.column.size(), block);
      for (std::size_t i = 0; i < width; ++i)
        for (std::size_t j = 0; j < other.column.size(); ++j)
          rows[k][i * size + other.column[j]] = block[i * other.column.size() + j];
    }
  });
  line_.resize(size);
  std::vector<const double*> row_of(B.size(), nullptr);
  std::vector<std::size_t> panel_of(B.size(), 0);
  for (std::size_t k = 0; k < fresh; ++k) {
    const std::vector<std::size_t>& column = panels_[old_panels + k].column;
    for (std::size_t i = 0; i < column.size(); ++i) {
      row_of[column[i] - before] = rows[k].data() + i * size;
      panel_of[column[i] - before] = k;
    }
  }
  parallel_for(B.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Line& line = line_[before + i];
      line.first = before + i;
      if (row_of[i] == nullptr) {  // on fixed dofs alone
        line.value.assign(1, 0.0);
        continue;
      }
      const auto entry = [&](std::size_t j) {
        if (j < before || row_of[j - before] == nullptr || panel_of[j - before] <= panel_of[i]) return row_of[i][j];
        return row_of[j - before][before + i];
      };
      std::size_t first = 0;
      while (first < before + i && entry(first) == 0.0) ++first;
      line.first = first;
      line.value.reserve(before + i - first + 1);
      for (std::size_t j = first; j <= before + i; ++j) line.value.push_back(entry(j));
    }
  });
}

void Compliance::add_solutions(const SparseColumns& B, std::size_t dof_count, const InverseOperator& inverse,
                               const Seen& seen) {
  constexpr std::size_t most = 32;  // columns per call: enough for the matrix-matrix kernels of the solver
  for (std::size_t first = 0; first < B.size(); first += most) {
    const std::size_t count = std::min(most, B.size() - first), before = line_.size();
    std::vector<double> block(count * dof_count, 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t e = B.begin[first + k]; e < B.begin[first + k + 1]; ++e) {
        columns_.add_entry(B.row[e], B.value[e]);
        block[k * dof_count + static_cast<std::size_t>(B.row[e])] += B.value[e];
      }
      columns_.end_column();
    }
    inverse.solve(block, static_cast<int>(count));
    line_.resize(before + count);
    parallel_for(count, 1, [&](std::size_t k, std::size_t) {
      std::vector<double>& value = line_[before + k].value;
      for (std::size_t j = 0; j <= before + k; ++j) {
        double sum = 0.0;
        for (std::size_t e = columns_.begin[j]; e < columns_.begin[j + 1]; ++e)
          sum += columns_.value[e] * block[k * dof_count + static_cast<std::size_t>(columns_.row[e])];
        value.push_back(sum);
      }
    });
    if (seen) seen(before, block);
  }
}

}  // namespace carom
