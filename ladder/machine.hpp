// SPDX-License-Identifier: Apache-2.0
// The part of the interpreter for everything except bits: word operands, the operations on them, timers and counters. All of
// it is NC_RT. An operation that cannot be executed writes nothing; it sets SM0, SD0 and SD1.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

#include "ladder/code.hpp"

namespace nc::ladder {

struct Machine {
  const Code& code;
  const Layout& at;
  std::uint8_t* const bit;
  std::int16_t* const word;
  const Unit* const units;
  std::uint32_t budget;

  // ---- errors ----
  // The first error stays until the program resets SM0.
  void fail(const Unit* ip, OperationError error) noexcept {
    std::uint8_t& flag = bit[at.sm + kSmError];
    if (flag != 0) return;
    flag = 1;
    word[at.sd + kSdError] = error;
    word[at.sd + kSdLine] = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(code.lines[static_cast<std::size_t>(ip - units)]));
  }

  // ---- words ----
  std::int32_t load32(std::uint32_t index) const noexcept {
    std::int32_t value;
    std::memcpy(&value, word + index, sizeof value);
    return value;
  }
  void save32(std::uint32_t index, std::int32_t value) noexcept {
    std::memcpy(word + index, &value, sizeof value);
  }

  static Mode mode_of(const Unit* ip, unsigned operand) noexcept {
    return static_cast<Mode>(ip->head.mode >> (2 * operand) & 3u);
  }
  static std::uint32_t operand_of(const Unit* ip, unsigned operand) noexcept {
    switch (operand) {
      case 0:
        return ip[0].head.a;
      case 1:
        return ip[1].tail.b;
      case 2:
        return ip[1].tail.c;
      default:
        return ip[2].tail.b;
    }
  }

  // Finds the index of `width` words of an operand whose place is known only in the scan.
  bool locate(const Unit* ip, const Indirect& where, std::uint32_t width, std::uint32_t* index) noexcept {
    std::int64_t place = where.base;
    if (where.z != Indirect::kNoZ) place += word[where.z];
    if (place < where.first || place + width > where.end) {
      fail(ip, kBadPlace);
      return false;
    }
    *index = static_cast<std::uint32_t>(place);
    return true;
  }
  bool locate(const Unit* ip, unsigned operand, std::uint32_t width, std::uint32_t* index) noexcept {
    const std::uint32_t value = operand_of(ip, operand);
    if (mode_of(ip, operand) == Mode::kIndirect) return locate(ip, code.indirect[value], width, index);
    *index = value;
    return true;
  }

  std::uint32_t gather(const Indirect& where) const noexcept {
    std::uint32_t value = 0;
    for (std::uint32_t i = 0; i < 4 * where.digits; ++i)
      value |= static_cast<std::uint32_t>(bit[where.base + i] & 1u) << i;
    return value;
  }
  void scatter(const Indirect& where, std::uint32_t value) noexcept {
    for (std::uint32_t i = 0; i < 4 * where.digits; ++i)
      bit[where.base + i] = static_cast<std::uint8_t>(value >> i & 1u);
  }

  bool get16(const Unit* ip, unsigned operand, std::int32_t* value) noexcept {
    const std::uint32_t raw = operand_of(ip, operand);
    switch (mode_of(ip, operand)) {
      case Mode::kDirect:
        *value = word[raw];
        return true;
      case Mode::kConstant:
        *value = static_cast<std::int32_t>(raw);
        return true;
      case Mode::kIndirect:
        break;
    }
    const Indirect& where = code.indirect[raw];
    if (where.digits != 0) {
      *value = static_cast<std::int16_t>(gather(where));
      return true;
    }
    std::uint32_t index;
    if (!locate(ip, where, 1, &index)) return false;
    *value = word[index];
    return true;
  }
  bool get32(const Unit* ip, unsigned operand, std::int32_t* value) noexcept {
    const std::uint32_t raw = operand_of(ip, operand);
    switch (mode_of(ip, operand)) {
      case Mode::kDirect:
        *value = load32(raw);
        return true;
      case Mode::kConstant:
        *value = static_cast<std::int32_t>(raw);
        return true;
      case Mode::kIndirect:
        break;
    }
    const Indirect& where = code.indirect[raw];
    if (where.digits != 0) {
      *value = static_cast<std::int32_t>(gather(where));
      return true;
    }
    std::uint32_t index;
    if (!locate(ip, where, 2, &index)) return false;
    *value = load32(index);
    return true;
  }
  // Stores the low half of the value; a value that does not fit wraps around.
  void put16(const Unit* ip, unsigned operand, std::int32_t value) noexcept {
    const std::uint32_t raw = operand_of(ip, operand);
    std::uint32_t index = raw;
    if (mode_of(ip, operand) == Mode::kIndirect) {
      const Indirect& where = code.indirect[raw];
      if (where.digits != 0) return scatter(where, static_cast<std::uint32_t>(value));
      if (!locate(ip, where, 1, &index)) return;
    }
    word[index] = static_cast<std::int16_t>(static_cast<std::uint16_t>(value));
  }
  void put32(const Unit* ip, unsigned operand, std::int32_t value) noexcept {
    const std::uint32_t raw = operand_of(ip, operand);
    std::uint32_t index = raw;
    if (mode_of(ip, operand) == Mode::kIndirect) {
      const Indirect& where = code.indirect[raw];
      if (where.digits != 0) return scatter(where, static_cast<std::uint32_t>(value));
      if (!locate(ip, where, 2, &index)) return;
    }
    save32(index, value);
  }

  // ---- compares ----
  static bool holds(std::int32_t left, std::int32_t right, unsigned relation) noexcept {
    switch (static_cast<Relation>(relation)) {
      case Relation::kEqual:
        return left == right;
      case Relation::kNotEqual:
        return left != right;
      case Relation::kGreater:
        return left > right;
      case Relation::kLessEqual:
        return left <= right;
      case Relation::kLess:
        return left < right;
      case Relation::kGreaterEqual:
        return left >= right;
    }
    return false;
  }
  std::uint32_t compare16(const Unit* ip) noexcept {
    std::int32_t left, right;
    if (!get16(ip, 0, &left) || !get16(ip, 1, &right)) return 0;
    return holds(left, right, ip->head.mode >> kModeExtra);
  }
  std::uint32_t compare32(const Unit* ip) noexcept {
    std::int32_t left, right;
    if (!get32(ip, 0, &left) || !get32(ip, 1, &right)) return 0;
    return holds(left, right, ip->head.mode >> kModeExtra);
  }

  // ---- one operation each; called when the result is on ----
  template <class F>
  void unary16(const Unit* ip, unsigned from, unsigned to, F&& f) noexcept {
    std::int32_t value;
    if (get16(ip, from, &value)) put16(ip, to, f(value));
  }
  template <class F>
  void unary32(const Unit* ip, unsigned from, unsigned to, F&& f) noexcept {
    std::int32_t value;
    if (get32(ip, from, &value))
      put32(ip, to, static_cast<std::int32_t>(f(static_cast<std::uint32_t>(value))));
  }
  template <class F>
  void binary16(const Unit* ip, F&& f) noexcept {
    std::int32_t left, right;
    if (get16(ip, 0, &left) && get16(ip, 1, &right)) put16(ip, 2, f(left, right));
  }
  // Calculates in unsigned arithmetic, which wraps around.
  template <class F>
  void binary32(const Unit* ip, F&& f) noexcept {
    std::int32_t left, right;
    if (get32(ip, 0, &left) && get32(ip, 1, &right))
      put32(
          ip, 2,
          static_cast<std::int32_t>(f(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(right))));
  }
  void exchange16(const Unit* ip) noexcept {
    std::int32_t left, right;
    if (!get16(ip, 0, &left) || !get16(ip, 1, &right)) return;
    put16(ip, 0, right);
    put16(ip, 1, left);
  }
  void exchange32(const Unit* ip) noexcept {
    std::int32_t left, right;
    if (!get32(ip, 0, &left) || !get32(ip, 1, &right)) return;
    put32(ip, 0, right);
    put32(ip, 1, left);
  }
  void multiply16(const Unit* ip) noexcept {
    std::int32_t left, right;
    if (get16(ip, 0, &left) && get16(ip, 1, &right)) put32(ip, 2, left * right);
  }
  void multiply32(const Unit* ip) noexcept {
    std::int32_t left, right;
    std::uint32_t index;
    if (!get32(ip, 0, &left) || !get32(ip, 1, &right) || !locate(ip, 2, 4, &index)) return;
    const std::int64_t product = static_cast<std::int64_t>(left) * right;
    std::memcpy(word + index, &product, sizeof product);
  }
  void divide16(const Unit* ip) noexcept {
    std::int32_t left, right;
    std::uint32_t index;
    if (!get16(ip, 0, &left) || !get16(ip, 1, &right) || !locate(ip, 2, 2, &index)) return;
    if (right == 0 || (left == std::numeric_limits<std::int16_t>::min() && right == -1))
      return fail(ip, kBadValue);
    word[index] = static_cast<std::int16_t>(left / right);
    word[index + 1] = static_cast<std::int16_t>(left % right);
  }
  void divide32(const Unit* ip) noexcept {
    std::int32_t left, right;
    std::uint32_t index;
    if (!get32(ip, 0, &left) || !get32(ip, 1, &right) || !locate(ip, 2, 4, &index)) return;
    if (right == 0 || (left == std::numeric_limits<std::int32_t>::min() && right == -1))
      return fail(ip, kBadValue);
    save32(index, left / right);
    save32(index + 2, left % right);
  }

  // Conversions to and from BCD with `digits` digits.
  void to_bcd(const Unit* ip, unsigned digits, bool wide) noexcept {
    std::int32_t value;
    if (!(wide ? get32(ip, 0, &value) : get16(ip, 0, &value))) return;
    if (value < 0) return fail(ip, kBadValue);
    std::uint32_t left = static_cast<std::uint32_t>(value), bcd = 0;
    for (unsigned i = 0; i < digits; ++i, left /= 10) bcd |= left % 10 << (4 * i);
    if (left != 0) return fail(ip, kBadValue);
    wide ? put32(ip, 1, static_cast<std::int32_t>(bcd)) : put16(ip, 1, static_cast<std::int32_t>(bcd));
  }
  void from_bcd(const Unit* ip, unsigned digits, bool wide) noexcept {
    std::int32_t value;
    if (!(wide ? get32(ip, 0, &value) : get16(ip, 0, &value))) return;
    const std::uint32_t bcd = static_cast<std::uint32_t>(value);
    std::int32_t sum = 0;
    for (unsigned i = digits; i-- > 0;) {
      const std::uint32_t digit = bcd >> (4 * i) & 15u;
      if (digit > 9) return fail(ip, kBadValue);
      sum = sum * 10 + static_cast<std::int32_t>(digit);
    }
    wide ? put32(ip, 1, sum) : put16(ip, 1, sum);
  }

  // Reads an operand n from 0 to `limit`; otherwise the instruction fails.
  bool count(const Unit* ip, unsigned operand, std::int32_t limit, std::int32_t* n) noexcept {
    if (!get16(ip, operand, n)) return false;
    if (*n >= 0 && *n <= limit) return true;
    fail(ip, kBadValue);
    return false;
  }
  void set_carry(std::uint32_t on) noexcept { bit[at.sm + kSmCarry] = static_cast<std::uint8_t>(on & 1u); }
  void rotate(const Unit* ip, bool wide, bool right) noexcept {
    const std::uint32_t size = wide ? 32 : 16;
    std::int32_t value, n;
    if (!(wide ? get32(ip, 0, &value) : get16(ip, 0, &value))) return;
    if (!count(ip, 1, static_cast<std::int32_t>(size) - 1, &n) || n == 0) return;
    const std::uint32_t by = static_cast<std::uint32_t>(n);
    const std::uint32_t from = wide ? static_cast<std::uint32_t>(value) : static_cast<std::uint16_t>(value);
    const std::uint32_t to = right ? from >> by | from << (size - by) : from << by | from >> (size - by);
    set_carry(right ? from >> (by - 1) : from >> (size - by));
    wide ? put32(ip, 0, static_cast<std::int32_t>(to)) : put16(ip, 0, static_cast<std::int32_t>(to));
  }
  void shift(const Unit* ip, bool right) noexcept {
    std::int32_t value, n;
    if (!get16(ip, 0, &value) || !count(ip, 1, 15, &n) || n == 0) return;
    const std::uint32_t from = static_cast<std::uint16_t>(value);
    set_carry(right ? from >> (n - 1) : from >> (16 - n));
    put16(ip, 0, static_cast<std::int32_t>(right ? from >> n : from << n));
  }
  void bit_of_word(const Unit* ip, bool on) noexcept {
    std::int32_t value, n;
    if (!get16(ip, 0, &value) || !count(ip, 1, 15, &n)) return;
    put16(ip, 0, on ? value | 1 << n : value & ~(1 << n));
  }

  // ---- rows of words; false when the budget of the scan is used up ----
  bool charge(std::uint32_t steps) noexcept {
    if (steps > budget) return false;
    budget -= steps;
    return true;
  }
  bool block_move(const Unit* ip) noexcept {
    std::int32_t n;
    std::uint32_t from, to;
    if (!count(ip, 2, std::numeric_limits<std::int16_t>::max(), &n)) return true;
    const auto width = static_cast<std::uint32_t>(n);
    if (!locate(ip, 0, width, &from) || !locate(ip, 1, width, &to)) return true;
    if (!charge(width / 8)) return false;
    std::memmove(word + to, word + from, width * sizeof *word);
    return true;
  }
  bool fill(const Unit* ip) noexcept {
    std::int32_t value, n;
    std::uint32_t to;
    if (!get16(ip, 0, &value) || !count(ip, 2, std::numeric_limits<std::int16_t>::max(), &n)) return true;
    if (!locate(ip, 1, static_cast<std::uint32_t>(n), &to)) return true;
    if (!charge(static_cast<std::uint32_t>(n) / 8)) return false;
    for (std::int32_t i = 0; i < n; ++i)
      word[to + static_cast<std::uint32_t>(i)] = static_cast<std::int16_t>(value);
    return true;
  }
  bool search(const Unit* ip, bool wide) noexcept {
    std::int32_t key, n;
    std::uint32_t row, to;
    if (!(wide ? get32(ip, 0, &key) : get16(ip, 0, &key))) return true;
    if (!count(ip, 3, std::numeric_limits<std::int16_t>::max(), &n)) return true;
    const auto width = static_cast<std::uint32_t>(n) * (wide ? 2 : 1);
    if (!locate(ip, 1, width, &row) || !locate(ip, 2, 2, &to)) return true;
    if (!charge(static_cast<std::uint32_t>(n))) return false;
    std::int16_t place = 0, matches = 0;
    for (std::int32_t i = 0; i < n; ++i) {
      const auto step = static_cast<std::uint32_t>(i);
      if ((wide ? load32(row + 2 * step) : word[row + step]) != key) continue;
      if (matches++ == 0) place = static_cast<std::int16_t>(i + 1);
    }
    word[to] = place;
    word[to + 1] = matches;
    return true;
  }
  void shortest_way(const Unit* ip) noexcept {
    std::int32_t places, from, target;
    if (!get16(ip, 0, &places) || !get16(ip, 1, &from) || !get16(ip, 2, &target)) return;
    if (places < 1 || from < 1 || from > places || target < 1 || target > places) return fail(ip, kBadValue);
    std::int32_t way = target - from;
    if (way < 0) way += places;
    if (2 * way > places) way -= places;
    put16(ip, 3, way);
  }

  // ---- timers and counters ----
  void reset_timer(std::uint32_t number) noexcept {
    bit[at.timer + number] = 0;
    bit[at.timer_on + number] = 0;
    word[at.timer_value + number] = 0;
    save32(at.timer_rest + 2 * number, 0);
  }
  void reset_counter(std::uint32_t number) noexcept {
    bit[at.counter + number] = 0;
    word[at.counter_value + number] = 0;
  }
  // The scan in which the coil goes on does not count; every further scan adds its period. The remainder
  // below one unit of the value is kept in nanoseconds, so that no time is lost.
  void run_timer(const Unit* ip, std::uint32_t rlo, bool retentive) noexcept {
    const std::uint32_t number = ip[1].tail.b;
    std::uint8_t& on = bit[at.timer_on + number];
    std::uint8_t& contact = bit[at.timer + number];
    if (rlo == 0) {
      if (retentive)
        on = 0;
      else if (on != 0 || contact != 0 || word[at.timer_value + number] != 0)
        reset_timer(number);
      return;
    }
    std::int32_t target;
    if (contact != 0 || !get16(ip, 0, &target)) return;
    std::int32_t value = word[at.timer_value + number];
    if (on == 0) {
      on = 1;
    } else {
      const std::uint32_t base = ip[1].tail.c;
      std::uint32_t rest = static_cast<std::uint32_t>(load32(at.timer_rest + 2 * number)) + code.scan_ns;
      if (rest >= base) {
        value += static_cast<std::int32_t>(rest / base);
        rest %= base;
      }
      save32(at.timer_rest + 2 * number, static_cast<std::int32_t>(rest));
    }
    if (value >= target) {
      contact = 1;
      if (value > target) value = target > 0 ? target : 0;
    }
    word[at.timer_value + number] = static_cast<std::int16_t>(value);
  }
  void run_counter(const Unit* ip, std::uint32_t rlo) noexcept {
    const std::uint32_t number = ip[1].tail.b;
    std::uint8_t& before = bit[at.counter_on + number];
    const bool rising = rlo > before;
    before = static_cast<std::uint8_t>(rlo);
    std::uint8_t& contact = bit[at.counter + number];
    std::int32_t target;
    if (!rising || contact != 0 || !get16(ip, 0, &target)) return;
    std::int16_t& value = word[at.counter_value + number];
    if (value < std::numeric_limits<std::int16_t>::max()) ++value;
    if (value >= target) contact = 1;
  }

  // ---- beginning of the scan ----
  void begin() noexcept {
    std::uint8_t* const sm = bit + at.sm;
    std::uint8_t& started = bit[at.started];
    sm[kSmOn] = 1;
    sm[kSmOff] = 0;
    sm[kSmFirst] = started == 0;
    sm[kSmNotFirst] = started != 0;
    if (code.clocks) {
      std::uint64_t now;  // time of this image in ns
      std::memcpy(&now, word + at.clock, sizeof now);
      if (started != 0) now += code.scan_ns;
      std::memcpy(word + at.clock, &now, sizeof now);
      static constexpr std::uint64_t kHalf[] = {50000000, 100000000, 500000000,
                                                1000000000};  // SM410 to SM413
      for (unsigned i = 0; i < 4; ++i) sm[kSmClock + i] = now / kHalf[i] % 2 == 1;
    }
    started = 1;
  }
};

}  // namespace nc::ladder
