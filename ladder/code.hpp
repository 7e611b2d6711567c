// SPDX-License-Identifier: Apache-2.0
// Compiled code, which compile() makes and the interpreter runs.
//
// An instruction is one to three units of 8 bytes. Contacts, blocks, branches, OUT, SET and RST become cells:
// a cell reads one bit, combines it with the result of logic (RLO) by a truth table of four entries, and
// stores the RLO. Blocks and branches keep a result in a bit of their own, so cells are enough for
// them, too. A row of cells runs without a conditional jump: the bits of a real program follow no pattern
// that a processor could predict, and a mispredicted jump takes as much time as ten contacts. So the time of a scan
// does not depend on the state of the machine either.
//
// Every index is checked when the program is compiled. Places that are known only in the scan (indexed devices,
// lengths of blocks) are described by an Indirect and checked there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"

namespace nc::ladder {

// The instructions of the interpreter. These have one unit each; kCells is followed by as many cells as its operand says.
#define NC_LADDER_OPS_SHORT(X)                                                                              \
  X(kEnd)                                                                                                   \
  X(kCells) X(kCell) X(kMep) X(kMef) X(kSet) X(kRst) X(kSkipNotRising) X(kJump) X(kJumpIf) X(kCall) X(kRet) \
      X(kRstTimer) X(kRstCounter)
// These have two units, the second with the operands b and c; kSer, kDser and kRots have three.
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
// The compiler emits these, and lower() turns them into cells. One unit each.
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

// The first unit of an instruction has op, mode and a, the second one b and c, the third one d (in b).
union Unit {
  struct {
    std::uint16_t op;
    std::uint16_t mode;  // two bits for each of the operands a, b, c, d; the bits above them depend on the op
    std::uint32_t a;
  } head;
  struct {
    std::uint32_t b, c;
  } tail;
  struct {
    std::uint32_t in;   // index of the bit that is read; the highest 8 bits are the truth table
    std::uint32_t out;  // index of the bit that gets the new RLO
  } cell;
};
static_assert(sizeof(Unit) == 8);

// Truth tables: the entry 2 * bit + RLO is the new RLO.
enum class Logic : std::uint32_t {
  kLd = 0b1100,
  kLdi = 0b0011,
  kAnd = 0b1000,
  kAni = 0b0010,
  kOr = 0b1110,
  kOri = 0b1011,
  kSame = 0b1010,
  kInvert = 0b0101,
  kClear = 0b0100  // bit AND NOT RLO
};
inline constexpr unsigned kLogicShift = 24;
inline constexpr std::uint32_t kMaxBits = 1u << kLogicShift;

// The kind of a word operand, in bits 2i and 2i+1 of Unit::mode for operand i.
enum class Mode : unsigned { kDirect = 0, kConstant = 1, kIndirect = 2 };
inline constexpr unsigned kModeExtra = 8;  // first bit of the relation of a compare

enum class Relation : unsigned { kEqual, kNotEqual, kGreater, kLessEqual, kLess, kGreaterEqual };

// A word operand whose place is known only in the scan, or which has several words, or a group of bits.
struct Indirect {
  std::uint32_t base = 0;    // index of the word, or of the first bit of digits
  std::uint32_t z = kNoZ;    // index of the word of the index register
  std::uint32_t first = 0;   // the range that the words may be in: the first word of this kind of device
  std::uint32_t end = 0;     // and the one after the last
  std::uint32_t digits = 0;  // number of digits of four bits: 4 for K4M0; 0 = words
  static constexpr std::uint32_t kNoZ = 0xffffffffu;
};

inline constexpr std::uint32_t kTimers = 512, kRetentive = 64, kCounters = 512;
inline constexpr std::uint32_t kAllTimers = kTimers + kRetentive;  // ST0 is number 512
inline constexpr std::uint32_t kM = 8192, kL = 2048, kD = 8192, kZ = 16, kSm = 1024, kSd = 16;

// The first index of each kind of internal device; they come after the devices of the table.
struct Layout {
  std::uint32_t sm, m, l, timer, timer_on, counter, counter_on, started, edges,
      bits;  // indices into DeviceImage::bit; `bits` is its size
  std::uint32_t d, z, sd, timer_value, timer_rest, counter_value, clock, loops, words;  // indices into DeviceImage::word; `words` is its size
};

// The memory of an edge is 0 or 1, or this value until the instruction has run for the first time: then no edge is reported.
inline constexpr std::uint8_t kEdgeUnknown = 2;

inline constexpr unsigned kSmError = 0, kSmOn = 400, kSmOff = 401, kSmFirst = 402, kSmNotFirst = 403,
                          kSmClock = 410, kSmCarry = 700;
inline constexpr unsigned kSdError = 0, kSdLine = 1;
// Error codes in SD0.
enum OperationError : std::int16_t { kBadValue = 4100, kBadPlace = 4101 };

struct RetainedD {
  std::uint32_t first = 0, count = 0;
};

// The power of a line of the source is the result of logic behind this unit. A line that has several units has several places, in the order of their execution.
struct FlowPlace {
  std::uint32_t line, unit;
};

// A bit that remembers what an instruction has seen when it was executed last: the memory of an edge, the coil of a counter, the gate of a master control. When a program takes
// the place of another one (exchange.hpp), the bits of instructions that both have keep their values.
struct Memory {
  std::uint32_t bit = 0;    // index in DeviceImage::bit
  std::uint64_t key = 0;    // of what decides about its value: the text of the rung up to the instruction, and the master controls around it
  std::uint64_t rung_key = 0;  // of the whole rung and the place in it; while compiling: number of the rung
  std::uint32_t unit = 0;   // while compiling: its first unit
  std::uint32_t area = 0;   // number of the instructions in front of it that direct the flow
  bool always = false;      // it is executed exactly once in each scan
};

struct TimerCoil {
  std::uint32_t number = 0, unit_us = 0, line = 0;
};

struct Code {
  std::vector<Unit> units;
  std::vector<std::uint32_t> lines;  // line of the source for each unit
  std::vector<Indirect> indirect;
  Layout layout{};
  DeviceTable table;
  std::map<std::string, std::string> aliases;  // maps a name in the program to its device
  std::vector<std::uint8_t> edge_start;        // initial values of the bits from Layout::edges on: kEdgeUnknown, or 0 for bits of MC, blocks and branches
  std::vector<Memory> memories;                // at most one for each bit
  std::uint64_t flow_key = 0;                  // of the instructions that direct the flow, with their conditions
  std::vector<TimerCoil> timer_coils;
  std::vector<bool> bits_written, words_written;  // for each bit and word of the table: an instruction may write it
  std::uint32_t scan_ns = 1000000;
  std::uint32_t step_budget = 0;
  unsigned instructions = 0;
  bool clocks = false;  // the program reads SM410 to SM413
  bool retain_counters = false;
  RetainedD retained_d;
  std::string file;
  std::vector<std::string> source;  // the lines of the program, for messages about faults in the scan and for listings
  std::vector<FlowPlace> flow;        // in the order of the lines
  std::vector<std::uint32_t> rungs;   // first line of each rung; a line that belongs to none is one of its own
  std::vector<Error> warnings;
};

struct Outcome {
  unsigned fault;
  std::uint32_t step;
};

// Turns the logic of the program into cells and adjusts the jumps. `targets`: units that jumps lead to. `main_end`: unit of FEND.
void lower(Code* code, const std::vector<std::uint32_t>& targets, std::uint32_t main_end);

// The interpreter, once with computed goto if the compiler has it, and once with a switch. Both have the same results.
Outcome execute_threaded(const Code& code, DeviceImage* image) noexcept;
Outcome execute_portable(const Code& code, DeviceImage* image) noexcept;
// The interpreter with a switch that holds devices at a value. `flow`: one byte for each unit, all 0; an instruction that was executed leaves kFlowExecuted there,
// and in bit 0 the result of logic behind it. Null = nobody looks.
inline constexpr std::uint8_t kFlowExecuted = 2;
Outcome execute_watched(const Code& code, DeviceImage* image, const Hold* holds, unsigned hold_count, std::uint8_t* flow) noexcept;

}  // namespace nc::ladder
