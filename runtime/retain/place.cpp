// SPDX-License-Identifier: Apache-2.0
// Places in programs as text. See place.hpp.
//
//   ncplace 1
//   system 0
//   program part.nc
//   block 12 0 0 11          line, O number, depth, line of the main program that was finished last
//   at X 1.5
//   restart 14 812 (SHA-256, or -)        blocks, bytes of the program, its hash; with all that follows only where it is known
//   begun X 0
//   coordinates 0          of the coordinate systems what it was begun with: 1 where G16 was in force; without this line it is not known
//   coordinate 0 X 30      CoordinateRow: what, axis, value
//   mirrored XZ            axes that the machine's switches had mirrored, "-" = none; without this line it is not known
//   cause power
//   end
#include "runtime/retain/place.hpp"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace nc::rt {
namespace {

constexpr const char* kPlaceHead = "ncplace 1";
constexpr const char* kNoText = "-";

// A name without what would end its line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

std::string number(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

bool read_axis(std::istringstream* words, std::vector<std::pair<char, double>>* axes) {
  std::string axis;
  double value = 0;
  if (!(*words >> axis >> value) || axis.size() != 1 || !std::isfinite(value) || axes->size() >= NC_MAX_AXES) return false;
  axes->emplace_back(axis[0], value);
  return true;
}

bool read_coordinate(std::istringstream* words, CoordinatesBegun* begun) {
  std::string axis;
  CoordinateRow row;
  if (!(*words >> row.of >> axis >> row.value) || row.of >= kCoordinateKinds || axis.size() != 1 || !std::isfinite(row.value)) return false;
  if (!begun->known || begun->rows.size() >= std::size_t{kCoordinateKinds} * NC_MAX_AXES) return false;
  row.axis = axis[0];
  begun->rows.push_back(row);
  return true;
}

bool read_restart(std::istringstream* words, ProgramPlace* place) {
  if (!(*words >> place->blocks >> place->size >> place->hash)) return false;
  if (place->hash == "-") place->hash.clear();
  return true;
}

bool read_line(const std::string& line, std::vector<ProgramPlace>* places) {
  std::istringstream words(line);
  std::string key;
  words >> key;
  if (key == "system") {
    unsigned system = 0;
    if (!(words >> system) || system >= NC_MAX_SYSTEMS) return false;
    places->emplace_back().system = system;
    return true;
  }
  if (places->empty()) return false;
  ProgramPlace& place = places->back();
  if (key == "program") {
    place.program = line.size() > 8 ? line.substr(8) : "";
    return true;
  }
  if (key == "block") return static_cast<bool>(words >> place.line >> place.number >> place.depth >> place.main_line);
  if (key == "restart") return place.restartable = read_restart(&words, &place);
  if (key == "cause") return static_cast<bool>(words >> place.cause);
  if (key == "coordinates") return place.coordinates.known = static_cast<bool>(words >> place.coordinates.polar);
  if (key == "mirrored") {
    CoordinatesBegun& begun = place.coordinates;
    begun.mirror_known = static_cast<bool>(words >> begun.mirrored) && begun.mirrored.size() <= NC_MAX_AXES;
    if (begun.mirrored == kNoText) begun.mirrored.clear();
    return begun.mirror_known;
  }
  if (key == "coordinate") return read_coordinate(&words, &place.coordinates);
  if (key == "at") return read_axis(&words, &place.at);
  return key == "begun" && read_axis(&words, &place.begun);
}

}  // namespace

std::string encode_places(const std::vector<ProgramPlace>& places) {
  if (places.empty()) return {};
  std::ostringstream text;
  text << kPlaceHead << '\n';
  for (const ProgramPlace& place : places) {
    text << "system " << place.system << "\nprogram " << one_line(place.program) << "\nblock " << place.line << ' ' << place.number << ' '
         << place.depth << ' ' << place.main_line << '\n';
    for (const auto& [axis, value] : place.at) text << "at " << axis << ' ' << number("%.9g", value) << '\n';
    if (place.restartable) text << "restart " << place.blocks << ' ' << place.size << ' ' << (place.hash.empty() ? kNoText : place.hash) << '\n';
    for (const auto& [axis, value] : place.begun) text << "begun " << axis << ' ' << number("%.17g", value) << '\n';
    if (place.coordinates.known) text << "coordinates " << place.coordinates.polar << '\n';
    for (const CoordinateRow& row : place.coordinates.rows) text << "coordinate " << row.of << ' ' << row.axis << ' ' << number("%.17g", row.value) << '\n';
    if (place.coordinates.mirror_known) text << "mirrored " << (place.coordinates.mirrored.empty() ? kNoText : place.coordinates.mirrored) << '\n';
    if (!place.cause.empty()) text << "cause " << place.cause << '\n';
  }
  text << "end\n";
  return text.str();
}

bool decode_places(const std::string& bytes, std::vector<ProgramPlace>* places) {
  places->clear();
  if (bytes.empty()) return true;
  std::istringstream lines(bytes);
  std::string line;
  bool good = std::getline(lines, line) && line == kPlaceHead, ended = false;
  while (good && !ended && std::getline(lines, line)) {
    ended = line == "end";
    good = ended || (places->size() <= 2 * NC_MAX_SYSTEMS && read_line(line, places));
  }
  if (good && ended) return true;
  places->clear();
  return false;
}

std::string place_text(const std::vector<ProgramPlace>& places, bool systems) {
  std::string text;
  for (const ProgramPlace& place : places) {
    if (!text.empty()) text += "; ";
    if (systems) text += "part system " + std::to_string(place.system + 1) + ": ";
    text += place.program;
    if (place.depth != 0 && place.main_line != 0) text += ", behind line " + std::to_string(place.main_line);
    if (place.depth != 0) text += place.number != 0 ? ", in O" + std::to_string(place.number) : std::string(", in a sub program");
    if (place.line != 0) text += ", line " + std::to_string(place.line);
    for (std::size_t i = 0; i < place.at.size(); ++i)
      text += (i == 0 ? ", " : " ") + std::string(1, place.at[i].first) + number("%.3f", place.at[i].second);
  }
  return text;
}

bool PlaceData::restore(const std::string& bytes) { return decode_places(bytes, &found_); }

bool StopData::restore(const std::string& bytes) {
  std::vector<ProgramPlace> places;
  if (!decode_places(bytes, &places)) return false;
  feeder_.set_stops(places);
  return true;
}

bool PlaceData::take(std::string* bytes) {
  if (!feeder_.take(Feeder::kPlace, bytes)) return false;
  *bytes = kept_or(*bytes);
  return true;
}

}  // namespace nc::rt
