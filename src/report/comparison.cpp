#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <string_view>

#include "base/errors.hpp"
#include "output/file_writer.hpp"
#include "output/xml.hpp"
#include "report/assets.hpp"
#include "report/page.hpp"
#include "report/report.hpp"
#include "report/results.hpp"
#include "report/run_tables.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// The last parts of the paths, as many as it takes until no two are the same.
std::vector<std::string> short_names(const std::vector<std::string>& folders) {
  std::vector<fs::path> paths;
  std::size_t longest = 0;
  for (const std::string& folder : folders) {
    paths.push_back(fs::absolute(folder).lexically_normal());
    if (paths.back().filename().empty()) paths.back() = paths.back().parent_path();
    longest = std::max(longest, static_cast<std::size_t>(std::distance(paths.back().begin(), paths.back().end())));
  }
  std::vector<std::string> names(paths.size());
  for (std::size_t count = 1; count <= longest; ++count) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      fs::path end;
      const auto all = std::distance(paths[i].begin(), paths[i].end());
      for (auto part =
               std::next(paths[i].begin(), std::max<std::ptrdiff_t>(all - static_cast<std::ptrdiff_t>(count), 0));
           part != paths[i].end(); ++part)
        end /= *part;
      names[i] = end.generic_string();
    }
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) break;
  }
  return names;
}

std::vector<NamedRun> read_runs(const std::vector<std::string>& folders) {
  const std::vector<std::string> names = short_names(folders);
  std::vector<NamedRun> runs;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    runs.push_back({names[i], read_results(folders[i])});
    const Units &first = runs.front().data.units, &own = runs.back().data.units;
    if (own.length != first.length || own.time != first.time || own.mass != first.mass)
      throw CaseError({folders[i], 0, 0}, "", fmt::format("a run in {}", units_comment(own)),
                      fmt::format("{}, as {} has", units_comment(first), folders.front()),
                      "Runs in different units cannot be laid over each other.");
  }
  return runs;
}

/// What was given that differs, or that nothing does.
std::string differences_section(const std::vector<NamedRun>& runs) {
  try {
    const DataTable table = input_differences(runs);
    if (!table.rows.empty()) return table_section(table);
    if (std::any_of(runs.begin(), runs.end(), [](const NamedRun& run) { return run.data.case_text.empty(); }))
      return "";
    return "<p class=\"note\">No key of the cases differs, the mesh is the same, and so is the program.</p>\n";
  } catch (const CaseError& error) {
    return fmt::format("<p class=\"note\">What differs in the cases is not known: {}</p>\n", xml_escape(error.what()));
  }
}

/// What was run, each with a way to its own report.
std::string runs_table(const std::vector<NamedRun>& runs, const fs::path& beside) {
  std::vector<TableRow> rows;
  for (const NamedRun& run : runs) {
    const ReportData& data = run.data;
    const fs::path page = fs::proximate(fs::path(data.folder) / "report.html", beside);
    TableRow row{
        {fmt::format("<span><i class=\"swatch\" style=\"background: var(--curve-{})\"></i>"
                     "<a href=\"{}\">{}</a></span>",
                     rows.size() % colours_of_curves + 1, xml_escape(page.generic_string()), xml_escape(run.name))}};
    if (data.summary) {
      const Summary& s = *data.summary;
      row.push_back(text_cell(s.case_info.title));
      row.push_back(text_cell(fmt::format("{}{}", to_string(s.outcome), s.message.empty() ? "" : ": " + s.message)));
      row.push_back(text_cell(s.scheme.name));
      for (const std::string& number :
           {fmt::format("{}", s.mesh.cells), fmt::format("{}", s.scheme.steps), number_text(s.cost.wall_seconds, 3)})
        row.push_back(number_cell(number));
    } else {
      row.push_back(text_cell("–"));
      row.push_back(text_cell("no summary: still going on, or interrupted"));
      for (int i = 0; i < 4; ++i) row.push_back(text_cell("–"));
    }
    rows.push_back(std::move(row));
  }
  std::string html =
      "<section>\n<h2>Runs</h2>\n" +
      html_table(
          {{"Run"}, {"case"}, {"outcome"}, {"scheme"}, {"cells", true}, {"steps", true}, {"wall clock [s]", true}},
          rows, "wide") +
      "</section>\n";
  for (const NamedRun& run : runs)
    for (const std::string& note : run.data.notes)
      html += fmt::format("<p class=\"note\">{}: {}</p>\n", xml_escape(run.name), xml_escape(note));
  return html;
}

/// By the name of a curve the number of its line in a chart: a filtered one has that of the raw one.
class LineNumbers {
 public:
  std::size_t of(const std::string& chart, std::string curve) {
    if (const std::size_t end = curve.rfind(", filtered"); end != std::string::npos) curve.resize(end);
    std::vector<std::string>& names = names_[chart];
    const auto found = std::find(names.begin(), names.end(), curve);
    const auto number = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(std::move(curve));
    return number;
  }

 private:
  std::map<std::string, std::vector<std::string>> names_;
};

/// Curves of the same chart on one picture, each with its run's name before its own. A run has one colour in all of
/// them, and a curve of one name one kind of line in all runs. Exact ones are drawn once.
std::vector<Chart> merged(std::vector<NamedRun>& runs) {
  std::vector<Chart> all;
  LineNumbers lines;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    NamedRun& run = runs[r];
    for (Chart& chart : run.data.charts) {
      if (chart.curves.empty()) continue;
      auto same = std::find_if(all.begin(), all.end(), [&chart](const Chart& c) {
        return c.section == chart.section && c.title == chart.title;
      });
      if (same == all.end()) {
        const auto end_of_section =
            std::find_if(all.rbegin(), all.rend(), [&chart](const Chart& c) { return c.section == chart.section; });
        Chart empty = chart;
        empty.curves.clear();
        same = all.insert(end_of_section == all.rend() ? all.end() : end_of_section.base(), std::move(empty));
      }
      for (Curve& curve : chart.curves) {
        const bool is_exact = curve.kind == CurveKind::exact;
        if (is_exact && std::any_of(same->curves.begin(), same->curves.end(),
                                    [&curve](const Curve& c) { return c.name == curve.name; }))
          continue;
        if (!is_exact) {
          curve.colour = r;
          curve.line = lines.of(chart.section + "\n" + chart.title, curve.name);
          curve.name = fmt::format("{}: {}", run.name, curve.name);
        }
        same->curves.push_back(std::move(curve));
      }
    }
  }
  for (Chart& chart : all)  // over those of all runs
    std::stable_partition(chart.curves.begin(), chart.curves.end(),
                          [](const Curve& curve) { return curve.kind != CurveKind::exact; });
  return all;
}

/// The views share what the rest of the page leaves.
std::vector<PageView> views_of(std::vector<NamedRun>& runs, std::size_t most_bytes) {
  std::vector<PageView> views;
  for (NamedRun& run : runs) {
    add_view(run.data, most_bytes / runs.size(), run.name);
    std::move(run.data.views.begin(), run.data.views.end(), std::back_inserter(views));
  }
  return views;
}

}  // namespace

std::string tables_of_runs(const std::vector<std::string>& results_folders, const std::string& format) {
  return tables_text(read_runs(results_folders), format);
}

void write_comparison(const std::vector<std::string>& results_folders, const std::string& file) {
  std::vector<NamedRun> runs = read_runs(results_folders);
  const fs::path folder = fs::absolute(file).parent_path();
  fs::create_directories(folder);
  const std::string title = fmt::format("{} runs side by side", runs.size());
  const std::vector<Chart> charts = merged(runs);
  const Units units = runs.front().data.units;
  const auto page = [&](const std::vector<PageView>& views) {
    std::string content =
        fmt::format("<header>\n<p class=\"kicker\">Carom · runs compared</p>\n<h1>{}</h1>\n</header>\n", title);
    content += runs_table(runs, folder) + differences_section(runs) + table_section(figures_of_runs(runs)) +
               view_sections(views) + table_section(checks_of_runs(runs)) + table_section(largest_of_runs(runs)) +
               table_section(parts_of_runs(runs)) + chart_figures(charts) + table_section(energies_of_runs(runs));
    content += fmt::format(
        "<footer>\n{}{}</footer>\n", foldable("Licence of dygraphs, which draws the curves", assets::dygraph_licence),
        views.empty() ? "" : foldable("Licence of three.js, which draws the view", assets::three_licence));
    return html_document(title, content, {charts, units.time}, views);
  };
  const std::size_t rest = page({}).size() + view_library_bytes();
  const std::vector<PageView> views = views_of(runs, bytes_of_views(rest));
  write_file(file, page(views));
}

}  // namespace carom
