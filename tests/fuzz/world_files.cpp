// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texts of mesh files, made of the mesh and then damaged, and polygons of any kind.
#include <algorithm>
#include <charconv>
#include <memory>
#include <string>

#include "world.h"
#include "world_call.h"

namespace meander::fuzz {
namespace {

std::string text_of(double x) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

/// The points and faces of a mesh as the text of a file: 0: OBJ, 1: its lines, 2: STL, 3: numbers alone.
std::string text_of(const std::vector<double>& vertices, const std::vector<uint32_t>& faces, unsigned kind) {
  std::string text = kind == 2 ? "solid a\n" : kind == 3 ? "" : "# a\no a\n";
  const auto place = [&](size_t v) {
    for (size_t k = 3 * v; k < std::min(3 * v + 3, vertices.size()); ++k) text += " " + text_of(vertices[k]);
    text += "\n";
  };
  if (kind != 2) {
    for (size_t v = 0; v < vertices.size() / 3; ++v) {
      if (kind != 3) text += "v";
      place(v);
    }
  }
  for (size_t f = 0; f + 2 < faces.size() && kind != 3; f += 3) {
    if (kind != 2) text += kind == 0 ? "f" : "l";
    if (kind == 2) text += "facet normal 0 0 1\nouter loop\n";
    for (size_t k = f; k < f + 3; ++k) {
      if (kind != 2) {
        text += " " + std::to_string(static_cast<int64_t>(faces[k]) + 1);
        continue;
      }
      text += "vertex";
      place(faces[k]);
    }
    text += kind == 2 ? "endloop\nendfacet\n" : "\n";
  }
  return text;
}

/// Bytes of it replaced, left out, doubled, or by what such files hold.
std::string damaged(std::string text, Noise noise, unsigned times) {
  static const char* const kPieces[] = {"f",  "v ",   "l ", "-1", "/", "//2", "nan",      "1e999", "0x1p3", "endloop",
                                        "\r", "\r\n", "\\\n", "#", " ", "\t",  "4294967297", "-",     "\xef\xbb\xbf"};
  for (unsigned k = 0; k < times; ++k) {
    const size_t at = text.empty() ? 0 : noise.next() % text.size();
    const std::string piece = kPieces[noise.next() % std::size(kPieces)];
    switch (noise.next() % 5) {
      case 0: text.insert(at, piece); break;
      case 1: text.replace(at, std::min<size_t>(piece.size(), text.size() - at), piece); break;
      case 2: text.erase(at, noise.next() % 9); break;
      case 3: text.resize(at); break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(noise.next());
    }
  }
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const char octal[] = {'\\', static_cast<char>('0' + (byte >> 6)), static_cast<char>('0' + (byte >> 3 & 7)),
                          static_cast<char>('0' + (byte & 7)), '\0'};
    out += octal;
  }
  return out + "\"";
}

}  // namespace

/// The text as the record says, exactly as long as the call is told, so that what reads on is found.
Shown<const char*> World::text(std::unique_ptr<char[]>& memory, size_t& size) {
  const unsigned kind = record_.op % kOpCount == kReadNumbers ? 3u : record_.a % 3u;
  const std::string made = damaged(text_of(in_.vertices, in_.faces, kind), Noise(record_.b), record_.c % 16u);
  size = made.size();
  memory.reset(new char[size]);
  std::copy(made.begin(), made.end(), memory.get());
  if (missing(0)) return {nullptr, "nullptr"};
  return {memory.get(), transcript_.open() ? quoted(made) : ""};
}

void World::read_polygons() {
  std::unique_ptr<char[]> memory;
  size_t size = 0;
  const auto given_text = text(memory, size);
  const uint32_t kind = record_.d < 240 ? record_.a % 3u : record_.d;
  Filled<meander_polygons> polygons(transcript_, "meander_polygons", "polygons", missing(1), missing(2));
  const meander_status status = call("meander_text_read_polygons", meander_text_read_polygons, given_text, shown(size),
                                     shown(kind), polygons.shown());
  if (!polygons.check(status)) return;
  uint64_t before = 0;
  for (size_t p = 0; p < polygons->polygon_count; ++p) {
    if (polygons->ends[p] < before) fail(transcript_, "ends of polygons that fall");
    before = polygons->ends[p];
    if (polygons->lines[p] == 0 || polygons->lines[p] > size + 1) fail(transcript_, "a line that is not there");
  }
  if (before != polygons->corner_count) fail(transcript_, "corners of no polygon");
  polygons.indices(polygons->corners, polygons->corner_count, polygons->point_count);
}

void World::read_numbers() {
  std::unique_ptr<char[]> memory;
  size_t size = 0;
  const auto given_text = text(memory, size);
  const size_t room = missing(1) ? 0 : room_for(size);
  Outputs outputs(transcript_);
  const auto numbers = outputs.array<double>("numbers", room, missing(1), true);
  size_t count = 0, end = 0;
  transcript_.line("size_t count = 0, end = 0;");
  const meander_status status = call("meander_text_read_numbers", meander_text_read_numbers, given_text, shown(size),
                                     numbers, shown(room), out(count, "count"), out(end, "end"));
  if (status == MEANDER_STATUS_OK && (count > room || end > size)) fail(transcript_, "more numbers than there is room");
}

/// Rows with room for all of them, and for as many as the record says, again and again: the same text.
void World::write_rows() {
  static const char* const kPatterns[] = {"%d\n", "v %.17g %.9g %.0g\n", "%.3f,%.0f;%.17f", "%.4r %.0r", "%%%d%%", "x"};
  constexpr size_t kColumns[] = {1, 3, 3, 2, 1, 0};
  constexpr size_t kMostOfNumber = 330;
  Noise noise(record_.b);
  const size_t kind = record_.a % std::size(kPatterns), rows = record_.d % 16u;
  // Up to the first zero, as the library reads it.
  const std::string pattern = damaged(kPatterns[kind], noise, record_.c % 4u).c_str();
  const size_t columns = record_.c < 128 ? kColumns[kind] : record_.c % 5u;
  std::vector<double> values(rows * columns);
  for (double& x : values) x = std::ldexp(noise.share() - 0.5, static_cast<int>(noise.next() % 140) - 70);
  if (record_.e && !values.empty()) values[record_.e % values.size()] = hostile(record_.e);
  if (transcript_.open()) {
    transcript_.line("std::vector<double> values = " + written(values) + ";");
    transcript_.line("size_t size = 0, written_rows = 0;");
  }
  size_t size = 0, made = 0;
  const std::unique_ptr<char[]> exact(new char[pattern.size() + 1]);
  std::copy_n(pattern.c_str(), pattern.size() + 1, exact.get());
  const auto write = [&](size_t done, char* to, size_t room) {
    const std::string place = transcript_.open() ? "std::vector<char>(" + std::to_string(room) + ").data()" : "";
    const Shown<const double*> from{missing(1) ? nullptr : values.data() + done * columns,
                                    missing(1) ? "nullptr" : "values.data() + " + std::to_string(done * columns)};
    return call("meander_text_write_rows", meander_text_write_rows,
                Shown<const char*>{missing(0) ? nullptr : exact.get(),
                                   missing(0) || !transcript_.open() ? "nullptr" : quoted(pattern)},
                from, shown(rows - done), shown(columns), Shown<char*>{to, to ? place : "nullptr"}, shown(room),
                out(size, "size"),
                missing(2) ? Shown<size_t*>{nullptr, "nullptr"} : Shown<size_t*>{&made, "&written_rows"});
  };
  const size_t most = rows * (columns * kMostOfNumber + pattern.size());
  const std::unique_ptr<char[]> all(new char[most]);
  if (write(0, all.get(), most) != MEANDER_STATUS_OK) return;
  if (made != rows || size > most) fail(transcript_, "rows were left out that there was room for");
  const std::string whole(all.get(), size);
  std::string joined;
  const size_t room = has(kNothingFits) ? 0 : size / 2 + 1;
  for (size_t done = 0; done < rows; done += made) {
    const std::unique_ptr<char[]> little(new char[room]);
    if (write(done, little.get(), room) != MEANDER_STATUS_OK) fail(transcript_, "the rest of the rows was refused");
    if (made > rows - done || size > room) fail(transcript_, "more rows than there is room for");
    if (made == 0) break;
    joined.append(little.get(), size);
    if (done + made == rows && joined != whole) fail(transcript_, "other text in parts than at once");
  }
}

void World::triangulate() {
  Noise noise(record_.a);
  std::vector<uint32_t> corners(in_.faces);
  std::vector<uint64_t> ends;
  if (record_.b % 4 == 1 && !corners.empty()) corners[record_.c % corners.size()] = noise.next();
  if (record_.b % 4 == 2) corners.resize(corners.size() / 2);
  for (uint64_t at = 0; at < corners.size();) {
    at = std::min<uint64_t>(corners.size(), at + (record_.d ? noise.next() % record_.d : 3));
    ends.push_back(at);
    if (ends.size() > 300) ends.back() = at = corners.size();
  }
  if (record_.e && !ends.empty()) ends[record_.e % ends.size()] = noise.next() % (corners.size() + 3);
  if (transcript_.open()) {
    transcript_.line("std::vector<uint32_t> corners = " + written(corners) + ";");
    transcript_.line("std::vector<uint64_t> ends = " + written(ends) + ";");
  }
  Filled<meander_triangles> triangles(transcript_, "meander_triangles", "triangles", missing(3), missing(4));
  auto vertices = given(in_.vertices, "vertices");
  auto given_corners = given(corners, "corners");
  auto given_ends = given(ends, "ends");
  if (missing(0)) vertices = {nullptr, "nullptr"};
  if (missing(1)) given_corners = {nullptr, "nullptr"};
  if (missing(2)) given_ends = {nullptr, "nullptr"};
  const meander_status status =
      call("meander_polygons_triangulate", meander_polygons_triangulate, vertices, shown(in_.vertex_count()),
           given_corners, shown(corners.size()), given_ends, shown(ends.size()), triangles.shown());
  if (!triangles.check(status)) return;
  if (triangles->count > corners.size()) fail(transcript_, "more triangles than corners");
  triangles.indices(triangles->polygons, triangles->count, ends.size());
  for (size_t k = 0; k < 3 * triangles->count; ++k) {
    if (std::find(corners.begin(), corners.end(), triangles->corners[k]) == corners.end()) {
      fail(transcript_, "a corner of no polygon");
    }
  }
}

}  // namespace meander::fuzz
