// SPDX-License-Identifier: Apache-2.0
// What a program remembers from one scan to the next about its own instructions, and by what another program knows these instructions again: see Memory in code.hpp.
#include <algorithm>

#include "ladder/compiler.hpp"

namespace nc::ladder {

namespace {

constexpr std::uint64_t kEmpty = 0xcbf29ce484222325u;  // FNV-1a

std::uint64_t with(std::uint64_t key, std::string_view text) {
  for (const char c : text) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return (key ^ 0xffu) * 0x100000001b3u;  // the end of the text, which holds no such byte: "A" "BC" is not "AB" "C"
}
std::uint64_t with(std::uint64_t key, std::uint64_t number) {
  for (unsigned shift = 0; shift < 64; shift += 8) key = (key ^ (number >> shift & 0xffu)) * 0x100000001b3u;
  return key;
}

}  // namespace

// The key of a rung is that of its lines, with the devices in the place of other names for them, because another program may give a name to another device.
void Compiler::add_to_rung() {
  const Action action = rule_->action;
  line_text_ = rule_->info.name;
  const std::string_view written = words_[0];
  if (written.size() != line_text_.size()) line_text_ += 'P';  // the form with an edge
  for (std::size_t i = 1; i < words_.size(); ++i) line_text_.append(" ").append(names_.without_aliases(words_[i]));
  key_before_line_ = rung_key_;
  if (action == Action::kAlias || action == Action::kNothing) return;
  rung_key_ = whole_rungs_.back() = with(rung_key_, line_text_);
  if (action == Action::kReturn || action == Action::kMainEnd || action == Action::kEnd || action == Action::kFor || action == Action::kNext || rule_->op == Op::kJump) note_flow(line_text_);
  else if (action == Action::kJump || action == Action::kCall) note_flow(line_text_ + std::to_string(key_here()));
}

void Compiler::begin_key() {
  key_before_rung_ = key_before_line_;
  whole_rungs_.back() = key_before_line_;
  rung_key_ = with(kEmpty, line_text_);
  whole_rungs_.push_back(rung_key_);
}

// What looked like a rung of its own goes on from the one before.
void Compiler::join_key() {
  whole_rungs_.pop_back();
  rung_key_ = whole_rungs_.back() = with(key_before_rung_, rung_key_);
  const std::uint64_t number = whole_rungs_.size() - 1;
  for (auto memory = code_.memories.rbegin(); memory != code_.memories.rend() && memory->rung_key > number; ++memory) memory->rung_key = number;
}

// Of the condition that holds here: the rung up to this line, and the rungs of the master controls around it.
std::uint64_t Compiler::key_here() const {
  std::uint64_t key = rung_key_;
  for (const Master& master : masters_) key = with(key, master.key);
  return key;
}

void Compiler::note_flow(std::string_view text) {
  code_.flow_key = with(code_.flow_key, text);
  ++flows_;
}

void Compiler::remember(std::uint32_t bit) {
  code_.memories.push_back({bit, key_here(), whole_rungs_.size() - 1, static_cast<std::uint32_t>(code_.units.size()), flows_, !main_ended_ && open_loops_.empty()});
}

void Compiler::note_written(const Place& place) {
  if (place.kind != Kind::kNamed && place.kind != Kind::kWordBit) return;
  std::vector<bool>& written = place.kind == Kind::kWordBit || place.type != DeviceType::kBit ? code_.words_written : code_.bits_written;
  if (place.index < written.size()) written[place.index] = true;
}

// Says which memories are of instructions that a jump may pass over or repeat, and makes one of those that share a bit: the coils of one counter.
void Compiler::finish_memories() {
  struct Span {
    std::uint32_t first, end;
  };
  std::vector<Span> spans;  // of units in the main program
  for (const Jump& jump : jumps_) {
    const auto label = labels_.find(jump.label);
    if (jump.call || jump.sub || label == labels_.end()) continue;
    const auto from = static_cast<std::uint32_t>(jump.unit);
    if (label->second.step > from) spans.push_back({from + 1, label->second.step});
    else spans.push_back({label->second.step, from + 1});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
  std::vector<Span> joined;
  for (const Span& span : spans) {
    if (!joined.empty() && span.first <= joined.back().end) joined.back().end = std::max(joined.back().end, span.end);
    else joined.push_back(span);
  }
  for (Memory& memory : code_.memories) {
    const auto behind = std::upper_bound(joined.begin(), joined.end(), memory.unit, [](std::uint32_t unit, const Span& span) { return unit < span.first; });
    if (behind != joined.begin() && memory.unit < std::prev(behind)->end) memory.always = false;
  }
  std::uint64_t rung = 0, in_rung = 0;
  for (Memory& memory : code_.memories) {
    in_rung = memory.rung_key == rung ? in_rung + 1 : 0;
    rung = memory.rung_key;
    memory.rung_key = with(with(memory.key, whole_rungs_[rung]), in_rung);
  }
  std::map<std::uint32_t, std::size_t> of_bit;
  std::vector<Memory> single;
  for (const Memory& memory : code_.memories) {
    const auto [known, added] = of_bit.emplace(memory.bit, single.size());
    if (added) {
      single.push_back(memory);
      continue;
    }
    Memory& first = single[known->second];
    first.key = with(with(first.key, memory.key), std::uint64_t{memory.area});
    first.rung_key = with(first.rung_key, memory.rung_key);
    first.always = first.always && memory.always;
  }
  code_.memories = std::move(single);
}

}  // namespace nc::ladder
