#include "deck/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/terminal_text.hpp"
#include "base/text_lines.hpp"
#include "deck/foreign.hpp"
#include "deck/keyword_table.hpp"

namespace carom {

namespace {

/// Of UTF-8, which some editors write.
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool is_comment(std::string_view line) {
  return line.starts_with("**");
}

/// Pieces between commas that stand in no quotes.
std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> pieces;
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '"') is_quoted = !is_quoted;
    if (i < text.size() && (is_quoted || text[i] != ',')) continue;
    pieces.push_back(trimmed(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  return pieces;
}

std::string without_quotes(std::string_view text) {
  std::string bare(text);
  std::erase(bare, '"');
  return bare;
}

/// Reads one file after the other, included ones in their place.
class DeckReader {
 public:
  DeckReader(Deck& deck, const IncludeReader& include) : deck_(deck), include_(include) {}

  void read(std::string bytes, const std::string& source) {
    deck_.files.push_back(std::make_unique<Deck::File>(Deck::File{source, std::move(bytes)}));
    const Deck::File& file = *deck_.files.back();
    const std::string_view text = file.bytes;
    const std::size_t first = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    std::size_t data_begin = first;
    int line = 1, data_line = 1;
    for (std::size_t at = first; at < text.size();) {
      const std::size_t begin = at;
      const std::string_view content = trimmed(take_line(text, at));
      const int own_line = line++;
      if (!content.starts_with('*') || is_comment(content)) continue;
      end_data(file, text.substr(data_begin, begin - data_begin), data_line);
      const Location where{source, own_line, 0};
      std::string keyword(content.substr(1));
      while (keyword.ends_with(',') && at < text.size()) {
        const std::string_view more = trimmed(take_line(text, at));
        ++line;
        if (!is_comment(more)) keyword += more;
        if (more.empty()) break;
      }
      begin_keyword(keyword, where);
      data_begin = at, data_line = line;
    }
    end_data(file, text.substr(data_begin), data_line);
  }

 private:
  void end_data(const Deck::File& file, std::string_view text, int first_line) {
    if (deck_.keywords.empty()) {
      int line = first_line;
      for (std::size_t at = 0; at < text.size(); ++line) {
        const std::string_view content = trimmed(take_line(text, at));
        if (content.empty() || is_comment(content)) continue;
        throw CaseError({file.name, line, 0}, "", printable(content), "a keyword such as *NODE",
                        "A deck begins with a keyword; comments begin with **.");
      }
    } else if (!text.empty()) {
      deck_.keywords.back().data.push_back({&file.name, first_line, text});
    }
  }

  void begin_keyword(std::string_view text, const Location& where) {
    const std::vector<std::string_view> pieces = split_at_commas(text);
    DeckKeyword keyword;
    keyword.where = where;
    const KeywordEntry* entry = find_keyword(upper_case(pieces.front()));
    keyword.name = entry != nullptr ? std::string(entry->name) : upper_case(pieces.front());
    if (keyword.name.empty()) throw CaseError(where, "", "a * alone", "a keyword such as *NODE");
    for (std::size_t i = 1; i < pieces.size(); ++i)
      if (!pieces[i].empty()) keyword.parameters.push_back(parameter(pieces[i], entry, keyword));
    if (keyword.name == "INCLUDE") return include_file(keyword);
    take_data_of_file(keyword);
    deck_.keywords.push_back(std::move(keyword));
  }

  /// INPUT names a file of the keyword's data lines.
  void take_data_of_file(DeckKeyword& keyword) {
    const auto input = std::ranges::find(keyword.parameters, "INPUT", &DeckParameter::name);
    if (input == keyword.parameters.end() || input->value.empty()) return;
    const std::string path = path_of(input->value, keyword);
    deck_.files.push_back(std::make_unique<Deck::File>(Deck::File{path, include_(path, keyword.where)}));
    const Deck::File& file = *deck_.files.back();
    int line = 1;
    for (std::size_t at = 0; at < file.bytes.size(); ++line) {
      const std::string_view content = trimmed(take_line(file.bytes, at));
      if (content.starts_with('*') && !is_comment(content))
        throw CaseError({path, line, 0}, "*" + keyword.name, printable(content), "data lines alone",
                        "A file with keywords stands in *INCLUDE.");
    }
    keyword.data.push_back({&file.name, 1, file.bytes});
    keyword.parameters.erase(input);
  }

  /// Counts from the folder of the file that the keyword stands in.
  static std::string path_of(const std::string& input, const DeckKeyword& keyword) {
    const std::filesystem::path path(input);
    const auto folder = std::filesystem::path(keyword.where.file).parent_path();
    return (path.is_absolute() ? path : folder / path).string();
  }

  static DeckParameter parameter(std::string_view text, const KeywordEntry* entry, const DeckKeyword& keyword) {
    const std::size_t equals = text.find('=');
    const std::string name = upper_case(trimmed(text.substr(0, equals)));
    std::string_view value = equals == std::string_view::npos ? "" : trimmed(text.substr(equals + 1));
    if (std::ranges::count(value, '"') % 2 != 0)
      keyword.fail(printable(value), "a closing quotation mark", "Names with blanks stand in \"quotes\".");
    const auto is_plain = [](char c) { return c >= 32 && c < 127; };
    if (!std::all_of(value.begin(), value.end(), is_plain) || !std::all_of(name.begin(), name.end(), is_plain))
      keyword.fail(printable(as_utf8(text)), "letters of ASCII, without umlauts and accents",
                   "Rename it, wherever the deck has it.");
    return {entry != nullptr ? parameter_name(*entry, name) : without_blanks(name), without_quotes(value)};
  }

  void include_file(const DeckKeyword& keyword) {
    const std::string* input = keyword.parameter("INPUT");
    if (input == nullptr || input->empty())
      keyword.fail("no file", "INPUT=NAME", "*INCLUDE, INPUT=mesh.inp reads that file in this place.");
    constexpr int deepest = 16;
    if (++depth_ > deepest)
      keyword.fail(fmt::format("files included {} deep", depth_), fmt::format("at most {}", deepest),
                   "Does a file include itself?");
    const std::string whole = path_of(*input, keyword);
    read(include_(whole, keyword.where), whole);
    --depth_;
  }

  Deck& deck_;
  const IncludeReader& include_;
  int depth_ = 0;
};

}  // namespace

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return upper;
}

std::string deck_name(std::string_view text) {
  return upper_case(without_quotes(text));
}

const std::string* DeckKeyword::parameter(std::string_view wanted) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const DeckParameter& p) { return p.name == wanted; });
  return found == parameters.end() ? nullptr : &found->value;
}

std::string DeckKeyword::required(std::string_view wanted) const {
  const std::string* value = parameter(wanted);
  if (value == nullptr || value->empty())
    fail(fmt::format("no {}", wanted), fmt::format("{}=NAME", wanted), "Add it to the keyword.");
  return upper_case(*value);
}

void DeckKeyword::fail(std::string found, std::string expected, std::string suggestion) const {
  throw CaseError(where, "*" + name, std::move(found), std::move(expected), std::move(suggestion));
}

bool looks_like_deck(std::string_view bytes) {
  bytes.remove_prefix(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string_view line = trimmed(take_line(bytes, at));
    if (line.empty() || is_comment(line)) continue;
    return line.size() > 1 && line[0] == '*' && std::isalpha(static_cast<unsigned char>(line[1])) != 0;
  }
  return false;
}

Deck read_deck(std::string bytes, const std::string& source, const IncludeReader& include) {
  refuse_foreign(bytes, source);
  Deck deck;
  DeckReader(deck, include).read(std::move(bytes), source);
  return deck;
}

std::string read_included(const std::string& path, const Location& where) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path, error))
    throw CaseError(where, "*INCLUDE", "no file " + path, "a file that can be read",
                    path.find('\\') == std::string::npos
                        ? "The path counts from the folder of the file that includes it."
                        : "Folders are parted by /.");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace carom
