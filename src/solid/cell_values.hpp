// What the cells of the bodies have at a displacement: stresses, rotations, energies, what their points remember.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "math/voigt.hpp"
#include "solid/rotation.hpp"
#include "solid/solid.hpp"

namespace carom {

/// What a value of a cell is of those of its points.
enum class OverPoints : std::uint8_t { mean, largest };

/// Mean over the reference volume of the Cauchy stress of each cell: xx, yy, zz, xy, yz, zx. zz is the hoop stress of
/// axisymmetric cells; bars give the tensor of their axial stress, nodal cells the mean of their patches.
/// wanted: increasing, the cells that are asked for, others may have zeros; empty: all.
std::vector<std::array<double, 6>> cell_stress(const Solid& solid, std::span<const double> u,
                                               const PointStep& step = {}, std::span<const Index> wanted = {});
/// The largest measure of these stresses and its cell, the first of several.
std::pair<double, std::size_t> largest_stress(const Solid& solid, std::span<const double> u, const PointStep& step,
                                              double (*measure)(const Voigt& stress));
/// Mean over the reference volume, or largest, of a history variable of the points of each cell (Law::history), from
/// the history of all points; 0 in cells of laws without it. Empty when no law of the bodies has it.
std::vector<double> cell_history(const Solid& solid, std::string_view variable, std::span<const double> history,
                                 OverPoints over = OverPoints::mean);

/// Mass of each cell.
std::vector<double> cell_masses(const Solid& solid);
/// u.K_e u / 2 of a cell at rest, u the displacements of its nodes (not of nodal parts, whose cells have no K_e).
double energy_at_rest(const Solid& solid, std::size_t cell, std::span<const Vec3> u);
/// The integral of f^2 over the reference volume of a cell, f the values at its nodes.
double square_integral(const Solid& solid, std::size_t cell, std::span<const double> f);
/// The strain energy of Solid::evaluate for points at rest before; allocates.
double strain_energy(const Solid& solid, std::span<const double> u);
/// True when cells have hourglass modes, whose energy u.F / 2 alone does not tell from that of strain.
bool has_hourglass(const Solid& solid);

/// Largest rotation of a small-strain cell that is there: the angle of R in its mean F = R U, bars: the angle by which
/// the axis turns; pi for a cell turned inside out. Small strain makes an error of order angle^2. Threaded, cheap
/// enough to be called every few steps.
Rotation largest_rotation(const Solid& solid, std::span<const double> u, std::span<const std::uint8_t> alive = {});
/// The first cell that is there whose forces are no numbers at u: at finite positions one that is turned inside out
/// (det F <= 0 at a quadrature point of finite strain). -1: none. One cell after the other.
Index first_inverted_cell(const Solid& solid, std::span<const double> u, std::span<const std::uint8_t> alive = {});

}  // namespace carom
