// The patches of nodes as cells (solid/node_patches.hpp), over a number type.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <type_traits>

#include "element/cell_integrals.hpp"
#include "element/kinematics.hpp"
#include "kernels/batch_values.hpp"
#include "kernels/point_stages.hpp"
#include "kernels/stages.hpp"
#include "math/directional.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The stages of one kind of patch, made of cells like Cell: TETRA4 or TRIA3 in a frame. Node 0 of a patch is its
/// middle, the others are its neighbours. A batch's connectivity has the offsets of the nodes, and after them of every
/// cell of the patch the positions of its other corners among the neighbours; a cell whose corners are all the first
/// one fills the patch up and has no volume.
///
/// With u relative to the middle, shares f_e = v_e / V of the volume V = sum v_e, v_e an equal part of each cell's for
/// each of its nodes, and the gradients G of the cells' linear fields, the point of the patch has
///   H = sum_e f_e sum_b u_b (x) G_eb,
/// and the modes are what H does not explain, q_b = u_b - H X_b. They are what stabilised cells have
/// (kernels/stabilisation_stages.hpp), but for the energy: with D_e = sum_b q_b (x) G_eb, how far the gradient of a
/// cell is from that of the patch, and Y_e = D_e F^-1 it is per volume
///   w = c G sum_e f_e |sym Y_e|^2 = c G sum_e f_e tr (C^-1 e_e C^-1 e_e),   e_e = sym sum_b z_b (x) G_eb,  z = F^T q
/// (nodal integration: Dohrmann, Heinstein, Jung, Key and Witkowski, Int. J. Numer. Methods Eng. 47, 2000; with such a
/// stabilisation: Puso and Solberg, ibid. 67, 2006; Gee, Dohrmann, Key and Wall, ibid. 78, 2009).
template <class Real, class Cell>
struct PatchStages {
  static constexpr int d = Cell::dimension, n = lanes<Real>, corners = Cell::nodes;
  static constexpr bool is_ring = Cell::frame == Frame::axisymmetric;
  static constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

  struct Geometry {
    Real weight[1];
    const Index* corner;  ///< [(d e + k) lanes]
    int neighbours, cells;
    Real X[most_neighbours][d];         ///< from the middle
    Real gradient[most_neighbours][d];  ///< sum_e f_e G_eb
    Real hoop[is_ring ? most_neighbours + 1 : 1];
    Real share[most_patch_cells];
    Real hoop_of_cell[is_ring ? most_patch_cells : 1];
    Real G[most_patch_cells][d][d];
  };
  static const Geometry& of(const double* geometry) { return *reinterpret_cast<const Geometry*>(geometry); }

  /// Entry `corner` of an array of [lanes] numbers, another one for each lane.
  [[gnu::always_inline]] static inline Real pick(const Real* values, int stride, const Index* corner) {
    const auto* from = reinterpret_cast<const double*>(values);
    double lane[n];
    for (int l = 0; l < n; ++l) lane[l] = from[corner[l] * stride * n + l];
    return load<Real>(lane);
  }
  [[gnu::always_inline]] static inline void put(Real* values, int stride, const Index* corner, const Real& value) {
    auto* to = reinterpret_cast<double*>(values);
    double lane[n];
    store(lane, value);
    for (int l = 0; l < n; ++l) to[corner[l] * stride * n + l] += lane[l];
  }

  /// Volumes v_e, gradients and middles of the cells.
  static void prepare(const CellStages& own, const double* x, const Index* offset, double thickness, double* of_batch) {
    auto& geometry = *reinterpret_cast<Geometry*>(of_batch);
    const int m = geometry.neighbours = own.nodes - 1, cells = geometry.cells = own.corners / d;
    geometry.corner = offset + own.nodes * n;
    Real middle[3], node[3];
    gather_node(x, offset, middle);
    for (int b = 0; b < m; ++b) {
      gather_node(x, offset + (b + 1) * n, node);
      for (int i = 0; i < d; ++i) geometry.X[b][i] = node[i] - middle[i];
    }
    Real volume{};
    for (int e = 0; e < cells; ++e) {
      const Index* corner = geometry.corner + d * e * n;
      Real edge[d][d], cofactor[d][d];
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) edge[k][i] = pick(&geometry.X[0][i], d, corner + k * n);
      const Real det = invert(edge, cofactor), inverse = det > 0.0 ? Real(1.0 / det) : Real{};
      Real& v = geometry.share[e];
      v = (d == 3 ? 1.0 / 24.0 : thickness / 6.0) * det;
      if constexpr (is_ring) v *= 2.0 * std::numbers::pi / thickness * radius(middle[0], geometry, corner);
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) geometry.G[e][k][i] = inverse * cofactor[k][i];
      volume += v;
    }
    geometry.weight[0] = volume;
    const Real part = 1.0 / volume;
    for (int e = 0; e < cells; ++e) {
      geometry.share[e] *= part;
      if constexpr (is_ring) {
        const Real hoop = 1.0 / (3.0 * radius(middle[0], geometry, geometry.corner + d * e * n));
        geometry.hoop_of_cell[e] = geometry.share[e] > 0.0 ? hoop : Real{};  // what fills up may lie on the axis
      }
    }
    add_gradients(geometry);
  }
  /// Of the point, from those of the cells.
  static void add_gradients(Geometry& geometry) {
    for (auto& of_node : std::span(geometry.gradient, static_cast<std::size_t>(geometry.neighbours)))
      for (Real& component : of_node) component = Real{};
    for (Real& hoop : geometry.hoop) hoop = Real{};
    for (int e = 0; e < geometry.cells; ++e) {
      const Index* corner = geometry.corner + d * e * n;
      const Real share = geometry.share[e];
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) put(&geometry.gradient[0][i], d, corner + k * n, Real(share * geometry.G[e][k][i]));
      if constexpr (is_ring) {
        const Real hoop = share * geometry.hoop_of_cell[e];
        geometry.hoop[geometry.neighbours] += hoop;
        for (int k = 0; k < d; ++k) put(geometry.hoop, 1, corner + k * n, hoop);
      }
    }
  }
  static void keep_cells(double* of_batch, const unsigned char* wanted) {
    auto& geometry = *reinterpret_cast<Geometry*>(of_batch);
    for (int e = 0; e < geometry.cells; ++e)
      if (wanted[e] == 0) geometry.share[e] = Real{};
    add_gradients(geometry);
  }
  [[gnu::always_inline]] static inline Real radius(const Real& middle, const Geometry& geometry, const Index* corner) {
    Real sum{};
    for (int k = 0; k < d; ++k) sum += pick(&geometry.X[0][0], d, corner + k * n);
    return middle + (1.0 / 3.0) * sum;
  }

  /// An equal part of each cell's lumped masses (element/cell_integrals.hpp) for each of its nodes.
  static void lumped_mass(const CellStages& own, const double* x, const Index* offset, double thickness, double density,
                          double* m) {
    for (int a = 0; a < own.nodes; ++a) store(m + a * n, Real{});
    const Index* table = offset + own.nodes * n;
    for (int e = 0; e < own.corners / d; ++e)
      for (int l = 0; l < n; ++l) {
        const auto corner = [&](int k) { return k == 0 ? 0 : table[(d * e + k - 1) * n + l] + 1; };
        if (corner(1) == corner(2)) continue;
        double place[3][corners], mass[corners];
        for (int k = 0; k < corners; ++k)
          for (int i = 0; i < 3; ++i) place[i][k] = x[offset[corner(k) * n + l] + i];
        carom::lumped_mass<Cell>(place, thickness, density, mass);
        for (int k = 0; k < corners; ++k) m[corner(k) * n + l] += mass[k] / corners;
      }
  }

  static void gradients(const double* of_batch, const double* u, const Index* offset, double* gradient, double* q) {
    const Geometry& geometry = of(of_batch);
    Real middle[3], node[3], H[3][3] = {};
    gather_node(u, offset, middle);
    for (int b = 0; b < geometry.neighbours; ++b) {
      gather_node(u, offset + (b + 1) * n, node);
      if constexpr (is_ring) H[2][2] += geometry.hoop[b] * node[0];
      for (int i = 0; i < d; ++i) {
        const Real along = node[i] - middle[i];
        store(q + (d * b + i) * n, along);
        for (int j = 0; j < d; ++j) H[i][j] += along * geometry.gradient[b][j];
      }
    }
    if constexpr (is_ring) H[2][2] += geometry.hoop[geometry.neighbours] * middle[0];
    store_point(gradient, 0, H);
    for (int b = 0; b < geometry.neighbours; ++b)
      for (int i = 0; i < d; ++i) {
        double* mode = q + (d * b + i) * n;
        Real rest = load<Real>(mode);
        for (int j = 0; j < d; ++j) rest -= H[i][j] * geometry.X[b][j];
        store(mode, rest);
      }
  }

  static void add_forces(const double* of_batch, const double* stress, const double* Q, const Index* offset, int count,
                         double* f) {
    const Geometry& geometry = of(of_batch);
    Real P[3][3], middle[3] = {};
    load_point(stress, 0, P);
    for (auto& row : P)
      for (Real& entry : row) entry *= geometry.weight[0];
    add_relative(geometry, Real{} - 1.0, Q, P);
    for (int b = 0; b < geometry.neighbours; ++b) {
      Real force[3] = {};
      for (int i = 0; i < d; ++i) {
        force[i] = load<Real>(Q + (d * b + i) * n);
        for (int j = 0; j < d; ++j) force[i] += P[i][j] * geometry.gradient[b][j];
        middle[i] -= force[i];
      }
      if constexpr (is_ring) force[0] += P[2][2] * geometry.hoop[b];
      scatter_one(force, offset + (b + 1) * n, count, f);
    }
    if constexpr (is_ring) middle[0] += P[2][2] * geometry.hoop[geometry.neighbours];
    scatter_one(middle, offset, count, f);
  }
  /// P += factor sum_b Q_b (x) X_b
  [[gnu::always_inline]] static inline void add_relative(const Geometry& geometry, const Real& factor, const double* Q,
                                                         Real P[3][3]) {
    for (int b = 0; b < geometry.neighbours; ++b)
      for (int i = 0; i < d; ++i) {
        const Real force = factor * load<Real>(Q + (d * b + i) * n);
        for (int j = 0; j < d; ++j) P[i][j] += force * geometry.X[b][j];
      }
  }
  static void relative(const double* of_batch, double factor, const double* Q, double* stress) {
    const Geometry& geometry = of(of_batch);
    Real P[3][3];
    load_point(stress, 0, P);
    add_relative(geometry, Real(factor / geometry.weight[0]), Q, P);
    store_point(stress, 0, P);
  }
  [[gnu::always_inline]] static inline void scatter_one(const Real (&force)[3], const Index* offset, int count,
                                                        double* f) {
    if (count == n) return scatter_node(force[0], force[1], force[2], offset, f);
    for (int i = 0; i < 3; ++i) {
      double lane[n];
      store(lane, force[i]);
      for (int l = 0; l < count; ++l) f[offset[l] + i] += lane[l];
    }
  }

  /// out_b += A z_b, or A^T z_b, of every mode.
  template <bool is_transposed>
  [[gnu::always_inline]] static inline void add_products(const double* geometry, const Real A[3][3], const double* z,
                                                         double* out) {
    for (int b = 0; b < of(geometry).neighbours; ++b) {
      Real mode[d];
      for (int i = 0; i < d; ++i) mode[i] = load<Real>(z + (d * b + i) * n);
      for (int i = 0; i < d; ++i) {
        Real sum = load<Real>(out + (d * b + i) * n);
        for (int j = 0; j < d; ++j) sum += (is_transposed ? A[j][i] : A[i][j]) * mode[j];
        store(out + (d * b + i) * n, sum);
      }
    }
  }
  static void clear(const double* geometry, double* modes) {
    for (int c = 0; c < d * of(geometry).neighbours; ++c) store(modes + c * n, Real{});
  }

  static void pull(const double* geometry, const double* F, const double* q, double* z) {
    Real f[3][3];
    load_frame(F, f);
    clear(geometry, z);
    add_products<true>(geometry, f, q, z);
  }

  /// A Number of the value and, of directional numbers, the change.
  [[gnu::always_inline]] static inline void set(Real& number, const Real& value, const Real&) { number = value; }
  [[gnu::always_inline]] static inline void set(Directional<Real>& number, const Real& value, const Real& change) {
    number = {value, change};
  }
  [[gnu::always_inline]] static inline const Real& last(const Real& value) { return value; }
  [[gnu::always_inline]] static inline const Real& last(const Directional<Real>& value) { return value.change; }

  /// C = 1 + 2 E of the directions of the cells; small strain: 1.
  template <class Number>
  [[gnu::always_inline]] static inline void metric(const double* E, const double* dE, Number C[d][d]) {
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) {
        const Real unit = Real{} + (i == j ? 1.0 : 0.0);
        const double times = i == j ? 2.0 : 1.0;
        const int c = voigt[i][j] * n;
        set(C[i][j], E == nullptr ? unit : Real(unit + times * load<Real>(E + c)),
            dE == nullptr ? Real{} : Real(times * load<Real>(dE + c)));
      }
  }
  template <class Number>
  [[gnu::always_inline]] static inline void inverse_metric(const Number C[d][d], Number out[d][d]) {
    Number cofactor[d][d];
    const Number inverse = 1.0 / invert(C, cofactor);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) out[i][j] = inverse * cofactor[i][j];
  }

  /// The energy and its derivatives, or of directional numbers their changes.
  template <class Number>
  [[gnu::always_inline]] static inline void forces(const double* of_batch, const ModeModuli& moduli, const double* E,
                                                   const double* dE, const double* z, const double* dz,
                                                   const double* plastic, double* energy, double* T, double* S) {
    const Geometry& geometry = of(of_batch);
    Number C[d][d], inverse[d][d], sum{}, metric_sum[d][d] = {};
    metric(E, dE, C);
    inverse_metric(C, inverse);
    Real value[most_neighbours][d], change[std::is_same_v<Number, Real> ? 1 : most_neighbours][d];
    for (int b = 0; b < geometry.neighbours; ++b)
      for (int i = 0; i < d; ++i) {
        const int c = (d * b + i) * n;
        Number elastic;
        set(elastic, load<Real>(z + c), dz == nullptr ? Real{} : load<Real>(dz + c));
        for (int j = 0; plastic != nullptr && j < d; ++j) elastic -= load<Real>(plastic + (d * b + j) * n) * C[i][j];
        if constexpr (std::is_same_v<Number, Real>) {
          value[b][i] = elastic;
        } else {
          value[b][i] = elastic.value;
          change[b][i] = elastic.change;
        }
      }
    clear(of_batch, T);
    for (int e = 0; e < geometry.cells; ++e) {
      const Index* corner = geometry.corner + d * e * n;
      Number gradient[d][d] = {}, mixed[d][d], spatial[d][d];
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) {
          const Real of_corner = pick(&value[0][i], d, corner + k * n);
          Number mode;
          if constexpr (std::is_same_v<Number, Real>)
            mode = of_corner;
          else
            set(mode, of_corner, pick(&change[0][i], d, corner + k * n));
          for (int j = 0; j < d; ++j) gradient[i][j] += geometry.G[e][k][j] * mode;
        }
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < i; ++j) gradient[i][j] = gradient[j][i] = 0.5 * (gradient[i][j] + gradient[j][i]);
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) {
          mixed[i][j] = inverse[i][0] * gradient[0][j];
          for (int k = 1; k < d; ++k) mixed[i][j] += inverse[i][k] * gradient[k][j];
        }
      const Real share = geometry.share[e];
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) {
          Number square = mixed[i][0] * mixed[0][j];
          spatial[i][j] = mixed[i][0] * inverse[0][j];
          for (int k = 1; k < d; ++k) {
            square += mixed[i][k] * mixed[k][j];
            spatial[i][j] += mixed[i][k] * inverse[k][j];
          }
          metric_sum[i][j] += share * square;
          if (i == j) sum += share * square;
        }
      const Real factor = (2.0 * moduli.G) * share;
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) {
          Real along{};
          for (int j = 0; j < d; ++j) along += last(spatial[i][j]) * geometry.G[e][k][j];
          put(reinterpret_cast<Real*>(T) + i, d, corner + k * n, Real(factor * along));
        }
    }
    store<Real>(energy, moduli.G * last(sum));
    for (int c = 0; c < 6; ++c) {  // S = 2 dw/dC
      const int r = c % 3, s = c < 3 ? r : (r + 1) % 3;
      Real entry{};
      if (r < d && s < d) {
        Number along = metric_sum[r][0] * inverse[0][s];
        for (int k = 1; k < d; ++k) along += metric_sum[r][k] * inverse[k][s];
        entry = (-4.0 * moduli.G) * last(along);
        for (int b = 0; plastic != nullptr && b < geometry.neighbours; ++b)
          entry -= load<Real>(T + (d * b + r) * n) * load<Real>(plastic + (d * b + s) * n) +
                   load<Real>(T + (d * b + s) * n) * load<Real>(plastic + (d * b + r) * n);
      }
      store(S + c * n, entry);
    }
  }
  static void trial(const double* geometry, const ModeModuli& moduli, const double* E, const double* z,
                    const double* plastic, double* energy, double* T, double* S) {
    forces<Real>(geometry, moduli, E, nullptr, z, nullptr, plastic, energy, T, S);
  }
  static void change(const double* geometry, const ModeModuli& moduli, const double* E, const double* dE,
                     const double* z, const double* dz, const double* plastic, double* energy, double* T, double* S) {
    forces<Directional<Real>>(geometry, moduli, E, dE, z, dz, plastic, energy, T, S);
  }

  /// P += sum_b q_b (x) T_b
  [[gnu::always_inline]] static inline void add_dyads(const double* geometry, const double* q, const double* T,
                                                      const Real& factor, double* P) {
    Real stress[3][3];
    load_point(P, 0, stress);
    for (int b = 0; b < of(geometry).neighbours; ++b)
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j)
          stress[i][j] += factor * load<Real>(q + (d * b + i) * n) * load<Real>(T + (d * b + j) * n);
    store_point(P, 0, stress);
  }
  static void push(const double* geometry, const double* F, const double* q, const double* T, const double* share,
                   double* Q, double* P) {
    Real f[3][3];
    load_frame(F, f);
    const Real factor = share == nullptr ? Real(Real{} + 1.0) : load<Real>(share);
    if (F != nullptr) add_dyads(geometry, q, T, factor, P);
    for (auto& row : f)
      for (Real& entry : row) entry *= factor * of(geometry).weight[0];
    clear(geometry, Q);
    add_products<false>(geometry, f, T, Q);
  }

  static void pull_change(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                          double* dz) {
    pull(geometry, F, dq, dz);
    if (F == nullptr) return;
    Real h[3][3];
    load_point(dH, 0, h);
    add_products<true>(geometry, h, q, dz);
  }
  static void push_change(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                          const double* T, const double* dT, double* Q, double* P) {
    push(geometry, F, q, dT, nullptr, Q, P);
    if (F == nullptr) return;
    Real h[3][3];
    load_point(dH, 0, h);
    for (auto& row : h)
      for (Real& entry : row) entry *= of(geometry).weight[0];
    add_products<false>(geometry, h, T, Q);
    add_dyads(geometry, dq, T, Real{} + 1.0, P);
  }

  /// As stabilisation::begin and flow.
  static void begin(const double* geometry, const double* E, const double* z, const double* history, bool is_over,
                    double* plastic, double* share) {
    const int size = d * of(geometry).neighbours;
    const Real one = Real{} + 1.0;
    store(share, one);
    if (history == nullptr) return clear(geometry, plastic);
    std::copy_n(history, size * n, plastic);
    if (!is_over) return;
    const Real lost = load<Real>(history + size * n), left = one - lost, inverse = 1.0 / (left > 0.0 ? left : one);
    alignas(64) double material[d * most_neighbours * n];
    material_modes(geometry, E, z, material);
    for (int c = 0; c < size; ++c)
      store(plastic + c * n, Real(inverse * (load<Real>(plastic + c * n) - lost * load<Real>(material + c * n))));
    store(share, left);
  }
  static void flow(const double* geometry, const double* E, const double* z, const double* plastic, const double* share,
                   double* history) {
    const int size = d * of(geometry).neighbours;
    const Real lost = 1.0 - load<Real>(share);
    alignas(64) double material[d * most_neighbours * n];
    material_modes(geometry, E, z, material);
    for (int c = 0; c < size; ++c) {
      const Real p = load<Real>(plastic + c * n);
      store(history + c * n, Real(p + lost * (load<Real>(material + c * n) - p)));
    }
    store(history + size * n, lost);
  }
  /// C^-1 z of every mode.
  static void material_modes(const double* geometry, const double* E, const double* z, double* out) {
    Real C[d][d], inverse[d][d], A[3][3] = {};
    metric(E, nullptr, C);
    inverse_metric(C, inverse);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) A[i][j] = inverse[i][j];
    clear(geometry, out);
    add_products<false>(geometry, A, z, out);
  }

  static constexpr CellStages stages() {
    static_assert(sizeof(Geometry) <= most_geometry * sizeof(Real));
    CellStages out;
    out.points = 1;
    out.directions = d;
    out.lumped_mass = lumped_mass;
    out.prepare = prepare;
    out.gradients = gradients;
    out.add_forces = add_forces;
    out.stabilisation = {pull, trial, push, pull_change, change, push_change, begin, flow, keep_cells, relative};
    return out;
  }
};

}  // namespace carom
