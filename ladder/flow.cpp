// SPDX-License-Identifier: Apache-2.0
// Program flow: master control, labels and jumps, subroutines, loops, ends.
#include <charconv>

#include "ladder/compiler.hpp"

namespace nc::ladder {

bool Compiler::number_after(char letter, std::string_view word, std::uint32_t limit, std::uint32_t* number) {
  *number = 0;
  if (word.size() > 1 && word[0] == letter) {
    const char* last = word.data() + word.size();
    const auto [end, failed] = std::from_chars(word.data() + 1, last, *number);
    if (end == last && failed == std::errc() && *number <= limit) return true;
  }
  error(std::string(1, letter) + "0 to " + std::string(1, letter) + std::to_string(limit) + " is needed");
  return false;
}

// ---- master control ----

void Compiler::master(const Rule& rule) {
  const bool good = take_result();
  std::uint32_t level;
  Place place;
  if (!operand_count(rule, 2, 2) || !number_after('N', words_[1], kMaxMasters - 1, &level) ||
      !bit_operand(words_[2], true, &place))
    return;
  if (!masters_.empty() && level <= masters_.back().level)
    return error("inside the master control N" + std::to_string(masters_.back().level) +
                 " a higher N is needed");
  if (branches_ != 0) error("the branch of MPS in line " + std::to_string(branch_line_) + " has no MPP");
  branches_ = 0;
  if (!good) return;
  note_coil(place);
  const std::uint32_t gate_bit = new_bit();
  remember(gate_bit);
  emit(Op::kOut, place.index);
  emit(Op::kOut, gate_bit);
  masters_.push_back({level, gate_bit, line_, rung_key_});
  rung_ = Rung{};
}

void Compiler::master_end() {
  std::uint32_t level;
  if (!operand_count(*rule_, 1, 1) || !number_after('N', words_[1], kMaxMasters - 1, &level)) return;
  close_rung();
  const auto open =
      std::find_if(masters_.begin(), masters_.end(), [&](const Master& m) { return m.level == level; });
  if (open == masters_.end()) return error("there is no MC N" + std::to_string(level) + " for it");
  masters_.erase(open, masters_.end());
}

// ---- labels and jumps ----

std::vector<unsigned> Compiler::loop_path() const {
  std::vector<unsigned> path;
  for (const Loop& loop : open_loops_) path.push_back(loop.id);
  return path;
}

void Compiler::label(std::string_view name) {
  std::uint32_t number = 0;
  number_after('P', name, kMaxLabel, &number);
  close_rung();
  const Label here{static_cast<std::uint32_t>(code_.units.size()), line_, loop_path(), main_ended_};
  const auto [known, added] = labels_.emplace(number, here);
  note_flow(name);
  if (!added) error("the label is in line " + std::to_string(known->second.line) + " already");
}

void Compiler::jump(const Rule& rule, bool pulse) {
  std::uint32_t number;
  bool good = true;
  if (rule.op == Op::kJump)
    close_rung();
  else
    good = take_result();
  if (!operand_count(rule, 1, 1) || !number_after('P', words_[1], kMaxLabel, &number) || !good) return;
  emit_pulse(rule.op, pulse);
  jumps_.push_back(
      {code_.units.size(), number, line_, loop_path(), main_ended_, rule.action == Action::kCall});
  emit(rule.op);
}

void Compiler::resolve_labels() {
  for (const Jump& jump : jumps_) {
    const auto found = labels_.find(jump.label);
    if (found == labels_.end()) {
      error_at(jump.line, "there is no label P" + std::to_string(jump.label));
      continue;
    }
    const Label& label = found->second;
    code_.units[jump.unit].head.a = label.step;
    if (jump.call) {
      if (!label.sub) error_at(jump.line, "a subroutine stands behind FEND");
      if (!label.loops.empty()) error_at(jump.line, "the label is inside FOR and NEXT");
      continue;
    }
    if (label.sub != jump.sub) error_at(jump.line, "a jump cannot cross FEND");
    if (label.loops.size() > jump.loops.size() ||
        !std::equal(label.loops.begin(), label.loops.end(), jump.loops.begin()))
      error_at(jump.line, "a jump cannot lead into FOR and NEXT");
  }
}

// ---- loops ----

void Compiler::loop(const Rule& rule) {
  Encoded count;
  if (!operand_count(rule, 1, 1)) return;
  close_rung();
  // A loop with a wrong count still counts as a loop, so that its NEXT is not reported, too.
  if (!encode('s', words_[1], &count)) count = {Mode::kConstant, 0};
  if (open_loops_.size() == kMaxLoops)
    return error("more than " + std::to_string(kMaxLoops) + " loops inside each other");
  const std::uint32_t slot = code_.layout.loops + 2 * loops_;
  open_loops_.push_back({loops_++, code_.units.size(), slot, line_});
  emit(Op::kFor, count.value, static_cast<unsigned>(count.mode));
  emit2(slot, 0);
}

void Compiler::loop_end() {
  if (!operand_count(*rule_, 0, 0)) return;
  close_rung();
  if (open_loops_.empty()) return error("there is no FOR for it");
  const Loop loop = open_loops_.back();
  open_loops_.pop_back();
  emit(Op::kNext);
  emit2(loop.slot, static_cast<std::uint32_t>(loop.unit) + 2);
  code_.units[loop.unit + 1].tail.c = static_cast<std::uint32_t>(code_.units.size());
}

// ---- ends ----

void Compiler::main_end() {
  if (!operand_count(*rule_, 0, 0)) return;
  end_of_text();
  if (!main_ended_) main_end_ = static_cast<std::uint32_t>(code_.units.size()) - 1;
  if (main_ended_) error("there is a FEND before it");
  main_ended_ = true;
}

void Compiler::text_end() {
  if (!operand_count(*rule_, 0, 0)) return;
  end_of_text();
  ended_ = true;
}

// Checks that nothing is open at FEND, at END, or where the text ends without END.
void Compiler::end_of_text() {
  close_rung();
  for (const Master& master : masters_) error_at(master.line, "MCR is missing");
  for (const Loop& loop : open_loops_) error_at(loop.line, "NEXT is missing");
  masters_.clear();
  open_loops_.clear();
  emit(Op::kEnd);
}

}  // namespace nc::ladder
