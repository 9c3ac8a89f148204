#include "linalg/reused_factors.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "linalg/gmres.hpp"

namespace carom {

namespace {

/// Iterations that cost about as much as a factorisation with its matrix (measured: n = 400 and 1,200).
constexpr int most_iterations = 30;
/// Unknowns below which a factorisation is cheaper than one iteration's overhead.
constexpr std::size_t least_size = 64;

}  // namespace

bool ReusedFactors::solve(std::span<const std::size_t> unknowns, const LinearOperator& A, std::span<const double> b,
                          std::span<double> x, double relative) const {
  if (std::holds_alternative<std::monostate>(factors_) || unknowns.size() < least_size) return false;
  std::vector<std::pair<std::size_t, std::size_t>> common;  // places in b and in the factors
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto known = place_.find(unknowns[i]);
    if (known != place_.end()) common.emplace_back(i, known->second);
  }
  const std::size_t others = unknowns.size() + place_.size() - 2 * common.size();
  if (others > most_iterations - 4) return false;
  std::vector<double> known(place_.size());
  const auto precondition = [&](std::span<double> v) {
    std::fill(known.begin(), known.end(), 0.0);
    for (const auto& [i, k] : common) known[k] = v[i];
    substitute(known);
    for (const auto& [i, k] : common) v[i] = known[k];
  };
  return gmres(A, precondition, b, x, relative, most_iterations);
}

void ReusedFactors::substitute(std::span<double> b) const {
  if (const auto* dense = std::get_if<DenseLu>(&factors_)) dense->solve(b);
  if (const auto* sparse = std::get_if<SparseLu>(&factors_)) sparse->solve(b);
}

template <class Factors, class... Matrix>
bool ReusedFactors::make(std::span<const std::size_t> unknowns, std::span<const double> b, std::span<double> x,
                         Matrix&&... matrix) {
  forget();
  try {
    factors_.template emplace<Factors>(std::forward<Matrix>(matrix)...);
  } catch (const std::runtime_error&) {
    forget();
    return false;
  }
  place_.clear();
  for (std::size_t i = 0; i < unknowns.size(); ++i) place_.emplace(unknowns[i], i);
  std::copy(b.begin(), b.end(), x.begin());
  substitute(x);
  return true;
}

bool ReusedFactors::factor(std::span<const std::size_t> unknowns, std::vector<double> a, std::span<const double> b,
                           std::span<double> x) {
  return make<DenseLu>(unknowns, b, x, std::move(a), static_cast<int>(b.size()));
}

bool ReusedFactors::factor(std::span<const std::size_t> unknowns, const CsrMatrix& a, const std::vector<Index>& order,
                           std::span<const double> b, std::span<double> x) {
  return make<SparseLu>(unknowns, b, x, a, order);
}

}  // namespace carom
