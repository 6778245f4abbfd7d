// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>

#include "base/failure.h"
#include "mesh/constants.h"

namespace meander {
namespace {

/// Indices travel in 32 bits; a larger one cannot even be handed on to be refused.
constexpr int64_t kIndexLimit = UINT32_MAX;

bool is_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// What from_chars found too large or too small: 0 or infinity, with the sign of the text.
double beyond_range(std::string_view word) {
  const bool minus = word.front() == '-';
  if (minus) word.remove_prefix(1);
  const size_t e = word.find_first_of("eE");
  const bool has_exponent = e != std::string_view::npos;
  const bool small =
      has_exponent ? e + 1 < word.size() && word[e + 1] == '-' : word.front() == '0' || word.front() == '.';
  const double value = small ? 0 : std::numeric_limits<double>::infinity();
  return minus ? -value : value;
}

/// What some compilers put behind "1." for no number: 1.#QNAN, -1.#IND, 1.#INF.
bool is_no_number(std::string_view behind) {
  return behind.starts_with("#QNAN") || behind.starts_with("#SNAN") || behind.starts_with("#IND") ||
         behind.starts_with("#INF");
}

/// A word as a number; false: it is none.
bool read_number(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
    if (!word.empty() && word.front() == '-') return false;
  }
  if (word.empty()) return false;
  const char* const stop = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), stop, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) value = beyond_range(word);
  if (end == stop) return true;
  const std::string_view behind(end, static_cast<size_t>(stop - end));
  if (!is_no_number(behind)) return false;
  value = behind.starts_with("#INF") ? std::copysign(HUGE_VAL, value) : NAN;
  return true;
}

/// Goes over a text, a word after the other, and knows in which line it is.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool done() const { return at_ == text_.size(); }
  size_t at() const { return at_; }
  uint32_t line() const { return line_; }

  /// To the beginning of the next line.
  void next_line() {
    while (!done() && !is_end(text_[at_])) ++at_;
    if (!done()) pass_end();
  }

  /// The next word of the line, empty at its end; `comments`: # ends it, and a backslash there continues it.
  std::string_view word(bool comments) {
    while (!done()) {
      if (is_blank(text_[at_])) {
        ++at_;
      } else if (comments && continues()) {
        next_line();
      } else {
        break;
      }
    }
    const size_t begin = at_;
    while (!done() && !is_end(text_[at_]) && !is_blank(text_[at_]) && !(comments && (is_comment() || continues()))) {
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  /// The next word, in whichever line.
  std::string_view any_word() {
    while (!done() && (is_blank(text_[at_]) || is_end(text_[at_]))) {
      if (is_end(text_[at_])) pass_end();
      else ++at_;
    }
    return word(false);
  }

  /// Back to a place in the same line.
  void back_to(size_t at) { at_ = at; }

  /// The line that begins at a place, as a sentence quotes it.
  std::string quoted(size_t begin) const {
    size_t end = begin;
    while (end < text_.size() && !is_end(text_[end])) ++end;
    std::string line(text_.substr(begin, std::min(end - begin, 4 * kQuotedCharacters)));
    while (!line.empty() && is_blank(line.back())) line.pop_back();
    line.erase(0, std::min(line.find_first_not_of(" \t\v\f"), line.size()));
    if (line.size() > kQuotedCharacters) {
      size_t cut = kQuotedCharacters - 3;
      while (cut > 0 && (static_cast<unsigned char>(line[cut]) & 0xC0) == 0x80) --cut;  // within a letter of UTF-8
      line = line.substr(0, cut) + "...";
    }
    for (char& c : line) {
      if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
    }
    return '\'' + line + '\'';
  }

 private:
  /// A comment may stand at once behind a number.
  bool is_comment() const {
    return text_[at_] == '#' && !(at_ > 0 && text_[at_ - 1] == '.' && is_no_number(text_.substr(at_)));
  }
  /// Blanks behind a backslash are not seen in an editor, and the last line may have no end.
  bool continues() const {
    if (text_[at_] != '\\') return false;
    size_t behind = at_ + 1;
    while (behind < text_.size() && is_blank(text_[behind])) ++behind;
    return behind == text_.size() || is_end(text_[behind]);
  }
  void pass_end() {
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
  }

  std::string_view text_;
  size_t at_ = 0;
  uint32_t line_ = 1;
};

[[noreturn]] void malformed(uint32_t line, const std::string& what) {
  throw Failure(FailureKind::kInvalidMesh, "Line " + std::to_string(line) + ": " + what + "; correct the file.");
}

class Reader {
 public:
  Reader(std::string_view text, TextPolygons& polygons) : scanner_(text), polygons_(polygons) {}

  void obj(bool lines);
  void stl(bool names);

 private:
  void obj_point(size_t begin, uint32_t line);
  void obj_polygon(size_t begin, uint32_t line, size_t least, const char* wanted);
  uint32_t index(std::string_view word, size_t begin, uint32_t line, const char* wanted);
  void add_point(const double* place) {
    polygons_.positions.insert(polygons_.positions.end(), place, place + 3);
  }
  void add_corner(uint32_t vertex) { polygons_.corners.push_back(vertex); }
  /// The corners since the last polygon are one, unless they are too few.
  void close_polygon(uint32_t line, size_t least) {
    if (polygons_.corners.size() - begun_ < least) {
      polygons_.corners.resize(begun_);
      ++polygons_.left_out;
      return;
    }
    polygons_.ends.push_back(polygons_.corners.size());
    polygons_.lines.push_back(line);
    begun_ = polygons_.corners.size();
  }

  Scanner scanner_;
  TextPolygons& polygons_;
  size_t begun_ = 0;  // where the corners of the polygon that is being read begin
  uint32_t greatest_ = 0, greatest_line_ = 0;
};

void Reader::obj_point(size_t begin, uint32_t line) {
  double place[3];
  for (double& coordinate : place) {
    const std::string_view word = scanner_.word(true);
    if (read_number(word, coordinate)) continue;
    malformed(line, scanner_.quoted(begin) + " is not a vertex with three coordinates" +
                        (word.find(',') == std::string_view::npos ? "" : " (numbers have a point, not a comma)"));
  }
  add_point(place);
}

/// The vertex of a reference such as 7, 7/1/3 or -1, counted from 0. One past the end is allowed here.
uint32_t Reader::index(std::string_view word, size_t begin, uint32_t line, const char* wanted) {
  const char* first = word.data();
  const char* const stop = first + word.size();
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') ++first;
  int64_t value = 0;
  const auto [end, error] = std::from_chars(first, stop, value);
  if (error == std::errc() && (end == stop || *end == '/') && value != 0) {
    const int64_t place = value > 0 ? value - 1 : static_cast<int64_t>(polygons_.point_count()) + value;
    if (place >= 0 && place < kIndexLimit) {
      const auto found = static_cast<uint32_t>(place);
      if (greatest_line_ == 0 || found > greatest_) {
        greatest_ = found;
        greatest_line_ = line;
      }
      return found;
    }
    if (place >= 0) malformed(line, "there is no vertex " + std::to_string(value));
    if (value < 0) {
      malformed(line, "there is no vertex " + std::to_string(value) + ", as only " +
                          std::to_string(polygons_.point_count()) + " stand before this line");
    }
  }
  if (error == std::errc::result_out_of_range) {
    malformed(line, "there is no vertex " + std::string(word.substr(0, word.find('/'))));
  }
  malformed(line, scanner_.quoted(begin) + " is not " + wanted);
}

void Reader::obj_polygon(size_t begin, uint32_t line, size_t least, const char* wanted) {
  for (std::string_view word = scanner_.word(true); !word.empty(); word = scanner_.word(true)) {
    add_corner(index(word, begin, line, wanted));
  }
  if (least == 2 && polygons_.corners.size() - begun_ < least) {
    malformed(line, scanner_.quoted(begin) + " is not " + wanted);
  }
  close_polygon(line, least);
}

void Reader::obj(bool lines) {
  const char wanted = lines ? 'l' : 'f';
  for (; !scanner_.done(); scanner_.next_line()) {
    const std::string_view word = scanner_.word(false);
    if (word.size() != 1) continue;
    const size_t begin = scanner_.at() - 1;
    const uint32_t line = scanner_.line();
    if (word[0] == 'v') {
      obj_point(begin, line);
    } else if (word[0] == wanted && lines) {
      obj_polygon(begin, line, 2, "a line of two or more vertices, counted from 1");
    } else if (word[0] == wanted) {
      obj_polygon(begin, line, 3, "a face of vertices, counted from 1");
    }
  }
  if (greatest_line_ != 0 && greatest_ >= polygons_.point_count()) {
    malformed(greatest_line_, "there is no vertex " + std::to_string(uint64_t{greatest_} + 1) + ", the file has " +
                                  std::to_string(polygons_.point_count()));
  }
}

bool is_word(std::string_view word, std::string_view wanted) {
  return std::ranges::equal(word, wanted, [](char a, char b) { return lower(a) == b; });
}

/// `names`: what follows solid and endsolid in their line is a name.
void Reader::stl(bool names) {
  uint32_t first = 0;  // the line of the first corner of a loop
  while (true) {
    const std::string_view word = scanner_.any_word();
    if (word.empty()) break;
    if (names && (is_word(word, "solid") || is_word(word, "endsolid"))) {
      scanner_.next_line();
    } else if (is_word(word, "vertex")) {
      const uint32_t line = scanner_.line();
      const size_t begin = scanner_.at() - word.size();
      double place[3];
      for (double& coordinate : place) {
        if (read_number(scanner_.any_word(), coordinate)) continue;
        malformed(line, scanner_.quoted(begin) + " is not a vertex with three coordinates");
      }
      if (polygons_.corners.size() == begun_) first = line;
      add_corner(static_cast<uint32_t>(std::min<size_t>(polygons_.point_count(), UINT32_MAX)));
      add_point(place);
    } else if ((is_word(word, "endloop") || is_word(word, "endfacet") || is_word(word, "facet")) &&
               polygons_.corners.size() > begun_) {
      close_polygon(first, 3);
    }
  }
  if (polygons_.corners.size() - begun_ == 3) close_polygon(first, 3);
  if (polygons_.corners.size() != begun_) {
    throw Failure(FailureKind::kInvalidMesh,
                  "Line " + std::to_string(first) + ": the file ends within a triangle; export it again.");
  }
}

}  // namespace

TextPolygons read_text(std::string_view text, TextKind kind) {
  TextPolygons polygons;
  if (kind != TextKind::kStl) {
    Reader(text, polygons).obj(kind == TextKind::kObjLines);
    return polygons;
  }
  Reader(text, polygons).stl(true);
  // All in one line: then there is no name, or one that ends where the first facet begins.
  if (polygons.positions.empty()) Reader(text, polygons).stl(false);
  return polygons;
}

size_t read_numbers(std::string_view text, std::span<double> numbers, size_t& end) {
  Scanner scanner(text);
  size_t count = 0;
  end = 0;
  for (; count < numbers.size(); ++count) {
    const std::string_view word = scanner.any_word();
    if (word.empty() || !read_number(word, numbers[count])) {
      end = scanner.at() - word.size();
      return count;
    }
    end = scanner.at();
  }
  return count;
}

}  // namespace meander
