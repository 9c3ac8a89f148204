// The volume of a cell and its derivatives, over a number type: what bulk viscosity works on.
#pragma once

#include <algorithm>

#include "kernels/point_stages.hpp"
#include "kernels/stages.hpp"
#include "material/linear_elastic_update.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

namespace small_bulk {

/// J = 1 + tr e: g = dJ/de = 1.
template <class Real>
static void volume(int points, const double* weight, const double* E, double* change, double* stretch, double* g) {
  Real sum{};
  store(stretch, sum);
  const Real unit[6] = {Real{} + 1.0, Real{} + 1.0, Real{} + 1.0};
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    sum += scalar<Real>(weight, p) * (e[0] + e[1] + e[2]);
    store_voigt(g, p, unit);
  }
  store(change, sum);
}

template <class Real>
static void gradient_change(int points, const double*, const double*, double* dg) {
  std::fill_n(dg, 6 * points * lanes<Real>, 0.0);
}

}  // namespace small_bulk

namespace finite_bulk {

/// J = det(1 + 2 E)^(1/2): g = dJ/dE = J C^-1, the cofactors of C over J. The least stretch is that of the largest
/// principal value of C^-1, or a little below.
template <class Real>
static void volume(int points, const double* weight, const double* E, double* change, double* stretch, double* g) {
  Real sum{}, largest{};
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    const Real xx = 1.0 + 2.0 * e[0], yy = 1.0 + 2.0 * e[1], zz = 1.0 + 2.0 * e[2];
    const Real J = square_root(finite_stages::stretch_determinant(e)), by_J = 1.0 / J;
    const Real cofactor[6] = {(yy * zz - e[4] * e[4]) * by_J,   (zz * xx - e[5] * e[5]) * by_J,
                              (xx * yy - e[3] * e[3]) * by_J,   (e[4] * e[5] - e[3] * zz) * by_J,
                              (e[5] * e[3] - e[4] * xx) * by_J, (e[3] * e[4] - e[5] * yy) * by_J};
    sum += scalar<Real>(weight, p) * (J - 1.0);
    store_voigt(g, p, cofactor);
    Real inverse[6];
    for (int c = 0; c < 6; ++c) inverse[c] = (c < 3 ? 1.0 : 2.0) * cofactor[c] * by_J;
    const Real of_point = largest_principal_bound(inverse);
    largest = of_point > largest ? of_point : largest;
  }
  store(change, sum);
  store(stretch, Real(1.0 / square_root(largest) - 1.0));
}

/// dg = (g (g : dE) - 2 g dE g) / J, J^2 = det C and so J = det g.
template <class Real>
static void gradient_change(int points, const double* g, const double* dE, double* dg) {
  for (int p = 0; p < points; ++p) {
    Real of_J[6], d[6], change[6];
    load_voigt(g, p, of_J);
    load_voigt(dE, p, d);
    double_product(of_J, d, change);
    Real product{};
    for (int c = 0; c < 6; ++c) product += of_J[c] * d[c];
    const Real G[3][3] = {{of_J[0], of_J[3], of_J[5]}, {of_J[3], of_J[1], of_J[4]}, {of_J[5], of_J[4], of_J[2]}};
    const Real by_J = 1.0 / determinant(G);
    for (int c = 0; c < 6; ++c) change[c] = (of_J[c] * product - 2.0 * change[c]) * by_J;
    store_voigt(dg, p, change);
  }
}

}  // namespace finite_bulk

/// out += a b, a one number per lane and b six per point.
template <class Real>
static void add_scaled(int points, const double* a, const double* b, double* out) {
  const Real factor = load<Real>(a);
  for (int c = 0; c < 6 * points; ++c)
    store(out + c * lanes<Real>, load<Real>(out + c * lanes<Real>) + factor * load<Real>(b + c * lanes<Real>));
}

/// sum over the points of w g : dE
template <class Real>
static void volume_change(int points, const double* weight, const double* g, const double* dE, double* change) {
  Real sum{};
  for (int p = 0; p < points; ++p) {
    Real product{};
    for (int c = 0; c < 6; ++c) product += scalar<Real>(g, 6 * p + c) * scalar<Real>(dE, 6 * p + c);
    sum += scalar<Real>(weight, p) * product;
  }
  store(change, sum);
}

template <class Real>
static constexpr BulkStages small_bulk_stages() {
  return {small_bulk::volume<Real>, volume_change<Real>, small_bulk::gradient_change<Real>, add_scaled<Real>};
}
template <class Real>
static constexpr BulkStages finite_bulk_stages() {
  return {finite_bulk::volume<Real>, volume_change<Real>, finite_bulk::gradient_change<Real>, add_scaled<Real>};
}

}  // namespace carom
