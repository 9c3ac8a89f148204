// The cells as operators over a number type: geometry at the quadrature points, gradients of nodal fields there, and
// the nodal forces of stresses there, which is the transposed operation.
#pragma once

#include <numbers>

#include "element/hexa8_kernel.hpp"
#include "element/shape_table.hpp"
#include "element/shapes/hexa8.hpp"
#include "math/pack.hpp"

// Everything is inlined into functions of internal linkage: see math/pack.hpp. Nodal values are [component][node];
// gradients H_ij = du_i/dX_j and stresses P_ij of point p stand at [(9 p + 3 i + j) lanes].
namespace carom {

/// How the directions of a cell lie in space. Plane cells lie in the x-y plane; axisymmetric ones turn about the y axis
/// with x the radius: volumes carry 2 pi x and H_zz = u_x / x. Bars have one reference direction, their axis.
enum class Frame : unsigned char { solid, plane, axisymmetric, bar };

template <class Real>
[[gnu::always_inline]] static inline void store_point(double* values, int p, const Real M[3][3]) {
  for (int c = 0; c < 9; ++c) store(values + (9 * p + c) * lanes<Real>, M[c / 3][c % 3]);
}
template <class Real>
[[gnu::always_inline]] static inline void load_point(const double* values, int p, Real M[3][3]) {
  for (int c = 0; c < 9; ++c) M[c / 3][c % 3] = load<Real>(values + (9 * p + c) * lanes<Real>);
}

/// Inverse times determinant of g[k][i] = dX_i / dxi_k, as cofactor[k][j] = det dxi_k / dX_j; returns the determinant.
template <class Real>
[[gnu::always_inline]] static inline Real invert(const Real g[3][3], Real cofactor[3][3]) {
  hexa8::cross(g[1], g[2], cofactor[0]);
  hexa8::cross(g[2], g[0], cofactor[1]);
  hexa8::cross(g[0], g[1], cofactor[2]);
  return g[0][0] * cofactor[0][0] + g[0][1] * cofactor[0][1] + g[0][2] * cofactor[0][2];
}
template <class Real>
[[gnu::always_inline]] static inline Real invert(const Real g[2][2], Real cofactor[2][2]) {
  cofactor[0][0] = g[1][1];
  cofactor[0][1] = -g[1][0];
  cofactor[1][0] = -g[0][1];
  cofactor[1][1] = g[0][0];
  return g[0][0] * g[1][1] - g[0][1] * g[1][0];
}

/// Cells whose fields and geometry share the shape functions, at the points of the shape's stiffness rule. `thickness`
/// is that of plane cells.
template <class ShapeType, Frame frame_>
struct Isoparametric {
  using Shape = ShapeType;
  static constexpr Frame frame = frame_;
  static constexpr int nodes = Shape::nodes, dimension = Shape::dimension;
  static constexpr int points = decltype(Shape::stiffness_rule())::points;

  template <class Real>
  struct Geometry {
    Real weight[points];                         ///< reference volume of the point; stands first in every geometry
    Real inverse[points][dimension][dimension];  ///< dxi_k / dX_j
    Real inverse_radius[frame == Frame::axisymmetric ? points : 1];
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][nodes], double thickness, Geometry<Real>& out) {
    constexpr const auto& table = stiffness_points<Shape>;
    for (int p = 0; p < points; ++p) {
      Real g[dimension][dimension] = {}, cofactor[dimension][dimension];
      for (int a = 0; a < nodes; ++a)
        for (int k = 0; k < dimension; ++k)
          for (int i = 0; i < dimension; ++i) g[k][i] += table.dN[p][a][k] * x[i][a];
      const Real det = invert(g, cofactor), inverse = 1.0 / det;
      for (int k = 0; k < dimension; ++k)
        for (int j = 0; j < dimension; ++j) out.inverse[p][k][j] = cofactor[k][j] * inverse;
      out.weight[p] = table.weight[p] * det;
      if constexpr (frame == Frame::plane) out.weight[p] *= thickness;
      if constexpr (frame == Frame::axisymmetric) {
        Real radius{};
        for (int a = 0; a < nodes; ++a) radius += table.N[p][a] * x[0][a];
        out.weight[p] *= 2.0 * std::numbers::pi * radius;
        out.inverse_radius[p] = 1.0 / radius;
      }
    }
  }

  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][nodes],
                                                      double* gradient) {
    constexpr const auto& table = stiffness_points<Shape>;
    for (int p = 0; p < points; ++p) {
      Real h[dimension][dimension] = {}, H[3][3] = {};
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dimension; ++i)
          for (int k = 0; k < dimension; ++k) h[i][k] += table.dN[p][a][k] * u[i][a];
      for (int i = 0; i < dimension; ++i)
        for (int j = 0; j < dimension; ++j)
          for (int k = 0; k < dimension; ++k) H[i][j] += h[i][k] * geometry.inverse[p][k][j];
      if constexpr (frame == Frame::axisymmetric) {
        for (int a = 0; a < nodes; ++a) H[2][2] += table.N[p][a] * u[0][a];
        H[2][2] *= geometry.inverse_radius[p];
      }
      store_point(gradient, p, H);
    }
  }

  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      Real f[3][nodes]) {
    constexpr const auto& table = stiffness_points<Shape>;
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < nodes; ++a) f[i][a] = Real{};
    for (int p = 0; p < points; ++p) {
      Real P[3][3], flux[dimension][dimension] = {}, hoop{};
      load_point(stress, p, P);
      for (int i = 0; i < dimension; ++i)
        for (int k = 0; k < dimension; ++k) {
          for (int j = 0; j < dimension; ++j) flux[i][k] += P[i][j] * geometry.inverse[p][k][j];
          flux[i][k] *= geometry.weight[p];
        }
      if constexpr (frame == Frame::axisymmetric) hoop = geometry.weight[p] * P[2][2] * geometry.inverse_radius[p];
      for (int a = 0; a < nodes; ++a) {
        for (int i = 0; i < dimension; ++i)
          for (int k = 0; k < dimension; ++k) f[i][a] += flux[i][k] * table.dN[p][a][k];
        if constexpr (frame == Frame::axisymmetric) f[0][a] += hoop * table.N[p][a];
      }
    }
  }
};

/// HEXA8 by sum factorisation.
struct Hexa8Cell {
  using Shape = Hexa8;
  static constexpr Frame frame = Frame::solid;
  static constexpr int nodes = 8, dimension = 3, points = 8;

  template <class Real>
  struct Geometry {
    Real weight[8];
    hexa8::PointGeometry<Real> point;
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][8], double, Geometry<Real>& out) {
    hexa8::ParentDerivatives<Real> dx[3];
    for (int i = 0; i < 3; ++i) hexa8::differentiate(x[i], dx[i]);
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      hexa8::geometry_at_point(p, dx, out.point);
      out.weight[p] = (1.0 / 512.0) * out.point.det[p];
    }
  }
  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][8],
                                                      double* gradient) {
    hexa8::ParentDerivatives<Real> du[3];
    for (int i = 0; i < 3; ++i) hexa8::differentiate(u[i], du[i]);
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      Real H[3][3];
      hexa8::gradient_at_point(p, du, geometry.point, H);
      store_point(gradient, p, H);
    }
  }
  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      Real f[3][8]) {
    hexa8::integrate(
        geometry.point, [&](int p, Real P[3][3]) __attribute__((always_inline)) { load_point(stress, p, P); }, f);
  }
};

/// LINE2 in space, one point: F = axis + H with H_i0 = (u_1 - u_0)_i / L. `area` is that of the section.
struct BarCell {
  static constexpr Frame frame = Frame::bar;
  static constexpr int nodes = 2, dimension = 3, points = 1;

  template <class Real>
  struct Geometry {
    Real weight[1];
    Real axis[3][3];  ///< F at rest: (axis, 0, 0)
    Real inverse_length;
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][2], double area, Geometry<Real>& out) {
    Real d[3], length{};
    for (int i = 0; i < 3; ++i) {
      d[i] = x[i][1] - x[i][0];
      length += d[i] * d[i];
    }
    length = square_root(length);
    out.inverse_length = 1.0 / length;
    out.weight[0] = area * length;
    for (int i = 0; i < 3; ++i) {
      out.axis[i][0] = d[i] * out.inverse_length;
      out.axis[i][1] = out.axis[i][2] = Real{};
    }
  }
  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][2],
                                                      double* gradient) {
    Real H[3][3] = {};
    for (int i = 0; i < 3; ++i) H[i][0] = (u[i][1] - u[i][0]) * geometry.inverse_length;
    store_point(gradient, 0, H);
  }
  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      Real f[3][2]) {
    Real P[3][3];
    load_point(stress, 0, P);
    for (int i = 0; i < 3; ++i) {
      f[i][1] = geometry.weight[0] * P[i][0] * geometry.inverse_length;
      f[i][0] = -f[i][1];
    }
  }
};

/// What cells share that keep their gradients: dN_a/dX_j of each point, and N_a / x of axisymmetric ones.
template <int nodes, int points, int dimension, bool is_ring>
struct DenseGradients {
  template <class Real>
  struct Geometry {
    Real weight[points];
    Real dN[points][nodes][dimension];
    Real hoop[is_ring ? nodes : 1];  ///< rings have one point
  };

  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][nodes],
                                                      double* gradient) {
    for (int p = 0; p < points; ++p) {
      Real H[3][3] = {};
      for (int a = 0; a < nodes; ++a) {
        for (int i = 0; i < dimension; ++i)
          for (int j = 0; j < dimension; ++j) H[i][j] += u[i][a] * geometry.dN[p][a][j];
        if constexpr (is_ring) H[2][2] += u[0][a] * geometry.hoop[a];
      }
      store_point(gradient, p, H);
    }
  }
  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      Real f[3][nodes]) {
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < nodes; ++a) f[i][a] = Real{};
    for (int p = 0; p < points; ++p) {
      Real P[3][3];
      load_point(stress, p, P);
      for (Real(&row)[3] : P)
        for (Real& entry : row) entry *= geometry.weight[p];
      for (int a = 0; a < nodes; ++a) {
        for (int i = 0; i < dimension; ++i)
          for (int j = 0; j < dimension; ++j) f[i][a] += P[i][j] * geometry.dN[p][a][j];
        if constexpr (is_ring) f[0][a] += P[2][2] * geometry.hoop[a];
      }
    }
  }
};

/// One point with the mean gradients of the cell, (1/V) integral of dN/dX dV (and of N / x of rings), which give
/// constant stresses their exact forces on any cell (Flanagan and Belytschko, Int. J. Numer. Methods Eng. 17, 1981),
/// and a stiffness of the hourglass modes: with gamma_a = (Gamma_a - Gamma_b X_jb dN_a/dX_j) / n, orthogonal to linear
/// fields, and q_i = gamma_a u_ia, the energy is k q_i q_i / 2 of each mode, a function of the displacement that a
/// rotation of the cell leaves alone. k = coefficient x modulus x V |dN/dX|^2 x (16/9 solid, 4/3 plane): with the shear
/// modulus and coefficient 1 that of the modes of two factors of a cube, or of a square, integrated fully.
template <class Full>
struct MeanGradientCell : DenseGradients<Full::nodes, 1, Full::dimension, Full::frame == Frame::axisymmetric> {
  using Shape = typename Full::Shape;
  static constexpr Frame frame = Full::frame;
  static constexpr int nodes = Full::nodes, dimension = Full::dimension, points = 1;
  static constexpr int modes = Shape::modes, directions = dimension;
  static constexpr bool is_ring = frame == Frame::axisymmetric;
  using Base = DenseGradients<nodes, 1, dimension, is_ring>;

  template <class Real>
  struct Geometry : Base::template Geometry<Real> {
    Real gamma[Shape::modes][nodes];
    Real stiffness;  ///< k for coefficient x modulus = 1
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][nodes], double thickness, Geometry<Real>& out) {
    typename Full::template Geometry<Real> full;
    Full::prepare(x, thickness, full);
    Real volume{};
    for (int p = 0; p < Full::points; ++p) volume += full.weight[p];
    out.weight[0] = volume;
    double unit[9 * Full::points * lanes<Real>];
    Real mean[3][nodes];
    fill<Real>(unit, 0, dimension);
    Full::integrate(full, unit, mean);
    Real square{};
    const Real inverse = 1.0 / volume;
    for (int a = 0; a < nodes; ++a)
      for (int j = 0; j < dimension; ++j) {
        out.dN[0][a][j] = mean[j][a] * inverse;
        square += out.dN[0][a][j] * out.dN[0][a][j];
      }
    if constexpr (is_ring) {
      fill<Real>(unit, 2, 3);
      Full::integrate(full, unit, mean);
      for (int a = 0; a < nodes; ++a) out.hoop[a] = mean[0][a] * inverse;
    }
    out.stiffness = (dimension == 3 ? 16.0 / 9.0 : 4.0 / 3.0) * volume * square;
    for (int m = 0; m < Shape::modes; ++m) {
      Real along[dimension] = {};
      for (int j = 0; j < dimension; ++j)
        for (int b = 0; b < nodes; ++b) along[j] += Shape::hourglass[m][b] * x[j][b];
      for (int a = 0; a < nodes; ++a) {
        Real gamma = Real{} + Shape::hourglass[m][a];
        for (int j = 0; j < dimension; ++j) gamma -= along[j] * out.dN[0][a][j];
        out.gamma[m][a] = gamma * (1.0 / nodes);
      }
    }
  }

  /// And q[(dimension m + i) lanes] = gamma_ma u_ia.
  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][nodes],
                                                      double* gradient, double* q) {
    Base::gradients(geometry, u, gradient);
    for (int m = 0; m < Shape::modes; ++m)
      for (int i = 0; i < dimension; ++i) {
        Real sum{};
        for (int a = 0; a < nodes; ++a) sum += geometry.gamma[m][a] * u[i][a];
        store(q + (dimension * m + i) * lanes<Real>, sum);
      }
  }
  /// And f_ia += Q_mi gamma_ma, Q laid out as q.
  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      const double* Q, Real f[3][nodes]) {
    Base::integrate(geometry, stress, f);
    for (int m = 0; m < Shape::modes; ++m)
      for (int i = 0; i < dimension; ++i) {
        const Real force = load<Real>(Q + (dimension * m + i) * lanes<Real>);
        for (int a = 0; a < nodes; ++a) f[i][a] += force * geometry.gamma[m][a];
      }
  }

 private:
  /// Stresses whose diagonal is 1 from `first` to before `last`.
  template <class Real>
  [[gnu::always_inline]] static inline void fill(double* stress, int first, int last) {
    for (int p = 0; p < Full::points; ++p) {
      Real P[3][3] = {};
      for (int i = first; i < last; ++i) P[i][i] = Real{} + 1.0;
      store_point(stress, p, P);
    }
  }
};

}  // namespace carom
