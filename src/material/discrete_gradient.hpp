// The stress of the energy-momentum method over a number type.
#pragma once

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// S = S_mid + [W_1 - W_0 - S_mid : (e_1 - e_0)] / |e_1 - e_0|^2 (e_1 - e_0): the discrete gradient of the stored
/// energy, S : (e_1 - e_0) = W_1 - W_0 (Gonzalez, Comput. Methods Appl. Mech. Eng. 190, 2000, eq. 30, with C = 1 + 2
/// e). S_mid is the stress at (e_0 + e_1) / 2. Strains closer to each other than 1e-5 of their mean keep S_mid: the
/// bracket, of third order, is below the round-off of W there. Voigt order, shear strains twice the tensor's; S may be
/// S_mid.
template <class Real>
[[gnu::always_inline]] static inline void discrete_gradient_stress(const Real e_0[6], const Real e_1[6],
                                                                   const Real S_mid[6], const Real& W_0,
                                                                   const Real& W_1, Real S[6]) {
  constexpr double nearest_square = 1e-10;
  Real d[6], mean_square = Real{}, square = Real{}, bracket = W_1 - W_0;
  for (int c = 0; c < 6; ++c) {
    const double weight = c < 3 ? 1.0 : 0.5;
    const Real mean = 0.5 * (e_0[c] + e_1[c]);
    d[c] = e_1[c] - e_0[c];
    square += weight * d[c] * d[c];
    mean_square += weight * mean * mean;
    bracket -= S_mid[c] * d[c];
  }
  const Real zero = Real{};
  const Real factor = square > nearest_square * mean_square ? bracket / square : zero;
  for (int c = 0; c < 6; ++c) S[c] = S_mid[c] + (c < 3 ? 1.0 : 0.5) * factor * d[c];
}

}  // namespace carom
