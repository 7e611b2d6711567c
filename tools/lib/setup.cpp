// SPDX-License-Identifier: Apache-2.0
// Reads a setup file; see setup.hpp. Every key that is not in the format and every value of a wrong type is
// an error that names the path of the key and its line. Inside this file errors are exceptions, which parse_setup()
// catches.
#include "tools/lib/setup.hpp"

#include <cmath>
#include <limits>

#include "tools/lib/json_check.hpp"
#include "tools/lib/number_text.hpp"

namespace nc::tools {
namespace {

using namespace json;  // NOLINT(google-build-using-namespace): this file uses the checks everywhere

// The number from 0 to `limit` that a text of digits is; nothing for any other text.
std::optional<uint32_t> digits(const std::string& key, uint32_t limit) {
  if (key.empty() || key.size() > 9) return std::nullopt;
  uint32_t value = 0;
  for (char c : key) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + static_cast<uint32_t>(c - '0');
  }
  return value <= limit ? std::optional(value) : std::nullopt;
}

/** Fills one Setup from one tree. */
class SetupReader {
 public:
  SetupReader(Setup* setup) : s_(*setup) {}

  void read(const JsonNode& root) {
    if (root.type != Type::kObject)
      fail(root, "", std::string("a setup must be an object, is ") + root.type_name());
    check_keys(root, "",
               {"axes", "params", "kinematics", "start", "work_offsets", "offsets", "vars", "inputs", "skip", "hits",
                "switches", "subprograms", "events", "options", "clock"});
    // The axes come first, because all other keys may name them.
    if (const JsonNode* node = member(root, "axes")) axes(*node);
    for (const auto& [key, node] : root.members) {
      if (key == "params") parameters(node);
      if (key == "kinematics") kinematics(node);
      if (key == "start") start(node);
      if (key == "work_offsets") work_offsets(node);
      if (key == "offsets") tool_offsets(node);
      if (key == "vars") variables(node);
      if (key == "inputs") s_.inputs = inputs(node, "inputs");
      if (key == "skip") skip(node);
      if (key == "hits") hits(node);
      if (key == "switches") switches(node);
      if (key == "subprograms") subprograms(node);
      if (key == "events") events(node);
      if (key == "options") options(node);
      if (key == "clock") clock(node);
    }
    check_work_offsets();
  }

 private:
  const JsonNode& object(const JsonNode& node, const std::string& path) {
    return expect(node, path, Type::kObject);
  }
  const JsonNode& list(const JsonNode& node, const std::string& path) {
    return expect(node, path, Type::kArray);
  }

  unsigned axis(const JsonNode& node, const std::string& path, const std::string& name) {
    const int index = name.size() == 1 ? s_.axis_index(name[0]) : -1;
    if (index < 0) fail(node, path, "the setup has no axis \"" + name + "\"");
    return static_cast<unsigned>(index);
  }

  char axis_letter(const JsonNode& node, const std::string& path) {
    const std::string& name = text(node, path);
    if (name.size() != 1 || std::string("ABCUVWXYZ").find(name[0]) == std::string::npos)
      fail(node, path, "an axis is one of A B C U V W X Y Z");
    if (s_.axis_index(name[0]) >= 0) fail(node, path, "the axis " + name + " stands here twice");
    return name[0];
  }

  void axes(const JsonNode& node) {
    list(node, "axes");
    if (node.items.empty() || node.items.size() > NC_MAX_AXES)
      fail(node, "axes", "a part system has 1 to " + std::to_string(NC_MAX_AXES) + " axes");
    s_.axes.clear();
    for (size_t i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const std::string path = item_path("axes", i);
      SetupAxis entry;
      if (item.type == Type::kString) {
        entry.name = axis_letter(item, path);
      } else {
        if (item.type != Type::kObject)
          fail(item, path, "must be a letter or an object with name and rotary");
        check_keys(item, path, {"name", "rotary"});
        const JsonNode* name = member(item, "name");
        if (!name) fail(item, path, "the key name is missing");
        entry.name = axis_letter(*name, path + ".name");
        if (const JsonNode* rotary = member(item, "rotary"))
          entry.rotary = boolean(*rotary, path + ".rotary");
      }
      s_.axes.push_back(entry);
    }
  }

  std::string parameter_text(const JsonNode& node, const std::string& path) {
    if (node.type == Type::kString) {
      for (const char c : node.text)
        if (static_cast<unsigned char>(c) < 0x20) fail(node, path, "has a control character");
      return node.text;
    }
    if (node.type != Type::kNumber) fail(node, path, "must be a number, a string or an object by axis");
    char out[kNumberText];
    return std::string(out, number_text(node.number, out));
  }

  void parameters(const JsonNode& node) {
    for (const auto& [key, value] : object(node, "params").members) {
      const std::string path = "params." + key;
      if (value.type != Type::kObject) {
        s_.parameters.push_back({{path, value.line}, key, 0, parameter_text(value, path)});
        continue;
      }
      for (const auto& [name, entry] : value.members) {
        const std::string axis_path = join(path, name);
        const unsigned index = axis(entry, axis_path, name);
        if (entry.type == Type::kObject) fail(entry, axis_path, "must be a number or a string");
        s_.parameters.push_back(
            {{axis_path, entry.line}, key, s_.axes[index].name, parameter_text(entry, axis_path)});
      }
    }
  }

  std::string axis_list(const JsonNode& node, const std::string& path) {
    std::string names;
    list(node, path);
    for (size_t i = 0; i < node.items.size(); ++i) {
      const std::string& name = text(node.items[i], item_path(path, i));
      axis(node.items[i], item_path(path, i), name);
      names += name;
    }
    if (names.empty() || names.size() > 2) fail(node, path, "one or two rotary axes");
    return names;
  }

  void kinematics(const JsonNode& node) {
    const std::string path = "kinematics";
    check_keys(object(node, path), path,
               {"type", "tool", "table", "center", "sense", "program_frame", "interpolation"});
    SetupKinematics k;
    const JsonNode* type = member(node, "type");
    if (!type) fail(node, path, "the key type is missing");
    k.type = one_of(*type, path + ".type", {"tool_tilt", "table_tilt", "combined"});
    if (const JsonNode* tool = member(node, "tool")) k.tool = axis_list(*tool, path + ".tool");
    if (const JsonNode* table = member(node, "table")) k.table = axis_list(*table, path + ".table");
    if (k.type != "table_tilt" && k.tool.empty()) fail(node, path, "the key tool is missing");
    if (k.type != "tool_tilt" && k.table.empty()) fail(node, path, "the key table is missing");
    if (const JsonNode* center = member(node, "center"))
      for (const SetupAxisValue& v : axis_values(*center, path + ".center")) k.center[v.axis] = v.value;
    if (const JsonNode* sense = member(node, "sense")) k.sense = one_of(*sense, path + ".sense", {"iso"});
    if (const JsonNode* frame = member(node, "program_frame"))
      k.program_frame = one_of(*frame, path + ".program_frame", {"table", "work"});
    if (const JsonNode* way = member(node, "interpolation"))
      k.interpolation = one_of(*way, path + ".interpolation", {"single_axis", "joint"});
    s_.kinematics = k;
  }

  std::vector<SetupAxisValue> axis_values(const JsonNode& node, const std::string& path) {
    std::vector<SetupAxisValue> values;
    for (const auto& [name, value] : object(node, path).members) {
      const std::string value_path = join(path, name);
      const unsigned index = axis(value, value_path, name);
      values.push_back({{value_path, value.line}, index, number(value, value_path)});
    }
    return values;
  }

  void start(const JsonNode& node) {
    for (const SetupAxisValue& v : axis_values(node, "start")) s_.start.v[v.axis] = v.value;
  }

  // Converts EXT, G54 ... G59 and G54.1Pn to the index of nc_work_offset_set().
  static std::optional<unsigned> work_offset_index(const std::string& key) {
    if (key == "EXT") return 0u;
    if (key.size() == 3 && key.compare(0, 2, "G5") == 0 && key[2] >= '4' && key[2] <= '9')
      return static_cast<unsigned>(key[2] - '3');
    for (const char* prefix : {"G54.1P", "G54.1 P"}) {
      const std::string p = prefix;
      if (key.compare(0, p.size(), p) != 0) continue;
      const auto n = digits(key.substr(p.size()), 999);
      if (n && *n >= 1) return 100u + *n;
    }
    return std::nullopt;
  }

  void work_offsets(const JsonNode& node) {
    for (const auto& [key, value] : object(node, "work_offsets").members) {
      const std::string path = "work_offsets." + key;
      const auto index = work_offset_index(key);
      if (!index) fail(value, path, "no such key: EXT, G54 to G59 or G54.1P1 and on");
      s_.work_offsets.push_back({{path, value.line}, *index, axis_values(value, path)});
    }
  }

  // To be called after the options were read, which say how many sets there are.
  void check_work_offsets() {
    const uint32_t sets = s_.option_work_offsets;
    for (const SetupWorkOffset& offset : s_.work_offsets)
      if (offset.index > 100 + sets)
        throw JsonError{offset.place.line, one_line(offset.place.path + ": the control has " +
                                                    (sets == 0 ? std::string("no extended work offsets")
                                                               : "G54.1P1 to G54.1P" + std::to_string(sets)) +
                                                    " (options.work_offsets)")};
  }

  void tool_offsets(const JsonNode& node) {
    static constexpr const char* kColumns[4] = {"length", "length_wear", "radius", "radius_wear"};
    for (const auto& [key, value] : object(node, "offsets").members) {
      const std::string path = "offsets." + key;
      const auto n = digits(key, 999'999);
      if (!n || *n == 0) fail(value, path, "no such key: an offset number is 1 or more");
      SetupToolOffset entry;
      entry.place = {path, value.line};
      entry.number = *n;
      if (value.type == Type::kNumber) {
        entry.plain = true;
        entry.column[NC_TOOL_LENGTH] = value.number;
      } else {
        if (value.type != Type::kObject) fail(value, path, "must be a number or an object");
        check_keys(value, path, {kColumns[0], kColumns[1], kColumns[2], kColumns[3]});
        for (int c = 0; c < 4; ++c)
          if (const JsonNode* column = member(value, kColumns[c]))
            entry.column[c] = number(*column, join(path, kColumns[c]));
      }
      s_.tool_offsets.push_back(entry);
    }
  }

  void variables(const JsonNode& node) {
    for (const auto& [key, value] : object(node, "vars").members) {
      const std::string path = "vars." + key;
      const auto n = digits(key, 999'999'999);
      if (!n) fail(value, path, "no such key: a variable is a number");
      const bool vacant = value.type == Type::kNull;
      if (!vacant && value.type != Type::kNumber) fail(value, path, "must be a number or null");
      s_.variables.push_back({{path, value.line}, *n, vacant, value.number});
    }
  }

  // A variable number of the macro interface inputs, decoded.
  struct InputNumber {
    uint32_t word;
    std::optional<uint32_t> bit;  // nothing: the number is that of the whole word
  };
  std::optional<InputNumber> input_number(uint32_t number) const {
    constexpr uint32_t kBits = 32;
    nc_system_variable row = {};
    for (unsigned i = 0; nc_system_variable_row(s_.dialect, i, &row) == NC_OK; ++i) {
      if (number < row.first || number > row.last) continue;
      const uint32_t offset = number - row.first;
      if (row.role == NC_VARIABLE_INPUT_WORD) return InputNumber{row.word + offset, std::nullopt};
      if (row.role == NC_VARIABLE_INPUT_BIT) return InputNumber{row.word + offset / kBits, offset % kBits};
    }
    return std::nullopt;
  }
  // The numbers that exist, as text: "1000 to 1035 and 1200 to 1295".
  std::string input_numbers() const {
    std::string text;
    uint32_t last = 0;
    nc_system_variable row = {};
    for (unsigned i = 0; nc_system_variable_row(s_.dialect, i, &row) == NC_OK; ++i) {
      if (row.role != NC_VARIABLE_INPUT_WORD && row.role != NC_VARIABLE_INPUT_BIT) continue;
      if (last != 0 && row.first == last + 1) text.resize(text.rfind(" to "));
      else text += (text.empty() ? "" : " and ") + std::to_string(row.first);
      text += " to " + std::to_string(row.last);
      last = row.last;
    }
    return text.empty() ? "this dialect has no interface inputs" : "interface inputs are " + text;
  }

  InputChange inputs(const JsonNode& node, const std::string& path) {
    constexpr uint32_t kLargest = 999'999;
    InputChange change;
    for (const auto& [key, value] : object(node, path).members) {
      const std::string key_path = join(path, key);
      const auto at = input_number(digits(key, kLargest).value_or(0));
      if (!at) fail(value, key_path, "no such key: " + input_numbers());
      if (at->bit) {
        set_bit(&change, *at, whole(value, key_path, 0, 1));
        continue;
      }
      const uint32_t bits = whole(value, key_path, 0, std::numeric_limits<uint32_t>::max());
      // A bit that is given as well as its word wins, in whatever order they stand.
      change.bits[at->word] |= bits & ~change.mask[at->word];
      change.mask[at->word] = std::numeric_limits<uint32_t>::max();
      for (const auto& [other, bit] : node.members) {
        const auto beside = input_number(digits(other, kLargest).value_or(0));
        if (beside && beside->bit && beside->word == at->word) set_bit(&change, *beside, whole(bit, join(path, other), 0, 1));
      }
    }
    return change;
  }

  static void set_bit(InputChange* change, const InputNumber& at, uint32_t on) {
    const uint32_t bit = 1u << *at.bit;
    change->mask[at.word] |= bit;
    change->bits[at.word] = on ? change->bits[at.word] | bit : change->bits[at.word] & ~bit;
  }

  void skip(const JsonNode& node) {
    list(node, "skip");
    for (size_t i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const std::string path = item_path("skip", i);
      check_keys(object(item, path), path,
                 {"signal", "box", "cylinder", "sphere", "plane", "holes", "turns_with", "ball", "coordinates"});
      SkipSolid solid;
      for (unsigned a = 0; a < NC_MAX_AXES; ++a) {
        solid.low[a] = -std::numeric_limits<double>::infinity();
        solid.high[a] = std::numeric_limits<double>::infinity();
      }
      if (const JsonNode* signal = member(item, "signal"))
        solid.signal = whole(*signal, path + ".signal", 1, 8);
      if (is_probed(item)) {
        solid.probe = probe_solid(item, path);
        s_.skip.push_back(solid);
        continue;
      }
      const JsonNode* box = member(item, "box");
      if (!box) fail(item, path, "the key box is missing");
      if (object(*box, path + ".box").members.empty()) fail(*box, path + ".box", "a box without a side");
      const std::string box_path = path + ".box";
      for (const auto& [name, range] : box->members) {
        const std::string range_path = join(box_path, name);
        const unsigned a = axis(range, range_path, name);
        if (list(range, range_path).items.size() != 2) fail(range, range_path, "must be [low, high]");
        solid.low[a] = number(range.items[0], item_path(range_path, 0));
        solid.high[a] = number(range.items[1], item_path(range_path, 1));
        solid.bounded[a] = true;
        if (!(solid.low[a] < solid.high[a])) fail(range, range_path, "low must be less than high");
      }
      s_.skip.push_back(solid);
    }
  }

  // True for an item that is more than a plain box in machine coordinates.
  static bool is_probed(const JsonNode& item) {
    for (const auto& [key, value] : item.members)
      if (key != "signal" && key != "box") return true;
    return false;
  }

  ProbeSolid probe_solid(const JsonNode& item, const std::string& path) {
    ProbeSolid solid;
    solid.shape = shape_of(item, path);
    if (const JsonNode* holes = member(item, "holes")) {
      const std::string at = path + ".holes";
      for (size_t i = 0; i < list(*holes, at).items.size(); ++i) {
        check_keys(object(holes->items[i], item_path(at, i)), item_path(at, i), {"box", "cylinder", "sphere", "plane"});
        solid.holes.push_back(shape_of(holes->items[i], item_path(at, i)));
      }
    }
    if (const JsonNode* turns = member(item, "turns_with")) {
      const std::string at = path + ".turns_with";
      for (size_t i = 0; i < list(*turns, at).items.size(); ++i) solid.turns.push_back(turn(turns->items[i], item_path(at, i)));
    }
    if (const JsonNode* ball = member(item, "ball")) {
      const std::string at = path + ".ball";
      check_keys(object(*ball, at), at, {"radius", "center"});
      solid.ball_radius = positive(*ball, at, "radius");
      if (const JsonNode* center = member(*ball, "center")) solid.ball_center = point(*center, at + ".center");
    }
    if (const JsonNode* coordinates = member(item, "coordinates"))
      solid.work = one_of(*coordinates, path + ".coordinates", {"machine", "work"}) == "work";
    if (solid.work && !solid.turns.empty()) fail(item, path + ".turns_with", "a solid that turns with an axis is given in machine coordinates");
    return solid;
  }

  // Reads the shape, of which an object must have exactly one.
  ProbeShape shape_of(const JsonNode& item, const std::string& path) {
    const JsonNode *found = nullptr, *node = nullptr;
    std::string name;
    for (const char* key : {"box", "cylinder", "sphere", "plane"}) {
      if (!(node = member(item, key))) continue;
      if (found) fail(*node, join(path, key), "stands beside " + name + ": one shape each");
      found = node;
      name = key;
    }
    if (!found) fail(item, path, "the key box, cylinder, sphere or plane is missing");
    const std::string at = join(path, name);
    object(*found, at);
    ProbeShape shape;
    shape.low.fill(-std::numeric_limits<double>::infinity());
    shape.high.fill(std::numeric_limits<double>::infinity());
    if (name == "box") {
      shape.kind = ProbeShape::Kind::kBox;
      if (found->members.empty()) fail(*found, at, "a box without a side");
      for (const auto& [letter, value] : found->members) range(value, join(at, letter), letter, &shape);
    } else if (name == "cylinder") {
      shape.kind = ProbeShape::Kind::kCylinder;
      check_keys(*found, at, {"axis", "center", "radius", "range"});
      if (const JsonNode* axis_name = member(*found, "axis")) shape.axis = one_of(*axis_name, at + ".axis", {"X", "Y", "Z"})[0] - 'X';
      shape.center = required_point(*found, at, "center");
      shape.radius = positive(*found, at, "radius");
      if (const JsonNode* ends = member(*found, "range")) range(*ends, at + ".range", std::string(1, static_cast<char>('X' + shape.axis)), &shape);
    } else if (name == "sphere") {
      shape.kind = ProbeShape::Kind::kSphere;
      check_keys(*found, at, {"center", "radius"});
      shape.center = required_point(*found, at, "center");
      shape.radius = positive(*found, at, "radius");
    } else {
      shape.kind = ProbeShape::Kind::kHalfSpace;
      check_keys(*found, at, {"point", "normal"});
      shape.center = required_point(*found, at, "point");
      shape.normal = required_point(*found, at, "normal");
      const double size = std::hypot(shape.normal[0], shape.normal[1], shape.normal[2]);
      if (!(size > 1e-6)) fail(*found, at + ".normal", "is the direction out of the solid, and not 0");
      for (double& v : shape.normal) v /= size;
    }
    return shape;
  }

  ProbeTurn turn(const JsonNode& node, const std::string& path) {
    check_keys(object(node, path), path, {"axis", "about", "center"});
    ProbeTurn turn;
    const JsonNode *name = member(node, "axis"), *about = member(node, "about");
    if (!name || !about) fail(node, path, std::string("the key ") + (name ? "about" : "axis") + " is missing");
    turn.axis_index = axis(*name, path + ".axis", text(*name, path + ".axis"));
    if (!s_.axes[turn.axis_index].rotary) fail(*name, path + ".axis", "must be a rotary axis of the setup");
    turn.about = one_of(*about, path + ".about", {"X", "Y", "Z"})[0] - 'X';
    if (const JsonNode* center = member(node, "center")) turn.center = point(*center, path + ".center");
    return turn;
  }

  void range(const JsonNode& node, const std::string& path, const std::string& letter, ProbeShape* shape) {
    const size_t a = linear(node, path, letter);
    if (list(node, path).items.size() != 2) fail(node, path, "must be [low, high]");
    shape->low[a] = number(node.items[0], item_path(path, 0));
    shape->high[a] = number(node.items[1], item_path(path, 1));
    if (!(shape->low[a] < shape->high[a])) fail(node, path, "low must be less than high");
  }

  // The index of X, Y or Z; a shape has no other coordinates.
  size_t linear(const JsonNode& node, const std::string& path, const std::string& letter) {
    if (letter.size() != 1 || letter[0] < 'X' || letter[0] > 'Z') fail(node, path, "no such key: a shape has X, Y and Z");
    axis(node, path, letter);
    return static_cast<size_t>(letter[0] - 'X');
  }

  Point3 point(const JsonNode& node, const std::string& path) {
    Point3 p{};
    for (const auto& [letter, value] : object(node, path).members) {
      const size_t a = linear(value, join(path, letter), letter);
      p[a] = number(value, join(path, letter));
    }
    return p;
  }

  Point3 required_point(const JsonNode& node, const std::string& path, const char* key) {
    const JsonNode* found = member(node, key);
    if (!found) fail(node, path, std::string("the key ") + key + " is missing");
    return point(*found, join(path, key));
  }

  double positive(const JsonNode& node, const std::string& path, const char* key) {
    const JsonNode* found = member(node, key);
    if (!found) fail(node, path, std::string("the key ") + key + " is missing");
    const double value = number(*found, join(path, key));
    if (!(value > 0)) fail(*found, join(path, key), "must be more than 0");
    return value;
  }

  void hits(const JsonNode& node) {
    list(node, "hits");
    for (size_t i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const std::string path = item_path("hits", i);
      SkipHit hit;
      hit.place = {path, item.line};
      hit.none = item.type == Type::kNull;
      if (!hit.none) {
        check_keys(object(item, path), path, {"when", "signal", "at"});
        if (const JsonNode* signal = member(item, "signal")) hit.signal = whole(*signal, path + ".signal", 1, 8);
        if (const JsonNode* when = member(item, "when")) {
          check_keys(object(*when, path + ".when"), path + ".when", {"line", "program"});
          place_of(*when, path + ".when", &hit.line, &hit.program);
        }
        const JsonNode* at = member(item, "at");
        if (!at) fail(item, path, "the key at is missing");
        if (at->type == Type::kNull) {
          hit.none = true;
        } else {
          for (const SetupAxisValue& v : axis_values(*at, path + ".at")) {
            hit.at[v.axis] = v.value;
            hit.named[v.axis] = true;
          }
          if (at->members.empty()) fail(*at, path + ".at", "names no axis");
        }
      }
      s_.hits.push_back(hit);
    }
  }

  // Reads a line of the main program or, with its O number, of another program.
  void place_of(const JsonNode& when, const std::string& path, std::optional<uint32_t>* line, std::optional<uint32_t>* program) {
    const JsonNode *line_node = member(when, "line"), *program_node = member(when, "program");
    if (program_node && !line_node) fail(when, path, "the key line is missing beside program");
    if (line_node) *line = whole(*line_node, path + ".line", 1, std::numeric_limits<uint32_t>::max());
    if (program_node) *program = whole(*program_node, path + ".program", 1, 99'999'999);
  }

  void switches(const JsonNode& node) {
    const std::string path = "switches";
    check_keys(object(node, path), path,
               {"optional_skip", "optional_stop", "single_block", "dry_run", "mirror"});
    for (const auto& [key, value] : node.members) {
      const std::string key_path = join(path, key);
      if (key == "optional_stop") s_.optional_stop = boolean(value, key_path);
      if (key == "single_block") s_.single_block = boolean(value, key_path);
      if (key == "dry_run") s_.dry_run = boolean(value, key_path);
      if (key == "optional_skip") {
        list(value, key_path);
        for (size_t i = 0; i < value.items.size(); ++i)
          s_.optional_skip |= 1u << whole(value.items[i], item_path(key_path, i), 1, 9);
      }
      if (key == "mirror") {
        list(value, key_path);
        for (size_t i = 0; i < value.items.size(); ++i) {
          const std::string at = item_path(key_path, i);
          s_.mirror_axes |= 1u << axis(value.items[i], at, text(value.items[i], at));
        }
      }
    }
  }

  void subprograms(const JsonNode& node) {
    for (const auto& [key, value] : object(node, "subprograms").members) {
      const std::string path = "subprograms." + key;
      if (key.empty()) fail(value, path, "a sub program needs an O number or a name");
      const bool is_number = digits(key, 99'999'999) && key[0] != '0';  // M700 13.3.1 (7): P100 and P0100 do not find the file "0100"
      const std::string name = is_number ? "O" + key : key;
      s_.subprograms.emplace_back(name, text(value, path));
    }
  }

  void events(const JsonNode& node) {
    list(node, "events");
    for (size_t i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const std::string path = item_path("events", i);
      check_keys(object(item, path), path, {"when", "inputs", "signals"});
      SetupEvent event;
      const JsonNode* when = member(item, "when");
      if (!when) fail(item, path, "the key when is missing");
      event.place = {path, item.line};
      check_keys(object(*when, path + ".when"), path + ".when", {"line", "program", "seconds", "m"});
      const size_t kinds = (member(*when, "line") ? 1u : 0u) + (member(*when, "seconds") ? 1u : 0u) + (member(*when, "m") ? 1u : 0u);
      if (kinds != 1) fail(*when, path + ".when", "must have one of line and seconds, or m");
      place_of(*when, path + ".when", &event.line, &event.program);
      if (const JsonNode* m = member(*when, "m")) event.m = whole(*m, path + ".when.m", 0, 99'999'999);
      if (const JsonNode* seconds = member(*when, "seconds")) {
        event.seconds = number(*seconds, path + ".when.seconds");
        if (*event.seconds < 0) fail(*seconds, path + ".when.seconds", "must not be negative");
      }
      if (const JsonNode* change = member(item, "inputs")) event.inputs = inputs(*change, path + ".inputs");
      if (const JsonNode* signals = member(item, "signals")) {
        check_keys(object(*signals, path + ".signals"), path + ".signals",
                   {"macro_interrupt", "feed_hold", "reset", "skip", "skip2", "skip3", "skip4", "skip5", "skip6", "skip7", "skip8"});
        const std::string signals_path = path + ".signals";
        for (const auto& [name, value] : signals->members)
          event.signals[name] = static_cast<int>(whole(value, join(signals_path, name), 0, 1));
      }
      s_.events.push_back(event);
    }
  }

  void options(const JsonNode& node) {
    const std::string path = "options";
    check_keys(object(node, path), path,
               {"variable_sets", "variable_ranges", "extended_variables", "tool_offsets", "work_offsets", "macro_extensions", "negative_count"});
    for (const auto& [key, value] : node.members) {
      const std::string key_path = join(path, key);
      if (key == "variable_sets") {
        s_.option_variable_sets = whole(value, key_path, 100, 600);
        const uint32_t n = s_.option_variable_sets;
        if (n != 100 && n != 200 && n != 300 && n != 600)
          fail(value, key_path, "must be 100, 200, 300 or 600");
      }
      if (key == "tool_offsets") s_.option_tool_offsets = whole(value, key_path, 1, 999);
      if (key == "work_offsets") s_.option_work_offsets = whole(value, key_path, 0, 300);
      if (key == "extended_variables") {
        s_.option_extended_variables = boolean(value, key_path);
        s_.extended_variables_place = {key_path, value.line};
      }
      if (key == "negative_count") {
        s_.option_negative_count = boolean(value, key_path);
        s_.negative_count_place = {key_path, value.line};
      }
      if (key == "macro_extensions") {
        s_.option_macro_extensions = boolean(value, key_path);
        s_.macro_extensions_place = {key_path, value.line};
      }
    }
    if (const JsonNode* ranges = member(node, "variable_ranges")) variable_ranges(*ranges, path + ".variable_ranges");
  }

  // To be called after the options that say which common variables exist.
  void variable_ranges(const JsonNode& node, const std::string& path) {
    list(node, path);
    if (node.items.size() > NC_VARIABLE_RANGES)
      fail(node, path, "there can be " + std::to_string(NC_VARIABLE_RANGES) + " further ranges of common variables");
    nc_config config;
    nc_config_init(&config);
    config.variable_sets = s_.option_variable_sets;
    config.extended_variables = s_.option_extended_variables;
    for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i) s_.option_variable_ranges[i] = {};
    for (unsigned i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const std::string at = item_path(path, i);
      check_keys(object(item, at), at, {"first", "last", "kept"});
      const JsonNode *first = member(item, "first"), *last = member(item, "last");
      if (!first || !last) fail(item, at, std::string("the key ") + (first ? "last" : "first") + " is missing");
      if (const JsonNode* kept = member(item, "kept")) boolean(*kept, at + ".kept");  // has no effect, because there is no power cut in a trace
      config.variable_ranges[i] = {whole(*first, at + ".first", 34, 999'999), whole(*last, at + ".last", 34, 999'999)};
      uint32_t taken = 0;
      if (nc_variable_range_check(&config, i, &taken) != NC_OK)
        fail(item, at, taken ? "#" + std::to_string(taken) + " is another variable already"
                             : "last must be from first on, at most 10000 variables");
      s_.option_variable_ranges[i] = config.variable_ranges[i];
    }
  }

  void clock(const JsonNode& node) {
    const auto ms = parse_clock(text(node, "clock"));
    if (!ms) fail(node, "clock", "must be a date and time like 2026-01-01T00:00:00");
    s_.clock_ms = *ms;
  }

  Setup& s_;
};

// Days since 1970-01-01 in the Gregorian calendar. The calendar repeats after 400 years, which are 146,097 days. Years are counted
// from March, so that the leap day is the last day of a year.
int64_t days_from_date(int64_t year, unsigned month, unsigned day) {
  year -= month <= 2;
  const int64_t era = year / 400;
  const unsigned year_of_era = static_cast<unsigned>(year - era * 400);
  const unsigned day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  const unsigned day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146'097 + static_cast<int64_t>(day_of_era) - 719'468;
}

}  // namespace

Setup::Setup() : clock_ms(*parse_clock("2026-01-01T00:00:00")) {}

int Setup::axis_index(char axis_name) const {
  for (size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name == axis_name) return static_cast<int>(i);
  return -1;
}

Point3 Setup::linear(const nc_axes& position) const {
  Point3 p{};
  for (size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name >= 'X') p[static_cast<size_t>(axes[i].name - 'X')] = position.v[i];
  return p;
}

std::optional<int64_t> parse_clock(const std::string& value) {
  static constexpr char kPattern[] = "dddd-dd-ddTdd:dd:dd";
  if (value.size() != sizeof kPattern - 1) return std::nullopt;
  for (size_t i = 0; i < value.size(); ++i)
    if (kPattern[i] == 'd' ? value[i] < '0' || value[i] > '9' : value[i] != kPattern[i]) return std::nullopt;
  const auto field = [&](size_t at, size_t n) { return *digits(value.substr(at, n), 9999); };
  const unsigned year = field(0, 4), month = field(5, 2), day = field(8, 2);
  const unsigned hour = field(11, 2), minute = field(14, 2), second = field(17, 2);
  if (year < 1970 || month < 1 || month > 12 || day < 1 || hour > 23 || minute > 59 || second > 59)
    return std::nullopt;
  const int64_t next = month == 12 ? days_from_date(year + 1, 1, 1) : days_from_date(year, month + 1, 1);
  if (days_from_date(year, month, day) >= next) return std::nullopt;
  return ((days_from_date(year, month, day) * 24 + hour) * 60 + minute) * 60'000 + int64_t{second} * 1000;
}

bool parse_setup(const std::string& content, const std::string& name, Setup* setup, std::string* error,
                 const Setup& defaults) {
  *setup = Setup(defaults);
  setup->name = name;
  JsonNode root;
  std::string why;
  if (!parse_json(content, &root, &why)) {
    *error = name + ":" + why.substr(5);  // "line N: why" -> "NAME:N: why"
    return false;
  }
  try {
    SetupReader(setup).read(root);
  } catch (const JsonError& problem) {
    *error = name + ":" + std::to_string(problem.line) + ": " + problem.text;
    return false;
  }
  return true;
}

bool load_setup(const std::string& path, Setup* setup, std::string* error, const Setup& defaults) {
  std::string content;
  if (!read_text_file(path, &content, error)) return false;
  return parse_setup(content, path, setup, error, defaults);
}

}  // namespace nc::tools
