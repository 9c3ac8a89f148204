// When have surfaces moved so far that something may have gone through something else?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/skin_pieces.hpp"

namespace carom {

/// The kind of look that is due.
enum class LookDue : std::uint8_t { none, bodies, folds };

/// Says when surfaces should be looked at again (SurfaceCrossings): of bodies, once points of two of them, whose boxes
/// have met on their way since the last look, may have moved by a quarter of the smallest of their cells relative to
/// each other; of folds of a body with itself, which need all of its skin, once its points have moved by as much, but
/// not within a hundred explicit steps (or one implicit one) after the last such look. Bodies that fly together, and
/// those that are far from each other, need no look. Nodes are not looked at in steps in which, as fast as since the
/// last look, nothing moves by half of that, sixteen steps at most.
class SkinMotion {
 public:
  /// The skin must outlive the object.
  explicit SkinMotion(const SkinPieces& skin);

  /// Displacement u has been looked at; also for folds?
  void looked(std::span<const double> u, bool with_folds);
  /// After a step, with the mesh's coordinates X. iterations: of the step, 0 of an explicit one.
  LookDue due(std::span<const Vec3> X, std::span<const double> u, int iterations);
  /// Does due() look at the displacement when it is called next?
  bool looks_next() const { return steps_ + 1 >= scan_; }
  /// May the next look be for folds, too?
  bool may_see_folds() const;

 private:
  template <class A>
  friend void fields(A& archive, SkinMotion& x) {
    archive("u", x.u_);
    archive("steps", x.steps_);
    archive("scan", x.scan_);
    archive("fold_work", x.fold_work_);
  }
  struct Body {
    Bounds moved, way;  ///< displacements since the look; where its nodes were and are
  };
  void follow(std::span<const Vec3> X, std::span<const double> u);
  double meeting() const;
  double folding() const;
  double spread() const;

  const SkinPieces& skin_;
  std::vector<double> least_;          ///< by body: smallest length of a cell
  std::vector<double> u_;              ///< at the last look, by node of the skin
  std::int64_t steps_ = 0, scan_ = 0;  ///< since the look; when nodes are looked at
  std::int64_t fold_work_ = 0;         ///< since folds were looked at, in explicit steps
  std::vector<Body> bodies_;
};

}  // namespace carom
