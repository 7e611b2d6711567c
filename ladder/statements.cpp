// SPDX-License-Identifier: Apache-2.0
// One line of the program: contacts, blocks, outputs, words. Program flow is in flow.cpp.
#include <cctype>

#include "ladder/compiler.hpp"
#include "ladder/elsewhere.hpp"

namespace nc::ladder {

// ---- the state of the rung ----

bool Compiler::has_result() {
  if (rung_.blocks != 0) return true;
  error("there is no contact before it: a rung begins with LD");
  return false;
}

// Inside MC ... MCR a rung is on only when the master control is on. So an AND with the master control is emitted before the result is used for the first time.
void Compiler::gate() {
  if (!masters_.empty() && !rung_.gated) emit(Op::kAnd, masters_.back().gate);
  rung_.gated = true;
}

bool Compiler::take_result() {
  bool good = has_result();
  if (rung_.blocks > 1) {
    error(std::to_string(rung_.blocks) + " blocks are not joined: ANB or ORB is missing");
    rung_.blocks = 1;
    good = false;
  }
  if (rung_.inherited != 0) {
    error("the branch of MPS in line " + std::to_string(branch_line_) + " has no MPP");
    rung_.inherited = branches_ = 0;
    good = false;
  }
  gate();
  rung_.blocks = 1;
  rung_.used = rung_.joined = true;
  return good;
}

void Compiler::close_rung() {
  if (!rung_.used) error("the result of the rung before it is not used");
  if (branches_ != 0) {
    error("the branch of MPS in line " + std::to_string(branch_line_) + " has no MPP");
    branches_ = 0;
  }
  rung_ = Rung{};
}

// A label in front of a rung belongs to it.
void Compiler::begin_rung() {
  code_.rungs.push_back(label_line_ != 0 ? label_line_ : line_);
  label_line_ = 0;
  begin_key();
}

void Compiler::note_coil(const Place& place) {
  std::uint64_t key = place.index;
  if (!word_bits_.empty() && word_bits_.back().bit == place.index)
    key = std::uint64_t{word_bits_.back().word} << 36 | std::uint64_t{word_bits_.back().number} << 32 | 0xffffffffu;
  const auto [coil, added] = coils_.emplace(key, line_);
  if (!added)
    warning("the same coil as in line " + std::to_string(coil->second) + ": the last one that runs decides");
}

// A rising edge needs a previous scan, so there is none in the first scan. Afterwards the contacts of SM400 to SM402 never go on, so they never rise.
void Compiler::note_rising() {
  if (rung_.always && masters_.empty())
    warning("its condition is SM400, SM401 or SM402 alone, which never rises: for once at the start take LD SM402 and "
        "the form without an edge");
}

namespace {

bool is_always(const Place& place) {
  return place.family == "SM" && place.number >= kSmOn && place.number <= kSmFirst;
}

}  // namespace

// ---- lines ----

void Compiler::statement() {
  std::string mnemonic(words_[0]);
  for (char& c : mnemonic) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  bool pulse = false;
  rule_ = find_rule(mnemonic, &pulse);
  if (rule_ == nullptr) {
    std::string_view name = words_[0];
    if (name.size() > 1 && name.back() == ':') name.remove_suffix(1);
    std::uint32_t number;
    if (words_.size() == 1 && name.size() > 1 && name[0] == 'P' &&
        name.find_first_not_of("0123456789", 1) == std::string_view::npos) {
      line_text_ = name;
      key_before_line_ = rung_key_;
      if (number_after('P', name, kMaxLabel, &number)) label(name);
      if (label_line_ != 0) begin_rung();
      label_line_ = line_;
      return;
    }
    const std::string elsewhere = instruction_elsewhere(mnemonic);
    error(elsewhere.empty() ? "no such instruction" : "not supported: " + elsewhere);
    return;
  }
  ++code_.instructions;
  add_to_rung();
  act(*rule_, pulse);
  close_word_bits();
  if (rung_.blocks == 0 && rule_->action != Action::kMaster) begin_rung();  // a line without a condition, as FEND
}

bool Compiler::operand_count(const Rule& rule, std::size_t least, std::size_t most) {
  const std::size_t count = words_.size() - 1;
  if (count >= least && count <= most) return true;
  const std::string form = rule.info.operands;
  error(form.empty() ? "takes no operand" : "operands: " + form);
  return false;
}

void Compiler::act(const Rule& rule, bool pulse) {
  switch (rule.action) {
    case Action::kLoad:
      return load(rule);
    case Action::kJoin:
      return join(rule);
    case Action::kBlock:
      return block(rule);
    case Action::kPushBranch:
    case Action::kReadBranch:
    case Action::kPopBranch:
      return branch(rule);
    case Action::kInvert:
    case Action::kEdgeOfResult:
      if (!operand_count(rule, 0, 0) || !has_result()) return;
      if (rule.op == Op::kMep) note_rising();
      if (rung_.blocks == 1) gate();
      rung_.always = false;
      emit(rule.op, rule.edge ? new_edge() : 0);
      rung_.used = false;
      // The new result may be on although the master control is off, so it has to be gated again.
      if (rung_.blocks == 1) rung_.gated = false;
      return;
    case Action::kOut:
      return out(rule);
    case Action::kSet:
      return set_bit(pulse);
    case Action::kReset:
      return reset(pulse);
    case Action::kPulseCoil:
      return pulse_coil(rule);
    case Action::kMaster:
      return master(rule);
    case Action::kMasterEnd:
      return master_end();
    case Action::kWords:
    case Action::kAccumulate:
      return words(rule, pulse);
    case Action::kResetRange:
      return reset_range(pulse);
    case Action::kJump:
    case Action::kCall:
      return jump(rule, pulse);
    case Action::kReturn:
      if (!operand_count(rule, 0, 0)) return;
      close_rung();
      if (!main_ended_) error("a subroutine stands behind FEND");
      emit(Op::kRet);
      return;
    case Action::kMainEnd:
      return main_end();
    case Action::kEnd:
      return text_end();
    case Action::kFor:
      return loop(rule);
    case Action::kNext:
      return loop_end();
    case Action::kAlias:
      return alias();
    case Action::kNothing:
      operand_count(rule, 0, 0);
      return;
  }
}

void Compiler::load(const Rule& rule) {
  if (rung_.used) {
    Rung next;
    next.before = rung_.blocks == 1;
    next.gated_before = rung_.gated;
    next.start = code_.units.size();
    next.inherited = branches_;
    rung_ = next;
    rung_.used = false;
    begin_rung();
  }
  const bool first = rung_.blocks == 0;
  rung_.always = false;
  if (rung_.blocks == kMaxBlocks)
    return error("more than " + std::to_string(kMaxBlocks) + " blocks inside each other");
  ++rung_.blocks;
  if (rule.spec[0] != '\0') {
    Encoded left, right;
    if (!operand_count(rule, 2, 2) || !encode(rule.spec[0], words_[1], &left) ||
        !encode(rule.spec[1], words_[2], &right))
      return;
    if (!first) emit(Op::kPush);
    emit(
        rule.op, left.value,
        static_cast<unsigned>(left.mode) | static_cast<unsigned>(right.mode) << 2 | rule.extra << kModeExtra);
    return emit2(right.value, 0);
  }
  Place place;
  if (!operand_count(rule, 1, 1) || !bit_operand(words_[1], false, &place)) return;
  if (place.family == "SM" && place.number >= kSmClock && place.number < kSmClock + 4) code_.clocks = true;
  rung_.always = first && is_always(place);
  if (rule.op == Op::kLdp) note_rising();
  if (!rule.edge) return emit(first ? rule.op : rule.op2, place.index);
  rung_.always = false;
  if (!first) emit(Op::kPush);
  emit(rule.op, place.index);
  emit2(new_edge(), 0);
}

void Compiler::join(const Rule& rule) {
  const bool good = has_result();
  if (good && rule.parallel && rung_.joined && rung_.blocks == 1)
    return error("a parallel contact cannot follow an output or a branch: begin with LD");
  Place place;
  Encoded left, right;
  rung_.always = false;
  if (rule.spec[0] != '\0') {
    if (!operand_count(rule, 2, 2) || !encode(rule.spec[0], words_[1], &left) ||
        !encode(rule.spec[1], words_[2], &right) || !good)
      return;
    emit(
        rule.op, left.value,
        static_cast<unsigned>(left.mode) | static_cast<unsigned>(right.mode) << 2 | rule.extra << kModeExtra);
    emit2(right.value, 0);
  } else {
    if (!operand_count(rule, 1, 1) || !bit_operand(words_[1], false, &place) || !good) return;
    if (place.family == "SM" && place.number >= kSmClock && place.number < kSmClock + 4) code_.clocks = true;
    emit(rule.op, place.index);
    if (rule.edge) emit2(new_edge(), 0);
  }
  rung_.used = false;
}

void Compiler::block(const Rule& rule) {
  if (!operand_count(rule, 0, 0)) return;
  if (rung_.blocks == 1 && !rule.parallel && rung_.before && !rung_.joined) {
    if (rung_.start >= code_.units.size()) return;  // its LD had an error
    // The block is joined with the result of the previous outputs, so its first LD has to keep that result.
    Unit& first = code_.units[rung_.start];
    const Op op = static_cast<Op>(first.head.op);
    if (op == Op::kLd || op == Op::kLdi) {
      first.head.op = static_cast<std::uint16_t>(op == Op::kLd ? Op::kPushLd : Op::kPushLdi);
    } else {
      Unit push{};
      push.head = {static_cast<std::uint16_t>(Op::kPush), 0, 0};
      const auto at = static_cast<std::ptrdiff_t>(rung_.start);
      code_.units.insert(code_.units.begin() + at, push);
      code_.lines.insert(code_.lines.begin() + at, line_);
    }
    join_key();
    code_.rungs.pop_back();  // what looked like a rung of its own goes on from the one before
    rung_.before = false;
    rung_.joined = true;
    rung_.gated = rung_.gated_before;
    rung_.inherited = 0;
    return emit(rule.op);
  }
  if (rung_.blocks < 2 || rung_.used) return error("there are no two blocks to join");
  if (rung_.blocks == 2 && rule.parallel && rung_.joined)
    return error("a parallel block cannot follow an output or a branch: begin with LD");
  --rung_.blocks;
  emit(rule.op);
}

void Compiler::branch(const Rule& rule) {
  if (!operand_count(rule, 0, 0)) return;
  if (rule.action == Action::kPushBranch) {
    if (branches_ == kMaxBranches)
      return error("more than " + std::to_string(kMaxBranches) + " branches inside each other");
    if (!take_result()) return;
    rung_.used = false;
    branch_line_ = line_;
    ++branches_;
    return emit(rule.op);
  }
  if (branches_ == 0) return error("there is no MPS for it");
  if (!rung_.used) error("the result of the branch before it is not used");
  if (rule.action == Action::kPopBranch) --branches_;
  rung_ = Rung{};
  rung_.blocks = 1;
  rung_.used = false;
  rung_.joined = rung_.gated = true;
  emit(rule.op);
}

void Compiler::out(const Rule& rule) {
  if (!take_result()) return;
  if (!operand_count(rule, 1, 2)) return;
  std::string message;
  const auto operand = names_.operand(words_[1], &message);
  if (!operand) return error(message);
  const Place& place = operand->place;
  if (operand->form == Operand::Form::kDevice && place.kind == Kind::kTimer) return out_timer(rule, place);
  if (rule.op != Op::kOut) return error("'" + std::string(words_[1]) + "' is no timer");
  if (operand->form == Operand::Form::kDevice && place.kind == Kind::kCounter) return out_counter(place);
  Place bit;
  if (!bit_operand(words_[1], true, &bit)) return;
  if (!operand_count(rule, 1, 1)) return;
  note_coil(bit);
  emit(Op::kOut, bit.index);
}

void Compiler::out_timer(const Rule& rule, const Place& place) {
  Encoded target;
  if (words_.size() != 3) return error("a timer needs its set value, such as K50 or D10");
  if (!encode('s', words_[2], &target)) return;
  if (target.mode == Mode::kConstant && static_cast<std::int32_t>(target.value) < 0)
    return error("the set value is from K0 to K32767");
  note_coil(place);
  code_.timer_coils.push_back({place.number, rule.extra, line_});
  emit(place.number < kTimers ? Op::kOutTimer : Op::kOutRetentive, target.value,
       static_cast<unsigned>(target.mode));
  emit2(place.number, rule.extra * 1000);
}

void Compiler::out_counter(const Place& place) {
  Encoded target;
  if (words_.size() != 3) return error("a counter needs its set value, such as K50 or D10");
  std::string message;
  const auto value = names_.operand(words_[2], &message);
  if (value && value->form == Operand::Form::kConstant && (value->constant < 0 || value->constant > 32767))
    return error("the set value is from K0 to K32767; for more count in 32 bits, with DINCP and LDD>=");
  if (!encode('s', words_[2], &target)) return;
  note_coil(place);
  remember(code_.layout.counter_on + place.number);
  emit(Op::kOutCounter, target.value, static_cast<unsigned>(target.mode));
  emit2(place.number, 0);
}

void Compiler::set_bit(bool pulse) {
  Place place;
  const bool good = take_result();
  if (!operand_count(*rule_, 1, 1) || !bit_operand(words_[1], true, &place) || !good) return;
  emit_pulse(Op::kSet, pulse);
  emit(Op::kSet, place.index);
}

void Compiler::reset(bool pulse) {
  const bool good = take_result();
  if (!operand_count(*rule_, 1, 1)) return;
  std::string message;
  const auto operand = names_.operand(words_[1], &message);
  if (!operand) return error(message);
  const Place& place = operand->place;
  if (operand->form == Operand::Form::kDevice && operand->z == Indirect::kNoZ &&
      (place.kind == Kind::kTimer || place.kind == Kind::kCounter)) {
    const Op op = place.kind == Kind::kTimer ? Op::kRstTimer : Op::kRstCounter;
    emit_pulse(op, pulse);
    return emit(op, place.number);
  }
  if (operand->form == Operand::Form::kDevice && place.type == DeviceType::kBit) {
    Place bit;
    if (!bit_operand(words_[1], true, &bit) || !good) return;
    emit_pulse(Op::kRst, pulse);
    return emit(Op::kRst, bit.index);
  }
  const bool wide = place.type == DeviceType::kWord32 || operand->digits > 4;
  Encoded word;
  if (!encode(wide ? 'D' : 'd', words_[1], &word)) return;
  const Op op = wide ? Op::kRstWord32 : Op::kRstWord;
  emit_pulse(op, pulse);
  emit(op, word.value, static_cast<unsigned>(word.mode));
  emit2(0, 0);
}

void Compiler::reset_range(bool pulse) {
  const bool good = take_result();
  if (!operand_count(*rule_, 2, 2)) return;
  std::string message;
  const auto first = names_.device(words_[1], &message);
  if (!first) return error(message);
  const auto last = names_.device(words_[2], &message);
  if (!last) return error(message);
  if (first->family.empty() || first->family != last->family || last->index < first->index)
    return error("first and last must be of one kind, M, L, T, ST, C, D or Z, in this order");
  const std::uint32_t count = last->index - first->index + 1;
  Op op = Op::kZrstBits;
  std::uint32_t start = first->index;
  if (first->kind == Kind::kTimer || first->kind == Kind::kCounter) {
    op = first->kind == Kind::kTimer ? Op::kZrstTimers : Op::kZrstCounters;
    start = first->number;
  } else if (first->type != DeviceType::kBit) {
    op = Op::kZrstWords;
  }
  if (first->family == "SM" || first->family == "SD" || first->kind == Kind::kContact)
    return error("first and last must be of one kind, M, L, T, ST, C, D or Z, in this order");
  if (!good) return;
  emit_pulse(op, pulse);
  emit(op, start);
  emit2(count, 0);
}

void Compiler::pulse_coil(const Rule& rule) {
  Place place;
  const bool good = take_result();
  if (!operand_count(rule, 1, 1) || !bit_operand(words_[1], true, &place) || !good) return;
  note_coil(place);
  if (rule.op != Op::kPlf) note_rising();
  emit(rule.op, place.index);
  emit2(new_edge(), 0);
}

void Compiler::words(const Rule& rule, bool pulse) {
  const bool good = take_result();
  const std::string_view spec = rule.spec;
  const bool accumulate = rule.action == Action::kAccumulate;
  if (!operand_count(rule, accumulate ? 2 : spec.size(), spec.size())) return;
  std::vector<std::string_view> given(words_.begin() + 1, words_.end());
  if (given.size() < spec.size()) given = {given[1], given[0], given[1]};  // the form with two operands, such as - S D: D becomes D - S
  Encoded encoded[4] = {};
  unsigned mode = 0;
  bool fits = true;
  for (std::size_t i = 0; i < spec.size(); ++i) {
    // A destination that is also a source is checked only once, as the destination.
    if (accumulate && words_.size() == 3 && i == 0) continue;
    fits = encode(spec[i], given[i], &encoded[i]) && fits;
    mode |= static_cast<unsigned>(encoded[i].mode) << (2 * i);
  }
  if (!fits || !good) return;
  if (accumulate && words_.size() == 3) {
    encoded[0] = encoded[2];
    mode |= static_cast<unsigned>(encoded[0].mode);
  }
  check_constants(rule, encoded);
  emit_pulse(rule.op, pulse);
  emit(rule.op, encoded[0].value, mode);
  emit2(encoded[1].value, encoded[2].value);
  if (units_of(rule.op) == 3) emit2(encoded[3].value, 0);
}

void Compiler::alias() {
  if (!operand_count(*rule_, 2, 2)) return;
  --code_.instructions;
  std::string message;
  if (!names_.alias(words_[1], words_[2], &message)) error(message);
}

}  // namespace nc::ladder
