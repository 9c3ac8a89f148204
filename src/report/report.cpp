#include "report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "output/file_writer.hpp"
#include "report/page.hpp"
#include "report/results.hpp"

namespace carom {

void write_report(const std::string& results_folder, const std::string& file) {
  ReportData data = read_results(results_folder);
  const std::size_t rest = make_page(data).size() + view_library_bytes();
  add_view(data, bytes_of_views(rest), "Bodies in motion");
  const std::string beside = (std::filesystem::path(results_folder) / "report.html").string();
  write_file(file.empty() ? beside : file, make_page(data));
}

std::string view_page(const std::string& results_folder, std::size_t most_bytes) {
  ReportData data = read_results(results_folder);
  const std::size_t libraries = view_library_bytes();
  add_view(data, most_bytes - std::min(libraries, most_bytes), data.title);
  if (data.views.empty())
    throw std::runtime_error(data.notes.empty() ? results_folder + " has no frames" : data.notes.back());
  const std::string narrow = "<style>main { padding: .25rem .5rem; } h2 { margin: .25rem 0 .5rem; }</style>\n";
  return html_document(data.title, narrow + view_sections(data.views), {{}, data.units.time}, data.views);
}

double write_watch_page(const std::string& results_folder, const RunningState& state) {
  ReportData data = read_results(results_folder);
  data.running = state;
  std::erase(data.notes, "summary.json is missing.");  // there is none before the end
  write_file((std::filesystem::path(results_folder) / "watch.html").string(), make_page(data));
  return data.time_reached;
}

void end_watch_page(const std::string& results_folder) {
  write_file((std::filesystem::path(results_folder) / "watch.html").string(),
             "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"refresh\" content=\"0; url=report.html\">\n"
             "<title>Carom</title>\n<p>The run has ended: <a href=\"report.html\">its report</a>.</p>\n");
}

}  // namespace carom
