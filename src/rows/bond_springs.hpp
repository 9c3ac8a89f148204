// Bonds as springs, where a scheme has springs for contact.
#pragma once

#include <span>

#include "rows/admissible.hpp"
#include "rows/response.hpp"

namespace carom {

/// The spring of a bond: force -eps_N w against the way w that its sides have parted, the same in all directions, so
/// that it acts along w and leaves no moment. It neither opens nor hardens. Its energy 1/2 eps_N |w|^2 feeds
/// contact_stored.
double bond_energy(const RowLaw& law, const Vec3& w);
RowTangent bond_tangent(double stiffness);

/// Adds to a response that lacks bonds their forces at displacement x and the energy that they store.
void add_bond_springs(std::span<const double> x, ContactResponse& response);

}  // namespace carom
