#include "flops.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/types.hpp"

namespace carom {
namespace {

std::size_t operations = 0;

/// A double that counts what is done with it.
struct Counted {
  double value;
};

Counted counted(double value) {
  ++operations;
  return {value};
}
Counted operator+(Counted a, Counted b) {
  return counted(a.value + b.value);
}
Counted operator+(Counted a, double b) {
  return counted(a.value + b);
}
Counted operator+(double a, Counted b) {
  return counted(a + b.value);
}
Counted operator-(Counted a, Counted b) {
  return counted(a.value - b.value);
}
Counted operator-(Counted a, double b) {
  return counted(a.value - b);
}
Counted operator-(double a, Counted b) {
  return counted(a - b.value);
}
Counted operator*(Counted a, Counted b) {
  return counted(a.value * b.value);
}
Counted operator*(Counted a, double b) {
  return counted(a.value * b);
}
Counted operator*(double a, Counted b) {
  return counted(a * b.value);
}
Counted operator/(Counted a, Counted b) {
  return counted(a.value / b.value);
}
Counted operator/(Counted a, double b) {
  return counted(a.value / b);
}
Counted operator/(double a, Counted b) {
  return counted(a / b.value);
}
Counted operator-(Counted a) {
  return {-a.value};
}
template <class Other>
Counted& operator+=(Counted& a, Other b) {
  return a = a + b;
}
template <class Other>
Counted& operator-=(Counted& a, Other b) {
  return a = a - b;
}
template <class Other>
Counted& operator*=(Counted& a, Other b) {
  return a = a * b;
}
template <class Other>
Counted& operator/=(Counted& a, Other b) {
  return a = a / b;
}
bool operator<=(Counted a, double b) {
  return a.value <= b;
}
bool operator<(Counted a, double b) {
  return a.value < b;
}
bool operator>(Counted a, double b) {
  return a.value > b;
}
bool operator<(Counted a, Counted b) {
  return a.value < b.value;
}
bool operator>(Counted a, Counted b) {
  return a.value > b.value;
}
Counted square_root(const Counted& a) {
  return counted(std::sqrt(a.value));
}

void gather_node(const double* values, const Index* offset, Counted node[3]) {
  for (int i = 0; i < 3; ++i) node[i].value = values[offset[0] + i];
}
void scatter_node(Counted x, Counted y, Counted z, const Index* offset, double* f) {
  const Counted force[] = {x, y, z};
  for (int i = 0; i < 3; ++i) f[offset[0] + i] = (f[offset[0] + i] + force[i]).value;
}

}  // namespace
}  // namespace carom

#include "kernels/kernel_table.hpp"
#include "solid/blocks.hpp"

namespace carom {

double flops_per_cell(const Model& model, const std::vector<double>& u, Sweep sweep) {
  static constexpr KernelTable table = make_kernels<Counted>();
  static constexpr Index most_cells = 1000;
  const SolidCells solid = make_solid_cells(model, table);
  const std::vector<double> rest(solid.history_size(), 0.0);
  std::vector<double> end(rest), f(u.size(), 0.0);
  SolidEnergies energies;
  Index cells = 0;
  operations = 0;
  for (const Block& block : solid.blocks) {
    const Index count = std::min(block.cells, most_cells);
    const CellBatches batches = solid.batches(block, 0, count, {.dt = 1.0, .history = rest}, end);
    if (sweep == Sweep::force)
      block.kernels.add_internal_force(batches, block.law(), u.data(), f.data(), &energies);
    else
      block.kernels.add_tangent_action(batches, block.law(), u.data(), u.data(), f.data());
    cells += count;
  }
  return static_cast<double>(operations) / static_cast<double>(cells);
}

}  // namespace carom
