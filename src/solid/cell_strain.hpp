// Strains of the cells and their rates, for output.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// Mean over the reference volume of the strain of each solid cell, in the order of Solid::cells() (part after part):
/// xx, yy, zz, xy, yz, zx as tensor components (xy is half the shear angle). Small-strain parts: sym(grad u), the
/// others Green-Lagrange's (F^T F - 1) / 2. zz is the hoop strain of axisymmetric cells; of plane stress it is not
/// computed and zero, and bars give the tensor of their axial strain alone.
std::vector<std::array<double, 6>> cell_strain(const Model& model, std::span<const double> u);

/// The same of the rate of strain: the symmetric gradient of the velocity v where the cells are at u, of small-strain
/// parts in the reference configuration. Zero of a body that turns.
std::vector<std::array<double, 6>> cell_strain_rate(const Model& model, std::span<const double> u,
                                                    std::span<const double> v);

/// By what length a cell of the part is shorter at u than in the reference position, of its mean F, between planes
/// whose normal at u is n: (1 - |F^T n|) times its reference length (cell_length). Negative where it is longer.
double cell_shortening(const Mesh& mesh, const Part& part, Index cell, const Vec3& n, std::span<const double> u);

}  // namespace carom
