// The program `carom`: command line and exit codes, nothing else.
#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "advise/check_summary.hpp"
#include "advise/cost_estimate.hpp"
#include "apps/report_commands.hpp"
#include "base/amounts.hpp"
#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "base/version.hpp"
#include "build/read_whole.hpp"
#include "build/simulation.hpp"
#include "casefile/example_cases.hpp"
#include "casefile/read_case.hpp"
#include "casefile/schema.hpp"
#include "compare/compare_cases.hpp"
#include "driver/material_page.hpp"
#include "linalg/process_environment.hpp"
#include "mesh/mesh_summary.hpp"
#include "mesh/read_mesh.hpp"
#include "output/checkpoint_file.hpp"
#include "output/data_table.hpp"
#include "output/mesh_file.hpp"
#include "parallel/job.hpp"
#include "parallel/threads.hpp"
#include "run/run_case.hpp"
#include "translate/convert_deck.hpp"

namespace {

using carom::ExitCode;

std::atomic<bool> stop_requested{false};

sigset_t only_sigterm() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  return set;
}

/// METIS puts a handler of its own on SIGTERM while it orders a matrix, which gives the ordering up and swallows the
/// signal. So SIGTERM is blocked in every thread, those that libraries start when they are loaded included, and waited
/// for.
void block_sigterm() {
  const sigset_t set = only_sigterm();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}
/// Run before the libraries are made ready (System V ABI, "Initialization and Termination Functions").
[[gnu::section(".preinit_array"), gnu::used]] void (*const block_at_load)() = block_sigterm;

void unblock_sigterm() {
  const sigset_t set = only_sigterm();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

extern "C" void request_stop(int /*signal*/) {
  stop_requested.store(true);
  std::signal(SIGINT, SIG_DFL);  // a second Ctrl-C ends the process at once
}

struct Arguments {
  std::string case_file, mesh_file, folder, output;
  std::vector<std::string> accepted;
  int threads = 0;
  bool quiet = false;
  std::optional<double> end;
  carom::compare::Options choices;
  int jobs = 0;
  std::string part;
  carom::PathRequest path;
  std::vector<std::string> folders;
  int every = 2;
  std::string format, example;
};

void stop_at_signals() {
  std::signal(SIGINT, request_stop);
  std::thread([] {
    const sigset_t set = only_sigterm();
    for (int signal = 0; sigwait(&set, &signal) == 0;) stop_requested.store(true);
  }).detach();
  std::signal(SIGHUP, request_stop);
  std::signal(SIGPIPE, SIG_IGN);  // a run outlives the pipe that its progress is written to
}

/// On stdout, without what could do harm to a terminal.
template <class... Values>
void show(fmt::format_string<Values...> format, Values&&... values) {
  carom::print_to_terminal(stdout, fmt::format(format, std::forward<Values>(values)...));
}

std::string results_folder(const Arguments& arguments, const char* ending) {
  if (!arguments.folder.empty()) return arguments.folder;
  return (std::filesystem::path("out") / std::filesystem::path(arguments.case_file).stem()).string() + ending;
}

ExitCode run(const Arguments& arguments) {
  stop_at_signals();
  carom::RunOptions options;
  options.folder = results_folder(arguments, "");
  options.threads = arguments.threads;
  options.progress = arguments.quiet ? carom::ProgressMode::quiet : carom::ProgressMode::automatic;
  options.accepted = arguments.accepted;
  return carom::run_case(arguments.case_file, options, stop_requested);
}

ExitCode resume(const Arguments& arguments) {
  stop_at_signals();
  carom::RunOptions options;
  options.folder = arguments.folder;
  options.threads = arguments.threads;
  options.progress = arguments.quiet ? carom::ProgressMode::quiet : carom::ProgressMode::automatic;
  return carom::resume_case(options, arguments.end, stop_requested);
}

ExitCode check(const Arguments& arguments) {
  carom::set_threads(arguments.threads);
  const carom::ReadCase read = carom::read_whole(arguments.case_file, arguments.accepted);
  const carom::Simulation simulation(read.given);
  carom::Examination found = carom::examine(simulation, results_folder(arguments, ""), carom::usual_rehearsal);
  found.notes.insert(found.notes.begin(), read.notes.begin(), read.notes.end());
  show("{}\n", found.text());
  return found.warnings.empty() ? ExitCode::good : ExitCode::verdict_failed;
}

ExitCode compare(const Arguments& arguments) {
  stop_at_signals();
  const carom::compare::Settings settings{{"/proc/self/exe"}, results_folder(arguments, "_compare"), arguments.jobs};
  return carom::compare::compare_cases(arguments.case_file, arguments.choices, settings,
                                       {arguments.quiet, arguments.format}, stop_requested);
}

ExitCode material(const Arguments& arguments) {
  const carom::Case given = carom::read_case(arguments.case_file);
  show("{}", carom::drive_material(given, arguments.part, arguments.path, results_folder(arguments, "_material")));
  return ExitCode::good;
}

ExitCode convert(const Arguments& arguments) {
  const std::string output = arguments.output.empty()
                                 ? std::filesystem::path(arguments.case_file).stem().string() + ".toml"
                                 : arguments.output;
  carom::read_whole(arguments.case_file, arguments.accepted);  // all that a run would refuse
  const carom::ConvertedDeck converted = carom::convert_deck(arguments.case_file, output, arguments.accepted);
  for (const std::string& note : converted.notes) show("note: {}\n", note);
  show("{} and {} written\n", converted.case_file, converted.mesh_file);
  return ExitCode::good;
}

ExitCode init(const Arguments& arguments) {
  const carom::BegunCase begun =
      carom::begin_case(carom::examples_folder("/proc/self/exe"), arguments.example, arguments.folder);
  show("{}{}{} written\n", begun.case_file, begun.other_file.empty() ? "" : " and ", begun.other_file);
  if (!begun.command.empty()) show("{}    makes its mesh\n", begun.command);
  show("carom check {}    says what it will do\n", begun.case_file);
  return ExitCode::good;
}

ExitCode mesh(const Arguments& arguments) {
  const carom::Mesh mesh = carom::read_mesh(arguments.mesh_file);
  show("{}", carom::mesh_summary(mesh));
  if (!arguments.output.empty()) carom::write_mesh(arguments.output, mesh);
  return ExitCode::good;
}

/// What all processes of the job do, each as a rank.
ExitCode on_ranks(ExitCode (*command)(const Arguments&), const Arguments& arguments) {
  ExitCode code = ExitCode::good;
  carom::run_as(carom::job_ranks(), [&] { code = command(arguments); });
  return code;
}

ExitCode dispatch(const CLI::App& app, const Arguments& arguments) {
  if (app.got_subcommand("run")) return on_ranks(run, arguments);
  if (app.got_subcommand("resume")) return on_ranks(resume, arguments);
  if (carom::job_ranks().own() > 0) return ExitCode::good;  // what follows is for one process
  if (app.got_subcommand("compare")) return compare(arguments);
  unblock_sigterm();  // nothing to be kept
  if (app.got_subcommand("watch")) {
    std::signal(SIGINT, request_stop);
    return carom::watch_run(arguments.folder, arguments.every, stop_requested);
  }
  if (app.got_subcommand("report")) {
    if (arguments.format.empty()) return carom::report_runs(arguments.folders, arguments.output);
    return carom::show_tables(arguments.folders, arguments.format);
  }
  if (app.got_subcommand("check")) return check(arguments);
  if (app.got_subcommand("material")) return material(arguments);
  if (app.got_subcommand("convert")) return convert(arguments);
  if (app.got_subcommand("mesh")) return mesh(arguments);
  if (app.got_subcommand("init")) return init(arguments);
  fmt::print("{}\n", carom::json_schema());
  return ExitCode::good;
}

/// In place of CLI::PositiveNumber, whose message has the 309 digits of the largest double.
const CLI::Validator& positive_number() {
  static const CLI::Validator is_positive(
      [](std::string& word) {
        double value = 0.0;
        const bool is_one = CLI::detail::lexical_cast(word, value) && value > 0.0 && std::isfinite(value);
        return is_one ? std::string() : fmt::format("found {}; expected a number > 0", word);
      },
      "POSITIVE");
  return is_positive;
}

CLI::Option* add_format(CLI::App* command, Arguments& arguments, const std::string& help) {
  return command->add_option("--format", arguments.format, help)->check(CLI::IsMember(carom::table_formats()));
}

/// For commands that take a deck as well.
void add_accept(CLI::App* command, Arguments& arguments) {
  command
      ->add_option("--accept", arguments.accepted,
                   "Keywords of a deck, with commas between, that may be left out although they change the physics")
      ->delimiter(',');
}

void add_convert(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("convert", "Write a deck of Abaqus or CalculiX as a case and its mesh");
  command->add_option("deck", arguments.case_file, "Deck (.inp)")->required();
  command->add_option("-o,--out", arguments.output, "Case file to write, its mesh beside it (default: <deck>.toml)");
  add_accept(command, arguments);
}

void add_init(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("init", "Begin a case of one's own with one that comes with the program");
  command->add_option("name", arguments.folder, "Folder to write, with the case and its mesh")->required();
  command->add_option("--like", arguments.example,
                      "Case to begin with, such as taylor_bar/rigid_wall; without it, all of them are shown");
}

void add_compare(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("compare", "Run variants of a case side by side and recommend one");
  command->add_option("case", arguments.case_file, "Case file (TOML)")->required();
  const auto list = [command](const char* name, auto& values, const char* help) {
    return command->add_option(name, values, help)->delimiter(',');
  };
  list("--scheme", arguments.choices.schemes, "Schemes, each as NAME or NAME:KEY=VALUE:...");
  list("--enforcement", arguments.choices.enforcements, "Enforcements of contact, written alike");
  list("--stiffness", arguments.choices.stiffnesses, "Stiffnesses, set in every [[contact]]");
  list("--cells", arguments.choices.cells, "Cells along the longest edge of each block")
      ->check(CLI::Range(1, 1'000'000));
  list("--courant", arguments.choices.courants, "Steps, over shortest cell / fastest wave")->check(positive_number());
  list("--refine", arguments.choices.refinements, "How often every cell is cut in halves (mesh files too)")
      ->check(CLI::Range(0, 6));
  command->add_option("--reference", arguments.choices.reference,
                      "Text in the name of the run that others are compared with");
  command->add_option("--out", arguments.folder, "Results folder (default: out/<name of the case>_compare)");
  command->add_option("--jobs", arguments.jobs, "Runs at a time (default: all cores)")->check(CLI::Range(0, 1024));
  add_format(command, arguments, "How the table is printed (default: text)");
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
}

void add_material(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      app.add_subcommand("material", "Draw the stress of a part's law on a path of deformation, without a mesh");
  command->add_option("case", arguments.case_file, "Case file (TOML)")->required();
  command->add_option("--part", arguments.part, "Name of the [[part]] (default: the only one)");
  command
      ->add_option("--path", arguments.path.path,
                   "uniaxial_stress, uniaxial_strain, simple_shear, or a .csv file of time and F_xx, F_xy, ... or "
                   "strain_xx, ...")
      ->required();
  const CLI::App* const path = command;
  const CLI::Validator not_of_tables(
      [path](std::string&) {
        const bool is_table = path->get_option("--path")->as<std::string>().ends_with(".csv");
        return std::string(is_table ? "a table of deformations says itself where and how fast it goes" : "");
      },
      "", "not of tables");
  command
      ->add_option("--to", arguments.path.to, "Engineering strains, or shears, at which the path turns (default: 0.1)")
      ->delimiter(',')
      ->check(not_of_tables);
  command->add_option("--steps", arguments.path.steps, "Steps from one turning point to the next (default: 200)")
      ->check(CLI::Range(1, 1'000'000))
      ->check(not_of_tables);
  command->add_option("--rate", arguments.path.rate, "Rate of that strain per unit of time (default: 1)")
      ->check(positive_number())
      ->check(not_of_tables);
  command->add_option("--measured", arguments.path.measured,
                      "File of rows strain,stress (engineering strain, Cauchy stress) to lay over the curve");
  command->add_option("--out", arguments.folder, "Folder (default: out/<name of the case>_material)");
}

void add_report(CLI::App& app, Arguments& arguments) {
  CLI::App* report_command = app.add_subcommand(
      "report", "Write the report of a results folder again, or lay several over each other on one page");
  report_command->add_option("folders", arguments.folders, "Results folders")->required();
  CLI::Option* const page = report_command->add_option(
      "--out", arguments.output, "File of the page (default: report.html in the folder, or out/comparison.html)");
  add_format(report_command, arguments, "Print the tables of the runs so, in place of the page")->excludes(page);
  CLI::App* watch_command =
      app.add_subcommand("watch", "Follow a run that is going on, on a page that reads itself again");
  watch_command->add_option("folder", arguments.folder, "Results folder")->required();
  watch_command->add_option("--every", arguments.every, "Seconds between looks (default: 2)")
      ->check(CLI::Range(1, 3600));
}

void print_error(const std::string& what) {
  carom::print_to_terminal(stderr, fmt::format("error: {}\n", what));
}

carom::JobEnd end_of(ExitCode code, std::string error = {}) {
  return {static_cast<int>(code), std::move(error)};
}

carom::JobEnd guarded(const CLI::App& app, const Arguments& arguments) {
  try {
    const ExitCode code = dispatch(app, arguments);
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "cannot write to stdout");
    return end_of(code);
  } catch (const carom::CaseError& e) {
    return end_of(ExitCode::case_wrong, e.what());
  } catch (const carom::CheckpointError& e) {
    return end_of(ExitCode::case_wrong, e.what());
  } catch (const std::bad_alloc&) {
    return end_of(ExitCode::run_failed, fmt::format("memory ran out while the case was made ready; {} are there",
                                                    carom::about_bytes(carom::available_memory())));
  } catch (const std::exception& e) {
    return end_of(ExitCode::run_failed, e.what());
  }
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// Is the first word one that should be a command and is none?
bool starts_with_no_command(int argc, const char* const* argv, const std::vector<std::string>& commands) {
  if (argc < 2 || argv[1][0] == '-' || argv[1][0] == '\0') return false;
  return std::find(commands.begin(), commands.end(), argv[1]) == commands.end();
}

/// What one sees who starts the program by its name alone.
void introduce() {
  fmt::print(
      "carom {}: impacts of deformable solids, which fly, hit, slide, stick, yield and rebound.\n\n"
      "  carom check CASE.toml    says what a case will do, and what is wrong with it\n"
      "  carom run CASE.toml      runs it; open out/CASE/report.html in a browser\n"
      "  carom mesh FILE          shows cells and groups of a mesh (Gmsh, MED, Abaqus, CalculiX)\n"
      "  carom --help             has all commands, carom COMMAND --help those of one\n\n"
      "A case to begin with: carom init mine --like tutorial/bracket, or another of the gallery, docs/gallery.md;\n"
      "the tutorial, docs/tutorial.md, goes through one.\n",
      carom::version());
}

/// Of a word that no command takes: the option, or the command, that was meant.
std::string unexpected(const CLI::App& app, int argc, const char* const* argv) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty()) return "";
  if (const std::vector<std::string> more = chosen.front()->remaining();
      chosen.front()->get_name() == "compare" && !more.empty() && !more.front().starts_with("-"))
    return fmt::format("carom compare takes one case, of which it runs variants, and found \"{}\" as well; {}",
                       more.front(), carom::compare::two_runs_remedy);
  std::vector<std::string> known;
  for (const CLI::Option* option : chosen.front()->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string near = carom::nearest(word, known);
    return fmt::format("carom {0} has no option {1}{2} (carom {0} --help)", chosen.front()->get_name(), word,
                       near.empty() ? "" : fmt::format("; did you mean {}?", near));
  }
  return "";
}

/// Keeps what is freed for what is asked for next. Large arrays that come and go are pages of the system's otherwise,
/// which it clears every time: a third of the time before the first step.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**,
                                                                             char**) = carom::limit_blas_threads;

int main(int argc, char** argv) {
  carom::prepare_process_environment(argv);
  if (!carom::reserve_blas_memory()) {
    fmt::print(stderr,
               "error: the limit of the address space (ulimit -v) leaves less than the 160 MB that linear algebra "
               "begins with: raise it to 500 MB or more\n");
    return static_cast<int>(ExitCode::run_failed);
  }
  keep_freed_memory();
  CLI::App app{"Impact dynamics of deformable solids."};
  app.set_version_flag("--version", fmt::format("carom {} ({})", carom::version(), carom::compiler()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 good; 1 a check or the verdict failed, or `check` has warnings; 2 the case, its mesh or its\n"
      "checkpoints cannot be used; 3 the run failed (what was computed is kept).");
  Arguments arguments;
  CLI::App* run_command = app.add_subcommand("run", "Run a case and write its results folder and report");
  run_command->add_option("case", arguments.case_file, "Case file (TOML) or deck of Abaqus or CalculiX")->required();
  add_accept(run_command, arguments);
  run_command->add_option("--out", arguments.folder, "Results folder (default: out/<name of the case>)");
  run_command->add_option("--threads", arguments.threads, "Threads (default: all cores)")->check(CLI::Range(0, 1024));
  run_command->add_flag("--quiet", arguments.quiet, "Print errors, and why a run is not good");
  CLI::App* resume_command = app.add_subcommand("resume", "Go on with a run from the last checkpoint of its folder");
  resume_command->add_option("folder", arguments.folder, "Results folder")->required();
  resume_command->add_option("--end", arguments.end, "Go on to this time (default: the end of the case)");
  resume_command->add_option("--threads", arguments.threads, "Threads (default: all cores)")
      ->check(CLI::Range(0, 1024));
  resume_command->add_flag("--quiet", arguments.quiet, "Print errors, and why a run is not good");
  CLI::App* check_command = app.add_subcommand("check", "Read, resolve and examine a case without running it");
  check_command->add_option("case", arguments.case_file, "Case file (TOML) or deck of Abaqus or CalculiX")->required();
  add_accept(check_command, arguments);
  add_init(app, arguments);
  add_convert(app, arguments);
  add_compare(app, arguments);
  add_material(app, arguments);
  add_report(app, arguments);
  CLI::App* mesh_command = app.add_subcommand("mesh", "Describe a mesh file, and write it in another format");
  mesh_command->add_option("file", arguments.mesh_file, "Mesh file (Gmsh 2.2 or 4.1, MED, Abaqus or CalculiX)")
      ->required();
  mesh_command->add_option("-o,--out", arguments.output, "File to write it to: .msh (Gmsh 2.2), .med, .inp or .vtu");
  app.add_subcommand("schema", "Print the JSON Schema of the case format");
  if (const std::vector<std::string> commands = command_names(app); starts_with_no_command(argc, argv, commands)) {
    print_error(
        fmt::format("\"{}\" is no command of carom; it has {} (carom --help)", argv[1], fmt::join(commands, ", ")));
    return static_cast<int>(ExitCode::case_wrong);
  }
  if (argc == 1) {
    introduce();
    return static_cast<int>(ExitCode::case_wrong);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& e) {
    if (const std::string what = unexpected(app, argc, argv); what.empty())
      app.exit(e);
    else
      print_error(what);
    return static_cast<int>(ExitCode::case_wrong);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(ExitCode::case_wrong);
  }
  const int code = carom::run_job(
      argc, argv, [&] { return guarded(app, arguments); }, print_error);
  // A run that failed may have had no memory left, and the exit handlers of the linear algebra have hung for want of
  // it.
  if (code == static_cast<int>(ExitCode::run_failed)) {
    std::fflush(nullptr);
    std::_Exit(code);
  }
  return code;
}
