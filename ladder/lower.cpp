// SPDX-License-Identifier: Apache-2.0
// Converts the logic instructions to cells. The depth to which blocks and branches are nested is known for each instruction
// when the program is compiled, so each depth has a bit of its own, and the scan needs no stack: LD within a rung
// stores the present result in such a bit, and ANB and ORB become contacts of it. In subroutines every MPS has its
// own bit, because a branch may call another subroutine. A coil is put into the previous cell if that one
// has no coil yet.
#include <algorithm>

#include "ladder/code.hpp"

namespace nc::ladder {

namespace {

class Lowering {
 public:
  Lowering(Code* code, std::uint32_t main_end)
      : code_(*code), main_end_(main_end), nowhere_(bit()), keep_(bit()) {}

  void run(const std::vector<std::uint32_t>& labels) {
    const std::vector<Unit> from = std::move(code_.units);
    lines_from_ = std::move(code_.lines);
    code_.units.clear();
    code_.lines.clear();
    std::vector<bool> target(from.size() + 1, false);
    for (const std::uint32_t step : labels) target[step] = true;
    std::vector<std::uint32_t> moved(from.size() + 1, 0);  // new index of each unit, for jumps
    bool skipped = false;                                  // the previous instruction was the test of a P form
    for (std::size_t i = 0; i < from.size();) {
      const Op op = static_cast<Op>(from[i].head.op);
      line_ = lines_from_[i];
      in_main_ = i <= main_end_;
      if (target[i]) {
        kept_ = false;
        flush();
      }
      moved[i] = static_cast<std::uint32_t>(code_.units.size());
      if (!skipped && logic(op, from[i].head.a)) {
        ++i;
        continue;
      }
      if (!reads_rlo(op)) kept_ = false;
      restore();
      flush();
      if (has_power(op)) code_.flow.push_back({line_, static_cast<std::uint32_t>(code_.units.size())});
      for (unsigned unit = 0; unit < units_of(op); ++unit) append(from[i + unit]);
      i += units_of(op);
      skipped = op == Op::kSkipNotRising;
    }
    adjust(moved);
  }

 private:
  std::uint32_t bit() {
    code_.edge_start.push_back(0);
    return code_.layout.edges + static_cast<std::uint32_t>(code_.edge_start.size()) - 1;
  }
  void append(const Unit& unit) {
    code_.units.push_back(unit);
    code_.lines.push_back(line_);
  }
  // The power of this line is the result of the newest cell.
  void show_power() { cell_flow_.push_back({line_, static_cast<std::uint32_t>(cells_.size() - 1)}); }
  // False: what the instruction does hangs on no result of logic.
  static bool has_power(Op op) { return op != Op::kEnd && op != Op::kJump && op != Op::kRet && op != Op::kFor && op != Op::kNext; }
  static bool reads_rlo(Op op) {
    switch (op) {
      case Op::kEnd:
      case Op::kJump:
      case Op::kRet:
      case Op::kFor:
      case Op::kNext:
      case Op::kLdp:
      case Op::kLdf:
      case Op::kLdCompare:
      case Op::kLdCompare32:
        return false;
      default:
        return true;
    }
  }

  void cell(Logic logic, std::uint32_t in) {
    cell(logic, in, nowhere_);
    show_power();
  }
  void cell(Logic logic, std::uint32_t in, std::uint32_t out) {
    Unit unit{};
    unit.cell = {in | static_cast<std::uint32_t>(logic) << kLogicShift, out};
    cells_.push_back(unit);
    cell_lines_.push_back(line_);
  }
  void out(std::uint32_t to) {
    if (!cells_.empty() && cells_.back().cell.out == nowhere_)
      cells_.back().cell.out = to;
    else
      cell(Logic::kSame, nowhere_, to);
  }
  // The cell of SET or RST leaves the new value of its device as RLO. When the next instruction uses the result, it is loaded again from keep_.
  void restore() {
    if (kept_) cell(Logic::kLd, keep_);
    kept_ = false;
  }
  void flush() {
    if (cells_.empty()) return;
    Unit unit{};
    unit.head.op = static_cast<std::uint16_t>(cells_.size() == 1 ? Op::kCell : Op::kCells);
    unit.head.a = static_cast<std::uint32_t>(cells_.size());
    code_.units.push_back(unit);
    code_.lines.push_back(cell_lines_.front());
    for (const FlowPlace& place : cell_flow_)
      code_.flow.push_back({place.line, static_cast<std::uint32_t>(code_.units.size()) + place.unit});
    cell_flow_.clear();
    code_.units.insert(code_.units.end(), cells_.begin(), cells_.end());
    code_.lines.insert(code_.lines.end(), cell_lines_.begin(), cell_lines_.end());
    cells_.clear();
    cell_lines_.clear();
  }
  std::uint32_t of_depth(std::vector<std::uint32_t>* bits, std::size_t depth) {
    while (bits->size() <= depth) bits->push_back(bit());
    return (*bits)[depth];
  }
  void push() {
    restore();
    out(of_depth(&block_bits_, depth_++));
  }
  void change(Logic logic, std::uint32_t device) {
    restore();
    out(keep_);
    show_power();
    cell(logic, device, device);
    kept_ = true;
  }

  bool logic(Op op, std::uint32_t a) {
    const auto begin = [&](Logic logic, std::uint32_t in) {
      kept_ = false;
      cell(logic, in);
      return true;
    };
    const auto go_on = [&](Logic logic, std::uint32_t in) {
      restore();
      cell(logic, in);
      return true;
    };
    switch (op) {
      case Op::kNop:
        return true;
      case Op::kLd:
        return begin(Logic::kLd, a);
      case Op::kLdi:
        return begin(Logic::kLdi, a);
      case Op::kPushLd:
        push();
        return begin(Logic::kLd, a);
      case Op::kPushLdi:
        push();
        return begin(Logic::kLdi, a);
      case Op::kPush:
        push();
        return true;
      case Op::kAnd:
        return go_on(Logic::kAnd, a);
      case Op::kAni:
        return go_on(Logic::kAni, a);
      case Op::kOr:
        return go_on(Logic::kOr, a);
      case Op::kOri:
        return go_on(Logic::kOri, a);
      case Op::kAnb:
        return go_on(Logic::kAnd, block_bits_[--depth_]);
      case Op::kOrb:
        return go_on(Logic::kOr, block_bits_[--depth_]);
      case Op::kInv:
        return go_on(Logic::kInvert, nowhere_);
      case Op::kMps:
        restore();
        branches_.push_back(in_main_ ? of_depth(&branch_bits_, branches_.size()) : bit());
        out(branches_.back());
        show_power();
        return true;
      case Op::kMrd:
        return begin(Logic::kLd, branches_.back());
      case Op::kMpp: {
        const std::uint32_t from = branches_.back();
        branches_.pop_back();
        return begin(Logic::kLd, from);
      }
      case Op::kOut:
        restore();
        out(a);
        show_power();
        return true;
      case Op::kSet:
        change(Logic::kOr, a);
        return true;
      case Op::kRst:
        change(Logic::kClear, a);
        return true;
      default:
        return false;
    }
  }

  void adjust(const std::vector<std::uint32_t>& moved) {
    for (std::size_t i = 0; i < code_.units.size();) {
      Unit& unit = code_.units[i];
      const Op op = static_cast<Op>(unit.head.op);
      if (op == Op::kJump || op == Op::kJumpIf || op == Op::kCall) unit.head.a = moved[unit.head.a];
      if (op == Op::kFor || op == Op::kNext) code_.units[i + 1].tail.c = moved[code_.units[i + 1].tail.c];
      i += op == Op::kCells || op == Op::kCell ? 1 + unit.head.a : units_of(op);
    }
  }

  Code& code_;
  std::uint32_t main_end_, nowhere_, keep_;
  std::vector<std::uint32_t> lines_from_;
  std::vector<Unit> cells_;
  std::vector<std::uint32_t> cell_lines_;
  std::vector<FlowPlace> cell_flow_;  // `unit` counts the cells that are not in the code yet
  std::vector<std::uint32_t> block_bits_, branch_bits_, branches_;
  std::size_t depth_ = 0;
  std::uint32_t line_ = 0;
  bool kept_ = false;  // the result is in keep_ and not in the RLO
  bool in_main_ = true;
};

}  // namespace

void lower(Code* code, const std::vector<std::uint32_t>& targets, std::uint32_t main_end) {
  Lowering(code, main_end).run(targets);
}

}  // namespace nc::ladder
