// Nodal values of the cells of a batch from vectors over all nodes, and back.
#pragma once

#include "base/types.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The two halves of a wider pack, one after the other.
[[gnu::always_inline]] static inline Pack4 join(Pack2 a, Pack2 b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}
[[gnu::always_inline]] static inline Pack8 join(Pack4 a, Pack4 b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Components x, y, z of the nodes at offset[0], offset[1], ..., one lane per node.
[[gnu::always_inline]] static inline void gather_node(const double* values, const Index* offset, double node[3]) {
  for (int i = 0; i < 3; ++i) node[i] = values[offset[0] + i];
}
[[gnu::always_inline]] static inline void gather_node(const double* values, const Index* offset, Pack2 node[3]) {
  const double *p0 = values + offset[0], *p1 = values + offset[1];
  const Pack2 xy0 = load<Pack2>(p0), xy1 = load<Pack2>(p1);
  node[0] = __builtin_shufflevector(xy0, xy1, 0, 2);
  node[1] = __builtin_shufflevector(xy0, xy1, 1, 3);
  node[2] = Pack2{p0[2], p1[2]};
}
[[gnu::always_inline]] static inline void gather_node(const double* values, const Index* offset, Pack4 node[3]) {
  const double *p0 = values + offset[0], *p1 = values + offset[1], *p2 = values + offset[2], *p3 = values + offset[3];
  const Pack4 xy02 = join(load<Pack2>(p0), load<Pack2>(p2)), xy13 = join(load<Pack2>(p1), load<Pack2>(p3));
  node[0] = __builtin_shufflevector(xy02, xy13, 0, 4, 2, 6);
  node[1] = __builtin_shufflevector(xy02, xy13, 1, 5, 3, 7);
  node[2] = join(Pack2{p0[2], p1[2]}, Pack2{p2[2], p3[2]});
}
[[gnu::always_inline]] static inline void gather_node(const double* values, const Index* offset, Pack8 node[3]) {
  Pack4 low[3], high[3];
  gather_node(values, offset, low);
  gather_node(values, offset + 4, high);
  for (int i = 0; i < 3; ++i) node[i] = join(low[i], high[i]);
}

/// Stage 1: nodal values [component][node] of the cells of one batch from an interleaved vector.
template <class Real, int nodes>
[[gnu::always_inline]] static inline void gather(const double* values, const Index* offset, Real (&out)[3][nodes]) {
#pragma GCC unroll 8
  for (int a = 0; a < nodes; ++a) {
    Real node[3];
    gather_node(values, offset + a * lanes<Real>, node);
    for (int i = 0; i < 3; ++i) out[i][a] = node[i];
  }
}

/// Adds (xy[0], xy[1], z) to the node at p.
[[gnu::always_inline]] static inline void add_to_node(double* p, Pack2 xy, double z) {
  store<Pack2>(p, load<Pack2>(p) + xy);
  p[2] += z;
}

/// Adds components x, y, z, one lane per node, to the nodes at offset[0], offset[1], ... Cells of a batch may share
/// nodes, so lanes go one after the other.
[[gnu::always_inline]] static inline void scatter_node(double x, double y, double z, const Index* offset, double* f) {
  f[offset[0]] += x;
  f[offset[0] + 1] += y;
  f[offset[0] + 2] += z;
}
[[gnu::always_inline]] static inline void scatter_node(Pack2 x, Pack2 y, Pack2 z, const Index* offset, double* f) {
  add_to_node(f + offset[0], __builtin_shufflevector(x, y, 0, 2), z[0]);
  add_to_node(f + offset[1], __builtin_shufflevector(x, y, 1, 3), z[1]);
}
[[gnu::always_inline]] static inline void scatter_node(Pack4 x, Pack4 y, Pack4 z, const Index* offset, double* f) {
  const Pack4 xy02 = __builtin_shufflevector(x, y, 0, 4, 2, 6), xy13 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  add_to_node(f + offset[0], __builtin_shufflevector(xy02, xy02, 0, 1), z[0]);
  add_to_node(f + offset[1], __builtin_shufflevector(xy13, xy13, 0, 1), z[1]);
  add_to_node(f + offset[2], __builtin_shufflevector(xy02, xy02, 2, 3), z[2]);
  add_to_node(f + offset[3], __builtin_shufflevector(xy13, xy13, 2, 3), z[3]);
}
[[gnu::always_inline]] static inline void scatter_node(Pack8 x, Pack8 y, Pack8 z, const Index* offset, double* f) {
  const auto low = [](Pack8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); };
  const auto high = [](Pack8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); };
  scatter_node(low(x), low(y), low(z), offset, f);
  scatter_node(high(x), high(y), high(z), offset + 4, f);
}

/// Stage 5 for a full batch: adds nodal values [component][node] to an interleaved vector.
template <class Real, int nodes>
[[gnu::always_inline]] static inline void scatter(const Real (&in)[3][nodes], const Index* offset, double* f) {
#pragma GCC unroll 8
  for (int a = 0; a < nodes; ++a) scatter_node(in[0][a], in[1][a], in[2][a], offset + a * lanes<Real>, f);
}

/// Stage 5 for the first `count` lanes alone.
template <class Real, int nodes>
static void scatter_some(const Real (&in)[3][nodes], const Index* offset, int count, double* f) {
  constexpr int n = lanes<Real>;
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) {
      double lane[n];
      store(lane, in[i][a]);
      for (int l = 0; l < count; ++l) f[offset[a * n + l] + i] += lane[l];
    }
}

/// Stage 5: adds the nodal values of the `count` cells of a batch.
template <class Real, int nodes>
[[gnu::always_inline]] static inline void scatter_batch(const Real (&in)[3][nodes], const Index* offset, int count,
                                                        double* f) {
  if (count == lanes<Real>)
    scatter(in, offset, f);
  else
    scatter_some(in, offset, count, f);
}

}  // namespace carom
