// SPDX-License-Identifier: Apache-2.0
// Compiled code: what compile() writes and the interpreter runs.
//
// An instruction is one to three units of 8 bytes. Contacts, blocks, branches, OUT, SET and RST become cells:
// a cell reads one bit, combines it with the result of logic (RLO) by a truth table of four entries, and
// stores the RLO. Where blocks and branches keep a result, they keep it in a bit of their own, so a cell is
// all they need. A row of cells runs without a branch between them: rungs of a real program follow no pattern
// that a processor could predict, and a mispredicted jump costs as much as ten contacts. The time of a scan
// does not depend on the state of the machine either.
//
// Every index was checked when the program was compiled; what can only be known in the scan (indexed devices,
// block lengths) goes through Indirect and is checked there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"

namespace nc::ladder {

// What the interpreter knows. One unit each; behind kCells come as many cells as its operand says.
#define NC_LADDER_OPS_SHORT(X)                                                                              \
  X(kEnd)                                                                                                   \
  X(kCells) X(kCell) X(kMep) X(kMef) X(kSet) X(kRst) X(kSkipNotRising) X(kJump) X(kJumpIf) X(kCall) X(kRet) \
      X(kRstTimer) X(kRstCounter)
// Two units, the second with operands b and c; three for the last ones.
#define NC_LADDER_OPS_LONG(X)                                                                              \
  X(kLdp)                                                                                                  \
  X(kLdf) X(kAndp) X(kAndf) X(kOrp) X(kOrf) X(kPls) X(kPlf) X(kFf) X(kOutTimer) X(kOutRetentive)           \
      X(kOutCounter) X(kFor) X(kNext) X(kLdCompare) X(kAndCompare) X(kOrCompare) X(kLdCompare32)           \
          X(kAndCompare32) X(kOrCompare32) X(kMov) X(kCml) X(kXch) X(kBcd) X(kBin) X(kAdd) X(kSub) X(kMul) \
              X(kDiv) X(kInc) X(kDec) X(kNeg) X(kWand) X(kWor) X(kWxor) X(kRor) X(kRol) X(kSfr) X(kSfl)    \
                  X(kBset) X(kBrst) X(kRstWord) X(kDmov) X(kDcml) X(kDxch) X(kDbcd) X(kDbin) X(kDadd)      \
                      X(kDsub) X(kDmul) X(kDdiv) X(kDinc) X(kDdec) X(kDneg) X(kDwand) X(kDwor) X(kDwxor)   \
                          X(kDror) X(kDrol) X(kRstWord32) X(kBmov) X(kFmov) X(kZrstBits) X(kZrstWords)     \
                              X(kZrstTimers) X(kZrstCounters) X(kWordBit) X(kBitWord) X(kSer) X(kDser) X(kRots)
// What lower() turns into cells. One unit each.
#define NC_LADDER_OPS_LOGIC(X)                                                                          \
  X(kNop)                                                                                               \
  X(kLd) X(kLdi) X(kPushLd) X(kPushLdi) X(kAnd) X(kAni) X(kOr) X(kOri) X(kPush) X(kAnb) X(kOrb) X(kMps) \
      X(kMrd) X(kMpp) X(kInv) X(kOut)

enum class Op : std::uint16_t {
#define NC_LADDER_OP(name) name,
  NC_LADDER_OPS_SHORT(NC_LADDER_OP) NC_LADDER_OPS_LONG(NC_LADDER_OP) NC_LADDER_OPS_LOGIC(NC_LADDER_OP)
#undef NC_LADDER_OP
};

inline constexpr unsigned units_of(Op op) {
  if (op == Op::kRots || op == Op::kSer || op == Op::kDser) return 3;
  return op >= Op::kLdp && op < Op::kNop ? 2 : 1;
}

// First unit: op, mode, a. Second: b, c. Third: d in b.
union Unit {
  struct {
    std::uint16_t op;
    std::uint16_t mode;  // two bits for each of the operands a, b, c, d; behind them what the op needs
    std::uint32_t a;
  } head;
  struct {
    std::uint32_t b, c;
  } tail;
  struct {
    std::uint32_t in;   // bit it reads; in the highest 8 bits its truth table
    std::uint32_t out;  // bit that becomes the new RLO
  } cell;
};
static_assert(sizeof(Unit) == 8);

// Truth tables: entry 2 * bit + RLO is the new RLO.
enum class Logic : std::uint32_t {
  kLd = 0b1100,
  kLdi = 0b0011,
  kAnd = 0b1000,
  kAni = 0b0010,
  kOr = 0b1110,
  kOri = 0b1011,
  kSame = 0b1010,
  kInvert = 0b0101,
  kClear = 0b0100  // bit and not RLO
};
inline constexpr unsigned kLogicShift = 24;
inline constexpr std::uint32_t kMaxBits = 1u << kLogicShift;

// How a word operand is found; bits 2i, 2i+1 of Unit::mode for operand i.
enum class Mode : unsigned { kDirect = 0, kConstant = 1, kIndirect = 2 };
inline constexpr unsigned kModeExtra = 8;  // relation of a compare, in the bits from here

enum class Relation : unsigned { kEqual, kNotEqual, kGreater, kLessEqual, kLess, kGreaterEqual };

// A word operand whose place is known in the scan only, or whose neighbours are written too.
struct Indirect {
  std::uint32_t base = 0;    // word, or first bit of digits
  std::uint32_t z = kNoZ;    // word of the index register
  std::uint32_t first = 0;   // words of the same kind of device: first ...
  std::uint32_t end = 0;     // ... and one behind the last
  std::uint32_t digits = 0;  // K4M0: four digits of four bits; 0 = words
  static constexpr std::uint32_t kNoZ = 0xffffffffu;
};

inline constexpr std::uint32_t kTimers = 512, kRetentive = 64, kCounters = 512;
inline constexpr std::uint32_t kAllTimers = kTimers + kRetentive;  // ST0 is number 512
inline constexpr std::uint32_t kM = 8192, kL = 2048, kD = 8192, kZ = 16, kSm = 1024, kSd = 16;

// Where the internal devices are, behind those of the table.
struct Layout {
  std::uint32_t sm, m, l, timer, timer_on, counter, counter_on, started, edges,
      bits;  // into DeviceImage::bit
  std::uint32_t d, z, sd, timer_value, timer_rest, counter_value, clock, loops, words;  // into ::word
};

// Memory of an edge: 0, 1, or this before the instruction ran for the first time, when no edge is reported.
inline constexpr std::uint8_t kEdgeUnknown = 2;

inline constexpr unsigned kSmError = 0, kSmOn = 400, kSmOff = 401, kSmFirst = 402, kSmNotFirst = 403,
                          kSmClock = 410, kSmCarry = 700;
inline constexpr unsigned kSdError = 0, kSdLine = 1;
// Codes in SD0.
enum OperationError : std::int16_t { kBadValue = 4100, kBadPlace = 4101 };

struct RetainedD {
  std::uint32_t first = 0, count = 0;
};

struct Code {
  std::vector<Unit> units;
  std::vector<std::uint32_t> lines;  // of each unit
  std::vector<Indirect> indirect;
  Layout layout{};
  DeviceTable table;
  std::map<std::string, std::string> aliases;  // resolved: what the program writes -> device
  std::vector<std::uint8_t> edge_start;        // kEdgeUnknown, or 0 for bits of MC, blocks and branches
  std::uint32_t scan_ns = 1000000;
  std::uint32_t step_budget = 0;
  unsigned instructions = 0;
  bool clocks = false;  // the program reads SM410..SM413
  bool retain_counters = false;
  RetainedD retained_d;
  std::string file;
  std::vector<std::string> source;  // the lines, for messages in the scan's name
  std::vector<Error> warnings;
};

struct Outcome {
  unsigned fault;
  std::uint32_t step;
};

// Turns the logic of the program into cells; jumps are adjusted. `targets`: units that jumps lead to.
void lower(Code* code, const std::vector<std::uint32_t>& targets, std::uint32_t main_end);

// The interpreter, with computed goto where the compiler has it, and with a switch. Same rules, same results.
Outcome execute_threaded(const Code& code, DeviceImage* image) noexcept;
Outcome execute_portable(const Code& code, DeviceImage* image) noexcept;
// The portable one, with devices that no instruction changes.
Outcome execute_held(const Code& code, DeviceImage* image, const Hold* holds, unsigned hold_count) noexcept;

}  // namespace nc::ladder
