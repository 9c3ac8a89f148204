// *BOUNDARY, *CLOAD, *DLOAD and *DSLOAD over all steps as supports, loads and functions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "math/vec3.hpp"
#include "translate/amplitudes.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

const std::array<const char*, 3> kAxisNames{"x", "y", "z"};

/// One thing that acts: a component of a support or force, a pressure, gravity.
struct Acting {
  std::string keyword, group;
  std::string what;   ///< "displacement", "velocity", "acceleration", "force", "pressure", "gravity"
  int component = 0;  ///< 3 to 5: about the axes
  Vec3 direction{};   ///< of gravity
  Location where;
  std::vector<Action> actions;
  const DeckKeyword* source = nullptr;  ///< the first keyword that says it
  DeckRigidBody* body = nullptr;        ///< the one whose reference node is imposed
};

/// The cells and the point masses that gravity of one size is given to in a step, line by line.
struct GravityCells {
  const DeckKeyword* keyword = nullptr;
  Location where;
  std::set<CellRef> cells;
  std::set<Index> masses;  ///< by their nodes
  bool is_everywhere = false;
};

class Actions {
 public:
  explicit Actions(Translation& t) : t_(t), amplitudes_(amplitudes_of(t.statements, t.errors)) {}

  void run() {
    for (std::size_t i = 0; i < t_.statements.list.size(); ++i) {
      const Statement& s = t_.statements.list[i];
      const std::string& name = s.keyword->name;
      t_.errors.attempt([&] {
        if (name == "BOUNDARY") each_line(s, i, &Actions::boundary);
        if (name == "CLOAD") each_line(s, i, &Actions::force);
        if (name == "DLOAD") each_line(s, i, &Actions::distributed);
        if (name == "DSLOAD") each_line(s, i, &Actions::surface_pressure);
      });
    }
    remove_replaced();
    if (!gravity_.empty()) refuse_partial_gravity();
    for (const Acting& acting : all_) t_.errors.attempt([&] { write(acting); });
    for (const Led& led : led_)
      if (!led.acting.body->is_guided()) write_support(led.acting, led.size, led.function);
  }

 private:
  using Line = void (Actions::*)(DeckCursor&, const Statement&, std::size_t);

  void each_line(const Statement& s, std::size_t i, Line line) {
    const std::string* amplitude = s.keyword->parameter("AMPLITUDE");
    amplitude_ = nullptr;
    keyword_ = s.keyword;
    if (amplitude != nullptr) {
      const auto found = amplitudes_.find(upper_case(*amplitude));
      if (found == amplitudes_.end())
        s.keyword->fail("the unknown amplitude " + *amplitude, "the NAME of an *AMPLITUDE");
      amplitude_ = &found->second;
    }
    const std::size_t step = step_at(i);
    const std::string* op = s.keyword->parameter("OP");
    if (op != nullptr && upper_case(*op) == "NEW") renewed_.insert({s.keyword->name, step});
    for (DeckCursor at(*s.keyword); at.next_line();) t_.errors.attempt([&] { (this->*line)(at, s, step); });
  }

  /// What stands before all steps holds from the first one on.
  std::size_t step_at(std::size_t statement) const {
    for (std::size_t k = 0; k < t_.steps.size(); ++k)
      if (statement > t_.steps[k].begin && statement < t_.steps[k].end) return k;
    return 0;
  }

  void act(const DeckCursor& at, const Acting& wanted, std::size_t step, double value) {
    const std::string kind = wanted.keyword == "BOUNDARY" ? "" : wanted.what;
    const auto [place, is_new] =
        places_.emplace(Key{wanted.keyword + kind, wanted.group, wanted.component, wanted.direction}, all_.size());
    if (is_new) {
      all_.push_back(wanted);
      all_.back().source = keyword_;
    }
    Acting* const found = &all_[place->second];
    if (found->what != wanted.what) {
      const bool rests =
          std::all_of(found->actions.begin(), found->actions.end(), [](const Action& a) { return a.value == 0.0; });
      if (!rests) at.fail(fmt::format("{} where {} is imposed", wanted.what, found->what), "one kind of motion");
      found->what = wanted.what;
    }
    if (found->body != nullptr && value != 0.0) found->where = wanted.where;
    if (!found->actions.empty() && found->actions.back().step == step) {
      // Of motions the last counts, as of a set and then of a node of it.
      const double earlier = found->actions.back().value;
      const bool may_stand = wanted.keyword == "BOUNDARY" || (wanted.what == "gravity" && value == earlier);
      if (!may_stand)
        at.fail(fmt::format("this load of {} a second time in its step: {:g} after {:g}",
                            wanted.group.empty() ? "all" : wanted.group, value, earlier),
                "each load once", "Where both act, write their sum, or give one a set of its own.");
      found->actions.pop_back();
    }
    found->actions.push_back({step, value, amplitude_, false});
  }

  void boundary(DeckCursor& at, const Statement& s, std::size_t step) {
    const std::string target(at.field());
    const std::string group = t_.node_group(at, s, target);
    const std::string* type = s.keyword->parameter("TYPE");
    const std::string what = type == nullptr ? "DISPLACEMENT" : upper_case(*type);
    if (what != "DISPLACEMENT" && what != "VELOCITY" && what != "ACCELERATION")
      s.keyword->fail("TYPE=" + what, "DISPLACEMENT, VELOCITY or ACCELERATION");
    const std::string first = upper_case(at.field());
    for (const int dof : named_components(at, first)) impose(at, group, dof, "DISPLACEMENT", step, 0.0, true);
    if (!as_integer(first)) return;
    const auto from = static_cast<int>(*as_integer(first));
    const std::string_view end = at.field();
    const int to = end.empty() ? from : component(at, end);
    const double value = at.real_or(0.0, "the value");
    at.end_line("nodes, first and last degree of freedom, value");
    constexpr int temperature = 11;
    if (from == temperature && to == from)
      return t_.findings.refuse(*s.keyword, at.where(), "an imposed temperature",
                                "It would be left out: nodes have no temperatures.");
    if (from < 1 || to < from || to > 6)
      at.fail(fmt::format("degrees of freedom {} to {}", from, to), "1 to 3, or 1 to 6 with those of turning");
    for (int dof = from; dof <= to; ++dof) impose(at, group, dof, what, step, value, false);
  }

  static int component(const DeckCursor& at, std::string_view text) {
    const auto number = as_integer(text);
    if (!number || *number < 1 || *number > 100) at.fail(fmt::format("\"{}\"", text), "a degree of freedom");
    return static_cast<int>(*number);
  }

  /// Of ENCASTRE and the like.
  static std::vector<int> named_components(const DeckCursor& at, const std::string& name) {
    if (as_integer(name)) return {};
    static const std::map<std::string, std::vector<int>> names{{"ENCASTRE", {1, 2, 3, 4, 5, 6}},
                                                               {"PINNED", {1, 2, 3}},
                                                               {"XSYMM", {1, 5, 6}},
                                                               {"YSYMM", {2, 4, 6}},
                                                               {"ZSYMM", {3, 4, 5}},
                                                               {"XASYMM", {2, 3, 4}},
                                                               {"YASYMM", {1, 3, 5}},
                                                               {"ZASYMM", {1, 2, 6}}};
    const auto found = names.find(name);
    if (found == names.end())
      at.fail(fmt::format("\"{}\"", name), "a degree of freedom, ENCASTRE, PINNED, XSYMM, XASYMM or those of y and z",
              "U1 to U3 are 1 to 3, UR1 to UR3 are 4 to 6.");
    return found->second;
  }

  void impose(const DeckCursor& at, const std::string& group, int dof, const std::string& what, std::size_t step,
              double value, bool is_named) {
    static const std::map<std::string, std::string> keys{
        {"DISPLACEMENT", "displacement"}, {"VELOCITY", "velocity"}, {"ACCELERATION", "acceleration"}};
    if (DeckRigidBody* const body = turned_by(t_, group)) {
      if (dof > 3) at.fail(fmt::format("degree of freedom {} of a ROT NODE", dof), "1, 2 or 3: turns about the axes");
      return act(at, {"BOUNDARY", body->node, keys.at(what), dof + 2, {}, at.where(), {}, nullptr, body}, step, value);
    }
    Acting wanted{"BOUNDARY", group, keys.at(what), dof - 1, {}, at.where(), {}, nullptr, nullptr};
    const Referred of = referred_to(t_, group);
    for (DeckRigidBody* body : of.bodies) {
      Acting on_body = wanted;
      on_body.group = body->node;
      on_body.body = body;
      act(at, on_body, step, value);
    }
    if (!of.has_others) return;
    if (dof <= 3) return act(at, wanted, step, value);
    if (value != 0.0)
      at.fail(fmt::format("a turn of degree of freedom {}", dof), "1, 2 or 3",
              "Nodes do not turn, but for those that a *RIGID BODY refers to.");
    if (!is_named) t_.findings.note(at.where(), fmt::format("degree of freedom {}: nodes do not turn", dof));
  }

  void force(DeckCursor& at, const Statement& s, std::size_t step) {
    const std::string target(at.field());
    const std::string group = t_.node_group(at, s, target);
    const int dof = component(at, at.field());
    for (const DeckRigidBody* body : referred_to(t_, group).bodies)
      if (body->is_obstacle())
        at.fail(
            "a force on the reference node of the rigid surface " + body->name, "forces on bodies",
            "A rigid surface is led, or moves as contact and gravity push it; a *RIGID BODY of solids takes forces.");
    if (dof > 3) at.fail(fmt::format("degree of freedom {}", dof), "1, 2 or 3", "Nodes of solids take no moments.");
    act(at, {"CLOAD", group, "force", dof - 1, {}, at.where(), {}}, step, at.real("the force"));
    at.end_line("nodes, degree of freedom, force");
  }

  void distributed(DeckCursor& at, const Statement& s, std::size_t step) {
    const std::string target = deck_name(at.field()), label = upper_case(at.field());
    if (label == "GRAV") return gravity(at, s, step, target);
    const std::string key = key_of(t_.mesh.names.loaded_faces, t_.scope(s), target + " " + label);
    if (key.empty()) {
      t_.findings.refuse(*s.keyword, at.where(), "a load of kind " + label, "It would be left out.");
      return;
    }
    act(at, {"DLOAD", t_.mesh.names.loaded_faces.at(key), "pressure", 0, {}, at.where(), {}}, step,
        at.real("the pressure"));
  }

  void gravity(DeckCursor& at, const Statement& s, std::size_t step, const std::string& target) {
    const double size = at.real("the acceleration");
    Vec3 direction{};
    for (double& c : direction) c = at.real_or(0.0, "the direction");
    if (norm(direction) == 0.0) at.fail("no direction", "three components");
    GravityCells& on = gravity_[{step, size, normalized(direction)}];
    if (on.keyword == nullptr) on = {s.keyword, at.where(), {}, {}, false};
    on.is_everywhere = on.is_everywhere || target.empty();
    if (!target.empty()) {
      const DeckNames& names = t_.mesh.names;
      const std::string cells = key_of(names.element_sets, t_.scope(s), target);
      const std::string masses = key_of(names.masses, t_.scope(s), target);
      if (cells.empty() && masses.empty())
        at.fail("\"" + target + "\"", "the name of a set of cells, or nothing for all of them");
      if (!cells.empty())
        for (const DeckNames::Cells& each : names.element_sets.at(cells)) {
          const std::vector<CellRef>& refs = t_.mesh.mesh.cell_groups.at(each.group);
          on.cells.insert(refs.begin(), refs.end());
        }
      if (!masses.empty()) add_nodes_of(names.masses.at(masses), on.masses);
    }
    act(at, {"DLOAD", "", "gravity", 0, normalized(direction), at.where(), {}}, step, size);
  }

  /// Carom's gravity acts on all parts.
  void refuse_partial_gravity() {
    const std::set<CellRef> bodies = t_.body_cells();
    std::set<Index> masses;
    for (const auto& [set, group] : t_.mesh.names.masses) add_nodes_of(group, masses);
    for (const auto& [key, on] : gravity_) {
      if (on.is_everywhere) continue;
      if (!std::ranges::includes(on.cells, bodies))
        t_.findings.refuse(*on.keyword, on.where, "gravity on some cells only", "It would act on all parts.");
      else if (!std::ranges::includes(on.masses, masses))
        t_.findings.refuse(*on.keyword, on.where, "gravity on cells and not on all point masses",
                           "It would act on these, too.");
    }
  }

  void add_nodes_of(const std::string& group, std::set<Index>& to) const {
    const std::vector<Index>& nodes = t_.mesh.mesh.node_groups.at(group);
    to.insert(nodes.begin(), nodes.end());
  }

  void surface_pressure(DeckCursor& at, const Statement& s, std::size_t step) {
    const std::string target(at.field()), label = upper_case(at.field());
    const std::string key = key_of(t_.mesh.names.surfaces, t_.scope(s), target);
    if (key.empty()) at.fail("\"" + target + "\"", "the NAME of a *SURFACE");
    if (label != "P") {
      t_.findings.refuse(*s.keyword, at.where(), "a load of kind " + label, "It would be left out.");
      return;
    }
    act(at, {"DSLOAD", t_.mesh.names.surfaces.at(key).group, "pressure", 0, {}, at.where(), {}}, step,
        at.real("the pressure"));
  }

  /// OP=NEW ends what the step does not say again.
  void remove_replaced() {
    for (const auto& [keyword, step] : renewed_)
      for (Acting& acting : all_) {
        if (acting.keyword != keyword || acting.actions.front().step >= step) continue;
        const bool is_said = std::any_of(acting.actions.begin(), acting.actions.end(),
                                         [step = step](const Action& a) { return a.step == step; });
        if (is_said) continue;
        if (keyword == "BOUNDARY") {
          t_.findings.refuse(*acting.source, t_.steps[step].step->where, "OP=NEW lets go of " + acting.group,
                             "Carom's supports hold for the whole run.");
          continue;
        }
        const auto after = std::find_if(acting.actions.begin(), acting.actions.end(),
                                        [step = step](const Action& a) { return a.step > step; });
        acting.actions.insert(after, {step, 0.0, nullptr, true});
      }
  }

  void write(const Acting& acting) {
    const Points points = history(acting.actions, t_.steps);
    double size = 0.0;
    for (const auto& [time, value] : points)
      if (std::abs(value) > std::abs(size)) size = value;
    const bool is_support = acting.keyword == "BOUNDARY";
    if (is_support && acting.actions.front().step > 0)
      t_.findings.refuse(*acting.source, acting.where, "a support that begins with a later step",
                         "Carom's supports hold for the whole run.");
    if (acting.what == "displacement")
      if (const auto jump = first_jump(points, t_.steps))
        throw CaseError(acting.where, "*BOUNDARY",
                        fmt::format("a displacement of {} that jumps at t = {:g}", acting.group, *jump),
                        "one that grows, from 0 or from where the step before it ended",
                        "Nodes cannot jump: let it grow by an AMPLITUDE, or say TYPE=VELOCITY.");
    if (acting.body != nullptr && acting.body->is_obstacle()) return move_rigid(*acting.body, acting, points);
    if (size == 0.0 && !is_support) return t_.findings.note(acting.where, "a load of 0: left out");
    std::string function;
    const bool is_constant = std::all_of(points.begin(), points.end(), [&](const auto& p) { return p.second == size; });
    if (!is_constant && size != 0.0) function = function_of(acting, points, size);
    if (acting.body != nullptr)
      lead_rigid(*acting.body, acting, size, function);
    else if (is_support)
      write_support(acting, size, function);
    else
      write_load(acting, size, function);
  }

  /// All nodes of a body of cells or nodes go along, unless translate_rigid_parts gives it a guide.
  void lead_rigid(DeckRigidBody& body, const Acting& acting, double size, const std::string& function) {
    body.motion.at(static_cast<std::size_t>(acting.component)) = DeckRigidBody::Motion{size, function, acting.where};
    if (acting.component >= 3) return;
    led_.push_back({acting, size, function});
    led_.back().acting.group = body.group;
  }

  /// A rigid surface is moved by its velocity: that of a displacement is the slope of its polygon.
  void move_rigid(DeckRigidBody& body, const Acting& acting, Points points) {
    if (acting.what == "acceleration")
      fail_at(acting, "an imposed acceleration of the reference node of a rigid body", "its velocity or displacement");
    if (acting.what == "displacement") points = slopes(acting, points);
    double size = 0.0;
    for (const auto& [time, value] : points)
      if (std::abs(value) > std::abs(size)) size = value;
    const bool is_constant = std::all_of(points.begin(), points.end(), [&](const auto& p) { return p.second == size; });
    body.motion.at(static_cast<std::size_t>(acting.component)) =
        DeckRigidBody::Motion{size, is_constant || size == 0.0 ? "" : function_of(acting, points, size), acting.where};
  }

  [[noreturn]] static void fail_at(const Acting& acting, const std::string& found, const std::string& expected) {
    throw CaseError(acting.where, "*" + acting.keyword, found, expected);
  }

  static Points slopes(const Acting& acting, const Points& points) {
    Points result;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double dt = points[i].first - points[i - 1].first, du = points[i].second - points[i - 1].second;
      if (dt == 0.0) {
        if (du != 0.0) fail_at(acting, "a displacement of the reference node that jumps", "one that grows");
        continue;
      }
      result.emplace_back(points[i - 1].first, du / dt);
      result.emplace_back(points[i].first, du / dt);
    }
    const bool starts_elsewhere = !points.empty() && points.front().second != 0.0;
    if (starts_elsewhere) fail_at(acting, "a displacement of the reference node that jumps", "one that grows from 0");
    if (!result.empty()) result.emplace_back(points.back().first, 0.0);  // stays where it is
    return result;
  }

  /// Up to round-off: multiples of one amplitude are one function.
  static bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr double round_off = 1e-12;  // of slopes up to 1, between points of a table
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return std::abs(x - y) < round_off; });
  }

  std::string function_of(const Acting& acting, const Points& points, double size) {
    std::vector<double> times, values;
    for (const auto& [time, value] : points) {
      times.push_back(time);
      values.push_back(value / size + 0.0);  // no -0
    }
    for (const auto& [name, known] : functions_)
      if (known.first == times && are_equal(known.second, values)) return name;
    const Amplitude* amplitude = acting.actions.front().amplitude;
    std::string name = amplitude != nullptr ? amplitude->keyword->required("NAME") : "steps";
    for (int k = 2; functions_.count(name) != 0; ++k)
      name = fmt::format("{} {}", amplitude != nullptr ? amplitude->keyword->required("NAME") : "steps", k);
    functions_[name] = {times, values};
    const Location& where = amplitude != nullptr ? amplitude->keyword->where : acting.where;
    TableMaker table(where);
    table.add("time", numbers_node(times, where)).add("value", numbers_node(values, where));
    t_.define("functions", name, table.node());
    return name;
  }

  void write_support(const Acting& acting, double size, const std::string& function) {
    const std::string axis = kAxisNames.at(static_cast<std::size_t>(acting.component));
    TableMaker support(acting.where);
    support.text("nodes", acting.group);
    if (size == 0.0) {
      support.add("blocked", texts_node({axis}, acting.where));
    } else {
      TableMaker motion(acting.where);
      motion.number(axis, size);
      if (!function.empty()) motion.text("function", function);
      support.add(acting.what, motion.node());
    }
    t_.append("support", support.node());
  }

  void write_load(const Acting& acting, double size, const std::string& function) {
    TableMaker load(acting.where);
    if (acting.what == "force") {
      Vec3 vector{};
      vector.at(static_cast<std::size_t>(acting.component)) = size;
      load.vector("force", vector).text("group", acting.group);
    } else if (acting.what == "pressure") {
      load.number("pressure", size).text("group", acting.group);
    } else {
      load.vector("gravity", scaled(acting.direction, size));
    }
    if (!function.empty()) load.text("function", function);
    t_.append("load", load.node());
  }

  using Key = std::tuple<std::string, std::string, int, Vec3>;

  Translation& t_;
  std::map<Key, std::size_t> places_;  ///< in all_
  std::map<std::tuple<std::size_t, double, Vec3>, GravityCells> gravity_;
  std::map<std::string, Amplitude> amplitudes_;
  const Amplitude* amplitude_ = nullptr;
  const DeckKeyword* keyword_ = nullptr;  ///< at hand
  std::vector<Acting> all_;
  /// What is imposed on bodies of cells or nodes along an axis.
  struct Led {
    Acting acting;
    double size = 0.0;
    std::string function;
  };
  std::vector<Led> led_;
  std::set<std::pair<std::string, std::size_t>> renewed_;
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> functions_;
};

}  // namespace

void translate_actions(Translation& t) {
  Actions(t).run();
}

}  // namespace carom
