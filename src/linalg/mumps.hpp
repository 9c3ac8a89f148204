// The sequential MUMPS, as the factorisations of symmetric and of general matrices call it. Internal to this folder.
#pragma once

#include <dmumps_c.h>

#include <cstddef>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// One instance: a pattern in coordinates, its analysis, its factors.
class Mumps {
 public:
  enum class Symmetry : MUMPS_INT { general = 0, symmetric = 2 };
  // Numbers of the MUMPS 5.5 users' guide, sections 5 and 6 (1-based there and here).
  static constexpr std::size_t null_pivots = 24;
  static constexpr std::size_t negative_count = 12, null_count = 28, entries = 29;

  explicit Mumps(Symmetry symmetry);
  ~Mumps();
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  MUMPS_INT& control(std::size_t i) { return mumps_.icntl[i - 1]; }
  double& real_control(std::size_t i) { return mumps_.cntl[i - 1]; }
  MUMPS_INT info(std::size_t i) const { return mumps_.infog[i - 1]; }
  /// A count of MUMPS: millions where it is negative (users' guide, section 5.4).
  double count(std::size_t i) const;
  /// The first null pivot, 0-based.
  Index null_pivot() const { return mumps_.pivnul_list[0] - 1; }

  /// Coordinates (1-based) and order of elimination (0-based) of a matrix of this size. Returns an error code, 0 for
  /// none.
  MUMPS_INT analyse(Index size, std::vector<MUMPS_INT> row, std::vector<MUMPS_INT> column,
                    const std::vector<Index>& order);
  bool has_pattern(Index size, const std::vector<MUMPS_INT>& row, const std::vector<MUMPS_INT>& column) const {
    return size == size_ && row == row_ && column == column_;
  }
  Index size() const { return size_; }
  /// Factors of these values, in the order of the coordinates. Pivots that are postponed for stability take workspace
  /// that the analysis could not foresee.
  MUMPS_INT factorise(std::vector<double> value);
  /// Overwrites the right-hand sides, one after the other.
  MUMPS_INT solve(double* b, int columns);

  /// True for the codes of a singular matrix.
  static bool is_singular(MUMPS_INT code) { return code == -6 || code == -10; }
  MUMPS_INT detail() const { return info(2); }
  std::string reason(MUMPS_INT code) const;

 private:
  enum class Job : MUMPS_INT { initialise = -1, terminate = -2, analyse = 1, factorise = 2, solve = 3 };
  MUMPS_INT call(Job job);

  DMUMPS_STRUC_C mumps_{};
  Index size_ = 0;
  std::vector<MUMPS_INT> row_, column_, place_;
  std::vector<double> value_;
};

}  // namespace carom
