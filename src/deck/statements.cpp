#include "deck/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "deck/deck_cursor.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

Vec3 point_of(DeckCursor& at) {
  Vec3 x{};
  for (double& component : x) component = at.real_or(0.0, "a coordinate");
  return x;
}

Placement placement_of(const DeckKeyword& instance) {
  Placement placement;
  DeckCursor at(instance);
  if (!at.next_line()) return placement;
  placement.shift = point_of(at);
  at.end_line("the three components of the shift");
  if (!at.next_line()) return placement;
  Placement::Turn turn{point_of(at), point_of(at), at.real("the angle in degrees")};
  at.end_line("two points and an angle");
  if (norm(subtract(turn.b, turn.a)) == 0.0)
    at.fail("an axis from a point to itself", "two points", "The instance turns about the line from a to b.");
  placement.turn = turn;
  return placement;
}

class Unfolding {
 public:
  explicit Unfolding(const Deck& deck) : deck_(deck) { result_.scopes.push_back({}); }

  Statements run() {
    for (const DeckKeyword& keyword : deck_.keywords) take(keyword);
    for (const DeckKeyword* open : {part_, instance_})
      if (open != nullptr)
        open->fail("no end", fmt::format("*END {} after it", open->name), "The file may have been cut off.");
    if (!parts_.empty() && result_.scopes.size() == 1)
      parts_.begin()->second.front()->fail("a part without an instance", "*INSTANCE in an *ASSEMBLY",
                                           "Parts are in the model where instances put them.");
    return std::move(result_);
  }

 private:
  using Keywords = std::vector<const DeckKeyword*>;

  void take(const DeckKeyword& keyword) {
    if (keyword.name == "PART") return begin_part(keyword);
    if (keyword.name == "INSTANCE") return begin_instance(keyword);
    if (keyword.name == "END PART") return end(keyword, part_);
    if (keyword.name == "END INSTANCE") {
      end(keyword, instance_);
      scope_ = 0;
      return;
    }
    if (keyword.name == "ASSEMBLY" || keyword.name == "END ASSEMBLY") return;
    if (part_ != nullptr)
      parts_[part_name_].push_back(&keyword);
    else
      result_.list.push_back({&keyword, scope_});
  }

  void begin_part(const DeckKeyword& keyword) {
    refuse_within(keyword);
    part_name_ = keyword.required("NAME");
    if (!parts_.emplace(part_name_, Keywords{&keyword}).second)
      keyword.fail("the part " + part_name_ + " a second time", "a name of its own");
    part_ = &keyword;
  }

  void begin_instance(const DeckKeyword& keyword) {
    refuse_within(keyword);
    const std::string name = keyword.required("NAME");
    const auto part = parts_.find(keyword.required("PART"));
    if (part == parts_.end())
      keyword.fail(fmt::format("the unknown part {}", keyword.required("PART")), "the NAME of a *PART before it");
    if (result_.instance(name) >= 0) keyword.fail("the instance " + name + " a second time", "a name of its own");
    scope_ = static_cast<int>(result_.scopes.size());
    result_.scopes.push_back({name + ".", placement_of(keyword)});
    instance_ = &keyword;
    for (std::size_t i = 1; i < part->second.size(); ++i) result_.list.push_back({part->second[i], scope_});
  }

  void refuse_within(const DeckKeyword& keyword) const {
    const DeckKeyword* open = part_ != nullptr ? part_ : instance_;
    if (open != nullptr)
      keyword.fail(fmt::format("*{} within the *{} of line {}", keyword.name, open->name, open->where.line),
                   fmt::format("*END {} before it", open->name));
  }

  static void end(const DeckKeyword& keyword, const DeckKeyword*& open) {
    if (open == nullptr)
      keyword.fail("an end without a beginning", fmt::format("*{} before it", keyword.name.substr(4)));
    open = nullptr;
  }

  const Deck& deck_;
  Statements result_;
  std::map<std::string, Keywords> parts_;  ///< the first keyword is *PART itself
  std::string part_name_;
  const DeckKeyword *part_ = nullptr, *instance_ = nullptr;
  int scope_ = 0;
};

}  // namespace

/// Rodrigues' formula.
Vec3 Placement::of(const Vec3& x) const {
  const Vec3 shifted = add(x, shift);
  if (!turn) return shifted;
  const double angle = turn->degrees * std::numbers::pi / 180.0;
  const Vec3 axis = normalized(subtract(turn->b, turn->a)), r = subtract(shifted, turn->a);
  const Vec3 turned = add(add(scaled(r, std::cos(angle)), scaled(cross(axis, r), std::sin(angle))),
                          scaled(axis, dot(axis, r) * (1.0 - std::cos(angle))));
  return add(turn->a, turned);
}

int Statements::instance(const std::string& name) const {
  const auto found =
      std::find_if(scopes.begin() + 1, scopes.end(), [&](const DeckScope& s) { return s.prefix == name + "."; });
  return found == scopes.end() ? -1 : static_cast<int>(found - scopes.begin());
}

Statements statements_of(const Deck& deck) {
  return Unfolding(deck).run();
}

}  // namespace carom
