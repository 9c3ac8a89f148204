#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "output/readable_unit.hpp"
#include "report/charts.hpp"
#include "report/html.hpp"
#include "report/place_text.hpp"

namespace carom {

namespace {

constexpr std::size_t kMost = 4;

/// A figure on its way to the list: how much it counts, whose it is, and its weight as text where that is not its
/// value.
struct Weighed {
  KeyFigure figure;
  double weight = 0.0;
  std::string name, weight_text{};
};

/// Names, or some of them and how many there are beside.
std::string listed(const std::vector<const Weighed*>& some) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, some.size()); ++i) text += (i > 0 ? ", " : "") + some[i]->name;
  return some.size() > most ? fmt::format("{} and {} more", text, some.size() - most) : text;
}

/// One figure for what is left out: none is dropped in silence.
KeyFigure others(const std::vector<const Weighed*>& left, std::string_view kind, std::string_view nothing,
                 double negligible) {
  const auto* const largest =
      *std::max_element(left.begin(), left.end(), [](const auto* a, const auto* b) { return a->weight < b->weight; });
  const std::string& most = largest->weight_text.empty() ? largest->figure.value : largest->weight_text;
  return {fmt::format("{}, {} more", kind, left.size()),
          largest->weight > negligible ? "at most " + most : std::string(nothing), listed(left)};
}

/// Those of largest weight, in their order, and what the others are. `nothing`: the value of those that have none.
void keep_largest(const std::vector<Weighed>& all, std::string_view kind, std::string_view nothing,
                  std::vector<KeyFigure>& figures) {
  std::vector<double> weights;
  for (const Weighed& w : all) weights.push_back(w.weight);
  std::sort(weights.rbegin(), weights.rend());
  if (weights.empty()) return;
  const double negligible = kNegligible * weights.front();
  const double least = weights.size() > kMost + 1 ? weights[kMost - 1] : 0.0;  // one more is not worth a line about it
  std::vector<const Weighed*> left;
  std::size_t kept = 0;
  for (const Weighed& w : all) {
    const bool is_kept = w.weight > negligible && w.weight >= least && kept <= kMost;
    if (is_kept) figures.push_back(w.figure);
    if (is_kept) ++kept;
    if (!is_kept) left.push_back(&w);
  }
  if (!left.empty()) figures.push_back(others(left, kind, nothing, negligible));
}

double length(const Vec3& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

std::string time_text(double t, const Units& units) {
  return with_readable_unit(t, units.time, 4);
}

/// Places of the table that have a quantity, e.g. "closed".
std::vector<std::string> places_with(const CsvTable& table, std::string_view quantity) {
  std::vector<std::string> places;
  for (const std::string& column : table.columns) {
    const ColumnName name = parse_column(column);
    if (name.place.empty() || name.quantity != quantity) continue;
    if (places.empty() || places.back() != name.place) places.emplace_back(name.place);
  }
  return places;
}

/// The vector of a place in a row; components that are not there are zero.
Vec3 vector_at(const CsvTable& table, const std::string& place, std::string_view quantity, std::size_t row) {
  Vec3 v{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto* values = table.column(fmt::format("{}.{}_{}", place, quantity, "xyz"[i]));
    if (values != nullptr) v[i] = (*values)[row];
  }
  return v;
}

using Names = std::vector<std::string>;

struct Peak {
  double value = 0.0, time = 0.0;
};

/// The greatest length of a vector at a place.
Peak peak_of(const CsvTable& table, const std::string& place, std::string_view quantity) {
  Peak peak;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double value = length(vector_at(table, place, quantity, row));
    if (value > peak.value) peak = {value, table.values.front()[row]};
  }
  return peak;
}

/// The class of a column of filtered curves, "CFC 1000".
std::string class_of(const CsvTable& filtered, std::string_view column) {
  const std::string begin = std::string(column) + ": SAE J211 ";
  for (const std::string& comment : filtered.comments)
    if (comment.starts_with(begin)) return comment.substr(begin.size());
  return "filtered";
}

/// Places of contact.csv with a quantity that meet something, or those that are tied.
std::vector<std::string> contacts_with(const CsvTable& contact, std::string_view quantity, const Names& ties,
                                       bool are_ties = false) {
  std::vector<std::string> places = places_with(contact, quantity);
  std::erase_if(places,
                [&](const std::string& place) { return (std::ranges::find(ties, place) != ties.end()) != are_ties; });
  return places;
}

/// The impulse of a place up to a time, which is linear between rows; rows are searched from `row` on, which is moved.
Vec3 impulse_at(const CsvTable& contact, const std::string& place, double t, std::size_t& row) {
  const std::vector<double>& time = contact.values.front();
  while (row + 2 < time.size() && time[row + 1] < t) ++row;
  const double width = time[row + 1] - time[row], share = width > 0.0 ? (t - time[row]) / width : 1.0;
  const Vec3 begin = vector_at(contact, place, "impulse", row), end = vector_at(contact, place, "impulse", row + 1);
  Vec3 out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = (1.0 - share) * begin[i] + share * end[i];
  return out;
}

/// The largest force in the mean over so long a time: of the impulse, so that it is exact however the force jumps
/// between rows. Windows begin or end at a row, as the largest of a broken line does. Nothing where rows stand farther
/// apart.
std::optional<double> largest_mean(const CsvTable& contact, const std::string& place, double window) {
  const std::vector<double>& time = contact.values.front();
  if (contact.column(place + ".impulse_x") == nullptr && contact.column(place + ".impulse_z") == nullptr) return {};
  double widest = 0.0, largest = 0.0;
  for (std::size_t row = 1; row < time.size(); ++row) widest = std::max(widest, time[row] - time[row - 1]);
  if (!(window > widest) || !(window < time.back() - time.front())) return {};
  for (const double before : {0.0, window}) {
    std::size_t first = 0, last = 0;
    for (const double t : time) {
      const double begin = t - before, end = begin + window;
      if (begin < time.front() || end > time.back()) continue;
      const Vec3 gone = impulse_at(contact, place, begin, first), come = impulse_at(contact, place, end, last);
      largest = std::max(largest, length({come[0] - gone[0], come[1] - gone[1], come[2] - gone[2]}) / window);
    }
  }
  return largest;
}

/// How long a wave takes through a cell at a contact, or at the one that a pair of parts belongs to; 0: not known.
double crossing_of(const std::optional<Summary>& summary, const std::string& place) {
  if (summary)
    for (const NamedValue& crossing : summary->crossings)
      if (place == crossing.name || place.starts_with(crossing.name + ".")) return crossing.value;
  return 0.0;
}

/// When anything begins to move: the last of the leading times without kinetic energy, such as those of a preload.
double begin_of_motion(const Tables& tables) {
  const auto* kinetic = tables.energy ? tables.energy->column("kinetic") : nullptr;
  if (kinetic == nullptr || kinetic->empty()) return -std::numeric_limits<double>::infinity();
  const auto moving = std::ranges::find_if(*kinetic, [](double energy) { return energy != 0.0; });
  const auto row = std::max<std::ptrdiff_t>(0, moving - kinetic->begin() - 1);
  return tables.energy->values.front()[static_cast<std::size_t>(row)];
}

constexpr std::string_view of_enforcement = "goes with the contact's stiffness or the step, and a cell's ringing";

/// Has nothing kinetic energy? Then time is that of loads alone, and no step makes peaks.
bool is_static(const Tables& tables) {
  const auto* kinetic = tables.energy ? tables.energy->column("kinetic") : nullptr;
  return kinetic != nullptr && !kinetic->empty() && *std::ranges::max_element(*kinetic) == 0.0;
}

/// A force that is no more than its mean over a wave's way through a cell is physical; of any other it is said what
/// it goes with.
std::string remark_on_peak(const CsvTable& contact, const std::string& place, const Peak& peak, double crossing,
                           const Units& units) {
  constexpr double same = 0.05;  // rounded pulses of bodies of several cells
  const std::string when = "at " + time_text(peak.time, units);
  const std::optional<double> mean = largest_mean(contact, place, crossing);
  if (!mean || *mean >= (1.0 - same) * peak.value) return when;
  return fmt::format("{}; at most {} in the mean of {}, a wave's way through a cell: what is above it {}", when,
                     with_readable_unit(*mean, units.force, 4), time_text(crossing, units), of_enforcement);
}

void add_peak_forces(const Tables& tables, const std::optional<Summary>& summary, const Units& units,
                     std::vector<KeyFigure>& figures) {
  const CsvTable& contact = *tables.contact;
  const auto text = [&](double force) { return with_readable_unit(force, units.force, 4); };
  std::vector<Weighed> all;
  for (const std::string& place : contacts_with(contact, "force", tables.ties)) {
    const Peak peak = peak_of(contact, place, "force");
    const std::string column = place + ".force_x";
    if (tables.contact_filtered && tables.contact_filtered->column(column) != nullptr) {
      const Peak filtered = peak_of(*tables.contact_filtered, place, "force");
      all.push_back(
          {{fmt::format("Peak force, {}, {}", place, class_of(*tables.contact_filtered, column)), text(filtered.value),
            fmt::format("at {}; {} unfiltered, which {}", time_text(filtered.time, units), text(peak.value),
                        of_enforcement),
            filtered.value, units.force},
           filtered.value,
           place});
      continue;
    }
    std::string remark = is_static(tables) ? "at " + time_text(peak.time, units)
                                           : remark_on_peak(contact, place, peak, crossing_of(summary, place), units);
    all.push_back(
        {{"Peak force, " + place, text(peak.value), std::move(remark), peak.value, units.force}, peak.value, place});
  }
  if (!all.empty() && std::all_of(all.begin(), all.end(), [](const Weighed& w) { return w.weight == 0.0; })) {
    figures.push_back({"Contact force", "none", "nothing was touched"});
    return;
  }
  keep_largest(all, "Peak force", "none", figures);
}

void add_ties(const CsvTable& contact, const Names& ties, const Units& units, std::vector<KeyFigure>& figures) {
  std::vector<Weighed> all;
  for (const std::string& place : contacts_with(contact, "force", ties, true)) {
    const Peak peak = peak_of(contact, place, "force");
    all.push_back({{"Largest force carried by tie " + place, with_readable_unit(peak.value, units.force, 4),
                    "at " + time_text(peak.time, units), peak.value, units.force},
                   peak.value,
                   place});
  }
  keep_largest(all, "Force of ties", "none", figures);
}

void add_peak_accelerations(const Tables& tables, const Units& units, std::vector<KeyFigure>& figures) {
  if (!tables.probes_filtered || !tables.probes) return;
  std::vector<Weighed> all;
  for (const char* quantity : {"acceleration", "local_acceleration"})
    for (const std::string& place : places_with(*tables.probes_filtered, quantity)) {
      const Peak filtered = peak_of(*tables.probes_filtered, place, quantity),
                 raw = peak_of(*tables.probes, place, quantity);
      const std::optional<double> multiple = multiple_of_g(filtered.value, units);
      const std::string column = fmt::format("{}.{}_x", place, quantity), unit = unit_of_column(units, column),
                        plain = with_readable_unit(filtered.value, unit, 4), g = in_g(filtered.value, units);
      const bool is_local = std::string_view(quantity) == "local_acceleration";
      all.push_back({{fmt::format("Peak {}acceleration, {}, {}", is_local ? "local " : "", place,
                                  class_of(*tables.probes_filtered, column)),
                      g.empty() ? plain : g,
                      fmt::format("{}{}at {}; {} unfiltered", g.empty() ? "" : plain, g.empty() ? "" : ", ",
                                  time_text(filtered.time, units),
                                  g.empty() ? with_readable_unit(raw.value, unit, 4) : in_g(raw.value, units)),
                      multiple.value_or(filtered.value), multiple ? "g" : unit},
                     filtered.value,
                     place});
    }
  keep_largest(all, "Peak acceleration", "none", figures);
}

/// Time with a closed row: an interval between rows of the table counts by half for each of its ends that is closed.
void add_durations(const Tables& tables, const Units& units, std::vector<KeyFigure>& figures) {
  const CsvTable& contact = *tables.contact;
  const double begin = is_static(tables) ? -std::numeric_limits<double>::infinity() : begin_of_motion(tables);
  std::vector<Weighed> all;
  const std::vector<double>& time = contact.values.front();
  for (const std::string& place : contacts_with(contact, "closed", tables.ties)) {
    const std::vector<double>& closed = *contact.column(place + ".closed");
    double sum = 0.0, first = std::numeric_limits<double>::quiet_NaN();
    int touches = 0;
    for (std::size_t row = 0; row < closed.size(); ++row) {
      if (time[row] < begin) continue;
      const bool is_first = row == 0 || time[row - 1] < begin;
      const double before = is_first ? 0.0 : closed[row - 1];
      if (!is_first)
        sum += 0.5 * (time[row] - time[row - 1]) * ((before > 0.0 ? 1.0 : 0.0) + (closed[row] > 0.0 ? 1 : 0));
      if (before > 0.0 || !(closed[row] > 0.0)) continue;
      if (touches++ == 0) first = time[row];
    }
    if (touches == 0) {
      all.push_back({{}, 0.0, place});
      continue;
    }
    std::string remark = "from " + time_text(first, units);
    if (touches > 1) remark += fmt::format(", in {} touches", touches);
    if (closed.back() > 0.0) remark += ", and still closed at the end";
    all.push_back(
        {{"Duration of contact, " + place, time_text(sum, units), std::move(remark), sum, units.time}, sum, place});
  }
  keep_largest(all, "Duration of contact", "never closed", figures);
}

/// Of all touches, from when anything moves until the end; nothing where nothing was touched.
void add_impulses(const Tables& tables, const Units& units, std::vector<KeyFigure>& figures) {
  const CsvTable& contact = *tables.contact;
  const std::vector<double>& time = contact.values.front();
  const auto begun = std::ranges::upper_bound(time, begin_of_motion(tables));
  const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, begun - time.begin() - 1));
  const std::string unit = unit_of(units, Dimension::impulse);
  std::vector<Weighed> all;
  for (const std::string& place : contacts_with(contact, "impulse", tables.ties)) {
    const Vec3 begin = vector_at(contact, place, "impulse", first),
               end = vector_at(contact, place, "impulse", contact.rows() - 1);
    const double impulse = length({end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]});
    all.push_back({{"Impulse, " + place, with_readable_unit(impulse, unit, 4), "of the contact force until the end",
                    impulse, unit},
                   impulse,
                   place});
  }
  if (std::ranges::any_of(all, [](const Weighed& w) { return w.weight > 0.0; }))
    keep_largest(all, "Impulse", "none", figures);
}

/// Whose record it is: "head", "head, local".
std::string record_name(const ShockSummary& shock) {
  return shock.quantity == "acceleration" ? shock.probe : shock.probe + ", local";
}

void add_shock(const Summary& summary, const Units& units, std::vector<KeyFigure>& figures) {
  std::vector<Weighed> injuries, pulses;
  for (const ShockSummary& shock : summary.shock) {
    const std::string of = record_name(shock),
                      filter = shock.cfc > 0.0 ? fmt::format("CFC {:g}", shock.cfc) : std::string("unfiltered");
    const auto interval = [&](double begin, double end) {
      return fmt::format("from {} to {}", time_text(begin, units), time_text(end, units));
    };
    injuries.push_back(
        {{"HIC15, " + of, number_text(shock.hic15, 4),
          fmt::format("{}; HIC36 {}; {}", interval(shock.hic15_begin, shock.hic15_end),
                      shock.hic36 == shock.hic15 ? "is the same"
                                                 : fmt::format("{}, {}", number_text(shock.hic36, 4),
                                                               interval(shock.hic36_begin, shock.hic36_end)),
                      filter),
          shock.hic15},
         shock.hic15,
         of});
    pulses.push_back(
        {{"Shock pulse, " + of, time_text(shock.pulse_end - shock.pulse_begin, units),
          fmt::format("above a tenth of its peak of {} g; velocity change {}; {}", number_text(shock.peak_g, 4),
                      with_readable_unit(shock.velocity_change, unit_of(units, Dimension::velocity), 4), filter),
          shock.pulse_end - shock.pulse_begin, units.time},
         shock.pulse_end - shock.pulse_begin,
         of});
  }
  keep_largest(injuries, "HIC15", "none", figures);
  keep_largest(pulses, "Shock pulse", "none", figures);
}

/// Speeds up to `rounding` are none.
Weighed speed_figure(const std::string& body, const Vec3& begin, const Vec3& end, double rounding, const Units& units) {
  const double least = std::max(rounding, 1e-9 * std::max(length(begin), length(end)));
  const auto speed = [least](const Vec3& v) { return length(v) > least ? length(v) : 0.0; };
  const double before = speed(begin), after = speed(end), ratio = before > 0.0 ? after / before : 0.0;
  const bool is_rebound =
      before > 0.0 && after > 0.0 && begin[0] * end[0] + begin[1] * end[1] + begin[2] * end[2] < 0.0;
  const std::string unit = unit_of_column(units, "velocity");
  const auto text = [&](double v) { return v > 0.0 ? with_readable_unit(v, unit, 4) : std::string("at rest"); };
  std::string remark = text(before) + " at the beginning";
  constexpr double least_ratio = 1e-3, most_ratio = 100.0;  // others say no more than the speeds themselves
  if (ratio >= least_ratio && ratio <= most_ratio) remark += fmt::format(", ratio {:.3g}", ratio);
  if (before > 0.0 && after > 0.0)
    remark += ", velocity change " + text(length({end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]}));
  return {{(is_rebound ? "Rebound speed, " : "Speed at the end, ") + body, text(after), std::move(remark), after, unit},
          std::max(before, after),
          body,
          text(std::max(before, after))};
}

void add_speeds(const Tables& tables, const std::optional<Summary>& summary, const Units& units,
                std::vector<KeyFigure>& figures) {
  std::vector<Weighed> all;
  const double rounding = kNegligible * scales_of(tables, summary).speed;
  if (summary) {
    for (const PartSummary& part : summary->parts)
      all.push_back(speed_figure(part.name, part.velocity_begin, part.velocity_end, rounding, units));
  }
  if (tables.contact && tables.contact->rows() > 0) {
    const CsvTable& table = *tables.contact;
    for (const std::string& place : places_with(table, "velocity")) {
      all.push_back(speed_figure(place, vector_at(table, place, "velocity", 0),
                                 vector_at(table, place, "velocity", table.rows() - 1), rounding, units));
    }
  }
  const bool is_moving = std::any_of(all.begin(), all.end(), [](const Weighed& w) { return w.weight > 0.0; });
  if (is_moving) keep_largest(all, "Speed", "at rest", figures);
}

void add_stress(const Summary& summary, const Units& units, std::vector<KeyFigure>& figures) {
  const StressSummary& stress = summary.stress;
  if (stress.instants == 0 || !(stress.value > 0.0)) return;
  figures.push_back({"Largest von Mises stress", with_readable_unit(stress.value, units.stress, 4),
                     fmt::format("in {}, cell {} at {}, at {}; of {} instants", stress.part, stress.cell,
                                 place_text(stress.position, summary.mesh.reach, units.length),
                                 time_text(stress.time, units), stress.instants),
                     stress.value, units.stress});
}

/// Columns of a table that are components of one quantity at one place.
struct Quantity {
  std::string place, name;
  std::vector<std::size_t> columns;
};

std::vector<Quantity> quantities_of(const CsvTable& table) {
  std::vector<Quantity> found;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const ColumnName column = parse_column(table.columns[c]);
    const auto same = std::find_if(found.begin(), found.end(), [&](const Quantity& q) {
      return q.place == column.place && q.name == column.quantity;
    });
    if (same != found.end())
      same->columns.push_back(c);
    else
      found.push_back({std::string(column.place), std::string(column.quantity), {c}});
  }
  return found;
}

/// The largest magnitude in the rows and what it is: the length of a vector, the component of a tensor that is largest.
std::pair<double, LargestValue> largest_value(const Quantity& quantity, const CsvTable& table, const Units& units) {
  const bool is_vector = quantity.columns.size() <= 3;
  double largest = 0.0;
  std::size_t at = 0, component = quantity.columns.front();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    double squares = 0.0;
    for (const std::size_t c : quantity.columns) {
      const double value = std::abs(table.values[c][row]);
      squares += value * value;
      if (is_vector || !(value > largest)) continue;
      largest = value, at = row, component = c;
    }
    if (!is_vector || !(std::sqrt(squares) > largest)) continue;
    largest = std::sqrt(squares), at = row;
  }
  std::string name = quantity.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const std::string_view axes = parse_column(table.columns[component]).component;
  if (!is_vector || quantity.columns.size() == 1) name += axes.empty() ? "" : fmt::format(" {}", axes);
  const std::string unit = unit_of_column(units, table.columns[component]);
  std::string value = with_readable_unit(largest, unit, 4);
  if (quantity.name.ends_with("acceleration") && quantity.name != "angular_acceleration")
    if (const std::string g = in_g(largest, units); !g.empty()) value += ", " + g;
  return {largest, LargestValue{name, std::move(value), time_text(table.values.front()[at], units), quantity.place,
                                quantity.place, largest, unit}};
}

}  // namespace

std::vector<LargestValue> largest_values(const Tables& tables, const std::optional<Summary>& summary,
                                         const Units& units) {
  std::vector<LargestValue> all;
  const auto add = [&](const std::optional<CsvTable>& table, const auto& is_wanted) {
    if (!table || table->rows() == 0) return;
    std::map<std::string, double> of_kind;
    std::vector<std::pair<double, LargestValue>> found;
    std::vector<std::string> kinds;
    for (const Quantity& quantity : quantities_of(*table)) {
      if (!is_wanted(quantity.name)) continue;
      found.push_back(largest_value(quantity, *table, units));
      kinds.push_back(quantity.name);
      of_kind[quantity.name] = std::max(of_kind[quantity.name], found.back().first);
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].first > kNegligible * of_kind[kinds[i]]) all.push_back(std::move(found[i].second));
  };
  const auto of_contact = [](std::string_view name) { return name == "force" || name == "penetration"; };
  const auto any = [](std::string_view) { return true; };
  const auto add_filtered = [&](const std::optional<CsvTable>& table, const auto& is_wanted) {
    const std::size_t first = all.size();
    add(table, is_wanted);
    for (std::size_t k = first; k < all.size(); ++k) all[k].quantity += ", filtered";
  };
  add(tables.contact, of_contact);
  add_filtered(tables.contact_filtered, of_contact);
  add(tables.probes, any);
  add_filtered(tables.probes_filtered, any);
  if (!summary) return all;
  for (LargestValue& value : all)
    for (const ProbeSummary& probe : summary->probes)
      if (probe.name == value.where)
        value.where = fmt::format("{}: {} at {}", probe.name, probe.place,
                                  place_text(probe.position, summary->mesh.reach, units.length));
  const StressSummary& stress = summary->stress;
  if (stress.instants > 0 && stress.value > 0.0)
    all.push_back({"von Mises stress", with_readable_unit(stress.value, units.stress, 4), time_text(stress.time, units),
                   fmt::format("{}: cell {} at {}", stress.part, stress.cell,
                               place_text(stress.position, summary->mesh.reach, units.length)),
                   "all parts", stress.value, units.stress});
  return all;
}

std::vector<XyPlot> spectrum_plots(const std::optional<CsvTable>& table, const std::optional<Summary>& summary,
                                   const Units& units) {
  std::vector<XyPlot> plots;
  if (!table || table->rows() == 0 || !summary) return plots;
  const std::optional<UnitSystem> system = system_of(units);
  const double hertz = system ? 1.0 / si_factor(Dimension::time, *system) : 1.0;
  const double g = system ? standard_gravity / si_factor(Dimension::acceleration, *system) : 1.0;
  for (const ShockSummary& shock : summary->shock) {
    XyPlot plot{fmt::format("{} · Q = {:g}{}", record_name(shock), shock.quality_factor,
                            shock.cfc > 0.0 ? fmt::format(", CFC {:g}", shock.cfc) : ", unfiltered"),
                system ? "natural frequency [Hz]" : "natural frequency",
                system ? "largest absolute acceleration [g]" : "largest absolute acceleration",
                "",
                "",
                {},
                true};
    double most = 0.0;
    std::vector<double> largest;
    for (const char* component : {"x", "y", "z"}) {
      XyCurve curve{component, {}, {}};
      const auto* values = table->column(fmt::format("{}.{}_{}", shock.probe, shock.quantity, component));
      for (std::size_t row = 0; values != nullptr && row < table->rows(); ++row) {
        if (!((*values)[row] > 0.0)) continue;  // nan where the record is too coarse
        curve.x.push_back(table->values.front()[row] * hertz);
        curve.y.push_back((*values)[row] / g);
      }
      largest.push_back(curve.y.empty() ? 0.0 : *std::ranges::max_element(curve.y));
      most = std::max(most, largest.back());
      plot.curves.push_back(std::move(curve));
    }
    constexpr double least = 1e-3;
    for (std::size_t c = plot.curves.size(); c-- > 0;)
      if (!(largest[c] > least * most)) plot.curves.erase(plot.curves.begin() + static_cast<std::ptrdiff_t>(c));
    if (plot.curves.size() == 1) plot.title = fmt::format("{}: {}", plot.title, plot.curves[0].name);
    if (!plot.curves.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

PartValues largest_of_parts(const std::optional<CsvTable>& table, const Units& units) {
  PartValues all;
  if (!table || table->rows() == 0) return all;
  std::map<std::string, double> of_kind;
  std::vector<std::pair<double, LargestValue>> found;
  const std::vector<Quantity> quantities = quantities_of(*table);
  for (const Quantity& quantity : quantities) {
    found.push_back(largest_value(quantity, *table, units));
    of_kind[quantity.name] = std::max(of_kind[quantity.name], found.back().first);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [value, largest] = found[i];
    if (all.parts.empty() || all.parts.back() != largest.where) {
      all.parts.push_back(largest.where);
      all.values.emplace_back();
    }
    if (of_kind[quantities[i].name] == 0.0) continue;
    if (all.parts.size() == 1) all.quantities.push_back(largest.quantity);
    const bool is_negligible = value <= kNegligible * of_kind[quantities[i].name];
    all.values.back().push_back(is_negligible
                                    ? PartValues::Value{"–", ""}
                                    : PartValues::Value{largest.value, largest.time, largest.number, largest.unit});
  }
  return all.parts.size() > 1 ? all : PartValues{};
}

std::optional<double> time_of_largest_force(const std::optional<CsvTable>& contact,
                                            const std::vector<std::string>& ties) {
  if (!contact) return std::nullopt;
  for (const bool are_ties : {false, true}) {
    Peak largest;
    for (const std::string& place : contacts_with(*contact, "force", ties, are_ties))
      if (const Peak peak = peak_of(*contact, place, "force"); peak.value > largest.value) largest = peak;
    if (largest.value > 0.0) return largest.time;
  }
  return std::nullopt;
}

std::vector<KeyFigure> key_figures(const Tables& tables, const std::optional<Summary>& summary, const Units& units) {
  std::vector<KeyFigure> figures;
  const bool has_contact = tables.contact && tables.contact->rows() > 0;
  if (has_contact && !is_static(tables)) add_impulses(tables, units, figures);
  if (has_contact) add_durations(tables, units, figures);
  add_speeds(tables, summary, units, figures);
  if (has_contact) add_peak_forces(tables, summary, units, figures);
  add_peak_accelerations(tables, units, figures);
  if (summary) add_shock(*summary, units, figures);
  if (has_contact) add_ties(*tables.contact, tables.ties, units, figures);
  if (summary) add_stress(*summary, units, figures);
  return figures;
}

}  // namespace carom
