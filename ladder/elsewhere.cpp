// SPDX-License-Identifier: Apache-2.0
#include "ladder/elsewhere.hpp"

#include <algorithm>

namespace nc::ladder {
namespace {

constexpr const char* kReal =
    "there are no real numbers in this language; scale to whole numbers and take the 32-bit instructions (D+ D- D* D/)";
constexpr const char* kLong = "counters and timers have 16 bits here; for 32 bits count with DINCP and compare with LDD>=";
constexpr const char* kInterrupt = "there are no interrupt programs; the whole program runs in every scan of the control";
constexpr const char* kSteps = "there are no step ladders; take relays, SET and RST";
constexpr const char* kString = "there are no character strings in this language";
constexpr const char* kUpDown = "there is no counter up and down; take INCP and DECP on a word";

struct Row {
  std::string_view name;
  const char* why;
};
// Instructions of MELSEC-Q, QnA, iQ-R and FX. The forms with a P at the end are not listed; they get the same text.
constexpr Row kInstructions[] = {
    {"E+", kReal},      {"E-", kReal},      {"E*", kReal},      {"E/", kReal},      {"EMOV", kReal},
    {"EDMOV", kReal},   {"ENEG", kReal},    {"ED+", kReal},     {"ED-", kReal},     {"ED*", kReal},     {"ED/", kReal},
       {"FLT", kReal},     {"DFLT", kReal},    {"INT", kReal},
    {"DINT", kReal},    {"DECMP", kReal},   {"DEZCP", kReal},   {"DEADD", kReal},   {"DESUB", kReal},
    {"DEMUL", kReal},   {"DEDIV", kReal},   {"DESQR", kReal},   {"DEMOV", kReal},   {"DEBCD", kReal},
    {"DEBIN", kReal},   {"SIN", kReal},     {"COS", kReal},     {"TAN", kReal},     {"ASIN", kReal},
    {"ACOS", kReal},    {"ATAN", kReal},    {"RAD", kReal},     {"DEG", kReal},     {"SQR", kReal},
    {"EXP", kReal},     {"LOG", kReal},     {"LDE", kReal},     {"ANDE", kReal},    {"ORE", kReal},
    {"UDCNT1", kUpDown}, {"UDCNT2", kUpDown},
    {"EI", kInterrupt}, {"DI", kInterrupt}, {"IMASK", kInterrupt}, {"IRET", kInterrupt},
    {"STL", kSteps},    {"$MOV", kString},  {"$+", kString},
};
constexpr std::string_view kRelations[] = {"=", "<>", ">", "<=", "<", ">="};

struct Device {
  std::string_view letters;
  const char* why;
};
constexpr Device kDevices[] = {
    {"LC", kLong}, {"LT", kLong}, {"LST", kLong}, {"LCN", kLong}, {"LTN", kLong}, {"S", kSteps}, {"LZ", "index registers are Z0 to Z15, of 16 bits"},
    {"V", "there are no edge relays; take PLS or LDP"},
    {"R", "there are no file registers; take D, or give this one a name: ALIAS"},
    {"X", "addresses of inputs are the machine's; give this one a name: ALIAS X0 <point>"},
    {"Y", "addresses of outputs are the machine's; give this one a name: ALIAS Y0 <point>"},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string find(std::string_view name) {
  for (const Row& row : kInstructions)
    if (row.name == name) return row.why;
  // LDE=, ANDE<>, ORE>= compare real numbers, LD$= compares strings.
  for (const std::string_view join : {"LD", "AND", "OR"}) {
    if (name.substr(0, join.size()) != join || name.size() < join.size() + 2) continue;
    const char kind = name[join.size()];
    const std::string_view relation = name.substr(join.size() + 1);
    if (std::find(std::begin(kRelations), std::end(kRelations), relation) == std::end(kRelations)) continue;
    if (kind == 'E') return kReal;
    if (kind == '$') return kString;
  }
  return {};
}

}  // namespace

std::string instruction_elsewhere(std::string_view mnemonic) {
  if (std::string why = find(mnemonic); !why.empty()) return why;
  if (mnemonic.size() < 2 || mnemonic.back() != 'P') return {};
  return find(mnemonic.substr(0, mnemonic.size() - 1));
}

std::string device_elsewhere(std::string_view name) {
  const std::size_t digits = static_cast<std::size_t>(std::find_if(name.begin(), name.end(), is_digit) - name.begin());
  if (digits == 0 || digits == name.size()) return {};
  const auto is_number = [](char c) { return is_digit(c) || (c >= 'A' && c <= 'F'); };  // the numbers of X and Y are hexadecimal
  if (!std::all_of(name.begin() + static_cast<std::ptrdiff_t>(digits), name.end(), is_number)) return {};
  for (const Device& device : kDevices)
    if (device.letters == name.substr(0, digits)) return device.why;
  return {};
}

}  // namespace nc::ladder
