// SPDX-License-Identifier: Apache-2.0
#include "ladder/names.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>

#include "ladder/elsewhere.hpp"

namespace nc::ladder {

namespace {

constexpr std::size_t kMaxName = 64;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_char(char c) {
  return is_digit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-' || c == '.';
}

// The edit distance of two words: the number of insertions, deletions and replacements.
std::size_t distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> row(right.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < right.size(); ++j) {
      const std::size_t replaced = diagonal + (left[i] == right[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// Splits a word such as D0Z1 into D0 and Z1; both are empty when it does not have that form.
std::pair<std::string_view, std::string_view> split_index(std::string_view word) {
  const std::size_t z = word.rfind('Z');
  if (z == std::string_view::npos || z == 0 || z + 1 == word.size() || !is_digit(word[z - 1])) return {};
  if (!std::all_of(word.begin() + static_cast<std::ptrdiff_t>(z) + 1, word.end(), is_digit)) return {};
  return {word.substr(0, z), word.substr(z)};
}

}  // namespace

Place current_value(const Place& place) {
  if (place.kind != Kind::kTimer && place.kind != Kind::kCounter) return place;
  Place value = place;
  const std::uint32_t offset = place.index - place.first;
  value.kind = Kind::kCurrentValue;
  value.type = DeviceType::kWord16;
  value.writable = true;
  value.index = place.value;
  value.end = place.value - offset + (place.end - place.first);
  value.first = place.value - offset;
  return value;
}

std::string Names::nearest(std::string_view word) const {
  if (word.size() > kMaxName) return {};
  std::string upper(word);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string message;
  if (upper != word && internal_device(upper, layout_, &message)) return upper;
  std::size_t best = 1 + word.size() / 4;
  std::string found;
  const auto offer = [&](const std::string& name) {
    if (name.size() > word.size() + best || word.size() > name.size() + best) return;
    const std::size_t apart = distance(word, name);
    if (apart > best || (apart == best && !found.empty()) || apart >= word.size()) return;
    best = apart;
    found = name;
  };
  for (const Device& device : table_.all()) offer(device.name);
  for (const auto& [name, target] : aliases_) offer(name);
  return found;
}

// One bit of a word, with its number as a hexadecimal digit: D0.5, D0.F, nc.fin_wait.0.
std::optional<Place> Names::word_bit(std::string_view word) const {
  const std::size_t dot = word.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 2 != word.size()) return std::nullopt;
  const char digit = word[dot + 1];
  if (!is_digit(digit) && (digit < 'A' || digit > 'F')) return std::nullopt;
  std::string ignored;
  std::string_view base = word.substr(0, dot);
  if (const auto alias = aliases_.find(std::string(base)); alias != aliases_.end()) base = alias->second;
  Place place;
  if (const Device* device = table_.find(base)) place = named_device(*device);
  else if (const auto internal = internal_device(base, layout_, &ignored)) place = *internal;
  else return std::nullopt;
  if (place.type == DeviceType::kBit) return std::nullopt;
  place.kind = Kind::kWordBit;
  place.type = DeviceType::kBit;
  place.number = static_cast<std::uint32_t>(is_digit(digit) ? digit - '0' : digit - 'A' + 10);
  place.family = {};
  return place;
}

std::optional<Place> Names::device(std::string_view word, std::string* message) const {
  if (const auto alias = aliases_.find(std::string(word)); alias != aliases_.end()) word = alias->second;
  if (const Device* device = table_.find(word)) return named_device(*device);
  std::string why;
  if (const auto place = internal_device(word, layout_, &why)) return place;
  if (const auto place = word_bit(word)) return place;
  if (why.empty()) {
    why = "no such device";
    if (word.size() > kMaxName) {
      why = "no such device: a name has at most " + std::to_string(kMaxName) + " characters";
    } else {
      why += " '" + std::string(word) + "'";
      const std::string name = nearest(word), elsewhere = device_elsewhere(word);
      const bool address = word[0] == 'X' || word[0] == 'Y';  // for these a list of the machine's names helps more
      const bool number = is_digit(word[0]) || (word.size() > 1 && (word[0] == '-' || word[0] == '+') && is_digit(word[1]));
      if (number) why += ": constants are K, decimal, and H, hexadecimal, such as K10 or H1F";
      else if (!elsewhere.empty() && (name.empty() || !address)) why += ": " + elsewhere;
      else if (!name.empty()) why += "; did you mean '" + name + "'?";
    }
  }
  *message = why;
  return std::nullopt;
}

std::optional<Operand> Names::constant(std::string_view word, std::string* message) const {
  Operand operand;
  operand.form = Operand::Form::kConstant;
  operand.hexadecimal = word[0] == 'H';
  const char* last = word.data() + word.size();
  const char* first = word.data() + 1;
  if (!operand.hexadecimal && *first == '+' && *++first == '-') return std::nullopt;
  const auto [end, error] = std::from_chars(first, last, operand.constant, operand.hexadecimal ? 16 : 10);
  if (end != last || (operand.hexadecimal && *first == '-')) return std::nullopt;
  if (error != std::errc()) {
    *message = "the constant is out of range";
    return std::nullopt;
  }
  return operand;
}

std::optional<Operand> Names::operand(std::string_view word, std::string* message) const {
  message->clear();
  const bool known = aliases_.count(std::string(word)) != 0 || table_.find(word) != nullptr;
  Operand operand;
  if (!known && word.size() > 1) {
    const bool number = is_digit(word[1]) || ((word[1] == '-' || word[1] == '+') && word.size() > 2);
    if ((word[0] == 'K' && number) ||
        (word[0] == 'H' && std::isxdigit(static_cast<unsigned char>(word[1])) != 0)) {
      if (const auto value = constant(word, message)) return value;
      if (!message->empty()) return std::nullopt;
      if (word[0] == 'K' && number && word.find_first_not_of("0123456789+-.", 1) == std::string_view::npos &&
          word.find('.') != std::string_view::npos) {
        *message = instruction_elsewhere("E+");
        return std::nullopt;
      }
    }
    if (word[0] == 'K' && is_digit(word[1]) && word.size() > 3 && !is_digit(word[2])) {  // K4M0
      const auto bits = device(word.substr(2), message);
      if (!bits) return std::nullopt;
      operand.digits = static_cast<std::uint32_t>(word[1] - '0');
      if (bits->kind != Kind::kRelay || bits->family == "SM" || operand.digits < 1 || operand.digits > 8) {
        *message = "digits are K1 to K8 of M or L, such as K4M0";
        return std::nullopt;
      }
      if (bits->index + 4 * operand.digits > bits->end) {
        *message = "the last of these bits does not exist";
        return std::nullopt;
      }
      operand.form = Operand::Form::kDigits;
      operand.place = *bits;
      return operand;
    }
    if (word[0] == 'E' && number) {
      *message = instruction_elsewhere("E+");
      return std::nullopt;
    }
    if (const auto [base, z] = split_index(word); !base.empty()) {
      const auto place = device(base, message);
      if (!place) return std::nullopt;
      const auto index = device(z, message);
      if (!index) return std::nullopt;
      operand.place = current_value(*place);
      if (operand.place.type == DeviceType::kBit || operand.place.family.empty()) {
        *message = "only words D, TN, STN and CN can be indexed with Z";
        return std::nullopt;
      }
      operand.z = index->index;
      return operand;
    }
  }
  const auto place = device(word, message);
  if (!place) return std::nullopt;
  operand.place = *place;
  return operand;
}

std::string Names::without_aliases(std::string_view word) const {
  if (const auto alias = aliases_.find(std::string(word)); alias != aliases_.end()) return alias->second;
  if (table_.find(word) != nullptr) return std::string(word);
  if (const std::size_t dot = word.rfind('.'); dot != std::string_view::npos && dot != 0 && dot + 2 == word.size())
    return without_aliases(word.substr(0, dot)) + std::string(word.substr(dot));
  if (word.size() > 3 && word[0] == 'K' && is_digit(word[1]) && !is_digit(word[2]))
    return std::string(word.substr(0, 2)) + without_aliases(word.substr(2));
  if (const auto [base, z] = split_index(word); !base.empty()) return without_aliases(base) + without_aliases(z);
  return std::string(word);
}

bool Names::alias(std::string_view name, std::string_view target, std::string* message) {
  if (name.size() > kMaxName || !std::all_of(name.begin(), name.end(), is_name_char)) {
    *message = "a name consists of at most 64 letters, digits, '_', '-' and '.'";
    return false;
  }
  std::string unused;
  if (aliases_.count(std::string(name)) != 0 || table_.find(name) != nullptr ||
      internal_device(name, layout_, &unused) || !unused.empty() || word_bit(name)) {
    *message = "'" + std::string(name) + "' is a device already";
    return false;
  }
  // Names such as K10 and H1F are refused, because they are constants.
  if (const bool starts = name[0] == 'K' || name[0] == 'H' || name[0] == 'E'; starts && name.size() > 1) {
    if (constant(name, &unused) || !unused.empty()) {
      *message = "'" + std::string(name) + "' is a constant";
      return false;
    }
  }
  if (!device(target, message)) return false;
  if (const auto chained = aliases_.find(std::string(target)); chained != aliases_.end())
    target = chained->second;
  aliases_.emplace(name, target);
  return true;
}

}  // namespace nc::ladder
