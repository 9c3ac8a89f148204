#include "casefile/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "casefile/document.hpp"

namespace carom {

namespace {

/// Orders of magnitude in SI between which a quantity of engineering is taken for plausible.
struct Plausible {
  Dimension dimension;
  const char* what;
  double low, high;
  const char* example;
  double example_value;
};

// Polymer foam to tungsten and osmium (22600 kg/m3); soft gel to diamond (1.2e12 Pa); sound in rubber foam to diamond
// (axial wave about 1.75e4 m/s); impacts beyond 5 km/s need laws of state, not elasticity.
constexpr Plausible density{Dimension::density, "density", 50.0, 25000.0, "steel", 7850.0};
constexpr Plausible modulus{Dimension::stress, "Young's modulus", 1e5, 1.5e12, "steel", 2.1e11};
constexpr Plausible wave_speed{Dimension::velocity, "wave speed sqrt(E/rho)", 10.0, 15000.0, "steel", 5170.0};
constexpr Plausible speed{Dimension::velocity, "speed", 0.0, 5000.0, "sound in steel", 5170.0};

bool within(double value, const Plausible& range, UnitSystem units) {
  const double in_si = value * si_factor(range.dimension, units);
  return in_si >= range.low && in_si <= range.high;
}

/// Do these properties make sense together in this unit system?
bool plausible(const CaseMaterial& m, UnitSystem units) {
  const double E = m.made().at_rest().E;
  return within(*m.rho, density, units) && within(E, modulus, units) &&
         within(std::sqrt(E / *m.rho), wave_speed, units);
}

std::string place(const Location& where) {
  return to_string({where.file, where.line, 0});
}

class Lint {
 public:
  explicit Lint(const Case& given) : case_(given) {}

  std::vector<std::string> run(std::vector<UnitSign> further) {
    for (const CaseMaterial& m : case_.materials) check_material(m);
    check_speeds();
    for (const CaseLoad& load : case_.loads) check_gravity(load);
    say_signs(std::move(further));
    check_twice();
    for (const CaseContact& contact : case_.contacts) {
      check_friction(contact);
      check_restitution(contact);
    }
    check_scheme();
    check_use();
    return std::move(lines_);
  }

 private:
  void say(const Location& where, const std::string& text) { lines_.push_back(place(where) + ": " + text); }

  void show(const Location& where, std::string what, std::string cure, std::optional<UnitSystem> fits = {}) {
    signs_.push_back({where, std::move(what), std::move(cure), fits});
  }

  /// One cause is said once, with everything that shows it.
  void say_signs(std::vector<UnitSign> further) {
    const auto is_same = [](const UnitSign& a, const UnitSign& b) {
      return a.fits ? a.fits == b.fits : a.cure == b.cure;
    };
    std::vector<std::vector<UnitSign>> groups;
    for (UnitSign& sign : signs_) {
      const auto known = std::ranges::find_if(groups, [&](const auto& group) { return is_same(group.front(), sign); });
      (known != groups.end() ? *known : groups.emplace_back()).push_back(std::move(sign));
    }
    const bool is_shown = !groups.empty();
    for (UnitSign& sign : further) (is_shown ? groups.front() : groups.emplace_back()).push_back(std::move(sign));
    for (const std::vector<UnitSign>& group : groups) say_group(group);
  }

  void say_group(const std::vector<UnitSign>& group) {
    const UnitSign& first = group.front();
    if (group.size() == 1) return say(first.where, first.what + "; " + first.cure);
    std::string list;
    for (const UnitSign& sign : group)
      list += fmt::format("{}{} (line {})", list.empty() ? "" : "; ", sign.what, sign.where.line);
    const std::string cure = first.fits ? fmt::format("did you mean units = {} instead of {}?",
                                                      toml_string(name(*first.fits)), toml_string(name(case_.units)))
                                        : first.cure;
    say(first.where, fmt::format("{} {} values show it: {}", cure, group.size(), list));
  }

  std::string with_unit(double value, Dimension dimension) const {
    return fmt::format("{:.4g} {}", value, unit_name(dimension, case_.units));
  }

  std::string did_you_mean(UnitSystem other) const {
    return fmt::format("did you mean units = {}?", toml_string(name(other)));
  }

  void check_material(const CaseMaterial& m) {
    check_poisson(m);
    if (m.damage && m.damage->D3 > 0.0)
      say(m.where,
          fmt::format("materials.{}: D3 = {:g} of the damage lets tension break later than compression; the d3 "
                      "of Abaqus has the other sign, is it one?",
                      toml_key(m.name), m.damage->D3));
    if (plausible(m, case_.units)) return;
    Hint hint;
    for (const UnitSystem other : unit_systems) {
      if (other != case_.units && plausible(m, other))
        hint = {fmt::format("it would fit {}: {}", name(other), did_you_mean(other)), other};
    }
    if (!hint.fits) hint.cure = mixed_units_hint(m);
    const double E = m.made().at_rest().E;
    const Location& where = m.place_of("E");
    const bool is_said = check_value(m, m.rho.where, *m.rho, density, hint);
    if (!check_value(m, where, E, modulus, hint) && !is_said)
      check_value(m, where, std::sqrt(E / *m.rho), wave_speed, hint);
  }

  struct Hint {
    std::string cure{};
    std::optional<UnitSystem> fits{};
  };

  /// Is one of the two values in the unit of another system?
  std::string mixed_units_hint(const CaseMaterial& m) const {
    for (const UnitSystem other : unit_systems) {
      const double E_factor = si_factor(Dimension::stress, other) / si_factor(Dimension::stress, case_.units);
      const double rho_factor = si_factor(Dimension::density, other) / si_factor(Dimension::density, case_.units);
      CaseMaterial with_E = m;
      with_E.values["E"].value *= E_factor;
      if (plausible(with_E, case_.units)) return fmt::format("is E in {}?", unit_name(Dimension::stress, other));
      CaseMaterial with_rho = m;
      with_rho.rho.value *= rho_factor;
      if (plausible(with_rho, case_.units)) return fmt::format("is rho in {}?", unit_name(Dimension::density, other));
    }
    return "";
  }

  /// True where something was found.
  bool check_value(const CaseMaterial& m, const Location& where, double value, const Plausible& range,
                   const Hint& hint) {
    if (within(value, range, case_.units)) return false;
    const double ratio = value * si_factor(range.dimension, case_.units) / range.example_value;
    const std::string distance =
        ratio < 1.0 ? fmt::format("{:.2g} times below", 1.0 / ratio) : fmt::format("{:.2g} times above", ratio);
    const std::string what = fmt::format("materials.{}: {} {} is {} that of {}", toml_key(m.name), range.what,
                                         with_unit(value, range.dimension), distance, range.example);
    if (hint.cure.empty())
      say(where, what + "; is it meant?");
    else
      show(where, what, hint.cure, hint.fits);
    return true;
  }

  void check_speed(const Location& where, const std::string& key, double value) {
    if (within(value, speed, case_.units)) return;
    std::optional<UnitSystem> fits;
    for (const UnitSystem other : unit_systems) {
      const bool materials_fit = std::all_of(case_.materials.begin(), case_.materials.end(),
                                             [other](const CaseMaterial& m) { return plausible(m, other); });
      if (other != case_.units && within(value, speed, other) && materials_fit) fits = other;
    }
    const std::string what =
        fmt::format("{}: {} is {:.4g} m/s, faster than elastic impact makes sense", key,
                    with_unit(value, Dimension::velocity), value * si_factor(Dimension::velocity, case_.units));
    if (fits)
      show(where, what, did_you_mean(*fits), fits);
    else
      say(where, what);
  }

  void check_speeds() {
    const auto check_initial = [this](const std::vector<CaseInitial>& list, const char* key) {
      for (const CaseInitial& initial : list) {
        if (!initial.velocity) continue;
        const Vec3& v = *initial.velocity;
        check_speed(initial.where, key, std::hypot(v[0], v[1], v[2]));
      }
    };
    check_initial(case_.initial, "initial.velocity");
    for (const CaseStage& stage : case_.stages) check_initial(stage.initial, "stage.initial.velocity");
    for (const CaseSupport& support : case_.supports) {
      for (const CaseSupport::Motion& motion : support.motions) {
        if (motion.kind != MotionKind::velocity) continue;
        check_speed(motion.amplitude.where, "support.velocity", std::abs(*motion.amplitude));
      }
    }
  }

  /// Is the magnitude that of the earth's gravity in another unit system, and not in this one?
  void check_gravity(const CaseLoad& load) {
    if (load.kind != CaseLoad::Kind::gravity) return;
    const double value = std::hypot(load.vector[0], load.vector[1], load.vector[2]);
    const auto is_earth = [value](UnitSystem units) {
      constexpr double loosely = 0.02;  // 9.81, 9.8 and 10 are all meant as g
      return std::abs(value * si_factor(Dimension::acceleration, units) / standard_gravity - 1.0) <= loosely;
    };
    if (is_earth(case_.units)) return;
    for (const UnitSystem other : unit_systems) {
      if (!is_earth(other)) continue;
      const double here = standard_gravity / si_factor(Dimension::acceleration, case_.units);
      const std::string what = fmt::format("load.gravity: {} is the earth's gravity in {}, but in {} that is {}",
                                           with_unit(value, Dimension::acceleration), name(other), name(case_.units),
                                           with_unit(here, Dimension::acceleration));
      const bool is_of_all = std::ranges::any_of(signs_, [&](const UnitSign& sign) { return sign.fits == other; });
      if (is_of_all)
        show(load.where, what, did_you_mean(other), other);
      else
        say(load.where, what);
      return;
    }
  }

  /// Loads that act twice in the same way.
  void check_twice() {
    const auto group = [](const CaseLoad& load) { return load.group ? **load.group : std::string{}; };
    const auto function = [](const CaseLoad& load) { return load.function ? **load.function : std::string{}; };
    for (std::size_t j = 1; j < case_.loads.size(); ++j) {
      const CaseLoad& second = case_.loads[j];
      for (std::size_t i = 0; i < j; ++i) {
        const CaseLoad& first = case_.loads[i];
        if (first.kind != second.kind || group(first) != group(second) || function(first) != function(second) ||
            first.vector != second.vector || first.pressure != second.pressure)
          continue;
        say(second.where,
            fmt::format("load: the same as that of line {}, and it counts twice; is it meant?", first.where.line));
      }
    }
  }

  /// Dry friction of engineering surfaces is below 1.5, of rubber on rough ground and clean metals in vacuum about 2
  /// (B. Bhushan, Principles and Applications of Tribology, 2013, chapter 5).
  void check_friction(const CaseContact& contact) {
    constexpr double most = 2.0;
    const CaseContactLaw* law = contact.law();
    if (law == nullptr || law->friction <= most) return;
    say(contact.where,
        fmt::format("contact \"{}\": a friction of {:g} is more than dry surfaces have (2 at most); is it "
                    "an angle in degrees, or in percent?",
                    *contact.name, law->friction));
  }

  /// A block of 2 x 2 x 2 cells that falls on a plane with 1 m/s by moreau_jean, E = 1 GPa: with 1 it leaves with
  /// 0.345 m/s, with 0 with 0.557 m/s.
  void check_restitution(const CaseContact& contact) {
    const CaseContactLaw* law = contact.law();
    if (law == nullptr || *law->restitution == 0.0) return;
    say(law->restitution.where,
        fmt::format("contact \"{}\": a restitution of {:g} is that of the nodes that touch, not of their bodies: these "
                    "rebound by their own waves, more of them without it, and nodes that are thrown back may make "
                    "energy; leave it out unless single nodes are meant",
                    *contact.name, *law->restitution));
  }

  /// The bulk modulus over the shear modulus is 2 (1 + nu) / (3 (1 - 2 nu)).
  void check_poisson(const CaseMaterial& m) {
    constexpr double most = 0.4999;
    const double nu = m.made().at_rest().nu;
    if (nu <= most) return;
    say(m.place_of("nu"),
        fmt::format("materials.{}: nu = {:g} makes the bulk modulus {:.2g} times the shear modulus: waves and explicit "
                    "steps follow the bulk, solids lock, and rounding grows by as much; rubber has 0.499 and less",
                    toml_key(m.name), nu, 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu))));
  }

  void check_scheme() {
    const CaseScheme& scheme = case_.scheme;
    const auto* newmark = std::get_if<NewmarkParameters>(&scheme.parameters);
    if (newmark == nullptr || newmark->is_stable_for_any_step()) return;
    say(scheme.where, fmt::format("scheme: Newmark with beta = {} and gamma = {} is stable for small steps only; with "
                                  "2 beta >= gamma it is stable for any step",
                                  newmark->beta, newmark->gamma));
  }

  /// What is declared and not used is a name forgotten elsewhere, more often than not.
  void check_use() {
    for (const CaseMaterial& m : case_.materials) {
      const bool used = std::any_of(case_.parts.begin(), case_.parts.end(),
                                    [&m](const CasePart& part) { return *part.material == m.name; });
      if (!used) say(m.where, fmt::format("materials.{}: no part uses it", toml_key(m.name)));
    }
    for (const CaseFunction& f : case_.functions) {
      const auto is_it = [&f](const auto& user) { return user.function && **user.function == f.name; };
      const auto has_it = [&is_it](const CaseSupport& support) {
        return std::any_of(support.motions.begin(), support.motions.end(), is_it);
      };
      const auto moves_by_it = [&is_it, &f](const CaseContact& contact) {
        const CaseObstacle* obstacle = contact.obstacle();
        if (obstacle == nullptr) return false;
        return is_it(*obstacle) || (obstacle->angular_function && **obstacle->angular_function == f.name);
      };
      const bool used = std::any_of(case_.loads.begin(), case_.loads.end(), is_it) ||
                        std::any_of(case_.contacts.begin(), case_.contacts.end(), moves_by_it) ||
                        std::any_of(case_.supports.begin(), case_.supports.end(), has_it);
      if (!used) say(f.where, fmt::format("functions.{}: no load, support or contact uses it", toml_key(f.name)));
    }
  }

  const Case& case_;
  std::vector<UnitSign> signs_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> plausibility_warnings(const Case& given, std::vector<UnitSign> further) {
  return Lint(given).run(std::move(further));
}

}  // namespace carom
