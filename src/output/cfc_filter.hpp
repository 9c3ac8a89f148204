// Low-pass filter of impact tests: SAE J211-1 channel frequency classes.
#pragma once

#include <span>
#include <vector>

namespace carom {

/// Longest sampling step times class, both in SI: J211 asks for 10 samples per period of the class at least.
inline constexpr double cfc_longest_sampling = 0.1;

/// Phaseless 4-pole low-pass of channel frequency class `cfc` (60, 180, 600, 1000; any positive number in Hz): a 2-pole
/// Butterworth filter run forwards and backwards (SAE J211-1, appendix C; ISO 6487, annex A).
/// T = dt: wd = 2 pi cfc 2.0775, wa = tan(wd T / 2), a0 = wa^2 / (1 + sqrt(2) wa + wa^2), a1 = 2 a0, a2 = a0,
/// b1 = -2 (wa^2 - 1) / (1 + sqrt(2) wa + wa^2), b2 = (-1 + sqrt(2) wa - wa^2) / (1 + sqrt(2) wa + wa^2),
/// Y(i) = a0 X(i) + a1 X(i-1) + a2 X(i-2) + b1 Y(i-1) + b2 Y(i-2).
/// The ends are continued by their mirror images, tilted by the mean slope over two periods of the cut-off: what is
/// slow goes on as it went, and what vibrates fast does so about the same mean. (Continued by point reflection, as is
/// often done, a record that ends amid a vibration would be held to its last value.) samples: equally spaced by dt in
/// seconds. Throws std::invalid_argument when cfc or dt is not positive, or when the sampling frequency is below 10 cfc
/// (J211's minimum).
std::vector<double> cfc_filter(std::span<const double> samples, double dt, double cfc);

/// Lowest frequency that the class cuts, 2.0775 cfc in Hz: what is slower than three of its periods is shaped by the
/// continuation of the ends.
inline constexpr double cfc_limit(double cfc) {
  return 2.0775 * cfc;
}

/// Equal intervals of time over a record for a filter of class cfc: the smallest interval of the record, or 1/1000 of
/// the period of the class if that is more; whole ones to its end. Times in seconds, ascending, at least two.
std::vector<double> equal_times(std::span<const double> time, double cfc);

/// Values at the times `at`, linear between those at `time`, whose ends are those of `at`. Both ascending.
std::vector<double> resampled(std::span<const double> time, std::span<const double> values, std::span<const double> at);

}  // namespace carom
