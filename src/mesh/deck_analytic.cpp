#include "mesh/deck_analytic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "deck/deck_cursor.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

using Point = std::array<double, 2>;

/// Of the space that the profile lies in.
struct Frame {
  Vec3 origin{}, x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};

  Vec3 at(double a, double b, double c) const {
    return add(add(origin, scaled(x, a)), add(scaled(y, b), scaled(z, c)));
  }
};

Point point_of(DeckCursor& at) {
  const double x = at.real_or(0.0, "a coordinate"), y = at.real_or(0.0, "a coordinate");
  return {x, y};
}

/// Of the middle of a chord from the arc.
double rise(double radius, double angle) {
  return radius * (1.0 - std::cos(0.5 * angle));
}

/// A polygon, and how far it is from the arcs that it stands for.
struct Profile {
  std::vector<Point> points;
  double roundness = 0.0;
};

/// The shorter way about the centre.
void append_arc(DeckCursor& at, Profile& to) {
  std::vector<Point>& profile = to.points;
  const Point from = profile.back(), end = point_of(at), centre = point_of(at);
  const double radius = std::hypot(from[0] - centre[0], from[1] - centre[1]);
  const double of_end = std::hypot(end[0] - centre[0], end[1] - centre[1]);
  constexpr double rounding = 1e-3;  // of coordinates as they are written
  if (!(radius > 0.0) || std::abs(of_end - radius) > rounding * radius)
    at.fail(fmt::format("an arc whose ends are {:g} and {:g} from its centre", radius, of_end), "the same distance");
  const double first = std::atan2(from[1] - centre[1], from[0] - centre[0]);
  const double whole = 2.0 * std::numbers::pi;
  const double sweep = std::remainder(std::atan2(end[1] - centre[1], end[0] - centre[0]) - first, whole);
  constexpr double widest = 179.74 * std::numbers::pi / 180.0;  // of Abaqus
  if (std::abs(sweep) > widest)
    at.fail("an arc of half a circle", "one of less than 179.74 degrees", "Write two: which way it goes is open.");
  constexpr double piece = std::numbers::pi / 60.0;
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / piece - 1e-9)));
  for (int i = 1; i < pieces; ++i) {
    const double angle = first + sweep * i / pieces;
    profile.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
  }
  profile.push_back(end);
  to.roundness = std::max(to.roundness, rise(radius, sweep / pieces));
}

/// From the line with START, at which the cursor is.
Profile profile_of(DeckCursor& at) {
  Profile whole;
  std::vector<Point>& profile = whole.points;
  do {
    const std::string word = upper_case(at.field());
    if (word.starts_with("STAR") && profile.empty())
      profile.push_back(point_of(at));
    else if (word == "LINE" && !profile.empty())
      profile.push_back(point_of(at));
    else if (word.starts_with("CIRC") && !profile.empty())
      append_arc(at, whole);
    else
      at.fail(fmt::format("\"{}\"", word), profile.empty() ? "START" : "LINE or CIRCL",
              word.starts_with("PARA") ? "Write the parabola as lines." : "");
    at.end_line("the coordinates of the segment");
  } while (at.next_line());
  if (profile.size() < 2) at.fail("a profile without segments", "START, then LINE or CIRCL");
  return whole;
}

Vec3 vector_of(DeckCursor& at) {
  Vec3 x{};
  for (double& component : x) component = at.real_or(0.0, "a coordinate");
  return x;
}

bool is_at_start(const DeckCursor& at) {
  DeckCursor peek = at;
  return !as_real(peek.field()).has_value();
}

/// Local axes by points a and b, of a cylinder also c: within a part they may be left out.
Frame frame_of(DeckCursor& at, const std::string& type) {
  Frame frame;
  if (type == "REVOLUTION") frame = {{}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};
  if (is_at_start(at)) return frame;
  frame.origin = vector_of(at);
  const Vec3 along = subtract(vector_of(at), frame.origin);
  if (!at.next_line()) at.fail("no profile", "START, then LINE or CIRCL");
  if (norm(along) == 0.0) at.fail("an axis from a point to itself", "two points");
  if (type == "REVOLUTION") {
    frame.z = normalized(along);
    const Vec3 other = std::abs(frame.z[0]) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    frame.y = normalized(cross(frame.z, other));
    frame.x = cross(frame.y, frame.z);
    return frame;
  }
  frame.x = normalized(along);
  const Vec3 generator = subtract(vector_of(at), frame.origin);
  const Vec3 across = cross(frame.x, generator);  // the local z-axis points against the generator
  if (norm(across) == 0.0) at.fail("a generator along the local x-axis", "a point beside it");
  frame.y = normalized(across);
  frame.z = cross(frame.x, frame.y);
  if (!at.next_line()) at.fail("no profile", "START, then LINE or CIRCL");
  return frame;
}

AnalyticFaces lines(const std::vector<Point>& profile) {
  AnalyticFaces made;
  for (const Point& p : profile) made.points.push_back({p[0], p[1], 0.0});
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) made.faces.push_back({i + 1, i});
  return made;
}

AnalyticFaces swept(const std::vector<Point>& profile, const Frame& frame, double half_length) {
  AnalyticFaces made;
  for (const Point& p : profile)
    for (const double z : {-half_length, half_length}) made.points.push_back(frame.at(p[0], p[1], z));
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) made.faces.push_back({2 * i + 2, 2 * i, 2 * i + 1, 2 * i + 3});
  return made;
}

AnalyticFaces revolved(const std::vector<Point>& profile, const Frame& frame) {
  constexpr std::size_t pieces = 72;
  AnalyticFaces made;
  std::vector<std::vector<std::size_t>> rings;  // one point on the axis
  for (const Point& p : profile) {
    std::vector<std::size_t>& ring = rings.emplace_back();
    made.roundness = std::max(made.roundness, rise(std::abs(p[0]), 2.0 * std::numbers::pi / pieces));
    for (std::size_t k = 0; k < (p[0] == 0.0 ? 1 : pieces); ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / pieces;
      ring.push_back(made.points.size());
      made.points.push_back(frame.at(p[0] * std::cos(angle), p[0] * std::sin(angle), p[1]));
    }
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::size_t k = 0; k < pieces; ++k) {
      const auto at = [&](std::size_t ring, std::size_t place) { return rings[ring][place % rings[ring].size()]; };
      std::vector<std::size_t> face{at(i, k), at(i + 1, k)};
      if (rings[i + 1].size() > 1) face.push_back(at(i + 1, k + 1));
      if (rings[i].size() > 1) face.push_back(at(i, k + 1));
      if (face.size() > 2) made.faces.push_back(face);
    }
  return made;
}

}  // namespace

AnalyticFaces analytic_faces(const DeckKeyword& surface, const std::string& type, double half_length) {
  DeckCursor at(surface);
  if (!at.next_line()) surface.fail("no data", "START, then LINE or CIRCL");
  const Frame frame = type == "SEGMENTS" ? Frame{} : frame_of(at, type);
  const Profile profile = profile_of(at);
  AnalyticFaces made = type == "CYLINDER"     ? swept(profile.points, frame, half_length)
                       : type == "REVOLUTION" ? revolved(profile.points, frame)
                                              : lines(profile.points);
  made.roundness = std::max(made.roundness, profile.roundness);
  return made;
}

}  // namespace carom
