#include "driver/material_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/errors.hpp"
#include "output/csv.hpp"
#include "output/file_writer.hpp"
#include "output/readable_unit.hpp"
#include "output/units.hpp"
#include "output/xml.hpp"
#include "parallel/threads.hpp"
#include "report/html.hpp"
#include "report/xy_plot.hpp"

namespace carom {

namespace {

struct Figure {
  std::string title, value, remark;
};

Units units_of(const MaterialDrive& drive) {
  return carom::units_of(name(drive.given.units));
}

std::string describe(const PathRequest& request, PathKind kind) {
  if (kind == PathKind::table) return "the deformations of " + request.path;
  std::string text = kind == PathKind::uniaxial_stress ? "uniaxial stress" : "uniaxial strain";
  if (kind == PathKind::simple_shear) text = "simple shear";
  return fmt::format("{} to {:g}, {} steps each, at the rate {:g}", text, fmt::join(request.to, ", "), request.steps,
                     request.rate);
}

void check_section(const CasePart& part, PathKind kind) {
  const bool is_bar = part.section == Section::bar;
  if (!is_bar || kind == PathKind::uniaxial_stress) return;
  throw CaseError(part.where, "--path", "a path with lateral strain, of a bar",
                  "uniaxial_stress for parts that are bars",
                  "Take a part of another section, or --path uniaxial_stress.");
}

/// The first point at which something has been dissipated.
std::optional<std::size_t> first_yield(const MaterialDrive& drive) {
  const std::vector<double> work = drive.column("dissipation");
  const auto it = std::find_if(work.begin(), work.end(), [](double w) { return w > 0.0; });
  if (it == work.end()) return std::nullopt;
  return static_cast<std::size_t>(it - work.begin());
}

/// The stress that a test of this kind measures.
const char* measured_stress(PathKind kind) {
  return kind == PathKind::simple_shear ? "stress_xy" : "stress_xx";
}

Figure off_measured(const MaterialDrive& drive) {
  const std::vector<double>& stress = drive.measured->stress;
  const double rms = drive.rms_off_measured();
  if (!std::isfinite(rms))
    return {"Off the measured curve", "not comparable", "no measured point lies on the first branch of the path"};
  double largest = 0.0;
  for (const double value : stress) largest = std::max(largest, std::abs(value));
  return {"Off the measured curve", with_readable_unit(rms, units_of(drive).stress, 3),
          largest > 0.0
              ? fmt::format("root mean square, {:.2g} % of the largest measured stress", 100.0 * rms / largest)
              : "root mean square"};
}

std::vector<Figure> figures_of(const MaterialDrive& drive) {
  const std::string stress = units_of(drive).stress;  // also that of energy per volume
  const std::vector<double> mises = drive.column("von_mises");
  std::vector<Figure> figures;
  if (const auto yield = first_yield(drive)) {
    const double strain = drive.path.strain.empty() ? std::nan("") : drive.path.strain[*yield];
    figures.push_back({"First yielding", with_readable_unit(mises[*yield], stress, 4),
                       std::isnan(strain) ? fmt::format("at t = {:.4g}", drive.path.time[*yield])
                                          : fmt::format("at a strain of {:.4g}", strain)});
  }
  const auto largest = std::max_element(mises.begin(), mises.end());
  figures.push_back({"Largest von Mises stress", with_readable_unit(*largest, stress, 4), "of the Cauchy stress"});
  const auto last = [&drive](const char* name) { return drive.column(name).back(); };
  if (!drive.material.law->history.empty())
    figures.push_back({"Dissipated", with_readable_unit(last("dissipation"), stress, 4), "per reference volume"});
  if (!drive.column("equivalent_plastic_strain").empty())
    figures.push_back(
        {"Plastic strain", fmt::format("{:.4g}", last("equivalent_plastic_strain")), "equivalent, at the end"});
  if (!drive.column(damaged_by).empty())
    figures.push_back({"Damage", fmt::format("{:.4g}", last(damaged_by)), "at the end; fracture at 1"});
  if (drive.measured) figures.push_back(off_measured(drive));
  if (!drive.column("temperature_rise").empty())
    figures.push_back({"Temperature", fmt::format("+{:.4g} K", last("temperature_rise")), "at the end"});
  return figures;
}

std::string header(const MaterialDrive& drive) {
  return fmt::format(
      "<header>\n<p class=\"kicker\">Carom · a law on a path</p>\n<h1>{}: {}</h1>\n"
      "<div class=\"banner unchecked\" role=\"status\"><strong>{}</strong><span>{}</span></div>\n</header>\n",
      xml_escape(*drive.part.name), xml_escape(*drive.part.material), xml_escape(drive.material.law->name),
      xml_escape(drive.description));
}

std::string figures_list(const std::vector<Figure>& figures) {
  std::string html = "<section>\n<h2>Key figures</h2>\n<dl class=\"figures\">\n";
  for (const Figure& f : figures)
    html += fmt::format("<div><dt>{}</dt><dd><strong>{}</strong> {}</dd></div>\n", xml_escape(f.title),
                        xml_escape(f.value), xml_escape(f.remark));
  return html + "</dl>\n</section>\n";
}

/// Stress over strain: what a test would measure.
std::string stress_over_strain(const MaterialDrive& drive) {
  if (drive.path.strain.empty()) return "";
  const bool is_shear = drive.path.kind == PathKind::simple_shear;
  XyPlot plot{"Cauchy stress over strain",
              is_shear ? "shear gamma" : "engineering strain l / l0 - 1",
              "stress",
              "",
              units_of(drive).stress,
              {}};
  plot.curves.push_back({is_shear ? "xy" : "xx", drive.path.strain, drive.column(measured_stress(drive.path.kind))});
  if (drive.measured) plot.curves.push_back({"measured", drive.measured->strain, drive.measured->stress, true});
  return "<section>\n<h2>Stress and strain</h2>\n<div class=\"charts\">\n" + xy_plot(plot) + "</div>\n</section>\n";
}

class Charts {
 public:
  explicit Charts(const MaterialDrive& drive) : drive_(drive) {}

  void add(const std::string& section, const std::string& title, const std::string& label, const std::string& unit,
           const std::vector<std::string>& columns) {
    Chart chart{section, title, label, unit, {}, ""};
    double largest = 0.0;
    for (const std::string& name : columns) largest = std::max(largest, largest_of(drive_.column(name)));
    for (const std::string& name : columns) {
      const std::vector<double> values = drive_.column(name);
      constexpr double negligible = 1e-12;
      if (!(largest_of(values) > negligible * largest)) continue;
      std::string shown = name;
      std::replace(shown.begin(), shown.end(), '_', ' ');
      chart.curves.push_back({shown, drive_.path.time, values, CurveKind::computed});
    }
    if (!chart.curves.empty()) charts_.push_back(std::move(chart));
  }

  std::vector<Chart> take() { return std::move(charts_); }

 private:
  const MaterialDrive& drive_;
  std::vector<Chart> charts_;
};

std::vector<Chart> charts_of(const MaterialDrive& drive) {
  const std::string stress = units_of(drive).stress;
  Charts charts(drive);
  charts.add("Over time", "Cauchy stress", "stress", stress,
             {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx", "von_mises"});
  charts.add("Over time", "Energy per reference volume", "energy", stress, {"energy", "dissipation"});
  charts.add("Over time", "Plastic strain", "strain", "", {"equivalent_plastic_strain"});
  charts.add("Over time", "Temperature rise", "temperature", "K", {"temperature_rise"});
  return charts.take();
}

std::string law_table(const MaterialDrive& drive) {
  std::vector<TableRow> rows;
  const auto add = [&rows](const std::string& key, const std::string& value, std::string_view unit,
                           const std::string& meaning) {
    rows.push_back({text_cell(key), number_cell(value), text_cell(unit), text_cell(meaning)});
  };
  const Material& material = drive.material;
  for (std::size_t p = 0; p < material.values.size(); ++p) {
    const LawParameter& parameter = material.law->parameters[p];
    const bool is_absent = !parameter.initial_phrase.empty() && material.values[p] == *parameter.initial;
    add(parameter.key, is_absent ? parameter.initial_phrase : fmt::format("{:g}", material.values[p]),
        is_absent ? "" : unit_name(parameter.unit, drive.given.units), parameter.meaning);
  }
  add("rho", fmt::format("{:g}", material.rho), unit_name(Dimension::density, drive.given.units), "Density.");
  for (const auto& [strain, stress] : material.curve)
    add(material.law->curve_key, fmt::format("{:g}, {:g}", strain, stress),
        unit_name(Dimension::stress, drive.given.units), "Plastic strain, yield stress.");
  return fmt::format("<section>\n<h2>The law</h2>\n<p>{}</p>\n{}</section>\n", xml_escape(material.law->formula),
                     html_table({{"Key"}, {"Value", true}, {"Unit"}, {"Meaning"}}, rows));
}

void write_table(const MaterialDrive& drive, const std::string& path) {
  CsvFile file(path, drive.curve.columns,
               {fmt::format("{}: law {} on {}", *drive.part.name, drive.material.law->name, drive.description),
                units_comment(units_of(drive))});
  for (const std::vector<double>& row : drive.curve.rows) file.append(row);
  file.close();
}

std::string page_of(const MaterialDrive& drive, const std::vector<Figure>& figures) {
  const std::vector<Chart> charts = charts_of(drive);
  const std::string content =
      header(drive) + figures_list(figures) + stress_over_strain(drive) + chart_figures(charts) + law_table(drive);
  return html_document(*drive.part.name, content, {charts, units_of(drive).time});
}

}  // namespace

const CasePart& part_named(const Case& given, const std::string& name) {
  std::vector<std::string> names;
  for (const CasePart& part : given.parts) {
    if (*part.name == name || (name.empty() && given.parts.size() == 1)) return part;
    names.push_back(*part.name);
  }
  throw CaseError({}, "--part", name.empty() ? "no name, of several parts" : fmt::format("\"{}\"", name),
                  fmt::format("the name of a [[part]]: {}", fmt::join(names, ", ")));
}

double MaterialDrive::rms_off_measured() const {
  return rms_difference(*measured, path.strain, column(measured_stress(path.kind)));
}

MaterialDrive follow_material(const Case& given, const std::string& part_name, const PathRequest& request) {
  const CasePart& part = part_named(given, part_name);
  MaterialPath path = make_path(request);
  check_section(part, path.kind);
  const auto material = std::find_if(given.materials.begin(), given.materials.end(),
                                     [&part](const CaseMaterial& m) { return m.name == *part.material; });
  Material made = material->made();
  MaterialCurve curve = follow(made, free_directions(part.section), path);
  const std::string description = describe(request, path.kind);
  std::optional<MeasuredCurve> measured = request.measured_curve;
  if (!request.measured.empty()) measured = read_measured(request.measured);
  if (measured && path.strain.empty())
    throw CaseError({}, "--measured", "a measured curve beside a table of deformations",
                    "one of the paths uniaxial_stress, uniaxial_strain, simple_shear");
  return {given, part, std::move(made), std::move(path), std::move(curve), std::move(measured), description};
}

std::string write_material(const MaterialDrive& drive, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder, error.message());
  std::string file_name = *drive.part.name;
  std::replace(file_name.begin(), file_name.end(), '/', '_');
  const std::string base = (std::filesystem::path(folder) / file_name).string();
  write_table(drive, base + ".csv");
  const std::vector<Figure> figures = figures_of(drive);
  write_file(base + ".html", page_of(drive, figures));
  std::string text =
      fmt::format("part \"{}\": law {}, {}\n", *drive.part.name, drive.material.law->name, drive.description);
  for (const Figure& f : figures) text += fmt::format("  {}: {} {}\n", f.title, f.value, f.remark);
  return text + fmt::format("{} points in {}.csv, open {}.html\n", drive.curve.rows.size(), base, base);
}

std::string drive_material(const Case& given, const std::string& part, const PathRequest& request,
                           const std::string& folder) {
  return write_material(follow_material(given, part, request), folder);
}

}  // namespace carom
